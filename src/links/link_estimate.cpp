#include "links/link_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

/// All corners on or behind the plane: no light passes between the plane's front and that side.
bool behind(const Polygon& corners, const Vec3& origin, const Vec3& n, double tolerance_m) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vec3& p) { return glm::dot(n, p - origin) <= tolerance_m; });
}

/// Received power per unit of the shooter's light if nothing stands between, from the shooter's
/// side: the receiver's solid angle, or the mean factor towards it.
double power_from(const LinkSide& receiver, const LinkSide& shooter, WorkCount& work) {
  if (shooter.is_light()) {
    ++work.form_factors;
    return solid_angle(shooter.center, receiver.corners);
  }
  const PolygonFrame& frame = shooter.frame();
  double sum = 0.0;
  for (const Vec2& q : shooter.shape.quadrature()) {
    sum += 0.25 * point_to_polygon(frame.at(q), frame.n, receiver.corners);
  }
  work.form_factors += 4;
  return shooter.area_m2 * sum;
}

}  // namespace

double LinkEstimator::power_bound(const LinkSide& receiver, const LinkSide& shooter) {
  const double gap =
      glm::length(receiver.center - shooter.center) - receiver.radius - shooter.radius;
  if (shooter.is_light()) {
    return gap > 0.0 ? receiver.area_m2 * shooter.light / (gap * gap) : 1e300;
  }
  const double factor =
      gap > 0.0 ? std::min(1.0, shooter.area_m2 / (std::numbers::pi * gap * gap)) : 1.0;
  return receiver.area_m2 * shooter.light * factor;
}

bool LinkEstimator::faces_away(const LinkSide& receiver, const LinkSide& shooter) {
  if (receiver.is_patch()) {
    const PolygonFrame& f = receiver.frame();
    const double tolerance_m = 1e-9 * (receiver.radius + shooter.radius);
    if (!shooter.is_group()) {
      if (behind(shooter.corners, f.origin, f.n, tolerance_m)) return true;
    } else if (glm::dot(f.n, shooter.center - f.origin) <= -shooter.radius) {
      return true;
    }
  }
  if (shooter.is_patch()) {
    const PolygonFrame& f = shooter.frame();
    const double tolerance_m = 1e-9 * (receiver.radius + shooter.radius);
    if (receiver.is_patch()) return behind(receiver.corners, f.origin, f.n, tolerance_m);
    return glm::dot(f.n, receiver.center - f.origin) <= -receiver.radius;
  }
  return false;
}

double LinkEstimator::factor_at(const Vec3& x, const Vec3& n, const LinkSide& shooter,
                                double* per_polygon) {
  if (shooter.is_light()) {
    ++work_->kernels;
    const Vec3 d = shooter.center - x;
    const double r2 = glm::dot(d, d), cosine = glm::dot(d, n);
    return cosine > 0.0 ? cosine / (r2 * std::sqrt(r2)) : 0.0;
  }
  if (shooter.is_patch()) {
    ++work_->form_factors;
    return point_to_polygon(x, n, shooter.corners);
  }
  const GroupNode& group = shooter.group();
  double sum = 0.0;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = shooter.forest->order()[i];
    const PolygonFrame& frame = shooter.forest->frames()[k];
    if (glm::dot(frame.n, x - frame.origin) <= 0.0) continue;
    polygon_.clear();
    for (const Vec2& p : shooter.forest->node(k).shape.vertices) polygon_.push_back(frame.at(p));
    ++work_->form_factors;
    const double f = point_to_polygon(x, n, polygon_);
    if (per_polygon != nullptr) per_polygon[i - group.begin] += f;
    sum += f;
  }
  return sum;
}

LinkEstimate LinkEstimator::evaluate(const LinkSide& receiver, const LinkSide& shooter,
                                     double tolerance, const Between& among) {
  among_ = among;
  all_between_ = false;
  return receiver.is_group() ? evaluate_group(receiver, shooter)
                             : evaluate_patch(receiver, shooter, tolerance);
}

LinkEstimate LinkEstimator::evaluate_patch(const LinkSide& receiver, const LinkSide& shooter,
                                           double tolerance) {
  LinkEstimate out;
  const PolygonFrame& frame = receiver.frame();
  const std::array<Vec2, 4> points = receiver.shape.quadrature();
  weights_.assign(shooter.is_group() ? shooter.group().end - shooter.group().begin : 0, 0.0);
  double* per_polygon = shooter.is_group() ? weights_.data() : nullptr;
  std::array<double, 4> e{};
  double mean_factor = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    e[k] = factor_at(frame.at(points[k]), frame.n, shooter, per_polygon);
    mean_factor += 0.25 * e[k];
  }
  const double center = factor_at(frame.at(receiver.shape.centroid), frame.n, shooter, nullptr);
  // A shooter that only the receiver's rim is in front of: what the corners see bounds what is
  // missed.
  double rim = 0.0;
  if (mean_factor < 0.5 * center || mean_factor == 0.0) {
    for (const Vec3& corner : receiver.corners) {
      const Vec3 x = corner + 0.05 * (receiver.center - corner);
      rim = std::max(rim, factor_at(x, frame.n, shooter, nullptr));
    }
  }
  const double top = std::max({mean_factor, center, rim});
  if (top <= 0.0) {
    out.invisible = faces_away(receiver, shooter);
    return out;
  }
  const double power = receiver.area_m2 * top * shooter.light;
  const Visibility v = visibility(receiver, shooter, power, tolerance);

  // A small shooter's light peaks between the receiver's points; seen from the shooter the total is
  // plain: a point light's by the receiver's solid angle, a patch's by reciprocity, A_r F_rs = A_s
  // F_sr.
  double missed = 0.0;
  if (!shooter.is_group() && (shooter.is_light() || shooter.radius < receiver.radius)) {
    const double total = power_from(receiver, shooter, *work_);
    const double plain = total / receiver.area_m2;
    missed = std::abs(plain - mean_factor);
    if (mean_factor > 0.0) {
      for (double& f : e) f *= plain / mean_factor;
      mean_factor = plain;
    }
  }

  // Affine fit to the four quarters: mean, slopes along the principal axes, and what it leaves
  // over.
  double seen = 0.0, mean = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    seen += 0.25 * v.at[k];
    e[k] *= v.at[k];
    mean += 0.25 * e[k];
  }
  const double slope1 = 0.25 * (e[1] + e[3] - e[0] - e[2]);
  const double slope2 = 0.25 * (e[2] + e[3] - e[0] - e[1]);
  const double saddle = 0.25 * (e[0] - e[1] - e[2] + e[3]);
  const double bend = center * v.center - mean;
  const int terms = receiver.forest->terms();
  double left_over =
      0.5 * std::abs(bend) + 0.7 * std::abs(saddle) + 0.25 * rim * seen + missed * seen + v.unfit;
  if (terms == 1) left_over += 0.8 * std::hypot(slope1, slope2);
  out.receiver_error = receiver.area_m2 * left_over;
  out.shooter_error = receiver.area_m2 * std::max(mean_factor, center) * v.within;
  if (seen <= 0.0) return out;

  // Shooter side: how the kernel weighs the shooter's slope, each row rescaled to its exact factor.
  std::array<std::array<double, 3>, 4> row{};
  double kernel_variation = 0.0;
  for (std::size_t k = 0; k < 4; ++k) row[k][0] = e[k];
  if (shooter.is_patch()) {
    const PolygonFrame& other = shooter.frame();
    const std::array<Vec2, 4> sources = shooter.shape.quadrature();
    for (std::size_t k = 0; k < 4; ++k) {
      if (e[k] <= 0.0) continue;
      std::array<double, 4> kernel{};
      if (v.partial[k]) {
        row[k][1] = e[k] * v.seen_from[k].x;
        row[k][2] = e[k] * v.seen_from[k].y;
      }
      double sum = 0.0, square = 0.0;
      const Vec3 x = frame.at(points[k]);
      for (std::size_t l = 0; l < 4; ++l) {
        kernel[l] = point_kernel(x, frame.n, other.at(sources[l]), other.n);
        sum += kernel[l];
        square += kernel[l] * kernel[l];
      }
      work_->kernels += 4;
      if (sum <= 0.0) {
        kernel_variation += 0.25;
        continue;
      }
      kernel_variation += 0.25 * std::sqrt(std::max(0.0, 4.0 * square / (sum * sum) - 1.0));
      for (std::size_t l = 0; l < 4 && !v.partial[k]; ++l) {
        const Vec2 d = sources[l] - shooter.shape.centroid;
        row[k][1] += e[k] * kernel[l] / sum * d.x;
        row[k][2] += e[k] * kernel[l] / sum * d.y;
      }
    }
    out.variation = receiver.area_m2 * mean * std::min(1.0, kernel_variation);
    if (terms == 3) out.variation *= 0.5;
  } else if (shooter.is_group()) {
    // Signed: what the group's uneven light would change, had every polygon the group's mean.
    const GroupNode& group = shooter.group();
    const std::span<const double> mean_light = shooter.forest->group_radiosity(shooter.id.group());
    const auto shooter_terms = static_cast<std::size_t>(shooter.forest->terms());
    double worst = 0.0;
    for (std::size_t band = 0; band < mean_light.size(); ++band) {
      double difference = 0.0;
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const std::uint32_t k = shooter.forest->order()[i];
        difference += 0.25 * weights_[i - group.begin] *
                      (shooter.forest->radiosity(k)[band * shooter_terms] - mean_light[band]);
      }
      worst = std::max(worst, std::abs(difference));
    }
    // Never more than if all of the factor fell on the brightest; rounding alone must not make it
    // more.
    const double share = shooter.variation > 0.0 ? worst / shooter.variation : 0.0;
    out.variation =
        receiver.area_m2 * seen * std::clamp(share, 0.02 * mean_factor, 10.0 * mean_factor);
  }
  const Vec2 e1 = receiver.shape.long_axis(), e2{-e1.y, e1.x};
  const Vec2 s = receiver.shape.deviations();
  if (terms == 1) {
    out.transport[0] = static_cast<float>(mean);
    return out;
  }
  for (std::size_t t = 0; t < 3; ++t) {
    const double r0 = row[0][t], r1 = row[1][t], r2 = row[2][t], r3 = row[3][t];
    const double d1 = s.x > 0.0 ? 0.25 * (r1 + r3 - r0 - r2) / s.x : 0.0;
    const double d2 = s.y > 0.0 ? 0.25 * (r2 + r3 - r0 - r1) / s.y : 0.0;
    const Vec2 gradient = d1 * e1 + d2 * e2;
    out.transport[t] = static_cast<float>(0.25 * (r0 + r1 + r2 + r3));
    out.transport[3 + t] = static_cast<float>(gradient.x);
    out.transport[6 + t] = static_cast<float>(gradient.y);
  }
  return out;
}

/// A far group receives as one: the irradiance that a plane facing the shooter would get, and from
/// where.
LinkEstimate LinkEstimator::evaluate_group(const LinkSide& receiver, const LinkSide& shooter) {
  LinkEstimate out;
  const Vec3 toward = glm::normalize(shooter.center - receiver.center);
  weights_.assign(shooter.is_group() ? shooter.group().end - shooter.group().begin : 0, 0.0);
  const double factor =
      factor_at(receiver.center, toward, shooter, shooter.is_group() ? weights_.data() : nullptr);
  const GroupNode& group = receiver.group();
  double facing_m2 = 0.0;
  std::vector<double> facing;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = receiver.forest->order()[i];
    const double cosine = std::max(0.0, glm::dot(receiver.forest->frames()[k].n, toward));
    facing.push_back(cosine * receiver.forest->node(k).shape.area_m2);
    facing_m2 += facing.back();
  }
  if (factor <= 0.0 || facing_m2 <= 0.0) {
    // Seen from its middle nothing arrives; that says little about its rim.
    out.receiver_error = 0.05 * power_bound(receiver, shooter) / std::max(shooter.light, 1e-300);
    return out;
  }
  Random random(LinkSide::seed_of(receiver, shooter));
  int open = 0;
  for (int ray = 0; ray < 4; ++ray) {
    double pick = facing_m2 * (ray + random.uniform()) / 4.0;
    std::uint32_t i = 0;
    while (i + 1 < facing.size() && pick >= facing[i]) pick -= facing[i++];
    const std::uint32_t k = receiver.forest->order()[group.begin + i];
    const PolygonFrame& frame = receiver.forest->frames()[k];
    const Vec3 x = frame.at(receiver.forest->node(k).shape.point_in_quarter(
        static_cast<int>(random.below(4)), random.uniform(), random.uniform()));
    open +=
        ray_open(x, occluders_->global(receiver.cluster, k), shooter, ray, random, nullptr) ? 1 : 0;
  }
  const double seen = open / 4.0;
  out.transport = {static_cast<float>(factor * seen), static_cast<float>(toward.x),
                   static_cast<float>(toward.y), static_cast<float>(toward.z)};
  out.receiver_error = facing_m2 * factor * (open == 0 ? 0.1 : 0.3);
  out.variation = facing_m2 * factor * seen * 0.3;
  return out;
}

}  // namespace enfilade
