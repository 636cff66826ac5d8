#include "run/section_shelf.hpp"

#include <filesystem>

#include "base/posix_file.hpp"

namespace enfilade {

void FileShelf::open(const std::string& local_directory) {
  remove_directory(local_directory);  // what a run that died has left there was never committed
  make_directory(local_directory);
}

void FileShelf::close(const std::string& local_directory, const std::string& parent) {
  std::error_code ignored;  // what cannot be removed is in nobody's way
  std::filesystem::remove_all(local_directory, ignored);
  std::filesystem::remove(parent, ignored);  // once the last rank's is gone
}

SectionFile FileShelf::read(const std::string& path, ClusterId cluster, Section section, int) {
  return read_section(path, cluster, section);
}

void FileShelf::write(const std::string& path, const SectionInfo& info,
                      std::span<const std::byte> bytes) {
  write_section(path, info, bytes);
}

void FileShelf::exchange(const std::string& from, const std::string& to) {
  exchange_file(from, to);
}

}  // namespace enfilade
