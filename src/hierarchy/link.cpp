#include "hierarchy/link.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace enfilade {

void LinkSet::add(const Link& link, std::span<const float> transport,
                  std::span<const double> tint) {
  ENFILADE_CHECK(transport.size() == stride_, std::to_string(transport.size()));
  links_.push_back(link);
  transport_.insert(transport_.end(), transport.begin(), transport.end());
  if (tint.empty() && tint_bands_ == 0) return;
  if (!tint.empty()) tint_bands_ = tint.size();
  tint_.resize(links_.size() * tint_bands_, 1.0f);
  std::copy(tint.begin(), tint.end(), tint_.end() - static_cast<std::ptrdiff_t>(tint.size()));
}

void LinkSet::add_from(const LinkSet& other, std::size_t i) {
  const std::span<const float> tint = other.tint(i);
  add(other[i], other.transport(i), std::vector<double>(tint.begin(), tint.end()));
}

void LinkSet::take_first(const LinkSet& other, std::size_t n) {
  ENFILADE_CHECK(n <= other.size() && stride_ == other.stride_, std::to_string(n));
  const auto first = [n](const auto& values, std::size_t each) {
    return values.begin() + static_cast<std::ptrdiff_t>(n * each);
  };
  links_.assign(other.links_.begin(), first(other.links_, 1));
  transport_.assign(other.transport_.begin(), first(other.transport_, stride_));
  tint_bands_ = other.tint_bands_;
  tint_.assign(other.tint_.begin(), first(other.tint_, tint_bands_));
}

std::size_t LinkSet::memory_bytes() const {
  return links_.capacity() * sizeof(Link) +
         (transport_.capacity() + tint_.capacity()) * sizeof(float);
}

void LinkSet::shrink() {
  links_.shrink_to_fit();
  transport_.shrink_to_fit();
  tint_.shrink_to_fit();
}

double area_factor(const PatchForest& receiver, const Link& link,
                   std::span<const float> transport) {
  if (!link.receiver.is_group()) {
    return receiver.node(receiver.find(link.receiver)).shape.area_m2 * transport[0];
  }
  double sum = 0.0;
  for_each_facing(receiver, link, transport, [&](std::uint32_t k, double cosine) {
    sum += receiver.node(k).shape.area_m2 * cosine * static_cast<double>(transport[0]);
  });
  return sum;
}

std::uint64_t linked_clusters(const LinkSet& links, ClusterId own) {
  std::uint64_t count = 0;
  ClusterId last;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const ClusterId shooter = links[i].shooter_cluster;
    if (shooter.valid() && shooter != last && shooter != own) ++count;
    last = shooter;
  }
  return count;
}

}  // namespace enfilade
