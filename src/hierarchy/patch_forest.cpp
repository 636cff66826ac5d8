#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "hierarchy/patch.hpp"

namespace enfilade {

PatchForest::PatchForest(const Cluster& cluster, std::vector<PolygonFrame> frames, int bands,
                         int terms)
    : bands_(bands), terms_(terms), frames_(std::move(frames)), order_(frames_.size()) {
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
  unreachable_.assign(nodes_.size(), 0);
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    for (int band = 0; band < bands_; ++band) {
      radiosity(k)[static_cast<std::size_t>(band * terms_)] =
          frames_[k].exitance[static_cast<std::size_t>(band)];
    }
  }
  std::iota(order_.begin(), order_.end(), 0u);
  if (frames_.size() > 1) build_group(0, static_cast<std::uint32_t>(order_.size()));
  pull_groups();
  sum_exitances();
}

/// Splits polygons by place and facing at once: a direction counts as half the group's extent.
std::int32_t PatchForest::build_group(std::uint32_t begin, std::uint32_t end) {
  if (end - begin == 1) return ~static_cast<std::int32_t>(order_[begin]);
  const auto index = static_cast<std::int32_t>(groups_.size());
  groups_.emplace_back();
  GroupNode group;
  group.begin = begin;
  group.end = end;
  Box centers, facings;
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t k = order_[i];
    for (const Vec2& p : nodes_[k].shape.vertices) group.bounds.add(frames_[k].at(p));
    centers.add(frames_[k].at(nodes_[k].shape.centroid));
    facings.add(frames_[k].n);
    group.area_m2 += nodes_[k].shape.area_m2;
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

/// The nodes alone, without their light; returns the first.
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
  }
  return first;
}

void PatchForest::push_pull(std::span<const double> gathered) {
  std::copy(gathered.begin(), gathered.end(), irradiance_.begin());
  push(irradiance_, stride(), bands_);
  pull();
}

// Children come after their parents, so that one pass forward pushes, and one backward pulls.
void PatchForest::push(std::span<double> values, std::size_t width, int affine) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const PatchNode& parent = nodes_[i];
    if (parent.leaf()) continue;
    const double* from = values.data() + i * width;
    for (int side = 0; side < 2; ++side) {
      const std::size_t c = static_cast<std::size_t>(parent.first_child + side);
      const Vec2 shift = nodes_[c].shape.centroid - parent.shape.centroid;
      double* to = values.data() + c * width;
      for (std::size_t t = 0; t < width; ++t) to[t] += from[t];
      if (terms_ != 3) continue;
      for (std::size_t t = 0; t < 3 * static_cast<std::size_t>(affine); t += 3) {
        to[t] += from[t + 1] * shift.x + from[t + 2] * shift.y;
      }
    }
  }
}

void PatchForest::pull() {
  const std::size_t n = stride();
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const PatchNode& parent = nodes_[i];
    const PolygonFrame& frame = frames_[parent.id.root];
    deviation_[i] = 0.0;
    if (!parent.leaf()) {
      const PatchShape& p = parent.shape;
      double worst = 0.0;
      for (int band = 0; band < bands_; ++band) {
        const std::size_t at = static_cast<std::size_t>(band * terms_);
        double value = 0.0, weight[2];
        Vec2 shift[2];
        for (int side = 0; side < 2; ++side) {
          const std::size_t c = static_cast<std::size_t>(parent.first_child + side);
          weight[side] = nodes_[c].shape.area_m2 / p.area_m2;
          shift[side] = nodes_[c].shape.centroid - p.centroid;
          value += weight[side] * irradiance_[c * n + at];
        }
        irradiance_[i * n + at] = value;
        Vec2 gradient(0.0);
        if (terms_ == 3) {
          Vec2 moment(0.0);
          for (int side = 0; side < 2; ++side) {
            const std::size_t c = static_cast<std::size_t>(parent.first_child + side);
            const PatchShape& s = nodes_[c].shape;
            const double* e = irradiance_.data() + c * n + at;
            moment += weight[side] * (e[0] * shift[side] + Vec2(s.cxx * e[1] + s.cxy * e[2],
                                                                s.cxy * e[1] + s.cyy * e[2]));
          }
          const double determinant = p.cxx * p.cyy - p.cxy * p.cxy;
          const double trace = p.cxx + p.cyy;
          if (determinant > 1e-14 * trace * trace) {
            gradient =
                Vec2(p.cyy * moment.x - p.cxy * moment.y, p.cxx * moment.y - p.cxy * moment.x) /
                determinant;
          } else if (trace > 0.0) {
            gradient = moment / trace;  // a needle: only along its length
          }
          irradiance_[i * n + at + 1] = gradient.x;
          irradiance_[i * n + at + 2] = gradient.y;
        }
        double square = 0.0;
        for (int side = 0; side < 2; ++side) {
          const std::size_t c = static_cast<std::size_t>(parent.first_child + side);
          const PatchShape& s = nodes_[c].shape;
          const double* e = irradiance_.data() + c * n + at;
          const double dv = e[0] - value - glm::dot(gradient, shift[side]);
          double mean_square = dv * dv;
          if (terms_ == 3) {
            const Vec2 dg = Vec2(e[1], e[2]) - gradient;
            mean_square += s.cxx * dg.x * dg.x + 2.0 * s.cxy * dg.x * dg.y + s.cyy * dg.y * dg.y;
          }
          square += weight[side] * mean_square;
        }
        const double rho = frame.reflectance[static_cast<std::size_t>(band)];
        worst = std::max(worst, rho * rho * square);
      }
      for (int side = 0; side < 2; ++side) {
        const std::size_t c = static_cast<std::size_t>(parent.first_child + side);
        worst += nodes_[c].shape.area_m2 / p.area_m2 * deviation_[c] * deviation_[c];
      }
      deviation_[i] = std::sqrt(worst);
    }
    for (int band = 0; band < bands_; ++band) {
      const std::size_t at = i * n + static_cast<std::size_t>(band * terms_);
      const double rho = frame.reflectance[static_cast<std::size_t>(band)];
      for (std::size_t t = 0; t < static_cast<std::size_t>(terms_); ++t) {
        radiosity_[at + t] = rho * irradiance_[at + t];
      }
      radiosity_[at] += frame.exitance[static_cast<std::size_t>(band)];
    }
  }
  pull_groups();
}

void PatchForest::find_lit() {
  lit_.assign(polygons(), 0);
  lit_polygons_ = 0;
  for (std::size_t k = 0; k < polygons(); ++k) {
    for (std::size_t at = k * stride(); at < (k + 1) * stride();
         at += static_cast<std::size_t>(terms_))
      if (radiosity_[at] > 0.0) lit_[k] = 1;
    lit_polygons_ += static_cast<std::uint32_t>(lit_[k]);
  }
}

void PatchForest::pull_groups() {
  find_lit();
  const auto bands = static_cast<std::size_t>(bands_);
  group_radiosity_.assign(groups_.size() * bands, 0.0);
  group_deviation_.assign(groups_.size(), 0.0);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const GroupNode& group = groups_[g];
    for (std::size_t band = 0; band < bands; ++band) {
      double sum = 0.0, square = 0.0;
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const std::uint32_t k = order_[i];
        const double b = radiosity_[k * stride() + band * static_cast<std::size_t>(terms_)];
        sum += nodes_[k].shape.area_m2 * b;
        square += nodes_[k].shape.area_m2 * b * b;
      }
      const double mean = group.area_m2 > 0.0 ? sum / group.area_m2 : 0.0;
      group_radiosity_[g * bands + band] = mean;
      group_deviation_[g] = std::max(
          group_deviation_[g],
          std::sqrt(group.area_m2 > 0.0 ? std::max(0.0, square / group.area_m2 - mean * mean)
                                        : 0.0));
    }
  }
}

void PatchForest::sum_exitances() {
  const auto bands = static_cast<std::size_t>(bands_);
  group_exitance_.assign(groups_.size() * bands, 0.0);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const GroupNode& group = groups_[g];
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const std::uint32_t k = order_[i];
      const double share = group.area_m2 > 0.0 ? nodes_[k].shape.area_m2 / group.area_m2 : 0.0;
      for (std::size_t b = 0; b < bands; ++b)
        group_exitance_[g * bands + b] += share * frames_[k].exitance[b];
    }
  }
}

void PatchForest::forget_enclosed_shares_below(std::uint32_t lit_polygons) {
  if (lit_polygons <= lit_when_measured_ + lit_when_measured_ / 256) return;
  lit_when_measured_ = lit_polygons;
  std::fill(enclosed_share_.begin(), enclosed_share_.end(), -1.0f);
}

std::size_t PatchForest::leaf_at(std::size_t polygon, const Vec3& p) const {
  const Vec2 q = frames_[polygon].project(p);
  std::size_t node = polygon;
  while (!nodes_[node].leaf()) {
    const PatchNode& at = nodes_[node];
    node = static_cast<std::size_t>(at.first_child) +
           (glm::dot(at.split_axis, q) >= at.split_at ? 1 : 0);
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

}  // namespace enfilade
