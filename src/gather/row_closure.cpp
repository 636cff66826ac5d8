#include "gather/row_closure.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace enfilade {

RowClosure::RowClosure(ClusterState& receiver)
    : receiver_(receiver),
      bands_(static_cast<std::size_t>(receiver.bands())),
      terms_(static_cast<std::size_t>(receiver.patches().terms())),
      width_(terms_ + 1 + 2 * bands_),
      uncertain_power_(bands_, 0.0) {}

void RowClosure::see(const ClusterState& shooter) {
  const PatchForest& patches = shooter.patches();
  ENFILADE_CHECK(lit_from_.empty() || lit_from_.back().first < shooter.id(),
                 std::to_string(shooter.id().value));
  lit_from_.emplace_back(shooter.id(), lit_.size());
  lit_.insert(lit_.end(), patches.lit().begin(), patches.lit().end());
  lit_in_view_ += patches.lit_polygons();
}

void RowClosure::add(std::size_t node, double factor, double uncertainty,
                     std::span<const double> light, double uncertainty_of_variation) {
  rows_.resize(std::max(rows_.size(), receiver_.patches().size() * width_), 0.0);
  double* to = row(node);
  to[0] += factor;
  to[terms_] += uncertainty;
  double top = 0.0;  // light is below zero in places, by the links' errors
  for (const double l : light) top = std::max(top, std::abs(l));
  const double varies = top > 0.0 ? uncertainty_of_variation / top : 0.0;
  for (std::size_t b = 0; b < bands_; ++b) {
    to[terms_ + 1 + b] += uncertainty * light[b];
    to[terms_ + 1 + bands_ + b] += (uncertainty + varies) * light[b];
  }
}

void RowClosure::add(const Link& link, std::span<const float> transport,
                     std::span<const double> light, double variation) {
  if (link.is_light()) return;
  const PatchForest& patches = receiver_.patches();
  if (link.receiver.is_group()) {
    const GroupNode& group = patches.groups()[link.receiver.group()];
    for (std::uint32_t j = group.begin; j < group.end; ++j) {
      const std::uint32_t k = patches.order()[j];
      const double cosine =
          glm::dot(patches.frames()[k].n, Vec3(transport[1], transport[2], transport[3]));
      if (cosine > 0.0 && !patches.unreachable(k))
        add(k, transport[0] * cosine, transport[0] * cosine * 0.3, light, 0.0);
    }
    return;
  }
  // A link that nothing came through takes no share: what is missing comes from where light is
  // seen.
  const std::size_t node = patches.find(link.receiver);
  const double per_m2 = transport[0] > 0.0f ? 1.0 / patches.node(node).shape.area_m2 : 0.0;
  add(node, transport[0], per_m2 * link.error, light, per_m2 * link.variation * variation);
  if (terms_ == 3) {
    row(node)[1] += transport[3];
    row(node)[2] += transport[6];
  }
}

std::vector<char> RowClosure::find_openings(int rings, const Occluders& occluders,
                                            WorkCount& work) {
  PatchForest& patches = receiver_.patches();
  const auto lit = [this](const PolygonRef& polygon) {
    const auto seen = std::lower_bound(lit_from_.begin(), lit_from_.end(),
                                       std::pair(polygon.cluster, std::size_t{0}));
    return seen != lit_from_.end() && seen->first == polygon.cluster &&
           lit_[seen->second + polygon.polygon] != 0;
  };
  patches.forget_enclosed_shares_below(lit_in_view_);
  std::vector<char> open(patches.polygons(), 0);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const PatchNode& node = patches.node(n);
    if (!node.leaf()) continue;
    if (patches.unreachable(node.id.root)) patches.set_enclosed_share(n, 0.0f);
    if (patches.enclosed_share(n) < 0.0f) {
      patches.set_enclosed_share(
          n, static_cast<float>(enclosed_share(receiver_, node, rings, occluders, lit, work)));
    }
    if (patches.enclosed_share(n) < 1.0f) open[node.id.root] = 1;
  }
  return open;
}

/// The radiosity of a leaf that sees itself, so to say, in `unseen` of its row: what is missing
/// beyond the links' doubt is no light that they know of, as between panels that nearly touch.
double RowClosure::own_light(std::size_t leaf, std::size_t band, double unseen,
                             double arrived) const {
  const PolygonFrame& frame = receiver_.patches().frames()[receiver_.patches().node(leaf).id.root];
  const double rho = frame.reflectance[band];
  return (rho * std::max(0.0, arrived) + frame.exitance[band]) /
         (1.0 - rho * std::min(unseen, 1.0));
}

void RowClosure::close(const Occluders& occluders, const Spectrum& flux_correction, WorkCount& work,
                       std::vector<double>& gathered) {
  const PatchForest& patches = receiver_.patches();
  rows_.resize(patches.size() * width_, 0.0);
  patches.push(rows_, width_, 1);
  // At least 512 rays for the cluster: a narrow opening must not pass for none.
  const std::size_t leaves = patches.polygons() + (patches.size() - patches.polygons()) / 2;
  const int rings = std::max(4, static_cast<int>(std::sqrt(128.0 / static_cast<double>(leaves))));
  const std::vector<char> open = find_openings(rings, occluders, work);
  const std::size_t stride = bands_ * terms_;
  std::vector<double> arrived(gathered);  // at the leaf and above it
  patches.push(arrived, stride, patches.bands());
  const double rays = 4.0 * rings * rings;
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const PatchNode& node = patches.node(n);
    if (!node.leaf()) continue;
    const double* has = row(n);
    for (std::size_t b = 0; b < bands_; ++b) {
      const double doubtful = has[terms_ + 1 + bands_ + b];
      uncertain_power_[b] += node.shape.area_m2 * doubtful;
      if (!flux_correction.empty())
        gathered[n * stride + b * terms_] += flux_correction[b] * doubtful;
    }
    const double target = patches.enclosed_share(n);
    if (has[terms_] <= 0.0 || target <= 0.0) continue;
    // Rays tell an open row's sum to within `blur`, the links to within their doubt: weigh one
    // against the other. A row without an opening sums to 1.
    const double uncertainty = 0.5 * has[terms_];
    const double blur = (target * (1.0 - target) + 1.0 / rays) / rays;
    const double gain =
        open[node.id.root] ? uncertainty * uncertainty / (uncertainty * uncertainty + blur) : 1.0;
    const double missing = gain * (target - has[0]);
    const double unseen = std::max(0.0, missing - has[terms_]);
    for (std::size_t b = 0; b < bands_; ++b) {
      double* to = gathered.data() + n * stride + b * terms_;
      const double light = has[terms_ + 1 + b] / has[terms_];
      to[0] += (missing - unseen) * light;
      if (unseen > 0.0)
        to[0] += unseen * std::min(light, own_light(n, b, unseen,
                                                    arrived[n * stride + b * terms_] +
                                                        (missing - unseen) * light));
      if (terms_ == 3) {
        to[1] -= gain * has[1] * light;
        to[2] -= gain * has[2] * light;
      }
    }
  }
}

}  // namespace enfilade
