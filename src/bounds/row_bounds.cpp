#include "bounds/row_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace enfilade {
namespace {

/// One link's share in one bound of a row: factor * value + added, factor in [least, most].
struct Term {
  double least, most, value, added;
};

/// Of the two bounds that hold for the light over a link, that by the points' range alone and that
/// by the mean and a covariance, the one that is narrower at the factor `at`. `sign` 1: upper.
Term term_of(const Range& factor, const LightRange& light, double spread, double deviation,
             double at, double sign) {
  const double by_points = sign > 0.0 ? light.at_points.hi : light.at_points.lo;
  const double by_mean = sign > 0.0 ? light.mean.hi : light.mean.lo;
  const double covariance = spread * deviation;
  const bool mean_is_narrower = sign * (by_mean - by_points) * at + covariance < 0.0;
  return mean_is_narrower ? Term{factor.lo, factor.hi, by_mean, sign * covariance}
                          : Term{factor.lo, factor.hi, by_points, 0.0};
}

double upper_at(const std::vector<Term>& terms, double reference) {
  double sum = reference;
  for (const Term& t : terms) {
    const double d = t.value - reference;
    sum += (d > 0.0 ? t.most : t.least) * d + t.added;
  }
  return sum;
}
double lower_at(const std::vector<Term>& terms, double reference) {
  double sum = reference;
  for (const Term& t : terms) {
    const double d = t.value - reference;
    sum += (d > 0.0 ? t.least : t.most) * d + t.added;
  }
  return sum;
}

/// Minimizes `value` over references >= 0 by a few trials about the last one; returns the least
/// value found. The first time the whole range [0, most] is searched.
template <class Value>
double least_value(const Value& value, double most, double step, double& reference) {
  if (reference < 0.0) {
    double lo = 0.0, hi = most;
    for (int i = 0; i < 24; ++i) {  // the value is convex
      const double a = lo + 0.382 * (hi - lo), b = lo + 0.618 * (hi - lo);
      (value(a) <= value(b) ? hi : lo) = value(a) <= value(b) ? b : a;
    }
    reference = 0.5 * (lo + hi);
    return std::min(value(reference), value(0.0));
  }
  double best = value(reference);
  const double old = reference;
  for (const double trial : {old * (1.0 + step), old * (1.0 - step)}) {
    const double v = value(trial);
    if (v < best) {
      best = v;
      reference = trial;
    }
  }
  return best;
}

/// Lower bounds without a closed row know of no reference but 0.
template <class Value>
double greatest_value(const Value& value, bool closed, double most, double step,
                      double& reference) {
  if (!closed) return value(0.0);
  return -least_value([&](double r) { return -value(r); }, most, step, reference);
}

/// The bounds of the light at points: affine factors, whose gradients are summed with their signs.
class PointBound {
 public:
  PointBound(const BoundRow& row, double sign) : row_(row), sign_(sign) {
    for (const BoundLink& link : row.links) {
      const LightRange& light = row.light(link);
      terms_.push_back(term_of({}, light, link.factor.point_spread, most_deviation(light),
                               link.factor.at_points.center, sign));
    }
  }
  double operator()(double reference) const {
    double sum = reference;
    Vec3 gradient(0.0);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const PointFactor& f = row_.links[i].factor.at_points;
      const double d = terms_[i].value - reference;
      sum += f.center * d + sign_ * f.remainder * std::abs(d) + terms_[i].added;
      gradient += d * f.gradient;
    }
    return sum + sign_ * glm::length(gradient) * row_.radius_m;
  }

 private:
  const BoundRow& row_;
  double sign_;
  std::vector<Term> terms_;
};

}  // namespace

void LightRange::intersect(const LightRange& other) {
  at_points.lo = std::max(at_points.lo, other.at_points.lo);
  at_points.hi = std::min(at_points.hi, other.at_points.hi);
  mean.lo = std::max({mean.lo, other.mean.lo, at_points.lo});
  mean.hi = std::min({mean.hi, other.mean.hi, at_points.hi});
}

double most_deviation(const LightRange& light) {
  const Range& r = light.at_points;
  const double m = std::clamp(0.5 * (r.lo + r.hi), std::min(light.mean.lo, light.mean.hi),
                              std::max(light.mean.lo, light.mean.hi));
  return std::sqrt(std::max(0.0, (r.hi - m) * (m - r.lo)));
}

LightRange bound_row(const BoundRow& row, double step, RowReference& reference) {
  thread_local std::vector<Term> upper, lower;
  upper.clear();
  lower.clear();
  double most = 0.0;
  for (const BoundLink& link : row.links) {
    const LightRange& light = row.light(link);
    const double deviation = most_deviation(light);
    const PairFactor& f = link.factor;
    upper.push_back(term_of(f.mean, light, f.mean_spread, deviation, f.mean.hi, 1.0));
    lower.push_back(term_of(f.mean, light, f.mean_spread, deviation, f.mean.lo, -1.0));
    most = std::max(most, light.at_points.hi);
  }
  LightRange e;
  const auto mean_upper = [&](double r) { return upper_at(upper, r); };
  const auto mean_lower = [&](double r) { return lower_at(lower, r); };
  e.mean.hi = least_value(mean_upper, most, step, reference.mean_upper);
  e.mean.lo = greatest_value(mean_lower, row.closed, most, step, reference.mean_lower);
  const PointBound point_upper(row, 1.0), point_lower(row, -1.0);
  e.at_points.hi = least_value(point_upper, most, step, reference.point_upper);
  e.at_points.lo = greatest_value(point_lower, row.closed, most, step, reference.point_lower);
  e.at_points.lo = std::max(0.0, e.at_points.lo);
  e.mean.lo = std::max(e.mean.lo, e.at_points.lo);
  e.mean.hi = std::min(e.mean.hi, e.at_points.hi);
  return e;
}

}  // namespace enfilade
