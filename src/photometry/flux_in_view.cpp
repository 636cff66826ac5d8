// The flux of a distribution into the solid angle of a polygon, by Green's theorem. With I the
// intensity, the 1-form F dC with F(gamma, C) = integral of I sin from 0 to gamma has the
// derivative I sin(gamma) dgamma dC, so that its integral around the polygon's outline on the
// sphere is the flux inside. F vanishes at gamma = 0; on the other half of the sphere the integral
// from the opposite pole does the same. As F is itself an integral, it is smooth where the
// intensity is not, and what lies between the points of the outline cannot be missed.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <boost/container/small_vector.hpp>

#include "photometry/intensity_distribution.hpp"

namespace enfilade {
namespace {

using Corners = boost::container::small_vector<Vec3, 10>;

/// Keeps the part with sign * z >= 0.
Corners half_of(const Corners& corners, double sign) {
  Corners kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double za = sign * a.z, zb = sign * b.z;
    if (za >= 0.0) kept.push_back(a);
    if ((za < 0.0) != (zb < 0.0)) {
      Vec3 crossing = a + (b - a) * (za / (za - zb));
      crossing.z = 0.0;
      kept.push_back(crossing);
    }
  }
  return kept;
}

}  // namespace

class FluxInView {
 public:
  FluxInView(const IntensityDistribution& distribution, double sign)
      : distribution_(distribution), sign_(sign) {}

  double around(const Corners& corners) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      sum += along(corners[i], corners[(i + 1) % corners.size()]);
    return std::abs(sum);
  }

 private:
  /// Gauss's rule with four points in panels of the table's step or less.
  double along(const Vec3& a, const Vec3& b) const {
    constexpr double most_panels = 64.0;
    const double la = glm::length(a), lb = glm::length(b);
    if (la <= 0.0 || lb <= 0.0) return 0.0;
    const Vec3 from = a / la, to = b / lb;
    const double angle = std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
    if (angle < 1e-12) return 0.0;
    double turn = 0.0;  // about the axis
    if (distribution_.planes_.size() > 1) {
      turn = std::abs(std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y)) /
             (distribution_.planes_[1] - distribution_.planes_[0]);
    }
    const int panels = static_cast<int>(
        std::clamp(std::ceil(std::max(angle / distribution_.step_, turn)), 1.0, most_panels));
    double sum = 0.0;
    Vec3 p = from;
    for (int i = 1; i <= panels; ++i) {
      const double s = angle * i / panels;
      const Vec3 q =
          i == panels ? to : (std::sin(angle - s) * from + std::sin(s) * to) / std::sin(angle);
      sum += panel(p, q);
      p = q;
    }
    return sum;
  }

  double panel(const Vec3& p, const Vec3& q) const {
    static constexpr std::array<double, 4> at{0.06943184420297371, 0.33000947820757187,
                                              0.66999052179242813, 0.93056815579702629};
    static constexpr std::array<double, 4> weight{0.17392742256872693, 0.32607257743127307,
                                                  0.32607257743127307, 0.17392742256872693};
    const Vec3 d = q - p;
    double sum = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Vec3 w = p + at[i] * d;
      const double ring2 = w.x * w.x + w.y * w.y;
      if (ring2 <= 0.0) continue;
      const double turn = (w.x * d.y - w.y * d.x) / ring2;
      const auto cumulative =
          distribution_.cumulative(std::atan2(std::sqrt(ring2), w.z), std::atan2(w.y, w.x));
      sum += weight[i] * turn * (sign_ > 0.0 ? cumulative.to : cumulative.to - cumulative.whole);
    }
    return sum;
  }

  const IntensityDistribution& distribution_;
  double sign_;
};

double IntensityDistribution::flux_within(std::span<const Vec3> corners) const {
  Corners polar;
  bool front = false, back = false;
  for (const Vec3& corner : corners) {
    polar.push_back(to_polar(corner));
    front |= polar.back().z >= 0.0;
    back |= polar.back().z < 0.0;
  }
  if (front != back) return FluxInView(*this, front ? 1.0 : -1.0).around(polar);
  return FluxInView(*this, 1.0).around(half_of(polar, 1.0)) +
         FluxInView(*this, -1.0).around(half_of(polar, -1.0));
}

}  // namespace enfilade
