// The bands of a scene's light as the one or three values that a page shows.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace enfilade {

/// One channel where all bands of the file are solved as one, else red, green and blue as pictures
/// show them (display_rgb).
class LightChannels {
 public:
  explicit LightChannels(const Scene& scene);

  std::size_t count() const { return count_; }
  /// Writes values in the solved bands as channels; `out` has count() places.
  void of(std::span<const double> solved, std::span<double> out) const;
  /// What each channel counts for in the one value of rooms and points (one_value()): the sum of
  /// the channels times these is exactly that value, however many bands there are.
  const std::vector<double>& weights() const { return weights_; }

 private:
  const Scene* scene_;
  std::size_t count_ = 1;
  std::vector<double> weights_;
};

}  // namespace enfilade
