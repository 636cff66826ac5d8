#include "store/cluster_store.hpp"

#include <filesystem>

#include "base/posix_file.hpp"

namespace enfilade {

ClusterStore::ClusterStore(const RunLayout& layout, std::uint64_t run, Rank rank,
                           std::size_t clusters, Machine& machine)
    : layout_(layout),
      local_directory_(layout.local_of(rank)),
      machine_(machine),
      charges_(machine, clusters),
      run_(run),
      links_(clusters) {
  remove_directory(local_directory_);  // what a run that died has left there was never committed
  make_directory(local_directory_);
}

ClusterStore::~ClusterStore() {
  std::error_code ignored;  // a directory that cannot be removed is in nobody's way
  std::filesystem::remove_all(local_directory_, ignored);
  std::filesystem::remove(layout_.local, ignored);  // succeeds for the last rank
}

void ClusterStore::write_initial(const ClusterState& state) {
  const ClusterId id = state.id();
  const auto put_section = [&](const std::string& path, Section section, RecordCount count) {
    const std::vector<std::byte> bytes = state.bytes_of(section);
    count.bytes = bytes.size();
    write_section(path, {{id, section, 0, run_}, {}, count}, bytes);
  };
  const std::string common = layout_.common();
  RecordCount surfaces, patches, links;
  surfaces.surfaces = state.patches().polygons();
  patches.patches = state.patches().size();
  links.links = state.links().size();
  put_section(RunLayout::geometry(common, id), Section::geometry, surfaces);
  put_section(RunLayout::patches(common, id, Slot::a), Section::patches, patches);
  put_section(RunLayout::links(common, id, Slot::a), Section::links, links);
  links_[id.index()] = {};
}

std::string ClusterStore::path_of(const std::string& directory, ClusterId id,
                                  Section section) const {
  return section == Section::links ? RunLayout::links(directory, id, links_[id.index()].slot)
                                   : RunLayout::patches(directory, id, other(committed_slot()));
}

SectionFile ClusterStore::load_section(const SectionName& name) {
  const auto& [id, section, committed] = name;
  const PhaseScope phase(machine_, Phase::io);
  const std::string common = layout_.common();
  Disk disk = Disk::common;
  std::string path;
  SectionPlace place{id, section, 0, run_};
  if (section == Section::geometry) {
    path = RunLayout::geometry(common, id);
  } else {
    const bool local =
        section == Section::links ? charges_.links_written(id) : !committed && written(id);
    if (local) disk = Disk::local;
    path = local || section == Section::links
               ? path_of(local ? local_directory_ : common, id, section)
               : RunLayout::patches(common, id, committed_slot());
    place.iteration = section == Section::links
                          ? links_[id.index()].iteration
                          : static_cast<std::uint32_t>(committed_ + (local ? 1 : 0));
  }
  SectionFile file = read_section(path, place);
  charges_.read(disk, id, file.info.count);
  if (section == Section::patches && !written(id)) links_[id.index()] = file.info.links;
  return file;
}

void ClusterStore::store_sections(std::vector<SectionFile> sections) {
  const ClusterId id = sections.front().info.place.cluster;
  const auto iteration = static_cast<std::uint32_t>(committed_ + 1);
  LinksPlace& links = links_[id.index()];
  if (sections.back().info.place.section == Section::links) {
    // The committed links stay as they are.
    if (!charges_.links_written(id)) links.slot = other(links.slot);
    links.iteration = iteration;
  }
  for (auto file = sections.rbegin(); file != sections.rend(); ++file) {  // links, then patches
    const PhaseScope phase(machine_, Phase::io);
    SectionPlace& place = file->info.place;
    place.iteration = iteration;
    place.run = run_;
    file->info.links = links;
    write_section(path_of(local_directory_, id, place.section), file->info, file->bytes);
    charges_.write(id, place.section, file->info.count);
  }
}

void ClusterStore::move_to_common() {
  const std::string common = layout_.common();
  charges_.move_to_common([&](ClusterId id, Section section) {
    exchange_file(path_of(local_directory_, id, section), path_of(common, id, section));
  });
}

}  // namespace enfilade
