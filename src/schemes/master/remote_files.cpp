#include "schemes/master/remote_files.hpp"

namespace enfilade {
namespace {
constexpr Rank master{0};
}

void RemoteFiles::prefetch(std::vector<SectionName> names) {
  if (names.empty()) return;
  const PhaseScope phase(machine_, Phase::io);
  send(communicator_, master, SectionRequest{names});
  auto reply = receive_from_master<SectionReply>(communicator_, machine_);
  ENFILADE_CHECK(reply.sections.size() == names.size(), std::to_string(reply.sections.size()));
  for (std::size_t i = 0; i < names.size(); ++i) fetched_[names[i]] = std::move(reply.sections[i]);
}

SectionFile RemoteFiles::load_section(const SectionName& name) {
  if (!fetched_.contains(name)) prefetch({name});
  auto node = fetched_.extract(name);
  return std::move(node.mapped());
}

void RemoteFiles::store_sections(std::vector<SectionFile> sections) {
  const PhaseScope phase(machine_, Phase::io);
  written_.insert(sections.front().info.place.cluster);
  send(communicator_, master, ClusterResult{std::move(sections)});
}

void RemoteFiles::move_to_common() {
  written_.clear();
  fetched_.clear();
}

}  // namespace enfilade
