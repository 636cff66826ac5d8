#include "store/section_charges.hpp"

namespace enfilade {

void SectionCharges::read(Disk disk, ClusterId id, const RecordCount& count) {
  const PhaseScope phase(machine_, Phase::io);
  const std::uint64_t bytes = machine_.record_bytes(count);
  machine_.read(disk, id.value, bytes);
  count_.bytes_read += bytes;
  ++count_.files_read;
}

void SectionCharges::write(ClusterId id, Section section, const RecordCount& count) {
  const PhaseScope phase(machine_, Phase::io);
  const std::uint64_t bytes = machine_.record_bytes(count);
  machine_.write(Disk::local, id.value, bytes);
  count_.bytes_written += bytes;
  ++count_.files_written;
  Local& local = local_[id];
  if (section == Section::links) {
    local.links = true;
    local.links_bytes = bytes;
  } else {
    local.patches_bytes = bytes;
    written_[id.index()] = 1;
  }
}

bool SectionCharges::links_written(ClusterId id) const {
  const auto found = local_.find(id);
  return found != local_.end() && found->second.links;
}

void SectionCharges::move_to_common() {
  const PhaseScope phase(machine_, Phase::commit);
  for (const auto& [id, local] : local_) {
    if (local.links) machine_.move_to_common(id.value, local.links_bytes);
    machine_.move_to_common(id.value, local.patches_bytes);
  }
  for (const auto& [id, local] : local_) written_[id.index()] = 0;
  local_.clear();
}

}  // namespace enfilade
