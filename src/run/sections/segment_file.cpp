#include "run/sections/segment_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>

#include "base/byte_stream.hpp"
#include "base/checksum.hpp"
#include "base/error.hpp"
#include "base/posix_file.hpp"
#include "run/sections/run_layout.hpp"

namespace enfilade {
namespace {

constexpr std::array<char, 8> segment_mark = {'E', 'N', 'F', 'S', 'E', 'G', 'M', '\n'};
constexpr std::uint32_t segment_version = 1;
constexpr std::size_t buffer_bytes = std::size_t{1} << 20;
/// Of the table's end: version, section, iteration, run, number of entries, checksum, mark.
constexpr std::size_t end_bytes = 2 * sizeof(std::uint32_t) + 1 + 3 * sizeof(std::uint64_t) + 8;
/// Of an entry: cluster, offset, place of the links.
constexpr std::size_t entry_bytes =
    sizeof(std::uint32_t) + sizeof(std::uint64_t) + links_place_bytes;

struct SegmentName {
  Rank rank;
  std::string kind;
  std::uint32_t part = 0;
};

template <class Number>
bool take_number(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// "rank-R.KIND.PART"; none for other files.
std::optional<SegmentName> segment_name(std::string_view file) {
  constexpr std::string_view head = "rank-";
  const std::size_t first = file.find('.'), last = file.rfind('.');
  SegmentName name;
  if (!file.starts_with(head) || first == last || last == std::string_view::npos) return {};
  if (!take_number(file.substr(head.size(), first - head.size()), name.rank.value)) return {};
  if (!take_number(file.substr(last + 1), name.part)) return {};
  name.kind = file.substr(first + 1, last - first - 1);
  return name;
}

std::optional<std::uint32_t> iteration_of_links(const SegmentName& name) {
  constexpr std::string_view head = "links-";
  std::uint32_t iteration = 0;
  if (!name.kind.starts_with(head) ||
      !take_number(std::string_view(name.kind).substr(head.size()), iteration))
    return {};
  return iteration;
}

std::vector<SegmentName> segments_in(const std::string& directory) {
  std::vector<SegmentName> names;
  std::error_code code;
  for (std::filesystem::directory_iterator it(directory, code), end; !code && it != end;
       it.increment(code)) {
    if (auto name = segment_name(it->path().filename().string())) names.push_back(std::move(*name));
  }
  return names;
}

void remove_segment(const std::string& directory, const SegmentName& name) {
  const std::string path = segment_path(directory, name.kind, name.rank, name.part);
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) fail_to_write(path, errno);
}

std::vector<std::byte> table_bytes(const SegmentKind& kind, std::span<const SegmentEntry> entries) {
  ByteWriter w(entries.size() * entry_bytes + end_bytes);
  for (const SegmentEntry& entry : entries) {
    w.put(entry.cluster);
    w.put(entry.at.offset);
    put_links(w, entry.links);
  }
  w.put(segment_version);
  w.put(kind.section);
  w.put(kind.iteration);
  w.put(kind.run);
  w.put(static_cast<std::uint64_t>(entries.size()));
  w.put(checksum(w.bytes()));
  w.put(segment_mark);
  return w.take();
}

/// Returns the table of a part; none where it is missing or of another run or iteration.
std::optional<std::vector<SegmentEntry>> read_table(const std::string& path,
                                                    const SegmentKind& kind, Rank rank,
                                                    std::uint32_t part) {
  std::error_code code;
  const std::uint64_t size = std::filesystem::file_size(path, code);
  if (code == std::errc::no_such_file_or_directory) return {};
  if (code || size < end_bytes) refuse_damaged(path, "the file is cut short");
  const std::vector<std::byte> end = read_part(path, size - end_bytes, end_bytes);
  ByteReader last(end, path);
  const auto of_version = last.get<std::uint32_t>();
  const auto section = last.get<Section>();
  const auto iteration = last.get<std::uint32_t>();
  const auto run = last.get<std::uint64_t>();
  const auto count = last.get<std::uint64_t>();
  last.get<std::uint64_t>();
  if (last.get<std::array<char, 8>>() != segment_mark)
    refuse_damaged(path, "the file is cut short or no segment");
  if (of_version != segment_version)
    refuse_damaged(path, "version " + std::to_string(of_version) + " is not known");
  if (count > (size - end_bytes) / entry_bytes) refuse_damaged(path, "the table is damaged");
  const std::size_t bytes = count * entry_bytes + end_bytes;
  const std::vector<std::byte> table = read_part(path, size - bytes, bytes);
  const std::size_t summed = bytes - sizeof(std::uint64_t) - segment_mark.size();
  ByteReader sum(std::span<const std::byte>(table).subspan(summed), path);
  if (sum.get<std::uint64_t>() != checksum(std::span<const std::byte>(table).first(summed)))
    refuse_damaged(path, "the table is damaged (checksum)");
  std::vector<SegmentEntry> entries;
  if (section != kind.section || iteration != kind.iteration || run != kind.run) return {};
  ByteReader r(table, path);
  for (std::uint64_t i = 0; i < count; ++i) {
    SegmentEntry entry;
    entry.cluster = r.get<ClusterId>();
    entry.at = {rank, part, r.get<std::uint64_t>()};
    entry.links = get_links(r);
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace

std::string segment_path(const std::string& directory, const std::string& kind, Rank rank,
                         std::uint32_t part) {
  return directory + "/rank-" + std::to_string(rank.value) + "." + kind + "." +
         std::to_string(part);
}

SegmentWriter::SegmentWriter(std::string directory, SegmentKind kind, Rank rank,
                             std::uint64_t most_part_bytes)
    : directory_(std::move(directory)),
      kind_(std::move(kind)),
      rank_(rank),
      most_part_bytes_(most_part_bytes) {}

SegmentWriter::~SegmentWriter() {
  if (file_ >= 0) ::close(file_);
}

/// Over the old content rather than into a new file: creating one costs a file system a hundred
/// times more. A link is not followed, and a pipe does not wait for its reader.
void SegmentWriter::open() {
  file_ = ::open(path().c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK, 0644);
  if (file_ < 0) fail_to_write(path(), errno);
  written_ = 0;
}

void SegmentWriter::flush() {
  write_all(file_, path(), buffer_);
  buffer_.clear();
}

SegmentPlace SegmentWriter::put(const SectionInfo& info, std::span<const std::byte> bytes) {
  const std::vector<std::byte> header = section_header(info, bytes);
  const std::size_t size = header.size() + bytes.size();
  if (file_ >= 0 && written_ + size > most_part_bytes_) {
    end_part();
    ++part_;
  }
  if (file_ < 0) open();
  const SegmentPlace at{rank_, part_, written_};
  buffer_.insert(buffer_.end(), header.begin(), header.end());
  written_ += size;
  table_.push_back({info.place.cluster, at, info.links});
  if (buffer_.size() + bytes.size() > buffer_bytes) flush();
  if (bytes.size() > buffer_bytes) {
    write_all(file_, path(), bytes);
  } else {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  }
  return at;
}

SectionFile SegmentWriter::get(const SegmentPlace& at, const SectionPlace& place) {
  if (file_ >= 0) flush();
  return read_section(segment_path(directory_, kind_.name, rank_, at.part), at.offset, place);
}

void SegmentWriter::end_part() {
  const std::vector<std::byte> table = table_bytes(kind_, table_);
  buffer_.insert(buffer_.end(), table.begin(), table.end());
  flush();
  if (::ftruncate(file_, static_cast<off_t>(written_ + table.size())) != 0)
    fail_to_write(path(), errno);
  const int closed = ::close(file_);
  file_ = -1;
  if (closed != 0) fail_to_write(path(), errno);
  table_.clear();
}

std::uint32_t SegmentWriter::end() {
  if (file_ < 0) return 0;
  end_part();
  return part_ + 1;
}

SegmentIndex::SegmentIndex(const std::string& directory, SegmentKind kind, std::size_t clusters,
                           int ranks)
    : directory_(directory), kind_(std::move(kind)), entries_(clusters) {
  for (Rank rank{0}; rank.value < ranks; ++rank.value) {
    for (std::uint32_t part = 0; add_table(rank, part); ++part) {
    }
  }
}

/// False where there is no such part.
bool SegmentIndex::add_table(Rank rank, std::uint32_t part) {
  const std::string path = segment_path(directory_, kind_.name, rank, part);
  const auto table = read_table(path, kind_, rank, part);
  if (!table) return false;
  for (const SegmentEntry& entry : *table) {
    if (entry.cluster.index() >= entries_.size())
      refuse_damaged(path, "holds a cluster that there is not");
    std::optional<SegmentEntry>& known = entries_[entry.cluster.index()];
    if (known && known->at.rank != rank) {
      refuse_damaged(path, "holds cluster " + std::to_string(entry.cluster.value) +
                               ", and so does rank " + std::to_string(known->at.rank.value));
    }
    known = entry;
  }
  return true;
}

bool SegmentIndex::complete() const {
  return std::ranges::all_of(entries_, [](const auto& entry) { return entry.has_value(); });
}

const SegmentEntry& SegmentIndex::at(ClusterId id) const {
  const std::optional<SegmentEntry>& entry = entries_[id.index()];
  if (!entry) {
    refuse_damaged(directory_, kind_.name + " of cluster " + std::to_string(id.value) +
                                   " are in no file of iteration " +
                                   std::to_string(kind_.iteration));
  }
  return *entry;
}

SectionFile SegmentIndex::read(ClusterId id) const {
  const SegmentPlace& place = at(id).at;
  return read_section(segment_path(directory_, kind_.name, place.rank, place.part), place.offset,
                      {id, kind_.section, kind_.iteration, kind_.run});
}

std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> SegmentIndex::links() const {
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> named;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const LinksPlace& links = at(ClusterId(i)).links;
    named.insert({links.iteration, static_cast<std::uint32_t>(links.at.rank.value), links.at.part});
  }
  return named;
}

void remove_unused_links(const std::string& directory, const SegmentIndex& committed_patches) {
  if (!committed_patches.complete()) return;
  const auto named = committed_patches.links();
  for (const SegmentName& name : segments_in(directory)) {
    const auto iteration = iteration_of_links(name);
    if (iteration && *iteration <= committed_patches.kind().iteration &&
        !named.contains({*iteration, static_cast<std::uint32_t>(name.rank.value), name.part}))
      remove_segment(directory, name);
  }
}

void remove_later_segments(const std::string& directory, std::uint32_t committed) {
  const std::string later = RunLayout::patches(RunLayout::slot_of(static_cast<int>(committed) + 1));
  for (const SegmentName& name : segments_in(directory)) {
    if (name.kind == later || iteration_of_links(name).value_or(0) > committed)
      remove_segment(directory, name);
  }
}

}  // namespace enfilade
