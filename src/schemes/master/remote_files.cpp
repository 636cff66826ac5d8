#include "schemes/master/remote_files.hpp"

namespace enfilade {
namespace {
constexpr Rank master{0};
}

void RemoteFiles::announce(std::span<const SectionName> sections) {
  if (sections.empty()) return;
  const PhaseScope phase(machine_, Phase::io);
  send(communicator_, master, SectionRequest{{sections.begin(), sections.end()}});
  auto reply = receive_from_master<SectionReply>(communicator_, machine_);
  ENFILADE_CHECK(reply.sections.size() == sections.size(), std::to_string(reply.sections.size()));
  for (std::size_t i = 0; i < sections.size(); ++i) {
    fetched_[sections[i]] = std::move(reply.sections[i]);
  }
}

SectionFile RemoteFiles::take(const SectionName& name) {
  if (!fetched_.contains(name)) announce({&name, 1});
  auto node = fetched_.extract(name);
  return std::move(node.mapped());
}

void RemoteFiles::write(ClusterId id, std::span<const std::byte> patches,
                        const RecordCount& patches_count, std::span<const std::byte> links,
                        const RecordCount& links_count) {
  const auto file = [&](Section section, std::span<const std::byte> bytes,
                        const RecordCount& count) {
    const auto iteration = static_cast<std::uint32_t>(committed_ + 1);
    return SectionFile{{id, section, iteration, Slot::a, count}, {bytes.begin(), bytes.end()}};
  };
  const PhaseScope phase(machine_, Phase::io);
  ClusterResult result;
  result.sections.push_back(file(Section::patches, patches, patches_count));
  if (!links.empty()) result.sections.push_back(file(Section::links, links, links_count));
  send(communicator_, master, result);
  written_.insert(id);
}

void RemoteFiles::move_to_common() {
  written_.clear();
  fetched_.clear();
}

SectionReply read_for(ClusterStore& store, const SectionRequest& request) {
  SectionReply reply;
  for (const SectionName& name : request.sections) {
    switch (name.section) {
      case Section::geometry:
        reply.sections.push_back(store.read_geometry(name.cluster));
        break;
      case Section::patches:  // read_patches() of a cluster without a gather also locates its links
        reply.sections.push_back(name.committed && store.written(name.cluster)
                                     ? store.read_committed_patches(name.cluster)
                                     : store.read_patches(name.cluster));
        break;
      case Section::links:
        reply.sections.push_back(store.read_links(name.cluster));
        break;
    }
  }
  return reply;
}

void write_for(ClusterStore& store, const ClusterResult& result) {
  ENFILADE_CHECK(!result.sections.empty(), "a result without patches");
  const SectionFile& patches = result.sections.front();
  const bool has_links = result.sections.size() > 1;
  const SectionFile& links = result.sections.back();
  store.write(patches.info.cluster, patches.bytes, patches.info.count,
              has_links ? std::span<const std::byte>(links.bytes) : std::span<const std::byte>(),
              links.info.count);
}

}  // namespace enfilade
