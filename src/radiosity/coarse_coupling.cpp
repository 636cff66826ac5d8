#include "radiosity/coarse_coupling.hpp"

#include <algorithm>

namespace enfilade {

double area_factor(const PatchForest& receiver, const Link& link,
                   std::span<const float> transport) {
  if (!link.receiver.is_group()) {
    return receiver.node(receiver.find(link.receiver)).shape.area_m2 * transport[0];
  }
  const GroupNode& group = receiver.groups()[link.receiver.group()];
  const Vec3 toward(transport[1], transport[2], transport[3]);
  double sum = 0.0;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = receiver.order()[i];
    if (receiver.sealed(k)) continue;
    const double cosine = std::max(0.0, glm::dot(receiver.frames()[k].n, toward));
    sum += receiver.node(k).shape.area_m2 * cosine * transport[0];
  }
  return sum;
}

double mean_exitance(const PatchForest& shooter, PatchId node, std::size_t band) {
  if (!node.is_group()) return shooter.frames()[node.root].exitance[band];
  const GroupNode& group = shooter.groups()[node.group()];
  double sum = 0.0;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = shooter.order()[i];
    sum += shooter.node(k).shape.area_m2 / group.area_m2 * shooter.frames()[k].exitance[band];
  }
  return sum;
}

}  // namespace enfilade
