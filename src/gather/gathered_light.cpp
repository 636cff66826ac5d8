#include "gather/gathered_light.hpp"

#include <algorithm>
#include <cmath>

#include "far_field/far_view.hpp"

namespace enfilade {

GatheredLight::GatheredLight(const PatchForest& receiver, std::span<const LightSource> lights,
                             const BuildingLight* far)
    : receiver_(receiver),
      lights_(lights),
      far_(far),
      bands_(static_cast<std::size_t>(receiver.bands())),
      terms_(static_cast<std::size_t>(receiver.terms())),
      light_(bands_ * terms_),
      means_(bands_) {}

double GatheredLight::read(const Link& link, std::span<const float> tint,
                           const PatchForest* shooter) {
  const double variation = read_light(link, shooter);
  tint_ = tint;
  for (std::size_t i = 0; i < light_.size() && !tint.empty(); ++i)
    light_[i] = tinted(light_[i], i / terms_);
  for (std::size_t b = 0; b < emitted_.size() && !tint.empty(); ++b)
    emitted_[b] = tinted(emitted_[b], b);
  for (std::size_t b = 0; b < bands_; ++b) {
    means_[b] = light_[b * terms_] + (emitted_.empty() ? 0.0 : emitted_[b]);
  }
  return variation;
}

double GatheredLight::most() const {
  double most = 0.0;
  for (std::size_t b = 0; b < static_cast<std::size_t>(receiver_.lead_bands()); ++b)
    most = std::max(most, std::abs(means_[b]));
  return most;
}

/// Where a linear shooting patch has not been made by its owner, light_ is its ancestor's affine
/// function about the patch's own centroid.
double GatheredLight::read_light(const Link& link, const PatchForest* shooter) {
  std::fill(light_.begin(), light_.end(), 0.0);
  emitted_.clear();
  if (link.is_far()) {
    const std::uint32_t node = link.shooter.group();
    const Vec3 toward = unfold_direction({link.shooter_x, link.shooter_y});
    far_->reflected(node, toward, light_, terms_);
    for (std::size_t b = 0; b < bands_; ++b) emitted_.push_back(far_->emitted(node, b));
    return far_->deviation(node);
  }
  if (shooter == nullptr) {
    const LightSource& light = lights_[link.shooter.root];
    for (std::size_t b = 0; b < bands_; ++b) light_[b * terms_] = light.intensity[b];
    return light.opening.empty() ? 0.0 : *std::ranges::max_element(light.intensity);
  }
  if (link.shooter.is_group()) {
    const std::span<const double> mean = shooter->group_radiosity(link.shooter.group());
    for (std::size_t b = 0; b < bands_; ++b) light_[b * terms_] = mean[b];
    return shooter->group_deviation(link.shooter.group());
  }
  const std::size_t node = shooter->find(link.shooter);
  const std::span<const double> radiosity = shooter->radiosity(node);
  std::copy(radiosity.begin(), radiosity.end(), light_.begin());
  if (terms_ == 3 && shooter->node(node).id != link.shooter) {
    const Vec2 shift = Vec2(link.shooter_x, link.shooter_y) - shooter->node(node).shape.centroid;
    for (std::size_t t = 0; t < light_.size(); t += 3) {
      light_[t] += light_[t + 1] * shift.x + light_[t + 2] * shift.y;
    }
  }
  return shooter->deviation(node);
}

void GatheredLight::receive(const Link& link, std::span<const float> transport) {
  irradiance();
  link.receiver.is_group() ? receive_group(link, transport) : receive_patch(link, transport);
}

/// transport[0] is the irradiance of a plane that faces the light; each polygon of the group gets
/// the share of its cosine to it, or all of it where light comes from all sides.
void GatheredLight::receive_group(const Link& link, std::span<const float> transport) {
  for_each_facing(receiver_, link, transport, [&](std::uint32_t k, double cosine) {
    for (std::size_t b = 0; b < bands_; ++b) {
      double& to = irradiance_[(k * bands_ + b) * terms_];
      to += transport[0] * cosine * light_[b * terms_];
      if (!emitted_.empty()) to += transport[FarTerms::of(true).emitted] * cosine * emitted_[b];
    }
  });
}

void GatheredLight::receive_patch(const Link& link, std::span<const float> transport) {
  double* to = irradiance_.data() + receiver_.find(link.receiver) * bands_ * terms_;
  for (std::size_t b = 0; b < bands_; ++b) {
    if (terms_ == 3) {  // of a far shooter, the slopes are zero
      const double value = light_[3 * b], x = light_[3 * b + 1], y = light_[3 * b + 2];
      for (std::size_t r = 0; r < 3; ++r) {
        const float* const t = transport.data() + 3 * r;
        to[3 * b + r] += t[0] * value + t[1] * x + t[2] * y;
      }
    } else {
      to[b] += transport[0] * light_[b];
    }
    if (!emitted_.empty()) to[b * terms_] += transport[FarTerms::of(false).emitted] * emitted_[b];
  }
}

std::vector<double>& GatheredLight::irradiance() {
  irradiance_.resize(receiver_.size() * bands_ * terms_, 0.0);
  return irradiance_;
}

Spectrum GatheredLight::power() const {
  Spectrum power(bands_, 0.0);
  for (std::size_t n = 0; n * bands_ * terms_ < irradiance_.size(); ++n) {
    for (std::size_t b = 0; b < bands_; ++b) {
      power[b] += receiver_.node(n).shape.area_m2 * irradiance_[(n * bands_ + b) * terms_];
    }
  }
  return power;
}

}  // namespace enfilade
