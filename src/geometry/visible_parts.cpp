#include "geometry/visible_parts.hpp"

#include <algorithm>

#include "geometry/clip.hpp"
#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

/// Of a closed form and of where its corners were cut: what is smaller is a sliver of nothing.
constexpr double rounding = 1e-12;

}  // namespace

void VisibleParts::begin(const Vec3& x, std::span<const Vec3> polygon, double tolerance_m) {
  x_ = x;
  tolerance_m_ = tolerance_m;
  corners_.assign(polygon.begin(), polygon.end());
  ends_.assign(1, static_cast<std::uint32_t>(polygon.size()));
}

bool VisibleParts::hide(std::span<const Vec3> occluder, std::size_t most) {
  if (empty()) return true;
  const Vec3 area = area_vector(occluder);
  const double length = glm::length(area);
  if (length <= 0.0) return true;
  const Vec3 m = area / length;
  const double side = glm::dot(m, x_ - occluder[0]);
  if (std::abs(side) <= tolerance_m_) return true;
  // Beyond the occluder's plane, and between the planes through x and its edges.
  const double sign = side > 0.0 ? -1.0 : 1.0;
  planes_.clear();
  planes_.push_back({sign * m, glm::dot(sign * m, occluder[0])});
  for (std::size_t i = 0; i < occluder.size(); ++i) {
    const Vec3 c = glm::cross(occluder[i] - x_, occluder[(i + 1) % occluder.size()] - x_);
    const double l = glm::length(c);
    if (l > 0.0) planes_.push_back({sign / l * c, glm::dot(sign / l * c, x_)});
  }
  next_corners_.clear();
  next_ends_.clear();
  for (std::size_t i = 0; i < ends_.size(); ++i) cut((*this)[i]);
  std::swap(corners_, next_corners_);
  std::swap(ends_, next_ends_);
  return size() <= most;
}

/// Appends the pieces of one part outside of the shadow, one for each plane of the shadow that cuts
/// it. Corners count as `split` counts them, but crossings are computed along the walk and pieces
/// begin where the walk meets them.
void VisibleParts::cut(std::span<const Vec3> part) {
  const std::size_t corners_before = next_corners_.size(), ends_before = next_ends_.size();
  inside_.assign(part.begin(), part.end());
  for (const Plane& plane : planes_) {
    still_inside_.clear();
    const std::size_t begin = next_corners_.size();
    bool any_inside = false, any_outside = false;
    Vec3 a = inside_.back();
    double side_a = plane.signed_distance(a);
    for (const Vec3& b : inside_) {
      const double side_b = plane.signed_distance(b);
      const bool crosses = (side_a < -tolerance_m_ && side_b > tolerance_m_) ||
                           (side_a > tolerance_m_ && side_b < -tolerance_m_);
      if (crosses) {
        const Vec3 p = zero_crossing(a, side_a, b, side_b);
        still_inside_.push_back(p);
        next_corners_.push_back(p);
      }
      if (side_b >= -tolerance_m_) still_inside_.push_back(b);
      if (side_b <= tolerance_m_) next_corners_.push_back(b);
      any_inside |= side_b > tolerance_m_;
      any_outside |= side_b < -tolerance_m_;
      a = b;
      side_a = side_b;
    }
    if (!any_inside) {  // none of it is in shadow: the part stays in one piece
      next_corners_.resize(corners_before);
      next_ends_.resize(ends_before);
      next_corners_.insert(next_corners_.end(), part.begin(), part.end());
      next_ends_.push_back(static_cast<std::uint32_t>(next_corners_.size()));
      return;
    }
    if (any_outside && next_corners_.size() - begin >= 3) {
      next_ends_.push_back(static_cast<std::uint32_t>(next_corners_.size()));
    } else {
      next_corners_.resize(begin);
    }
    std::swap(inside_, still_inside_);
  }
}

double VisibleParts::factor(const Vec3& n) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) sum += point_to_polygon(x_, n, (*this)[i]);
  return sum > rounding ? sum : 0.0;
}

}  // namespace enfilade
