#include "hierarchy/cluster_codec.hpp"

#include <array>
#include <cstring>
#include <type_traits>

#include "base/error.hpp"

namespace enfilade {

// Lists of mesh lines are copied in one piece.
template <>
inline constexpr bool has_no_padding<MeshLine> = sizeof(MeshLine) == 4 * sizeof(double);

namespace {

/// Writes the fields side by side as one record without padding.
template <class... Fields>
void put_record(ByteWriter& w, const Fields&... fields) {
  static_assert(((std::is_arithmetic_v<Fields> && !std::is_same_v<Fields, bool>)&&...));
  std::array<std::byte, (sizeof(Fields) + ...)> record;
  std::byte* to = record.data();
  ((std::memcpy(to, &fields, sizeof fields), to += sizeof fields), ...);
  w.put(record);
}

/// Reads what put_record has written.
template <class... Fields>
void get_record(ByteReader& r, Fields&... fields) {
  const auto record = r.get<std::array<std::byte, (sizeof(Fields) + ...)>>();
  const std::byte* from = record.data();
  ((std::memcpy(&fields, from, sizeof fields), from += sizeof fields), ...);
}

// Flags of a link.
constexpr std::uint8_t evaluated_flag = 1, finest_flag = 2;

/// Bytes of one element of a list in the file; lengths are checked against them.
constexpr std::size_t link_bytes = 5 * sizeof(std::uint32_t) + 4 * sizeof(float) + 2;
constexpr std::size_t group_bytes = 4 * sizeof(std::uint32_t) + 7 * sizeof(double);
constexpr std::size_t aggregate_bytes = 2 * sizeof(std::uint32_t) + sizeof(double);
constexpr std::size_t range_bytes = 2 * sizeof(std::uint32_t);
/// Roughly, and no polygon has less.
constexpr std::size_t least_polygon_bytes = 4 * sizeof(Vec3);

void put_count(ByteWriter& w, std::size_t count) { w.put(static_cast<std::uint64_t>(count)); }

void write_frame(const PolygonFrame& frame, ByteWriter& w) {
  w.put(frame.surface.value);
  for (const Vec3& axis : {frame.origin, frame.u, frame.v, frame.n})
    put_record(w, axis.x, axis.y, axis.z);
  w.put_all(frame.reflectance);
  w.put_all(frame.exitance);
  w.put_all(frame.transmittance);
  w.put_all(frame.lines);
}

PolygonFrame read_frame(ByteReader& r) {
  PolygonFrame frame;
  frame.surface.value = r.get<std::uint32_t>();
  for (Vec3* axis : {&frame.origin, &frame.u, &frame.v, &frame.n})
    get_record(r, axis->x, axis->y, axis->z);
  r.get_all(frame.reflectance);
  r.get_all(frame.exitance);
  r.get_all(frame.transmittance);
  frame.lines = r.get_all<MeshLine>();
  return frame;
}

/// A polygon's own node; nodes below it follow from the splits.
void write_root(const PatchNode& n, ByteWriter& w) {
  put_record(w, n.id.root, n.id.path);
  w.put_all(n.shape.vertices);
}

PatchNode read_root(ByteReader& r) {
  PatchNode n;
  get_record(r, n.id.root, n.id.path);
  r.get_all(n.shape.vertices);
  n.shape = PatchShape::from(n.shape.vertices);
  return n;
}

void write_group(const GroupNode& g, ByteWriter& w) {
  put_record(w, g.left, g.right, g.begin, g.end, g.bounds.lo.x, g.bounds.lo.y, g.bounds.lo.z,
             g.bounds.hi.x, g.bounds.hi.y, g.bounds.hi.z, g.area_m2);
}

GroupNode read_group(ByteReader& r) {
  GroupNode g;
  get_record(r, g.left, g.right, g.begin, g.end, g.bounds.lo.x, g.bounds.lo.y, g.bounds.lo.z,
             g.bounds.hi.x, g.bounds.hi.y, g.bounds.hi.z, g.area_m2);
  return g;
}

void write_link(const Link& l, ByteWriter& w) {
  const auto flags =
      static_cast<std::uint8_t>((l.evaluated ? evaluated_flag : 0) | (l.finest ? finest_flag : 0));
  put_record(w, l.shooter_cluster.value, l.shooter.root, l.shooter.path, l.receiver.root,
             l.receiver.path, l.shooter_x, l.shooter_y, l.error, l.variation, flags,
             l.visibility_uncertainty);
}

Link read_link(ByteReader& r) {
  Link l;
  std::uint8_t flags = 0;
  get_record(r, l.shooter_cluster.value, l.shooter.root, l.shooter.path, l.receiver.root,
             l.receiver.path, l.shooter_x, l.shooter_y, l.error, l.variation, flags,
             l.visibility_uncertainty);
  l.evaluated = (flags & evaluated_flag) != 0;
  l.finest = (flags & finest_flag) != 0;
  return l;
}

}  // namespace

void ClusterCodec::write_geometry(const PatchForest& f, ByteWriter& w) {
  put_record(w, std::int32_t{f.bands_}, std::int32_t{f.lead_bands_}, std::int32_t{f.terms_});
  put_count(w, f.frames_.size());
  for (const PolygonFrame& frame : f.frames()) write_frame(frame, w);
  for (std::size_t k = 0; k < f.frames_.size(); ++k) write_root(f.nodes_[k], w);
  put_count(w, f.groups_.size());
  for (const GroupNode& group : f.groups_) write_group(group, w);
  w.put_all(f.order_);
}

PatchForest ClusterCodec::read_geometry(ByteReader& r) {
  PatchForest f;
  f.bands_ = r.get<std::int32_t>();
  f.lead_bands_ = r.get<std::int32_t>();
  f.terms_ = r.get<std::int32_t>();
  std::vector<PolygonFrame> frames(r.get_count(least_polygon_bytes));
  for (PolygonFrame& frame : frames) frame = read_frame(r);
  f.frames_ = SharedList(std::move(frames));
  for (std::size_t k = 0; k < f.frames_.size(); ++k) f.nodes_.push_back(read_root(r));
  f.groups_.resize(r.get_count(group_bytes));
  for (GroupNode& group : f.groups_) group = read_group(r);
  f.order_ = r.get_all<std::uint32_t>();
  f.sum_exitances();
  return f;
}

void ClusterCodec::write_aggregates(const Aggregates& a, ByteWriter& w) {
  put_count(w, a.aggregates_.size());
  for (const auto& [node, area_m2] : a.aggregates_) put_record(w, node.root, node.path, area_m2);
  put_count(w, a.of_polygon_.size());
  for (const Aggregates::Range& range : a.of_polygon_) put_record(w, range.begin, range.end);
}

Aggregates ClusterCodec::read_aggregates(ByteReader& r) {
  Aggregates a;
  a.aggregates_.resize(r.get_count(aggregate_bytes));
  for (auto& [node, area_m2] : a.aggregates_) get_record(r, node.root, node.path, area_m2);
  a.of_polygon_.resize(r.get_count(range_bytes));
  for (Aggregates::Range& range : a.of_polygon_) get_record(r, range.begin, range.end);
  return a;
}

void ClusterCodec::write_patches(const PatchForest& f, ByteWriter& w) {
  std::vector<std::uint32_t> splits;
  for (std::size_t c = f.frames_.size(); c < f.nodes_.size(); c += 2) {
    splits.push_back(static_cast<std::uint32_t>(f.nodes_[c].parent));
  }
  w.put_all(splits);
  w.put_all(f.radiosity_);
  w.put_all(f.irradiance_);
  w.put_all(f.deviation_);
  w.put_all(f.kept_);
  w.put_all(f.enclosed_share_);
  w.put_all(f.settled_);
  w.put_all(f.link_error_);
  w.put(f.lit_when_measured_);
  w.put_all(f.unreachable_);
}

void ClusterCodec::read_patches(PatchForest& f, ByteReader& r) {
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
  f.kept_ = r.get_all<double>();
  f.enclosed_share_ = r.get_all<float>();
  f.settled_ = r.get_all<std::uint8_t>();
  f.link_error_ = r.get_all<float>();
  f.lit_when_measured_ = r.get<std::uint32_t>();
  f.unreachable_ = r.get_all<std::uint8_t>();
  if (f.radiosity_.size() != f.nodes_.size() * f.stride() ||
      f.irradiance_.size() != f.radiosity_.size() || f.deviation_.size() != f.nodes_.size() ||
      f.enclosed_share_.size() != f.nodes_.size() || f.settled_.size() != f.nodes_.size() ||
      f.link_error_.size() != f.nodes_.size() || f.unreachable_.size() != f.frames_.size()) {
    throw RunError("a cluster's record holds light for another number of patches");
  }
  // Each split makes one leaf more.
  if (!f.kept_.empty() && f.kept_.size() != (f.frames_.size() + splits.size()) * f.stride())
    throw RunError("a cluster's record holds earlier light for another number of patches");
  f.pull_groups();
}

void ClusterCodec::write_links(const LinkSet& l, ByteWriter& w) {
  put_count(w, l.stride_);
  put_count(w, l.links_.size());
  for (const Link& link : l.links_) write_link(link, w);
  w.put_all(l.transport_);
  put_count(w, l.tint_bands_);
  w.put_all(l.tint_);
}

LinkSet ClusterCodec::read_links(ByteReader& r, std::size_t stride) {
  if (r.get<std::uint64_t>() != stride)
    throw RunError("a cluster's record holds links of another basis");
  LinkSet l(stride);
  l.links_.resize(r.get_count(link_bytes));
  for (Link& link : l.links_) link = read_link(r);
  l.transport_ = r.get_all<float>();
  l.tint_bands_ = r.get<std::uint64_t>();
  l.tint_ = r.get_all<float>();
  if (l.transport_.size() != l.links_.size() * l.stride_ ||
      l.tint_.size() != l.links_.size() * l.tint_bands_) {
    throw RunError("a cluster's record holds transport for another number of links");
  }
  return l;
}

std::size_t ClusterCodec::patches_bytes(const PatchForest& f) {
  return f.frames_.size() +
         f.nodes_.size() * (3 * sizeof(std::uint32_t) + sizeof(double) * (2 * f.stride() + 1)) +
         f.kept_.size() * sizeof(double);
}

std::size_t ClusterCodec::links_bytes(const LinkSet& l) {
  return l.links_.size() * link_bytes + (l.transport_.size() + l.tint_.size()) * sizeof(float);
}

}  // namespace enfilade
