#include "hierarchy/link_errors.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// Next to nothing arrives where the errors are so many times the light.
constexpr double most_share = 1e6;

}  // namespace

void LinkErrors::add(const PatchForest& receiver, const Link& link, double power) {
  irradiance_.resize(receiver.size(), 0.0);
  if (!link.receiver.is_group()) {
    const std::size_t node = receiver.find(link.receiver);
    const double m2 = receiver.node(node).shape.area_m2;
    if (m2 > 0.0) irradiance_[node] += power / m2;
    return;
  }
  const GroupNode& group = receiver.groups()[link.receiver.group()];
  for (std::uint32_t i = group.begin; i < group.end && group.area_m2 > 0.0; ++i)
    irradiance_[receiver.order()[i]] += power / group.area_m2;
}

void LinkErrors::set(PatchForest& receiver) {
  irradiance_.resize(receiver.size(), 0.0);
  const auto terms = static_cast<std::size_t>(receiver.terms());
  for (std::size_t n = 0; n < receiver.size(); ++n) {
    const PatchNode& node = receiver.node(n);
    if (node.parent >= 0) irradiance_[n] += irradiance_[static_cast<std::size_t>(node.parent)];
    double most = 0.0;
    for (std::size_t b = 0; b < static_cast<std::size_t>(receiver.lead_bands()); ++b)
      most = std::max(most, receiver.irradiance(n)[b * terms]);
    const double share = most > 0.0 ? std::min(irradiance_[n] / most, most_share) : 0.0;
    receiver.set_link_error(n, static_cast<float>(share));
  }
}

}  // namespace enfilade
