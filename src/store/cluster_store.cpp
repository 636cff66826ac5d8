#include "store/cluster_store.hpp"

#include <utility>

namespace enfilade {

ClusterStore::ClusterStore(const RunLayout& layout, Rank rank, std::size_t clusters,
                           Machine& machine, std::unique_ptr<SectionShelf> shelf)
    : layout_(layout),
      local_directory_(layout.local_of(rank)),
      machine_(machine),
      shelf_(std::move(shelf)),
      links_slot_(clusters, Slot::a),
      written_(clusters, 0) {
  shelf_->open(local_directory_);
}

ClusterStore::~ClusterStore() { shelf_->close(local_directory_, layout_.local); }

SectionFile ClusterStore::read(Disk disk, const std::string& path, ClusterId id, Section section,
                               int iteration) {
  const PhaseScope phase(machine_, Phase::io);
  SectionFile file = shelf_->read(path, id, section, iteration);
  const std::uint64_t bytes = machine_.record_bytes(file.info.count);
  machine_.read(disk, id.value, bytes);
  count_.bytes_read += bytes;
  ++count_.files_read;
  return file;
}

std::uint64_t ClusterStore::put(Disk disk, const std::string& path, const SectionInfo& info,
                                std::span<const std::byte> bytes) {
  const PhaseScope phase(machine_, Phase::io);
  shelf_->write(path, info, bytes);
  const std::uint64_t size = machine_.record_bytes(info.count);
  machine_.write(disk, info.cluster.value, size);
  count_.bytes_written += size;
  ++count_.files_written;
  return size;
}

void ClusterStore::write_initial(const ClusterState& state) {
  const ClusterId id = state.id();
  const auto put_section = [&](const std::string& path, Section section, RecordCount count) {
    const std::vector<std::byte> bytes = state.bytes_of(section);
    count.bytes = bytes.size();
    shelf_->write(path, {id, section, 0, Slot::a, count}, bytes);
  };
  const std::string common = layout_.common();
  RecordCount surfaces, patches, links;
  surfaces.surfaces = state.patches().polygons();
  patches.patches = state.patches().size();
  links.links = state.links().size();
  put_section(RunLayout::geometry(common, id), Section::geometry, surfaces);
  put_section(RunLayout::patches(common, id, Slot::a), Section::patches, patches);
  put_section(RunLayout::links(common, id, Slot::a), Section::links, links);
  links_slot_[id.index()] = Slot::a;
}

SectionFile ClusterStore::read_geometry(ClusterId id) {
  return read(Disk::common, RunLayout::geometry(layout_.common(), id), id, Section::geometry, 0);
}

SectionFile ClusterStore::read_patches(ClusterId id) {
  if (written(id)) {
    const Slot slot = other(committed_slot());
    return read(Disk::local, RunLayout::patches(local_directory_, id, slot), id, Section::patches,
                committed_ + 1);
  }
  SectionFile file = read_committed_patches(id);
  links_slot_[id.index()] = file.info.links_slot;
  return file;
}

SectionFile ClusterStore::read_committed_patches(ClusterId id) {
  return read(Disk::common, RunLayout::patches(layout_.common(), id, committed_slot()), id,
              Section::patches, committed_);
}

SectionFile ClusterStore::read_links(ClusterId id) {
  const auto found = local_.find(id);
  const bool local = found != local_.end() && found->second.links;
  const std::string& directory = local ? local_directory_ : layout_.common();
  return read(local ? Disk::local : Disk::common,
              RunLayout::links(directory, id, links_slot_[id.index()]), id, Section::links,
              committed_ + (local ? 1 : 0));
}

void ClusterStore::write(ClusterId id, std::span<const std::byte> patches,
                         const RecordCount& patches_count, std::span<const std::byte> links,
                         const RecordCount& links_count) {
  Local& local = local_[id];
  written_[id.index()] = 1;
  Slot& links_slot = links_slot_[id.index()];
  const auto iteration = static_cast<std::uint32_t>(committed_ + 1);
  if (!links.empty()) {
    if (!local.links) links_slot = other(links_slot);  // the committed ones stay
    local.links = true;
    local.links_bytes = put(Disk::local, RunLayout::links(local_directory_, id, links_slot),
                            {id, Section::links, iteration, links_slot, links_count}, links);
  }
  local.patches_bytes =
      put(Disk::local, RunLayout::patches(local_directory_, id, other(committed_slot())),
          {id, Section::patches, iteration, links_slot, patches_count}, patches);
}

void ClusterStore::move_to_common() {
  const PhaseScope phase(machine_, Phase::commit);
  const std::string common = layout_.common();
  const Slot slot = other(committed_slot());
  for (const auto& [id, local] : local_) {
    const Slot links_slot = links_slot_[id.index()];
    if (local.links) {
      shelf_->exchange(RunLayout::links(local_directory_, id, links_slot),
                       RunLayout::links(common, id, links_slot));
      machine_.move_to_common(id.value, local.links_bytes);
    }
    shelf_->exchange(RunLayout::patches(local_directory_, id, slot),
                     RunLayout::patches(common, id, slot));
    machine_.move_to_common(id.value, local.patches_bytes);
  }
  for (const auto& [id, local] : local_) written_[id.index()] = 0;
  local_.clear();
}

}  // namespace enfilade
