// What every fuzz target has: libFuzzer's entry point, and a file for readers that want one.
#pragma once

#include <stdlib.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

/// Does what is tested with the bytes; a fault shows as a crash, a sanitizer's report or a hang.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace enfilade::fuzz {

/// Whether the reader took the last input, of a target that tells. A file of the corpus that a new
/// version of its format refuses tests nothing beyond the version.
inline bool was_read = false, tells_what_was_read = false;

/// Holds whatever the compiler does with assert.
inline void require(bool holds) {
  if (!holds) abort();
}

/// The bytes as a file with this extension, in a directory of its own that goes with it.
class InputFile {
 public:
  InputFile(const std::uint8_t* data, std::size_t size, const std::string& extension)
      : InputFile(std::string(reinterpret_cast<const char*>(data), size), extension) {}
  InputFile(const std::string& bytes, const std::string& extension) {
    std::string name = (std::filesystem::temp_directory_path() / "enfilade_fuzz_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
    directory_ = name;
    path_ = directory_ / ("input" + extension);
    put_beside("input" + extension, bytes);
  }
  /// A further file, in the same directory.
  void put_beside(const std::string& name, const std::string& bytes) const {
    std::ofstream(directory_ / name, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  ~InputFile() { std::filesystem::remove_all(directory_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path directory_, path_;
};

}  // namespace enfilade::fuzz
