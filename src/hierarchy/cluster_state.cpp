#include "hierarchy/cluster_state.hpp"

#include "base/byte_stream.hpp"

namespace enfilade {

template <>
inline constexpr bool has_no_padding<MeshLine> = sizeof(MeshLine) == 4 * sizeof(double);
template <>
inline constexpr bool has_no_padding<GroupNode> = sizeof(GroupNode) ==
                                                  4 * sizeof(std::uint32_t) + 7 * sizeof(double);
template <>
inline constexpr bool has_no_padding<Link> =
    true;  // but one byte: until its fields are written one by one

namespace {

/// The frame's first axis runs along the longest edge, so that a rectangle is cut along its sides.
PolygonFrame frame_of(const ClusterPolygon& polygon, const Scene& scene) {
  PolygonFrame frame;
  frame.surface = polygon.surface;
  frame.origin = centroid(polygon.polygon);
  frame.n = normal(polygon.polygon);
  double longest = -1.0;
  for (std::size_t i = 0; i < polygon.polygon.size(); ++i) {
    const Vec3 edge = polygon.polygon[(i + 1) % polygon.polygon.size()] - polygon.polygon[i];
    // A little longer is not enough: parallel sides that differ by rounding must give one answer.
    if (glm::length(edge) > longest * (1.0 + 1e-9)) {
      longest = glm::length(edge);
      frame.u = edge;
    }
  }
  frame.u = glm::normalize(frame.u - glm::dot(frame.u, frame.n) * frame.n);
  frame.v = glm::cross(frame.n, frame.u);
  const Surface& surface = scene.surfaces[polygon.surface.index()];
  frame.reflectance.assign(surface.reflectance.begin(), surface.reflectance.end());
  frame.exitance.assign(surface.exitance.begin(), surface.exitance.end());
  for (const Segment& s : polygon.contacts) {
    frame.lines.push_back({frame.project(s.a), frame.project(s.b)});
  }
  return frame;
}

std::vector<PolygonFrame> frames_of(const Cluster& cluster, const Scene& scene) {
  std::vector<PolygonFrame> frames;
  for (const ClusterPolygon& p : cluster.polygons) frames.push_back(frame_of(p, scene));
  return frames;
}

std::size_t link_stride(Basis basis) { return basis == Basis::linear ? 9 : 4; }

}  // namespace

/// Reads and writes the private parts of the solver's structures, section by section.
class ClusterStateCodec {
 public:
  static void write_geometry(const PatchForest& f, ByteWriter& w) {
    w.put(f.bands_);
    w.put(f.terms_);
    w.put(static_cast<std::uint64_t>(f.frames_.size()));
    for (const PolygonFrame& frame : f.frames_) {
      w.put(frame.surface);
      w.put(frame.origin);
      w.put(frame.u);
      w.put(frame.v);
      w.put(frame.n);
      w.put_all(frame.reflectance);
      w.put_all(frame.exitance);
      w.put_all(frame.lines);
    }
    for (std::size_t k = 0; k < f.frames_.size(); ++k) write_node(f.nodes_[k], w);
    w.put_all(f.groups_);
    w.put_all(f.order_);
  }

  static PatchForest read_geometry(ByteReader& r) {
    PatchForest f;
    f.bands_ = r.get<int>();
    f.terms_ = r.get<int>();
    f.frames_.resize(r.get_count(sizeof(Vec3)));
    for (PolygonFrame& frame : f.frames_) {
      frame.surface = r.get<SurfaceId>();
      frame.origin = r.get<Vec3>();
      frame.u = r.get<Vec3>();
      frame.v = r.get<Vec3>();
      frame.n = r.get<Vec3>();
      r.get_all(frame.reflectance);
      r.get_all(frame.exitance);
      frame.lines = r.get_all<MeshLine>();
    }
    for (std::size_t k = 0; k < f.frames_.size(); ++k) f.nodes_.push_back(read_node(r));
    f.groups_ = r.get_all<GroupNode>();
    f.order_ = r.get_all<std::uint32_t>();
    f.sum_exitances();
    return f;
  }

  /// Only which node was split is kept: shapes follow from the polygons by the same cuts.
  static void write_patches(const PatchForest& f, ByteWriter& w) {
    std::vector<std::uint32_t> splits;
    for (std::size_t c = f.frames_.size(); c < f.nodes_.size(); c += 2) {
      splits.push_back(static_cast<std::uint32_t>(f.nodes_[c].parent));
    }
    w.put_all(splits);
    w.put_all(f.radiosity_);
    w.put_all(f.irradiance_);
    w.put_all(f.deviation_);
    w.put_all(f.enclosed_share_);
    w.put(f.lit_when_measured_);
    w.put_all(f.unreachable_);
  }

  static void read_patches(PatchForest& f, ByteReader& r) {
    const std::vector<std::uint32_t> splits = r.get_all<std::uint32_t>();
    f.nodes_.reserve(f.frames_.size() + 2 * splits.size());
    for (const std::uint32_t parent : splits) {
      if (parent >= f.nodes_.size())
        throw RunError("a cluster's record names a patch it does not have");
      f.add_halves(parent);
    }
    f.radiosity_ = r.get_all<double>();
    f.irradiance_ = r.get_all<double>();
    f.deviation_ = r.get_all<double>();
    f.enclosed_share_ = r.get_all<float>();
    f.lit_when_measured_ = r.get<std::uint32_t>();
    f.unreachable_ = r.get_all<std::uint8_t>();
    if (f.radiosity_.size() != f.nodes_.size() * f.stride() ||
        f.irradiance_.size() != f.radiosity_.size() || f.deviation_.size() != f.nodes_.size() ||
        f.enclosed_share_.size() != f.nodes_.size() || f.unreachable_.size() != f.frames_.size()) {
      throw RunError("a cluster's record holds light for another number of patches");
    }
    f.pull_groups();
  }

  static void write_links(const LinkSet& l, ByteWriter& w) {
    w.put(static_cast<std::uint64_t>(l.stride_));
    w.put_all(l.links_);
    w.put_all(l.transport_);
  }

  static LinkSet read_links(ByteReader& r, std::size_t stride) {
    if (r.get<std::uint64_t>() != stride)
      throw RunError("a cluster's record holds links of another basis");
    LinkSet l(stride);
    l.links_ = r.get_all<Link>();
    l.transport_ = r.get_all<float>();
    if (l.transport_.size() != l.links_.size() * l.stride_) {
      throw RunError("a cluster's record holds transport for another number of links");
    }
    return l;
  }

  static std::size_t bytes(const PatchForest& f) {
    // What does not lie in the nodes and frames themselves.
    const auto bands = static_cast<std::size_t>(f.bands_);
    const std::size_t in_frames =
        bands > BandValues::static_capacity ? 2 * sizeof(double) * bands : 0;
    std::size_t corners = 0;
    for (const PatchNode& n : f.nodes_) {
      if (n.shape.vertices.capacity() > PatchOutline::static_capacity)
        corners += n.shape.vertices.capacity();
    }
    return f.nodes_.capacity() * sizeof(PatchNode) + corners * sizeof(Vec2) +
           (f.radiosity_.capacity() + f.irradiance_.capacity() + f.deviation_.capacity()) *
               sizeof(double) +
           f.frames_.size() * (sizeof(PolygonFrame) + in_frames) +
           f.groups_.size() * (sizeof(GroupNode) + sizeof(double) * (2 * bands + 1));
  }
  static std::size_t bytes(const LinkSet& l) {
    return l.links_.capacity() * sizeof(Link) + l.transport_.capacity() * sizeof(float);
  }

  /// Of a section, about.
  static std::size_t written_bytes(const ClusterState& state, Section section) {
    const PatchForest& f = state.patches();
    const LinkSet& l = state.links();
    constexpr std::size_t head = 64;
    if (section == Section::links)
      return head + l.links_.size() * sizeof(Link) + l.transport_.size() * sizeof(float);
    if (section == Section::patches) {
      return head + f.frames_.size() +
             f.nodes_.size() * (2 * sizeof(std::uint32_t) + sizeof(double) * (2 * f.stride() + 1));
    }
    return head;  // written once
  }

  static void shrink(PatchForest& f) {
    f.nodes_.shrink_to_fit();
    f.radiosity_.shrink_to_fit();
    f.irradiance_.shrink_to_fit();
    f.deviation_.shrink_to_fit();
    f.enclosed_share_.shrink_to_fit();
    for (PatchNode& n : f.nodes_) n.shape.vertices.shrink_to_fit();
  }
  static void shrink(LinkSet& l) {
    l.links_.shrink_to_fit();
    l.transport_.shrink_to_fit();
  }

 private:
  static void write_node(const PatchNode& n, ByteWriter& w) {
    w.put(n.id);
    w.put_all(n.shape.vertices);
  }
  static PatchNode read_node(ByteReader& r) {
    PatchNode n;
    n.id = r.get<PatchId>();
    r.get_all(n.shape.vertices);
    n.shape = PatchShape::from(n.shape.vertices);
    return n;
  }
};

ClusterState::ClusterState(const Cluster& cluster, const Scene& scene, Basis basis,
                           std::size_t aggregates)
    : id_(cluster.id),
      cell_(cluster.cell),
      bands_(scene.bands),
      basis_(basis),
      patches_(cluster, frames_of(cluster, scene), scene.bands, static_cast<int>(basis)),
      aggregates_(patches_, aggregates),
      links_(link_stride(basis)) {
  shrink();
}

ClusterState::ClusterState(std::span<const std::byte> geometry, std::span<const std::byte> patches,
                           std::span<const std::byte> links) {
  const std::string what = "a cluster's record";
  ByteReader g(geometry, what);
  id_ = g.get<ClusterId>();
  cell_ = g.get<CellId>();
  basis_ = g.get<Basis>();
  patches_ = ClusterStateCodec::read_geometry(g);
  aggregates_ = Aggregates::read(g);
  g.expect_end();
  bands_ = patches_.bands();
  ByteReader p(patches, what);
  iteration_ = p.get<int>();
  ClusterStateCodec::read_patches(patches_, p);
  p.expect_end();
  links_ = LinkSet(link_stride(basis_));
  if (!links.empty()) {
    ByteReader l(links, what);
    links_ = ClusterStateCodec::read_links(l, link_stride(basis_));
    l.expect_end();
  }
  shrink();
}

void ClusterState::shrink() {
  ClusterStateCodec::shrink(patches_);
  ClusterStateCodec::shrink(links_);
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
  ByteWriter w(ClusterStateCodec::written_bytes(*this, section));
  switch (section) {
    case Section::geometry:
      w.put(id_);
      w.put(cell_);
      w.put(basis_);
      ClusterStateCodec::write_geometry(patches_, w);
      aggregates_.write(w);
      break;
    case Section::patches:
      w.put(iteration_);
      ClusterStateCodec::write_patches(patches_, w);
      break;
    case Section::links:
      ClusterStateCodec::write_links(links_, w);
      break;
  }
  return w.take();
}

std::size_t ClusterState::memory_bytes() const {
  return sizeof(*this) + ClusterStateCodec::bytes(patches_) + ClusterStateCodec::bytes(links_) +
         aggregates_.memory_bytes();
}

}  // namespace enfilade
