#include "hierarchy/patch_forest.hpp"

#include <algorithm>
#include <numeric>

#include "base/error.hpp"

namespace enfilade {

PolygonFrame frame_on(const Polygon& polygon) {
  PolygonFrame frame;
  frame.origin = centroid(polygon);
  frame.n = normal(polygon);
  double longest = -1.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    // Parallel sides that differ by rounding alone must give the same frame: the first one counts.
    constexpr double clearly_longer = 1.0 + 1e-9;
    if (glm::length(edge) > longest * clearly_longer) {
      longest = glm::length(edge);
      frame.u = edge;
    }
  }
  frame.u = glm::normalize(frame.u - glm::dot(frame.u, frame.n) * frame.n);
  frame.v = glm::cross(frame.n, frame.u);
  return frame;
}

PatchForest::PatchForest(const Cluster& cluster, std::vector<PolygonFrame> frames, int bands,
                         int terms, int lead_bands)
    : bands_(bands),
      terms_(terms),
      lead_bands_(lead_bands > 0 ? lead_bands : bands),
      frames_(std::move(frames)),
      order_(frames_.size()) {
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    PatchOutline corners;
    for (const Vec3& p : cluster.polygons[k].polygon) corners.push_back(frames_[k].project(p));
    PatchNode node;
    node.shape = PatchShape::from(corners);
    node.id = {static_cast<std::uint32_t>(k), 1};
    nodes_.push_back(std::move(node));
  }
  radiosity_.assign(nodes_.size() * stride(), 0.0);
  irradiance_.assign(nodes_.size() * stride(), 0.0);
  deviation_.assign(nodes_.size(), 0.0);
  enclosed_share_.assign(nodes_.size(), -1.0f);
  settled_.assign(nodes_.size(), 0);
  link_error_.assign(nodes_.size(), 0.0f);
  unreachable_.assign(nodes_.size(), 0);
  for (std::size_t k = 0; k < frames_.size(); ++k) reflect(k);  // no irradiance yet
  std::iota(order_.begin(), order_.end(), 0u);
  if (frames_.size() > 1) build_group(0, static_cast<std::uint32_t>(order_.size()));
  pull_groups();
  sum_exitances();
}

/// The axis along which a group's polygons differ most: 0 .. 2 the centroids' coordinates, 3 .. 5
/// those of the normals, which are scaled by half the group's extent.
int PatchForest::widest_axis(const GroupNode& group) const {
  Box centers, facings;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = order_[i];
    centers.add(frames_[k].at(nodes_[k].shape.centroid));
    facings.add(frames_[k].n);
  }
  const double weight = 0.5 * group.bounds.diagonal();
  int axis = 0;
  double widest = -1.0;
  for (int a = 0; a < 6; ++a) {
    const double width = a < 3 ? centers.extent()[a] : weight * facings.extent()[a - 3];
    if (width > widest) {
      widest = width;
      axis = a;
    }
  }
  return axis;
}

/// Groups the polygons order_[begin .. end): the median along the widest axis parts them in two.
/// Returns the group's number, or ~k for a single polygon k.
std::int32_t PatchForest::build_group(std::uint32_t begin, std::uint32_t end) {
  if (end - begin == 1) return ~static_cast<std::int32_t>(order_[begin]);
  const auto index = static_cast<std::int32_t>(groups_.size());
  groups_.emplace_back();
  GroupNode group;
  group.begin = begin;
  group.end = end;
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t k = order_[i];
    for (const Vec2& p : nodes_[k].shape.vertices) group.bounds.add(frames_[k].at(p));
    group.area_m2 += nodes_[k].shape.area_m2;
  }
  const int axis = widest_axis(group);
  auto key = [&](std::uint32_t k) {
    return axis < 3 ? frames_[k].at(nodes_[k].shape.centroid)[axis] : frames_[k].n[axis - 3];
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::sort(order_.begin() + begin, order_.begin() + end, [&](std::uint32_t i, std::uint32_t j) {
    return key(i) != key(j) ? key(i) < key(j) : i < j;
  });
  group.left = build_group(begin, middle);
  group.right = build_group(middle, end);
  groups_[static_cast<std::size_t>(index)] = group;
  return index;
}

std::size_t PatchForest::find(PatchId id) const {
  std::size_t node = id.root;
  int bit = 31;
  while (bit > 0 && ((id.path >> bit) & 1u) == 0) --bit;
  while (bit-- > 0 && !nodes_[node].leaf()) {
    node = static_cast<std::size_t>(nodes_[node].first_child) + ((id.path >> bit) & 1u);
  }
  return node;
}

/// Makes the children of a leaf without their light; returns the first child.
std::size_t PatchForest::add_halves(std::size_t leaf) {
  ENFILADE_CHECK(nodes_[leaf].leaf(), std::to_string(leaf));
  const std::size_t first = nodes_.size();
  const PatchCut cut = nodes_[leaf].shape.cut(frames_[nodes_[leaf].id.root].lines);
  auto halves = nodes_[leaf].shape.halves(cut);
  nodes_[leaf].split_axis = cut.axis;
  nodes_[leaf].split_at = cut.at;
  nodes_[leaf].first_child = static_cast<std::int32_t>(first);
  for (int side = 0; side < 2; ++side) {
    PatchNode child;
    child.shape = side == 0 ? std::move(halves.first) : std::move(halves.second);
    child.id = nodes_[leaf].id.child(side);
    child.parent = static_cast<std::int32_t>(leaf);
    nodes_.push_back(std::move(child));
  }
  return first;
}

std::size_t PatchForest::subdivide(std::size_t leaf) {
  const std::size_t first = add_halves(leaf);
  kept_.clear();
  for (std::size_t child = first; child < nodes_.size(); ++child) {
    const Vec2 shift = nodes_[child].shape.centroid - nodes_[leaf].shape.centroid;
    for (std::vector<double>* light : {&radiosity_, &irradiance_}) {
      light->resize((child + 1) * stride());
      const double* from = light->data() + leaf * stride();
      double* to = light->data() + child * stride();
      std::copy(from, from + stride(), to);
      if (terms_ == 3) {
        for (int band = 0; band < bands_; ++band) {
          to[band * 3] += from[band * 3 + 1] * shift.x + from[band * 3 + 2] * shift.y;
        }
      }
    }
    deviation_.push_back(0.0);
    enclosed_share_.push_back(-1.0f);
    settled_.push_back(0);
    link_error_.push_back(link_error_[leaf]);
  }
  return first;
}

void PatchForest::keep_light() {
  kept_.clear();
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (!nodes_[n].leaf()) continue;
    kept_.insert(kept_.end(), irradiance(n).begin(), irradiance(n).end());
  }
}

std::vector<double> PatchForest::take_kept_light() { return std::exchange(kept_, {}); }

void PatchForest::forget_enclosed_shares_below(std::uint32_t lit_polygons) {
  // One more lit polygon among hundreds changes no share by more than rays can tell.
  constexpr std::uint32_t one_in = 256;
  if (lit_polygons <= lit_when_measured_ + lit_when_measured_ / one_in) return;
  lit_when_measured_ = lit_polygons;
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    if (settled_[n] == 0) enclosed_share_[n] = -1.0f;
}

std::size_t PatchForest::leaf_at(std::size_t polygon, const Vec3& p) const {
  const Vec2 q = frames_[polygon].project(p);
  std::size_t node = polygon;
  while (!nodes_[node].leaf()) {
    const PatchNode& at = nodes_[node];
    node = at.child(glm::dot(at.split_axis, q) >= at.split_at ? 1 : 0);
  }
  return node;
}

void PatchForest::evaluate(bool of_radiosity, std::size_t polygon, const Vec3& p,
                           std::span<double> out) const {
  const std::size_t node = leaf_at(polygon, p);
  const Vec2 q = frames_[polygon].project(p);
  const std::vector<double>& light = of_radiosity ? radiosity_ : irradiance_;
  const Vec2 shift = q - nodes_[node].shape.centroid;
  for (std::size_t band = 0; band < static_cast<std::size_t>(bands_); ++band) {
    const double* e = light.data() + node * stride() + band * static_cast<std::size_t>(terms_);
    out[band] = e[0] + (terms_ == 3 ? e[1] * shift.x + e[2] * shift.y : 0.0);
  }
}

std::size_t PatchForest::memory_bytes() const {
  // The heap memory of small vectors that have outgrown their fixed part.
  const auto bands = static_cast<std::size_t>(bands_);
  const std::size_t in_frames =
      bands > BandValues::static_capacity ? 2 * sizeof(double) * bands : 0;
  std::size_t corners = 0;
  for (const PatchNode& n : nodes_) {
    if (n.shape.vertices.capacity() > PatchOutline::static_capacity)
      corners += n.shape.vertices.capacity();
  }
  return nodes_.capacity() * sizeof(PatchNode) + corners * sizeof(Vec2) +
         (radiosity_.capacity() + irradiance_.capacity() + deviation_.capacity()) * sizeof(double) +
         (enclosed_share_.capacity() + link_error_.capacity()) * sizeof(float) +
         settled_.capacity() + kept_.capacity() * sizeof(double) +
         frames_.size() * (sizeof(PolygonFrame) + in_frames) +
         groups_.size() * (sizeof(GroupNode) + sizeof(double) * (2 * bands + 1));
}

void PatchForest::shrink() {
  nodes_.shrink_to_fit();
  radiosity_.shrink_to_fit();
  irradiance_.shrink_to_fit();
  deviation_.shrink_to_fit();
  enclosed_share_.shrink_to_fit();
  settled_.shrink_to_fit();
  link_error_.shrink_to_fit();
  kept_.shrink_to_fit();
  for (PatchNode& n : nodes_) n.shape.vertices.shrink_to_fit();
}

}  // namespace enfilade
