// A file that appears under its name when it is complete, and not before.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace enfilade {

/// Writes into a new file beside `path`, of a name that nobody can foresee (O_EXCL, so that no link
/// is followed); commit() renames it to `path`. An object that is dropped leaves nothing. A device
/// or a pipe at `path`, such as /dev/stdout, is written to as it stands. All but the destructor
/// throw RunError.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void add(std::string_view text);
  /// `durable`: flushes the bytes to the disk first, so that a power cut does not leave the name
  /// with none of them.
  void commit(bool durable);

 private:
  void open_beside();
  [[noreturn]] void fail(int code);

  std::string path_, temporary_;  ///< no temporary: `path_` itself is written to
  int fd_ = -1;
};

/// Replaces a file by `text`, at once: if this process dies, the file holds all of the old or all
/// of the new text. Throws RunError; the file then keeps its old content.
void replace_file(const std::string& path, std::string_view text);
/// The same, flushed to the disk: for files that outlive the run.
void write_file_atomically(const std::string& path, std::string_view text);

/// Removes from `directory` what AtomicFiles of processes that died have left there.
void remove_unfinished_files(const std::string& directory);
/// True for the name of a file that an AtomicFile has not finished.
bool is_unfinished_file(std::string_view name);

}  // namespace enfilade
