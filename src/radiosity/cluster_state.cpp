#include "radiosity/cluster_state.hpp"

#include <cstring>
#include <type_traits>

#include "base/error.hpp"

namespace enfilade {
namespace {

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* p = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), p, p + sizeof(T));
  }
  template <class T>
  void put_all(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(static_cast<std::uint64_t>(values.size()));
    const auto* p = reinterpret_cast<const std::byte*>(values.data());
    bytes_.insert(bytes_.end(), p, p + values.size() * sizeof(T));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, advance(sizeof(T)), sizeof(T));
    return value;
  }
  template <class T>
  std::vector<T> get_all() {
    const auto n = get<std::uint64_t>();
    if (n > bytes_.size() / sizeof(T)) throw RunError("a cluster's record is cut short");
    std::vector<T> values(n);
    const std::byte* from = advance(n * sizeof(T));
    if (n > 0) std::memcpy(values.data(), from, n * sizeof(T));
    return values;
  }

 private:
  const std::byte* advance(std::size_t n) {
    if (n > bytes_.size() - at_) throw RunError("a cluster's record is cut short");
    const std::byte* p = bytes_.data() + at_;
    at_ += n;
    return p;
  }
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

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
  frame.reflectance = surface.reflectance;
  frame.exitance = surface.exitance;
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
  static void write_geometry(const PatchForest& f, Writer& w) {
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
    }
    for (std::size_t k = 0; k < f.frames_.size(); ++k) write_node(f.nodes_[k], w);
    w.put_all(f.groups_);
    w.put_all(f.order_);
  }

  static PatchForest read_geometry(Reader& r) {
    PatchForest f;
    f.bands_ = r.get<int>();
    f.terms_ = r.get<int>();
    f.frames_.resize(r.get<std::uint64_t>());
    for (PolygonFrame& frame : f.frames_) {
      frame.surface = r.get<SurfaceId>();
      frame.origin = r.get<Vec3>();
      frame.u = r.get<Vec3>();
      frame.v = r.get<Vec3>();
      frame.n = r.get<Vec3>();
      frame.reflectance = r.get_all<double>();
      frame.exitance = r.get_all<double>();
    }
    for (std::size_t k = 0; k < f.frames_.size(); ++k) f.nodes_.push_back(read_node(r));
    f.groups_ = r.get_all<GroupNode>();
    f.order_ = r.get_all<std::uint32_t>();
    return f;
  }

  /// Only which node was split is kept: shapes follow from the polygons by the same cuts.
  static void write_patches(const PatchForest& f, Writer& w) {
    std::vector<std::uint32_t> splits;
    for (std::size_t c = f.frames_.size(); c < f.nodes_.size(); c += 2) {
      splits.push_back(static_cast<std::uint32_t>(f.nodes_[c].parent));
    }
    w.put_all(splits);
    w.put_all(f.radiosity_);
    w.put_all(f.irradiance_);
    w.put_all(f.deviation_);
    w.put_all(f.exposure_);
    w.put_all(f.sealed_);
  }

  static void read_patches(PatchForest& f, Reader& r) {
    f.radiosity_.resize(f.nodes_.size() * f.stride());
    f.irradiance_.resize(f.nodes_.size() * f.stride());
    f.deviation_.resize(f.nodes_.size());
    f.exposure_.resize(f.nodes_.size());
    f.sealed_.resize(f.frames_.size());
    for (const std::uint32_t parent : r.get_all<std::uint32_t>()) {
      if (parent >= f.nodes_.size())
        throw RunError("a cluster's record names a patch it does not have");
      f.subdivide(parent);
    }
    f.radiosity_ = r.get_all<double>();
    f.irradiance_ = r.get_all<double>();
    f.deviation_ = r.get_all<double>();
    f.exposure_ = r.get_all<float>();
    f.sealed_ = r.get_all<std::uint8_t>();
    if (f.radiosity_.size() != f.nodes_.size() * f.stride() ||
        f.irradiance_.size() != f.radiosity_.size() || f.deviation_.size() != f.nodes_.size() ||
        f.exposure_.size() != f.nodes_.size() || f.sealed_.size() != f.frames_.size()) {
      throw RunError("a cluster's record holds light for another number of patches");
    }
    f.pull_groups();
  }

  static void write_links(const LinkSet& l, Writer& w) {
    w.put(static_cast<std::uint64_t>(l.stride_));
    w.put_all(l.links_);
    w.put_all(l.transport_);
  }

  static LinkSet read_links(Reader& r) {
    LinkSet l(r.get<std::uint64_t>());
    l.links_ = r.get_all<Link>();
    l.transport_ = r.get_all<float>();
    if (l.transport_.size() != l.links_.size() * l.stride_) {
      throw RunError("a cluster's record holds transport for another number of links");
    }
    return l;
  }

  static std::size_t bytes(const PatchForest& f) {
    std::size_t corners = 0;
    for (const PatchNode& n : f.nodes_) corners += n.shape.vertices.capacity();
    return f.nodes_.capacity() * sizeof(PatchNode) + corners * sizeof(Vec2) +
           (f.radiosity_.capacity() + f.irradiance_.capacity() + f.deviation_.capacity()) *
               sizeof(double) +
           f.frames_.size() *
               (sizeof(PolygonFrame) + 2 * sizeof(double) * static_cast<std::size_t>(f.bands_)) +
           f.groups_.size() *
               (sizeof(GroupNode) + sizeof(double) * static_cast<std::size_t>(f.bands_ + 1));
  }
  static std::size_t bytes(const LinkSet& l) {
    return l.links_.capacity() * sizeof(Link) + l.transport_.capacity() * sizeof(float);
  }

 private:
  static void write_node(const PatchNode& n, Writer& w) {
    w.put(n.id);
    w.put_all(n.shape.vertices);
  }
  static PatchNode read_node(Reader& r) {
    PatchNode n;
    n.id = r.get<PatchId>();
    n.shape = PatchShape::from(r.get_all<Vec2>());
    return n;
  }
};

ClusterState::ClusterState(const Cluster& cluster, const Scene& scene, Basis basis)
    : id_(cluster.id),
      cell_(cluster.cell),
      bands_(scene.bands),
      basis_(basis),
      patches_(cluster, frames_of(cluster, scene), scene.bands, static_cast<int>(basis)),
      links_(link_stride(basis)) {}

ClusterState::ClusterState(std::span<const std::byte> geometry, std::span<const std::byte> patches,
                           std::span<const std::byte> links) {
  Reader g(geometry);
  id_ = g.get<ClusterId>();
  cell_ = g.get<CellId>();
  basis_ = g.get<Basis>();
  patches_ = ClusterStateCodec::read_geometry(g);
  bands_ = patches_.bands();
  Reader p(patches);
  iteration_ = p.get<int>();
  ClusterStateCodec::read_patches(patches_, p);
  links_ = LinkSet(link_stride(basis_));
  if (!links.empty()) {
    Reader l(links);
    links_ = ClusterStateCodec::read_links(l);
  }
}

ClusterState ClusterState::shooter() const {
  ClusterState copy;
  copy.id_ = id_;
  copy.cell_ = cell_;
  copy.bands_ = bands_;
  copy.iteration_ = iteration_;
  copy.basis_ = basis_;
  copy.patches_ = patches_;
  copy.links_ = LinkSet(links_.stride());
  return copy;
}

void ClusterState::correct(std::span<const double> irradiance_offset) {
  patches_.offset(irradiance_offset);
}

std::vector<std::byte> ClusterState::bytes_of(Section section) const {
  Writer w;
  switch (section) {
    case Section::geometry:
      w.put(id_);
      w.put(cell_);
      w.put(basis_);
      ClusterStateCodec::write_geometry(patches_, w);
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
  return sizeof(*this) + ClusterStateCodec::bytes(patches_) + ClusterStateCodec::bytes(links_);
}

}  // namespace enfilade
