// Where the sections of clusters lie: in files; or, when a run is replayed, in its record alone.
#pragma once

#include <span>
#include <string>

#include "run/section_file.hpp"

namespace enfilade {

class SectionShelf {
 public:
  virtual ~SectionShelf() = default;
  /// Makes a rank's local directory, empty.
  virtual void open(const std::string& local_directory) = 0;
  /// Takes it away again, and `parent` once nothing is left in there.
  virtual void close(const std::string& local_directory, const std::string& parent) = 0;
  /// The section as iteration `iteration` left it. Throws RunError.
  virtual SectionFile read(const std::string& path, ClusterId cluster, Section section,
                           int iteration) = 0;
  virtual void write(const std::string& path, const SectionInfo& info,
                     std::span<const std::byte> bytes) = 0;
  virtual void exchange(const std::string& from, const std::string& to) = 0;
};

/// In files, each with its header and checksum (section_file.hpp).
class FileShelf final : public SectionShelf {
 public:
  void open(const std::string& local_directory) override;
  void close(const std::string& local_directory, const std::string& parent) override;
  SectionFile read(const std::string& path, ClusterId cluster, Section section,
                   int iteration) override;
  void write(const std::string& path, const SectionInfo& info,
             std::span<const std::byte> bytes) override;
  void exchange(const std::string& from, const std::string& to) override;
};

}  // namespace enfilade
