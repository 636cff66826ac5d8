#include "far_field/building_light.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace enfilade {
namespace {

/// Adds a polygon of area `m2` and normal n.
void add_polygon(ClusterLight& light, std::size_t bands, const Vec3& n, double m2,
                 std::size_t lead_bands, std::span<const double> radiosity, std::size_t stride,
                 std::span<const double> exitance) {
  const std::array<double, directions> share = axis_shares(n);
  double worst = 0.0;
  for (std::size_t b = 0; b < bands; ++b) {
    const double value = radiosity[b * stride];
    if (b < lead_bands) worst = std::max(worst, value);
    for (std::size_t k = 0; k < directions; ++k) light[k * bands + b] += share[k] * m2 * value;
    light[directions * bands + b] += m2 * (value - exitance[b]);
  }
  double* sums = light.data() + (directions + 1) * bands;
  sums[0] += m2 * worst;
  sums[1] += m2 * worst * worst;
  sums[2] = std::max(sums[2], worst);
  sums[3] += worst > 0.0 ? 1.0 : 0.0;
}

}  // namespace

ClusterLight light_of(const ClusterState& cluster) {
  const PatchForest& patches = cluster.patches();
  const auto bands = static_cast<std::size_t>(patches.bands());
  ClusterLight light(cluster_light_size(bands), 0.0);
  for (std::size_t k = 0; k < patches.polygons(); ++k) {
    const PolygonFrame& frame = patches.frames()[k];
    add_polygon(light, bands, frame.n, patches.node(k).shape.area_m2,
                static_cast<std::size_t>(patches.lead_bands()), patches.radiosity(k),
                static_cast<std::size_t>(patches.terms()),
                {frame.exitance.data(), frame.exitance.size()});
  }
  return light;
}

BuildingLight::BuildingLight(const BuildingTree& tree, const Scene& scene,
                             std::span<const Cluster> clusters)
    : tree_(tree),
      bands_(static_cast<std::size_t>(scene.bands)),
      lead_bands_(static_cast<std::size_t>(scene.lead_bands > 0 ? scene.lead_bands : scene.bands)),
      width_(cluster_light_size(bands_)),
      rows_(tree.nodes().size() * width_, 0.0),
      emitted_(tree.nodes().size() * directions * bands_, 0.0) {
  for (const Cluster& cluster : clusters) {
    ClusterLight light(width_, 0.0);
    first_polygon_.push_back(static_cast<std::uint32_t>(polygons_.size()));
    for (const ClusterPolygon& polygon : cluster.polygons) {
      const Spectrum& exitance = scene.surfaces[polygon.surface.index()].exitance;
      const double m2 = area_m2(polygon.polygon);
      add_polygon(light, bands_, normal(polygon.polygon), m2, lead_bands_, exitance, 1, exitance);
      const double emitted = m2 * *std::max_element(exitance.begin(), exitance.end());
      polygons_.push_back({plane_of(polygon.polygon), centroid(polygon.polygon),
                           static_cast<float>(m2), static_cast<float>(emitted),
                           static_cast<float>(emitted)});
    }
    std::copy_n(light.begin(), directions * bands_,
                emitted_.data() + tree.leaf_of(cluster.id) * directions * bands_);
    set(cluster.id, light);
  }
  first_polygon_.push_back(static_cast<std::uint32_t>(polygons_.size()));
  const std::size_t width = directions * bands_;
  for (std::size_t i = tree.nodes().size(); i-- > 0;) {
    const BuildingTree::Node& node = tree.nodes()[i];
    for (std::size_t k = 0; k < width && !node.leaf(); ++k)
      emitted_[i * width + k] = emitted_[node.left * width + k] + emitted_[node.right * width + k];
  }
  sum();
}

void BuildingLight::set(ClusterId cluster, std::span<const double> light) {
  ENFILADE_CHECK(light.size() == width_, std::to_string(light.size()));
  std::copy(light.begin(), light.end(), row(tree_.leaf_of(cluster)).begin());
}

void BuildingLight::correct(ClusterId cluster, std::span<const double> changes) {
  const std::span<double> light = row(tree_.leaf_of(cluster));
  const double* emitted = emitted_row(tree_.leaf_of(cluster));
  for (std::size_t b = 0; b < bands_; ++b) {
    for (std::size_t k = 0; k < directions; ++k) {
      double& power = light[k * bands_ + b];
      power += changes[b] * (power - emitted[k * bands_ + b]);
    }
    light[directions * bands_ + b] *= 1.0 + changes[b];
  }
}

void BuildingLight::sum() {
  const std::span<const BuildingTree::Node> nodes = tree_.nodes();
  const std::size_t most = (directions + 1) * bands_ + 2;
  for (const ClusterId cluster : tree_.clusters()) share_reflected(cluster);
  brightest_.resize(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {  // children come after their parent
    const auto k = static_cast<std::uint32_t>(i);
    if (nodes[i].leaf()) {
      brightest_[i] = brightest_face(k);
      continue;
    }
    const std::span<const double> a = row(nodes[i].left), b = row(nodes[i].right);
    const std::span<double> to = row(k);
    for (std::size_t j = 0; j < width_; ++j) to[j] = a[j] + b[j];
    to[most] = std::max(a[most], b[most]);
    brightest_[i] = nodes[i].end_cell - nodes[i].first_cell == 1
                        ? brightest_face(k)
                        : std::max(brightest_[nodes[i].left], brightest_[nodes[i].right]);
  }
  // A node and its sibling are weighed with their parent's mean radiosity.
  draws_.resize(nodes.size());
  for (const BuildingTree::Node& node : nodes) {
    if (node.leaf()) continue;
    const auto parent = static_cast<std::uint32_t>(&node - nodes.data());
    const double mean = radiosity(parent, Vec3(0.0));
    make_draw(node.left, mean);
    make_draw(node.right, mean);
  }
}

double BuildingLight::brightest_face(std::uint32_t node) const {
  const std::array<double, directions>& facing_m2 = tree_.node(node).facing_m2;
  double brightest = 0.0;
  for (std::size_t k = 0; k < directions; ++k) {
    for (std::size_t b = 0; b < bands_ && facing_m2[k] > 0.0; ++b)
      brightest = std::max(brightest, row(node)[k * bands_ + b] / facing_m2[k]);
  }
  return brightest;
}

/// Half by light and half by area, so that neither dim nor small parts are missed.
void BuildingLight::make_draw(std::uint32_t node, double mean) {
  Draw& draw = draws_[node];
  const std::span<const double> light = row(node);
  const BuildingTree::Node& n = tree_.node(node);
  double sum = 0.0;
  for (std::size_t k = 0; k < directions; ++k) {
    double power = 0.0;
    for (std::size_t b = 0; b < bands_; ++b) power = std::max(power, light[k * bands_ + b]);
    const double weight = power + mean * n.facing_m2[k];
    draw.weight[k] = static_cast<float>(weight);
    sum += 0.5 * weight;
  }
  draw.all = static_cast<float>(sum);
  const Vec3 extent = n.bounds.extent(), center = n.bounds.center();
  draw.size2 = static_cast<float>(0.25 * glm::dot(extent, extent));
  for (int k = 0; k < 3; ++k)
    draw.center[static_cast<std::size_t>(k)] = static_cast<float>(center[k]);
}

double BuildingLight::radiosity(std::uint32_t node, const Vec3& w) const {
  const double m2 = tree_.facing_m2(node, w);
  return m2 > 0.0 ? intensity(node, w) / m2 : 0.0;
}

double BuildingLight::reflected(std::uint32_t node, std::size_t band, const Vec3& w) const {
  const double m2 = tree_.facing_m2(node, w);
  return m2 > 0.0 ? std::max(0.0, reflected_toward(node, band, axis_shares(w)) / m2) : 0.0;
}

void BuildingLight::reflected(std::uint32_t node, const Vec3& w, std::span<double> out,
                              std::size_t step) const {
  const std::array<double, directions> share = axis_shares(w);
  const double m2 = tree_.facing_m2(node, w);
  for (std::size_t b = 0; b < bands_; ++b) {
    const bool none = m2 <= 0.0 || (b >= lead_bands_ && out[b % lead_bands_ * step] == 0.0);
    const double radiosity = none ? 0.0 : reflected_toward(node, b, share) / m2;
    out[b * step] = b < lead_bands_ ? std::max(0.0, radiosity) : radiosity;
  }
}

/// The reflected power towards a direction with these shares of the axes.
double BuildingLight::reflected_toward(std::uint32_t node, std::size_t band,
                                       const std::array<double, directions>& share) const {
  const std::span<const double> light = row(node);
  const double* emitted = emitted_row(node);
  double power = 0.0;
  for (std::size_t k = 0; k < directions; ++k) {
    power += share[k] * (light[k * bands_ + band] - emitted[k * bands_ + band]);
  }
  return power;
}

double BuildingLight::emitted(std::uint32_t node, std::size_t band) const {
  double power = 0.0;
  for (std::size_t k = 0; k < directions; ++k) power += emitted_row(node)[k * bands_ + band];
  const double m2 = 2.0 * tree_.facing_m2(node, Vec3(0.0));
  return m2 > 0.0 ? power / m2 : 0.0;
}

double BuildingLight::intensity(std::uint32_t node, const Vec3& w) const {
  const std::array<double, directions> share = axis_shares(w);
  const std::span<const double> light = row(node);
  double worst = 0.0;
  for (std::size_t b = 0; b < bands_; ++b) {
    double power = 0.0;
    for (std::size_t k = 0; k < directions; ++k) power += share[k] * light[k * bands_ + b];
    worst = std::max(worst, power);
  }
  return worst;
}

double BuildingLight::power(std::uint32_t node) const {
  return row(node)[(directions + 1) * bands_];
}

void BuildingLight::share_reflected(ClusterId cluster) {
  const std::uint32_t leaf = tree_.leaf_of(cluster);
  double reflected = 0.0, m2 = 0.0;
  for (std::size_t b = 0; b < bands_; ++b)
    reflected = std::max(reflected, reflected_power(leaf, b));
  const auto begin = polygons_.begin() + first_polygon_[cluster.index()],
             end = polygons_.begin() + first_polygon_[cluster.index() + 1];
  for (auto p = begin; p != end; ++p) m2 += p->area_m2;
  for (auto p = begin; p != end; ++p) {
    const double share = m2 > 0.0 ? reflected * p->area_m2 / m2 : 0.0;
    p->power = p->emitted + static_cast<float>(share);
  }
}

double BuildingLight::deviation(std::uint32_t node) const {
  const double* sums = row(node).data() + (directions + 1) * bands_;
  double m2 = 0.0;
  for (const double facing : tree_.node(node).facing_m2) m2 += facing;
  if (m2 <= 0.0) return 0.0;
  const double mean = sums[0] / m2;
  return std::sqrt(std::max(0.0, sums[1] / m2 - mean * mean));
}

}  // namespace enfilade
