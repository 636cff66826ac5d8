#include "hierarchy/cluster_state.hpp"

#include "hierarchy/cluster_codec.hpp"

namespace enfilade {

namespace {

PolygonFrame frame_of(const ClusterPolygon& polygon, const Scene& scene) {
  PolygonFrame frame = frame_on(polygon.polygon);
  frame.surface = polygon.surface;
  const Surface& surface = scene.surfaces[polygon.surface.index()];
  frame.reflectance.assign(surface.reflectance.begin(), surface.reflectance.end());
  frame.exitance.assign(surface.exitance.begin(), surface.exitance.end());
  frame.transmittance.assign(surface.transmittance.begin(), surface.transmittance.end());
  for (const Segment& s : polygon.contacts) {
    frame.lines.push_back({frame.project(s.a), frame.project(s.b)});
  }
  return frame;
}

std::vector<PolygonFrame> frames_of(const Cluster& cluster, const Scene& scene) {
  std::vector<PolygonFrame> frames;
  frames.reserve(cluster.polygons.size());
  for (const ClusterPolygon& p : cluster.polygons) frames.push_back(frame_of(p, scene));
  return frames;
}

/// Transport coefficients per link: 3 x 3 for the linear basis; else one for patches, four for
/// groups (LinkEstimate::transport), and six for groups that receive from far nodes (FarTerms).
std::size_t link_stride(Basis basis) { return basis == Basis::linear ? 9 : 6; }

}  // namespace

ClusterState::ClusterState(const Cluster& cluster, const Scene& scene, Basis basis,
                           std::size_t aggregates)
    : id_(cluster.id),
      cell_(cluster.cell),
      bands_(scene.bands),
      basis_(basis),
      patches_(cluster, frames_of(cluster, scene), scene.bands, static_cast<int>(basis),
               scene.lead_bands),
      aggregates_(patches_, aggregates),
      links_(link_stride(basis)) {
  shrink();
}

ClusterState::ClusterState(std::span<const std::byte> geometry, std::span<const std::byte> patches,
                           std::span<const std::byte> links) {
  const std::string what = "a cluster's record";
  ByteReader g(geometry, what);
  id_.value = g.get<std::uint32_t>();
  cell_.value = g.get<std::uint32_t>();
  basis_ = static_cast<Basis>(g.get<std::uint8_t>());
  patches_ = ClusterCodec::read_geometry(g);
  aggregates_ = ClusterCodec::read_aggregates(g);
  g.expect_end();
  bands_ = patches_.bands();
  ByteReader p(patches, what);
  iteration_ = p.get<std::int32_t>();
  ClusterCodec::read_patches(patches_, p);
  p.expect_end();
  links_ = LinkSet(link_stride(basis_));
  if (!links.empty()) {
    ByteReader l(links, what);
    links_ = ClusterCodec::read_links(l, link_stride(basis_));
    l.expect_end();
  }
  shrink();
}

void ClusterState::shrink() {
  patches_.shrink();
  links_.shrink();
}

ClusterState ClusterState::shooter() const {
  ClusterState copy;
  copy.id_ = id_;
  copy.cell_ = cell_;
  copy.bands_ = bands_;
  copy.iteration_ = iteration_;
  copy.basis_ = basis_;
  copy.patches_ = patches_;
  copy.aggregates_ = aggregates_;
  copy.links_ = LinkSet(links_.stride());
  return copy;
}

void ClusterState::correct(std::span<const double> changes) {
  aggregates_.add_share(patches_, changes);
}

std::vector<std::byte> ClusterState::bytes_of(Section section) const {
  constexpr std::size_t head_bytes = 64;  // more than what stands before the lists
  const std::size_t lists_bytes = section == Section::patches
                                      ? ClusterCodec::patches_bytes(patches_)
                                  : section == Section::links ? ClusterCodec::links_bytes(links_)
                                                              : 0;  // written once
  ByteWriter w(head_bytes + lists_bytes);
  switch (section) {
    case Section::geometry:
      w.put(id_.value);
      w.put(cell_.value);
      w.put(static_cast<std::uint8_t>(basis_));
      ClusterCodec::write_geometry(patches_, w);
      ClusterCodec::write_aggregates(aggregates_, w);
      break;
    case Section::patches:
      w.put(std::int32_t{iteration_});
      ClusterCodec::write_patches(patches_, w);
      break;
    case Section::links:
      ClusterCodec::write_links(links_, w);
      break;
  }
  return w.take();
}

std::size_t ClusterState::memory_bytes() const {
  return sizeof(*this) + patches_.memory_bytes() + links_.memory_bytes() +
         aggregates_.memory_bytes();
}

}  // namespace enfilade
