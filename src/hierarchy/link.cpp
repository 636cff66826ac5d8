#include "hierarchy/link.hpp"

#include "base/error.hpp"

namespace enfilade {

void LinkSet::add(const Link& link, std::span<const float> transport) {
  ENFILADE_CHECK(transport.size() == stride_, std::to_string(transport.size()));
  links_.push_back(link);
  transport_.insert(transport_.end(), transport.begin(), transport.end());
}

void LinkSet::take_first(const LinkSet& other, std::size_t n) {
  ENFILADE_CHECK(n <= other.size() && stride_ == other.stride_, std::to_string(n));
  links_.assign(other.links_.begin(), other.links_.begin() + static_cast<std::ptrdiff_t>(n));
  transport_.assign(other.transport_.begin(),
                    other.transport_.begin() + static_cast<std::ptrdiff_t>(n * stride_));
}

std::size_t LinkSet::memory_bytes() const {
  return links_.capacity() * sizeof(Link) + transport_.capacity() * sizeof(float);
}

void LinkSet::shrink() {
  links_.shrink_to_fit();
  transport_.shrink_to_fit();
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

}  // namespace enfilade
