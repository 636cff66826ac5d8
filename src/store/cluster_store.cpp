#include "store/cluster_store.hpp"

#include <filesystem>

#include "base/posix_file.hpp"

namespace enfilade {

ClusterStore::ClusterStore(const RunLayout& layout, std::uint64_t run, Rank rank, int ranks,
                           std::size_t clusters, Machine& machine)
    : layout_(layout),
      local_directory_(layout.local_of(rank)),
      rank_(rank),
      ranks_(ranks),
      machine_(machine),
      charges_(machine, clusters),
      run_(run),
      own_patches_(clusters),
      links_(clusters) {
  remove_directory(local_directory_);  // what a run that died has left there was never committed
  make_directory(local_directory_);
}

ClusterStore::~ClusterStore() {
  std::error_code ignored;  // a directory that cannot be removed is in nobody's way
  std::filesystem::remove_all(local_directory_, ignored);
  std::filesystem::remove(layout_.local, ignored);  // succeeds for the last rank
}

SegmentKind ClusterStore::kind(Section section, std::uint32_t iteration) const {
  const std::string name =
      section == Section::geometry ? RunLayout::geometry()
      : section == Section::links
          ? RunLayout::links(iteration)
          : RunLayout::patches(RunLayout::slot_of(static_cast<int>(iteration)));
  return {name, section, iteration, run_};
}

void ClusterStore::write_initial(const ClusterState& state) {
  const ClusterId id = state.id();
  const auto put_section = [&](std::unique_ptr<SegmentWriter>& writer, Section section,
                               RecordCount count) {
    if (!writer)
      writer = std::make_unique<SegmentWriter>(layout_.common(), kind(section, 0), rank_);
    return writer->put({{id, section, 0, run_}, links_[id.index()], count},
                       state.bytes_of(section));
  };
  RecordCount surfaces, patches, links;
  surfaces.surfaces = state.patches().polygons();
  patches.patches = state.patches().size();
  links.links = state.links().size();
  links_[id.index()] = {};
  put_section(geometry_writer_, Section::geometry, surfaces);
  links_[id.index()] = {0, put_section(links_writer_, Section::links, links)};
  put_section(patches_writer_, Section::patches, patches);
}

void ClusterStore::end_initial() {
  for (std::unique_ptr<SegmentWriter>* writer :
       {&geometry_writer_, &links_writer_, &patches_writer_}) {
    if (*writer) (*writer)->end();
    writer->reset();
  }
}

void ClusterStore::set_committed(int iteration) {
  committed_ = iteration;
  patches_.reset();
  if (rank_.value == 0 && iteration > 0)
    remove_unused_links(layout_.common(), index_of(Section::patches));
}

/// Reads the tables of common when it is first asked.
const SegmentIndex& ClusterStore::index_of(Section section) {
  std::unique_ptr<SegmentIndex>& index = section == Section::geometry ? geometry_ : patches_;
  const auto iteration = static_cast<std::uint32_t>(committed_);
  if (!index)
    index = std::make_unique<SegmentIndex>(
        layout_.common(), kind(section, section == Section::geometry ? 0 : iteration),
        links_.size(), ranks_);
  return *index;
}

SectionFile ClusterStore::load_links(ClusterId id) {
  const auto& [iteration, at] = links_[id.index()];
  const SectionPlace place{id, Section::links, iteration, run_};
  if (charges_.links_written(id)) return links_writer_->get(at, place);
  return read_section(segment_path(layout_.common(), RunLayout::links(iteration), at.rank, at.part),
                      at.offset, place);
}

SectionFile ClusterStore::load_section(const SectionName& name) {
  const auto& [id, section, committed] = name;
  const PhaseScope phase(machine_, Phase::io);
  const bool local = section == Section::links     ? charges_.links_written(id)
                     : section == Section::patches ? !committed && written(id)
                                                   : false;
  const auto iteration = static_cast<std::uint32_t>(committed_ + 1);
  SectionFile file =
      section == Section::links ? load_links(id)
      : local ? patches_writer_->get(own_patches_[id.index()], {id, section, iteration, run_})
              : index_of(section).read(id);
  charges_.read(local ? Disk::local : Disk::common, id, file.info.count);
  if (section == Section::patches && !written(id)) links_[id.index()] = file.info.links;
  return file;
}

void ClusterStore::store_sections(std::vector<SectionFile> sections) {
  const ClusterId id = sections.front().info.place.cluster;
  const auto iteration = static_cast<std::uint32_t>(committed_ + 1);
  for (auto file = sections.rbegin(); file != sections.rend(); ++file) {  // links, then patches
    const PhaseScope phase(machine_, Phase::io);
    SectionPlace& place = file->info.place;
    place.iteration = iteration;
    place.run = run_;
    file->info.links = links_[id.index()];
    std::unique_ptr<SegmentWriter>& writer =
        place.section == Section::links ? links_writer_ : patches_writer_;
    if (!writer)
      writer =
          std::make_unique<SegmentWriter>(local_directory_, kind(place.section, iteration), rank_);
    const SegmentPlace at = writer->put(file->info, file->bytes);
    if (place.section == Section::links) {
      links_[id.index()] = {iteration, at};
    } else {
      own_patches_[id.index()] = at;
    }
    charges_.write(id, place.section, file->info.count);
  }
}

void ClusterStore::move_to_common() {
  for (std::unique_ptr<SegmentWriter>* writer : {&links_writer_, &patches_writer_}) {
    if (!*writer) continue;
    const std::uint32_t parts = (*writer)->end();
    for (std::uint32_t part = 0; part < parts; ++part) {
      const auto path = [&](const std::string& directory) {
        return segment_path(directory, (*writer)->kind().name, rank_, part);
      };
      exchange_file(path(local_directory_), path(layout_.common()));
    }
    writer->reset();
  }
  charges_.move_to_common();
}

}  // namespace enfilade
