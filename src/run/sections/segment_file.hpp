// Segments: files that hold the sections of many clusters, one behind the other. A rank writes one
// for all the patches of an iteration, and one for the links that changed, instead of two files for
// each cluster: of what a file system does, making a file is the dearest.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "run/sections/section_file.hpp"

namespace enfilade {

/// What a segment is of: its kind names its file, and the rest stands in its table.
struct SegmentKind {
  std::string name;  ///< RunLayout::geometry(), patches(), links()
  Section section = Section::geometry;
  std::uint32_t iteration = 0;
  std::uint64_t run = 0;
};

/// Returns "DIRECTORY/rank-R.KIND.PART".
std::string segment_path(const std::string& directory, const std::string& kind, Rank rank,
                         std::uint32_t part);

/// One section of a segment, as the segment's table has it.
struct SegmentEntry {
  ClusterId cluster;
  SegmentPlace at;
  LinksPlace links;  ///< of patches
};

/// Writes a rank's segment of one kind.
class SegmentWriter {
 public:
  /// `most_part_bytes`: a part ends before that, unless one section alone is larger, so that 32-bit
  /// tools can read it.
  SegmentWriter(std::string directory, SegmentKind kind, Rank rank,
                std::uint64_t most_part_bytes = std::uint64_t{1} << 30);
  /// What was not ended is no segment.
  ~SegmentWriter();
  SegmentWriter(const SegmentWriter&) = delete;
  SegmentWriter& operator=(const SegmentWriter&) = delete;

  const SegmentKind& kind() const { return kind_; }
  /// Appends a section. Throws RunError.
  SegmentPlace put(const SectionInfo& info, std::span<const std::byte> bytes);
  /// Reads a section that was put before.
  SectionFile get(const SegmentPlace& at, const SectionPlace& place);
  /// Ends the segment with its table, without which nobody reads it. Returns the number of its
  /// parts. Throws RunError.
  std::uint32_t end();

 private:
  std::string path() const { return segment_path(directory_, kind_.name, rank_, part_); }
  void open();
  void flush();
  void end_part();

  std::string directory_;
  SegmentKind kind_;
  Rank rank_;
  std::uint64_t most_part_bytes_;
  int file_ = -1;
  std::uint32_t part_ = 0;
  std::uint64_t written_ = 0;        ///< bytes of this part, those in `buffer_` among them
  std::vector<std::byte> buffer_;    ///< not written yet
  std::vector<SegmentEntry> table_;  ///< of this part
};

/// Where each cluster's section of one kind lies, by the tables of all ranks' segments.
class SegmentIndex {
 public:
  /// Reads the tables in `directory` of ranks 0 .. ranks - 1, by their names: a listing may lag
  /// behind on a network's disk. Segments of another run or iteration are passed over: ranks that
  /// gathered for no cluster have left theirs. Throws RunError for a damaged table and a cluster of
  /// two ranks.
  SegmentIndex(const std::string& directory, SegmentKind kind, std::size_t clusters, int ranks);

  /// True where each cluster is in one of them.
  bool complete() const;
  /// Throws RunError where the cluster is in none of them.
  const SegmentEntry& at(ClusterId id) const;
  SectionFile read(ClusterId id) const;
  const SegmentKind& kind() const { return kind_; }
  /// Returns the segments of links that the patches name: iteration, rank and part. Throws RunError
  /// where a cluster is in no segment.
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> links() const;

 private:
  bool add_table(Rank rank, std::uint32_t part);

  std::string directory_;
  SegmentKind kind_;
  std::vector<std::optional<SegmentEntry>> entries_;  ///< by cluster
};

/// Removes segments of links of the committed iteration and those before it that its patches do not
/// name: newer ones replace all of theirs. Later ones may be those of a rank that is ahead. Removes
/// nothing where a cluster's patches are missing.
void remove_unused_links(const std::string& directory, const SegmentIndex& committed_patches);
/// Removes what ranks that are no more may have left of iterations after the committed one. No rank
/// may write yet.
void remove_later_segments(const std::string& directory, std::uint32_t committed);

}  // namespace enfilade
