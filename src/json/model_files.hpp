// The files of a model, read within limits: no other file of the machine can be drawn in.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace enfilade {

/// Reads the model and what it names. Only regular files are read, only such as lie in a model's
/// folder or below it (links followed) unless that is lifted, and not more bytes than
/// `most_bytes` in all.
class ModelFiles {
 public:
  static constexpr std::uint64_t most_bytes = std::uint64_t{4} << 30;

  /// The files that the user names; the first gives its name to the model.
  ModelFiles(std::vector<std::string> models, bool allow_outside);
  ModelFiles(const std::string& model, bool allow_outside)
      : ModelFiles(std::vector{model}, allow_outside) {}

  const std::string& model() const { return models_[0]; }
  /// Returns the bytes of the model itself. Throws InputError.
  const std::string& read_model() { return read(model(), {model(), "file"}); }

  /// Where a file is named, for messages.
  struct Place {
    std::string file, where;
  };
  /// Returns the path of `name`, which is named in the folder of file `from`. Where it is not
  /// there, letters of another case will do, as they do where most models are made.
  static std::string path_from(const std::string& from, const std::string& name);
  /// Returns the bytes of a file that is named at `place`, read once and kept. Throws InputError
  /// that names the place where it is missing, empty, no regular file, outside or too large.
  const std::string& read(const std::string& path, const Place& place);
  /// The same for a file of text: in UTF-8 (text_encoding.hpp).
  const std::string& read_text(const std::string& path, const Place& place);
  /// True where a file of that path may be read.
  bool allowed(const std::string& path) const;
  /// True where a file of that name is there, of whatever kind.
  static bool exists(const std::string& path);
  /// Returns the full path, links followed where that is possible: one that cannot exist (too long,
  /// links in a circle) is no error here.
  static std::string canonical(const std::string& path);
  /// Hash of the names and bytes of all files read.
  std::uint64_t hash() const { return hash_; }

 private:
  [[noreturn]] static void fail(const std::string& path, const Place& place,
                                const std::string& what, const std::string& hint);

  std::vector<std::string> models_, folders_;
  bool allow_outside_;
  std::uint64_t bytes_ = 0, hash_ = 0;
  std::map<std::string, std::string> read_, text_;  ///< by path
};

}  // namespace enfilade
