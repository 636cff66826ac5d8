// Push and pull of light through the hierarchy (Hanrahan, Salzman and Aupperle 1991), for affine
// functions on convex patches.
#include <algorithm>
#include <cmath>

#include "hierarchy/patch_forest.hpp"

namespace enfilade {
namespace {

/// A patch and its two halves; the light of a half is an affine function of one band: value at the
/// half's centroid, then the gradient (linear basis).
struct SplitPatch {
  const PatchShape& whole;
  const PatchShape* half[2];
  double weight[2];  ///< share of the area
  Vec2 shift[2];     ///< from the whole's centroid to the half's

  SplitPatch(const PatchShape& parent, const PatchShape& first, const PatchShape& second)
      : whole(parent), half{&first, &second} {
    for (int side = 0; side < 2; ++side) {
      weight[side] = half[side]->area_m2 / whole.area_m2;
      shift[side] = half[side]->centroid - whole.centroid;
    }
  }
  double mean(const double* const light[2]) const {
    double value = 0.0;
    for (int side = 0; side < 2; ++side) value += weight[side] * light[side][0];
    return value;
  }
  Vec2 gradient(const double* const light[2]) const;
  double mean_square_misfit(const double* const light[2], int terms, double value,
                            const Vec2& gradient) const;
};

/// Least-squares gradient g over the whole: C g = m with the area's covariance C and the first
/// moment m of the halves' light.
Vec2 SplitPatch::gradient(const double* const light[2]) const {
  // Below this share of the squared trace the covariance's determinant is rounding error.
  constexpr double least_determinant = 1e-14;
  Vec2 moment(0.0);
  for (int side = 0; side < 2; ++side) {
    const PatchShape& s = *half[side];
    const double* e = light[side];
    moment += weight[side] *
              (e[0] * shift[side] + Vec2(s.cxx * e[1] + s.cxy * e[2], s.cxy * e[1] + s.cyy * e[2]));
  }
  const PatchShape& p = whole;
  const double determinant = p.cxx * p.cyy - p.cxy * p.cxy;
  const double trace = p.cxx + p.cyy;
  if (determinant > least_determinant * trace * trace) {
    return Vec2(p.cyy * moment.x - p.cxy * moment.y, p.cxx * moment.y - p.cxy * moment.x) /
           determinant;
  }
  if (trace > 0.0) return moment / trace;  // a needle: only along its length
  return Vec2(0.0);
}

/// Mean square over the whole of the halves' light minus the affine function (value, gradient).
double SplitPatch::mean_square_misfit(const double* const light[2], int terms, double value,
                                      const Vec2& gradient) const {
  double square = 0.0;
  for (int side = 0; side < 2; ++side) {
    const PatchShape& s = *half[side];
    const double* e = light[side];
    const double dv = e[0] - value - glm::dot(gradient, shift[side]);
    double mean_square = dv * dv;
    if (terms == 3) {
      const Vec2 dg = Vec2(e[1], e[2]) - gradient;
      mean_square += s.cxx * dg.x * dg.x + 2.0 * s.cxy * dg.x * dg.y + s.cyy * dg.y * dg.y;
    }
    square += weight[side] * mean_square;
  }
  return square;
}

}  // namespace

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
      const std::size_t c = parent.child(side);
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
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    deviation_[i] = 0.0;
    if (!nodes_[i].leaf()) pull_node(i);
    reflect(i);
  }
  pull_groups();
}

/// Fits an inner node's irradiance to its children's, and sets its deviation: the fit's misfit in
/// radiosity, and the children's own deviations.
void PatchForest::pull_node(std::size_t parent) {
  const std::size_t child[2] = {nodes_[parent].child(0), nodes_[parent].child(1)};
  const SplitPatch split(nodes_[parent].shape, nodes_[child[0]].shape, nodes_[child[1]].shape);
  const PolygonFrame& frame = frames_[nodes_[parent].id.root];
  double worst = 0.0;
  for (int band = 0; band < bands_; ++band) {
    const std::size_t at = static_cast<std::size_t>(band * terms_);
    const double* const light[2] = {irradiance_.data() + child[0] * stride() + at,
                                    irradiance_.data() + child[1] * stride() + at};
    double* const fit = irradiance_.data() + parent * stride() + at;
    const double value = split.mean(light);
    fit[0] = value;
    Vec2 gradient(0.0);
    if (terms_ == 3) {
      gradient = split.gradient(light);
      fit[1] = gradient.x;
      fit[2] = gradient.y;
    }
    const double square = split.mean_square_misfit(light, terms_, value, gradient);
    const double rho = frame.reflectance[static_cast<std::size_t>(band)];
    if (band < lead_bands_) worst = std::max(worst, rho * rho * square);
  }
  for (int side = 0; side < 2; ++side) {
    worst += split.weight[side] * deviation_[child[side]] * deviation_[child[side]];
  }
  deviation_[parent] = std::sqrt(worst);
}

/// Radiosity = exitance + reflectance * irradiance.
void PatchForest::reflect(std::size_t node) {
  const PolygonFrame& frame = frames_[nodes_[node].id.root];
  for (int band = 0; band < bands_; ++band) {
    const std::size_t at = node * stride() + static_cast<std::size_t>(band * terms_);
    const double rho = frame.reflectance[static_cast<std::size_t>(band)];
    for (std::size_t t = 0; t < static_cast<std::size_t>(terms_); ++t) {
      radiosity_[at + t] = rho * irradiance_[at + t];
    }
    radiosity_[at] += frame.exitance[static_cast<std::size_t>(band)];
  }
}

void PatchForest::find_lit() {
  lit_.assign(polygons(), 0);
  lit_polygons_ = 0;
  for (std::size_t k = 0; k < polygons(); ++k) {
    for (int band = 0; band < lead_bands_; ++band)
      if (radiosity_[k * stride() + static_cast<std::size_t>(band * terms_)] > 0.0) lit_[k] = 1;
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
      if (group.area_m2 <= 0.0 || band >= static_cast<std::size_t>(lead_bands_)) continue;
      group_deviation_[g] = std::max(
          group_deviation_[g], std::sqrt(std::max(0.0, square / group.area_m2 - mean * mean)));
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

}  // namespace enfilade
