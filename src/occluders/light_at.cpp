#include "occluders/light_at.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

/// Parts are halved while their estimated error is above this share of the light.
constexpr double least_error = 5e-5;
/// Parts with a shadow's edge are halved while they bring more than this share.
constexpr double least_shadow = 4e-3;
constexpr int most_halvings = 14;
/// An opening is looked at in two parts, or four, where its radius is this share of the distance:
/// so that an edge of a shadow is noticed.
constexpr double wide = 0.1, very_wide = 0.3;
/// Of the light of a part of which some points are hidden: the error that remains.
constexpr double mixed_error = 0.25;

class Opening {
 public:
  Opening(const LitPlace& place, const Occluders& occluders, WorkCount* work)
      : place_(place), occluders_(occluders), work_(work) {}

  LightAtPoint of(const LightSource& light) {
    const LightPart whole = LightPart::whole(light);
    const LightKernel kernel = kernel_of(whole, place_.x, place_.n);
    scale_ = std::max(kernel.at, kernel.spread);
    const double distance = glm::length(whole.center - place_.x);
    least_halvings_ = whole.is_point() || whole.radius <= wide * distance ? 0
                      : whole.radius <= very_wide * distance              ? 1
                                                                          : 2;
    add(whole, kernel, 0);
    return {sum_, std::sqrt(error2_)};
  }

 private:
  bool open(const Vec3& y) const {
    if (work_ != nullptr) ++work_->rays;
    return !occluders_.rays().occluded(place_.x, y, place_.own, RayScene::no_polygon, place_.start);
  }

  void add(const LightPart& part, const LightKernel& kernel, int halvings) {
    const bool may_halve = !part.is_point() && halvings < most_halvings;
    // Without any light from its points, an opening may still be seen from close by.
    const bool rough = kernel.spread > least_error * scale_ ||
                       (kernel.at <= 0.0 && scale_ <= 0.0 && halvings < least_halvings_);
    if (may_halve && (rough || halvings < least_halvings_)) {
      halve(part, halvings);
      return;
    }
    double sum = 0.0;
    int seen = 0, count = 0;
    for (const LightPoint& point : part.points()) {
      const double one = point.share * kernel_from(*part.light, point.y, place_.x, place_.n);
      if (one <= 0.0) continue;
      ++count;
      if (!open(point.y)) continue;
      ++seen;
      sum += one;
    }
    const bool mixed = seen > 0 && seen < count;
    if (mixed && may_halve && kernel.at > least_shadow * scale_) {
      halve(part, halvings);
      return;
    }
    sum_ += sum;
    const double error = kernel.spread + (mixed ? mixed_error * kernel.at : 0.0);
    error2_ += error * error;
  }

  void halve(const LightPart& part, int halvings) {
    for (const int side : {0, 1}) {
      const LightPart half = part.half(side);
      const LightKernel kernel = kernel_of(half, place_.x, place_.n);
      scale_ = std::max(scale_, kernel.at);
      add(half, kernel, halvings + 1);
    }
  }

  const LitPlace& place_;
  const Occluders& occluders_;
  WorkCount* work_;
  double scale_ = 0.0;  ///< about the whole light that may arrive
  int least_halvings_ = 0;
  double sum_ = 0.0, error2_ = 0.0;
};

}  // namespace

LightAtPoint light_at(const LightSource& light, const LitPlace& place, const Occluders& occluders,
                      WorkCount* work) {
  return Opening(place, occluders, work).of(light);
}

double light_by_one_ray(const LightSource& light, const LitPlace& place, const Occluders& occluders,
                        double r1, double r2) {
  const Vec3 y = point_on(light, r1, r2);
  const double kernel = kernel_from(light, y, place.x, place.n);
  if (kernel <= 0.0 ||
      occluders.rays().occluded(place.x, y, place.own, RayScene::no_polygon, place.start))
    return 0.0;
  return kernel;
}

}  // namespace enfilade
