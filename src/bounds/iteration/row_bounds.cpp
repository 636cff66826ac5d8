#include "bounds/iteration/row_bounds.hpp"

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

/// The extreme of factor * d over a factor's range.
double extreme(double least, double most, double d, double sign) {
  return (sign * d > 0.0 ? most : least) * d;
}

/// Of a wall: the weighted mean of its parts' values, and what the parts give beyond it.
struct WallSums {
  double reference = 0.0, beyond = 0.0;
};

/// The bound of the light over all links, means over the receiver; sign 1: upper, -1: lower.
class MeanBound {
 public:
  MeanBound(const BoundRow& row, double sign) : row_(row), sign_(sign) {
    for (const BoundLink& link : row.links) {
      const PairFactor& f = link.factor;
      const LightRange& light = row.light(link);
      terms_.push_back(term_of(f.mean, light, f.mean_spread, light.deviation,
                               sign > 0.0 ? f.mean.hi : f.mean.lo, sign));
    }
    for (const BoundWall& wall : row.walls) {
      double weights = 0.0, values = 0.0;
      for (std::uint32_t i = wall.begin; i < wall.end; ++i) {
        weights += terms_[i].most;
        values += terms_[i].most * terms_[i].value;
      }
      WallSums sums;
      sums.reference = weights > 0.0 ? values / weights : 0.0;
      sums.beyond = over(wall.begin, wall.end, sums.reference);
      walls_.push_back(sums);
    }
  }
  double operator()(double reference) const {
    double sum = row_.most * reference;
    std::size_t done = 0;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const BoundWall& wall = row_.walls[w];
      const double by_parts = over(wall.begin, wall.end, reference);
      const double by_whole =
          extreme(wall.whole.mean.lo, wall.whole.mean.hi, walls_[w].reference - reference, sign_) +
          walls_[w].beyond;
      sum += over(done, wall.begin, reference) +
             (sign_ > 0.0 ? std::min(by_parts, by_whole) : std::max(by_parts, by_whole));
      done = wall.end;
    }
    return sum + over(done, terms_.size(), reference);
  }

 private:
  double over(std::size_t begin, std::size_t end, double reference) const {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const Term& t = terms_[i];
      sum += extreme(t.least, t.most, t.value - reference, sign_) + t.added;
    }
    return sum;
  }

  const BoundRow& row_;
  double sign_;
  std::vector<Term> terms_;
  std::vector<WallSums> walls_;
};

/// Minimizes `value` over references >= 0 by trials about the last one, `most` the first time;
/// returns the least value found.
template <class Value>
double least_value(const Value& value, double most, double step, double& reference) {
  if (reference < 0.0) reference = most;
  double best = value(reference);
  const double first = best;
  for (const double factor : {1.0 - step, 1.0 + step}) {
    // The value is convex: longer and longer steps downhill, until they lead up again.
    double at = factor, walked = best;
    for (int i = 0; i < 40; ++i, at *= at) {
      const double v = value(reference * at);
      if (v >= walked) break;
      best = walked = v;
      reference *= at;
    }
    if (best < first) break;
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

/// A sum of products of affine factors and differences of radiosities: its value at the receiver's
/// centre, how far it may be off, and its gradient.
struct AffineSum {
  double value = 0.0, off = 0.0;
  Vec3 gradient{0.0};
  void add(const PointFactor& f, double d) {
    value += f.center * d;
    off += f.remainder * std::abs(d);
    gradient += d * f.gradient;
  }
  void add(const AffineSum& other) {
    value += other.value;
    off += other.off;
    gradient += other.gradient;
  }
};

/// The bounds of the light at points: affine factors, whose gradients are summed with their signs.
class PointBound {
 public:
  PointBound(const BoundRow& row, double sign) : row_(row), sign_(sign) {
    for (const BoundLink& link : row.links) {
      const LightRange& light = row.light(link);
      terms_.push_back(term_of({}, light, link.factor.point_spread, light.deviation,
                               link.factor.at_points.center, sign));
    }
    for (const BoundWall& wall : row.walls) {
      double weights = 0.0, values = 0.0;
      for (std::uint32_t i = wall.begin; i < wall.end; ++i) {
        const double weight = row.links[i].factor.at_points.center;
        weights += weight;
        values += weight * terms_[i].value;
      }
      references_.push_back(weights > 0.0 ? values / weights : 0.0);
      beyond_.push_back(over(wall.begin, wall.end, references_.back()));
    }
  }
  double operator()(double reference) const {
    AffineSum sum;
    std::size_t done = 0;
    for (std::size_t w = 0; w < beyond_.size(); ++w) {
      const BoundWall& wall = row_.walls[w];
      const AffineSum by_parts = over(wall.begin, wall.end, reference);
      AffineSum by_whole = beyond_[w];
      by_whole.add(wall.whole.at_points, references_[w] - reference);
      sum.add(over(done, wall.begin, reference));
      sum.add(bound(by_whole) * sign_ < bound(by_parts) * sign_ ? by_whole : by_parts);
      done = wall.end;
    }
    sum.add(over(done, terms_.size(), reference));
    return row_.most * reference + bound(sum) + sign_ * glm::length(sum.gradient) * row_.radius_m;
  }

 private:
  double bound(const AffineSum& sum) const { return sum.value + sign_ * sum.off; }
  AffineSum over(std::size_t begin, std::size_t end, double reference) const {
    AffineSum sum;
    for (std::size_t i = begin; i < end; ++i) {
      sum.add(row_.links[i].factor.at_points, terms_[i].value - reference);
      sum.value += terms_[i].added;
    }
    return sum;
  }

  const BoundRow& row_;
  double sign_;
  std::vector<Term> terms_;
  std::vector<double> references_;
  std::vector<AffineSum> beyond_;
};

}  // namespace

void LightRange::intersect(const LightRange& other) {
  at_points.lo = std::max(at_points.lo, other.at_points.lo);
  at_points.hi = std::min(at_points.hi, other.at_points.hi);
  mean.lo = std::max({mean.lo, other.mean.lo, at_points.lo});
  mean.hi = std::min({mean.hi, other.mean.hi, at_points.hi});
  deviation = std::min({deviation, other.deviation, most_deviation(*this)});
}

double most_deviation(const LightRange& light) {
  const Range& r = light.at_points;
  const double m = std::clamp(0.5 * (r.lo + r.hi), std::min(light.mean.lo, light.mean.hi),
                              std::max(light.mean.lo, light.mean.hi));
  return std::sqrt(std::max(0.0, (r.hi - m) * (m - r.lo)));
}

LightRange bound_row(const BoundRow& row, double step, RowReference& reference) {
  double most = 0.0;
  for (const BoundLink& link : row.links) most = std::max(most, row.light(link).at_points.hi);
  LightRange e;
  e.mean.hi = least_value(MeanBound(row, 1.0), most, step, reference.mean_upper);
  e.mean.lo = greatest_value(MeanBound(row, -1.0), row.closed, most, step, reference.mean_lower);
  e.at_points.hi = least_value(PointBound(row, 1.0), most, step, reference.point_upper);
  e.at_points.lo =
      greatest_value(PointBound(row, -1.0), row.closed, most, step, reference.point_lower);
  e.at_points.lo = std::max(0.0, e.at_points.lo);
  e.mean.lo = std::max(e.mean.lo, e.at_points.lo);
  e.mean.hi = std::min(e.mean.hi, e.at_points.hi);
  e.deviation = most_deviation(e);
  return e;
}

}  // namespace enfilade
