#include "coarse/aggregate_flow.hpp"

#include <algorithm>

namespace enfilade {
AggregateFlow::AggregateFlow(const PatchForest& receiver, const Aggregates& receiving,
                             const PatchForest& shooter, const Aggregates& shooting)
    : receiver_(receiver),
      shooter_(shooter),
      receiving_(receiving),
      shooting_(shooting),
      bands_(static_cast<std::size_t>(receiver.bands())),
      flow_(receiving.size() * shooting.size() * bands_, 0.0) {
  if (shooting.size() > 1) reflected_ = shooting.reflected_power(shooter);
}

/// The irradiance of a group link goes to the group's polygons by cosine (if it has a direction)
/// and area; the power that reaches a patch goes to the aggregates in it by area.
std::vector<double> received_shares(const PatchForest& receiver, const Aggregates& receiving,
                                    const Link& link, std::span<const float> transport) {
  std::vector<double> received(receiving.size(), 0.0);
  constexpr double whole = 1.0;
  if (receiving.size() == 1) {
    received[0] = whole;
  } else if (!link.receiver.is_group()) {
    receiving.add(receiver, link.receiver, std::span(&whole, 1), received);
  } else {
    double sum = 0.0;
    for_each_facing(receiver, link, transport, [&](std::uint32_t k, double cosine) {
      const double area_m2 = receiver.node(k).shape.area_m2 * cosine;
      receiving.add(receiver, {k, 1}, std::span(&area_m2, 1), received);
      sum += area_m2;
    });
    for (double& share : received) share = sum > 0.0 ? share / sum : 0.0;
  }
  return received;
}

/// By the power that each aggregate of the shooter reflects, for want of anything better: a link
/// only knows its shooter as a whole.
void AggregateFlow::share_sent(PatchId node) {
  from_ = shooting_.of(shooter_, node);
  sent_.assign(from_.size() * bands_, 1.0);
  if (from_.size() == 1) return;
  for (std::size_t b = 0; b < bands_; ++b) {
    double sum = 0.0;
    for (std::uint32_t z = from_.begin; z < from_.end; ++z) sum += reflected_[z * bands_ + b];
    for (std::uint32_t i = 0; i < from_.size(); ++i) {
      sent_[i * bands_ + b] =
          sum > 0.0 ? reflected_[(from_.begin + i) * bands_ + b] / sum : 1.0 / from_.size();
    }
  }
}

void AggregateFlow::add(const Link& link, std::span<const float> transport,
                        std::span<const double> power) {
  if (flow_.size() == bands_) {  // one aggregate on either side
    for (std::size_t b = 0; b < bands_; ++b) flow_[b] += power[b];
    return;
  }
  received_ = received_shares(receiver_, receiving_, link, transport);
  share_sent(link.shooter);
  for (std::size_t to = 0; to < received_.size(); ++to) {
    if (received_[to] == 0.0) continue;
    for (std::uint32_t i = 0; i < from_.size(); ++i) {
      double* flow = flow_.data() + (to * shooting_.size() + from_.begin + i) * bands_;
      for (std::size_t b = 0; b < bands_; ++b) {
        flow[b] += received_[to] * sent_[i * bands_ + b] * power[b];
      }
    }
  }
}

}  // namespace enfilade
