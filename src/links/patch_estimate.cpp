// The estimate of a link to a patch, step by step: form factors at the patch's points, visibility,
// errors, and the transport coefficients.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/form_factor.hpp"
#include "links/link_estimate.hpp"
#include "links/terms/error_terms.hpp"
#include "links/terms/sky_samples.hpp"

namespace enfilade {
namespace {

/// The corners' factors are taken a little inside the patch, by this share of the way to the
/// centre.
constexpr double rim_inset = 0.05;
/// Below this share of the centre's factor, the four points' mean indicates that only a part of the
/// patch faces the shooter.
constexpr double facing_in_part = 0.5;
/// A linear basis transports the shooter's gradient; this share of the error by its variation
/// remains.
constexpr double variation_left_by_gradients = 0.5;
/// Bounds of a shooting group's variation per mean factor. Upper: as if all of the factor fell on
/// the polygons of highest radiosity. Lower: differences that cancel out within one sample.
constexpr double least_group_variation = 0.02, most_group_variation = 10.0;

/// Irradiance at the receiver's four points per coefficient of the shooter's affine radiosity.
using PointRows = std::array<std::array<double, 3>, 4>;

/// Returns the unoccluded received power per unit of the shooter's light, computed from the
/// shooter's side: a point light's by the receiver's solid angle, a patch's by reciprocity, A_r
/// F_rs = A_s F_sr.
double power_from(const LinkSide& receiver, const LinkSide& shooter, WorkCount& work) {
  if (shooter.is_light()) {
    ++work.form_factors;
    return power_onto(*shooter.part, receiver.corners, receiver.frame().n);
  }
  const PolygonFrame& frame = shooter.frame();
  double sum = 0.0;
  for (const Vec2& q : shooter.shape.quadrature())
    sum += 0.25 * point_to_polygon(frame.at(q), frame.n, receiver.corners);
  work.form_factors += 4;
  return shooter.area_m2 * sum;
}

/// Rescales the factors of a shooter smaller than the receiver to the exact total, known by
/// reciprocity, since its light peaks between the receiver's points. Returns the difference of
/// their mean from the total.
double match_total(const LinkSide& receiver, const LinkSide& shooter, PointFactors& factor,
                   WorkCount& work) {
  const bool small = shooter.is_light() || shooter.radius < receiver.radius;
  if (shooter.is_group() || !small) return 0.0;
  const double exact =
      factor.total >= 0.0 ? factor.total : power_from(receiver, shooter, work) / receiver.area_m2;
  const double missed = std::abs(exact - factor.mean);
  if (factor.mean > 0.0) {
    for (double& f : factor.at) f *= exact / factor.mean;
    factor.mean = exact;
  } else if (shooter.is_light()) {  // a beam between the points
    factor.at.fill(exact);
    factor.mean = exact;
  }
  return missed;
}

/// What a beam does between the four points and the centre is seen near the corners: the share of
/// the affine fit's misfit there that is taken as its mean over the patch.
constexpr double corner_share = 1.0 / 3.0;

/// The mean misfit at the corners of the affine fit to the factors at the four points. For a light
/// whose intensity depends on the direction.
double beam_unfit(const LinkSide& receiver, const LinkSide& shooter, const PointFactors& factor) {
  const PatchShape& shape = receiver.shape;
  const FourPointFit fit = FourPointFit::of(factor.at);
  const Vec2 e1 = shape.long_axis(), e2{-e1.y, e1.x}, s = shape.deviations();
  double off = 0.0;
  for (const Vec2& vertex : shape.vertices) {
    const Vec2 d = (1.0 - rim_inset) * (vertex - shape.centroid);
    const double predicted = fit.mean + (s.x > 0.0 ? fit.slope1 * glm::dot(d, e1) / s.x : 0.0) +
                             (s.y > 0.0 ? fit.slope2 * glm::dot(d, e2) / s.y : 0.0);
    const Vec3 x = receiver.frame().at(shape.centroid + d);
    off += std::abs(kernel_of(*shooter.part, x, receiver.frame().n).at - predicted);
  }
  // More than all of the light cannot be misplaced.
  return std::min(corner_share * off / static_cast<double>(shape.vertices.size()),
                  std::max(factor.mean, factor.total));
}

/// An opening whose points all shine past the patch may light it from between them: it is looked at
/// in parts while that may matter.
double unseen_power(const LinkSide& receiver, const LinkSide& shooter) {
  const double distance = std::max(glm::length(receiver.center - shooter.center), shooter.radius);
  if (shooter.radius <= 0.0) return 0.0;
  return shooter.most_toward(receiver) *
         std::min(4.0 * std::numbers::pi, receiver.area_m2 / (distance * distance));
}

/// What only a light needs: the exact total, the error of its points, and of a beam the misfit.
void add_light_terms(const LinkSide& receiver, const LinkSide& shooter, PointFactors& factor,
                     WorkCount& work) {
  factor.total = power_from(receiver, shooter, work) / receiver.area_m2;
  const LightPart& part = *shooter.part;
  const PolygonFrame& frame = receiver.frame();
  if (!part.is_point()) {
    for (const Vec2& q : receiver.shape.quadrature())
      factor.spread += 0.25 * kernel_of(part, frame.at(q), frame.n).spread;
    factor.spread = std::max(factor.spread, kernel_of(part, receiver.center, frame.n).spread);
  }
  if (part.light->distribution) factor.unfit = beam_unfit(receiver, shooter, factor);
}

/// One point's row from a shooting patch: the point's exact factor e, and the shooter's slopes as
/// the kernel weighs them. `seen_from`: the centroid of the visible part's light where only a part
/// is visible, else null. Returns the kernel's coefficient of variation over the shooter.
double add_kernel_row(const Vec3& x, const Vec3& n, const LinkSide& shooter, double e,
                      const Vec2* seen_from, std::array<double, 3>& row) {
  const PolygonFrame& frame = shooter.frame();
  const std::array<Vec2, 4> sources = shooter.shape.quadrature();
  std::array<double, 4> kernel{};
  double sum = 0.0, square = 0.0;
  for (std::size_t l = 0; l < 4; ++l) {
    kernel[l] = point_kernel(x, n, frame.at(sources[l]), frame.n);
    sum += kernel[l];
    square += kernel[l] * kernel[l];
  }
  if (seen_from != nullptr) {
    row[1] = e * seen_from->x;
    row[2] = e * seen_from->y;
  }
  if (sum <= 0.0) return 1.0;
  for (std::size_t l = 0; l < 4 && seen_from == nullptr; ++l) {
    const Vec2 d = sources[l] - shooter.shape.centroid;
    row[1] += e * kernel[l] / sum * d.x;
    row[2] += e * kernel[l] / sum * d.y;
  }
  return std::sqrt(std::max(0.0, 4.0 * square / (sum * sum) - 1.0));
}

/// Fills the rows from a shooting patch. Returns the mean coefficient of variation of the kernel k
/// over the shooter: by Cauchy and Schwarz, |mean of (k - mean k)(B - mean B)| is at most the
/// product of their standard deviations.
double fill_rows(const LinkSide& receiver, const LinkSide& shooter, const PairVisibility& v,
                 PointRows& rows, WorkCount& work) {
  const PolygonFrame& frame = receiver.frame();
  const std::array<Vec2, 4> points = receiver.shape.quadrature();
  double kernel_variation = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double e = rows[k][0];
    if (e <= 0.0) continue;
    kernel_variation += 0.25 * add_kernel_row(frame.at(points[k]), frame.n, shooter, e,
                                              v.partial[k] ? &v.seen_from[k] : nullptr, rows[k]);
    work.kernels += 4;
  }
  return kernel_variation;
}

/// By how much a shooting group's irradiance would change if each polygon had the group's mean
/// radiosity, per unit of the group's variation; worst band. `factors`: sums over four points of
/// each polygon's factor.
double group_variation(const LinkSide& shooter, std::span<const double> factors) {
  const GroupNode& group = shooter.group();
  const std::span<const double> mean_light = shooter.forest->group_radiosity(shooter.id.group());
  const auto terms = static_cast<std::size_t>(shooter.forest->terms());
  double worst = 0.0;
  for (std::size_t band = 0; band < mean_light.size(); ++band) {
    double difference = 0.0;
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const std::uint32_t k = shooter.forest->order()[i];
      difference += 0.25 * factors[i - group.begin] *
                    (shooter.forest->radiosity(k)[band * terms] - mean_light[band]);
    }
    worst = std::max(worst, std::abs(difference));
  }
  return shooter.variation > 0.0 ? worst / shooter.variation : 0.0;
}

/// The receiver's coefficients by the shooter's: for the linear basis the affine fit to each column
/// of the rows, its slopes turned from the principal axes to the polygon's.
std::array<float, 9> transport_of(const LinkSide& receiver, const PointRows& rows) {
  std::array<float, 9> transport{};
  const auto fit_of = [&](std::size_t t) {
    return FourPointFit::of({rows[0][t], rows[1][t], rows[2][t], rows[3][t]});
  };
  if (receiver.forest->terms() == 1) {
    transport[0] = static_cast<float>(fit_of(0).mean);
    return transport;
  }
  const Vec2 e1 = receiver.shape.long_axis(), e2{-e1.y, e1.x};
  const Vec2 s = receiver.shape.deviations();
  for (std::size_t t = 0; t < 3; ++t) {
    const FourPointFit fit = fit_of(t);
    const double d1 = s.x > 0.0 ? fit.slope1 / s.x : 0.0;
    const double d2 = s.y > 0.0 ? fit.slope2 / s.y : 0.0;
    const Vec2 gradient = d1 * e1 + d2 * e2;
    transport[t] = static_cast<float>(fit.mean);
    transport[3 + t] = static_cast<float>(gradient.x);
    transport[6 + t] = static_cast<float>(gradient.y);
  }
  return transport;
}

/// The sky is never cut: what its parts bring together is known at the receiver's points.
LinkEstimate sky_estimate(const LinkSide& receiver, const LightSource& sky,
                          const Occluders& occluders, WorkCount& work) {
  const std::uint32_t own = occluders.global(receiver.cluster, receiver.id.root);
  const SkySamples found = sky_samples(receiver.frame(), receiver.shape, own, sky, occluders, work);
  ReceiverSamples samples{FourPointFit::of(found.at), found.center};
  samples.seen = 1.0;
  samples.unfit = found.unfit + found.hidden + found.error;
  LinkEstimate out;
  out.receiver_error = receiver.area_m2 * receiver_error(samples, receiver.forest->terms());
  out.tint = found.tint.mean();
  PointRows rows{};
  for (std::size_t k = 0; k < 4; ++k) rows[k][0] = found.at[k];
  out.transport = transport_of(receiver, rows);
  return out;
}

}  // namespace

PointFactors LinkEstimator::point_factors(const LinkSide& receiver, const LinkSide& shooter) {
  const PolygonFrame& frame = receiver.frame();
  clear_group_factors(shooter);
  PointFactors factor;
  const std::array<Vec2, 4> points = receiver.shape.quadrature();
  for (std::size_t k = 0; k < 4; ++k) {
    factor.at[k] = factor_at(frame.at(points[k]), frame.n, shooter, group_factors_);
    factor.mean += 0.25 * factor.at[k];
  }
  factor.center = factor_at(frame.at(receiver.shape.centroid), frame.n, shooter, {});
  if (factor.mean < facing_in_part * factor.center || factor.mean == 0.0) {
    for (const Vec3& corner : receiver.corners) {
      const Vec3 x = corner + rim_inset * (receiver.center - corner);
      factor.rim = std::max(factor.rim, factor_at(x, frame.n, shooter, {}));
    }
  }
  if (shooter.is_light()) add_light_terms(receiver, shooter, factor, *work_);
  if (shooter.is_patch())
    factor.unfit = rim_misfit({receiver.corners, frame.n, receiver.center, receiver.radius},
                              shooter.corners, factor.at, work_->form_factors);
  return factor;
}

LinkEstimate LinkEstimator::evaluate_patch(const LinkSide& receiver, const LinkSide& shooter,
                                           double tolerance) {
  if (shooter.is_light() && shooter.part->light->sky)
    return sky_estimate(receiver, *shooter.part->light, *occluders_, *work_);
  LinkEstimate out;
  PointFactors factor = point_factors(receiver, shooter);
  const double largest = std::max({factor.mean, factor.center, factor.rim, factor.total});
  if (largest <= 0.0) {
    out.invisible = faces_away(receiver, shooter) || (shooter.is_light() && shooter.radius <= 0.0);
    if (shooter.is_light()) out.variation = unseen_power(receiver, shooter);
    return out;
  }
  const double power = receiver.area_m2 * largest * shooter.light;
  const PairVisibility v = visibility_.of(receiver, shooter, group_factors_, power, tolerance);
  out.sampled = v.sampled;
  out.tint = v.tint.mean();
  ReceiverSamples samples;
  samples.missed = match_total(receiver, shooter, factor, *work_);
  std::array<double, 4> e = factor.at;  // visible irradiance per radiosity
  for (std::size_t k = 0; k < 4; ++k) {
    e[k] *= v.at[k];
    samples.seen += 0.25 * v.at[k];
  }
  samples.fit = FourPointFit::of(e);
  samples.center = factor.center * v.center;
  samples.rim = factor.rim;
  samples.unfit = v.unfit + factor.unfit * samples.seen;
  const int terms = receiver.forest->terms();
  out.receiver_error = receiver.area_m2 * receiver_error(samples, terms);
  if (shooter.is_light() && !(shooter.part->is_point() && !shooter.part->light->distribution)) {
    // |e - fit| <= e + fit, whatever a near opening brings to single points.
    out.receiver_error = std::min(out.receiver_error, 2.0 * receiver.area_m2 * factor.total);
  }
  out.shooter_error =
      visibility_error(receiver.area_m2 * std::max(factor.mean, factor.center), v.uncertainty);
  if (samples.seen <= 0.0) return out;

  PointRows rows{};
  for (std::size_t k = 0; k < 4; ++k) rows[k][0] = e[k];
  if (shooter.is_patch()) {
    const double kernel_variation = fill_rows(receiver, shooter, v, rows, *work_);
    out.variation = receiver.area_m2 * samples.fit.mean * std::min(1.0, kernel_variation);
    if (terms == 3) out.variation *= variation_left_by_gradients;
  } else if (shooter.is_light()) {
    out.variation = receiver.area_m2 * samples.seen * std::min(factor.spread, 2.0 * factor.total);
  } else if (shooter.is_group()) {
    out.variation =
        receiver.area_m2 * samples.seen *
        std::clamp(group_variation(shooter, group_factors_), least_group_variation * factor.mean,
                   most_group_variation * factor.mean);
  }
  out.transport = transport_of(receiver, rows);
  return out;
}

}  // namespace enfilade
