#include "radiosity/link.hpp"

#include "base/error.hpp"

namespace enfilade {

void LinkSet::add(const Link& link, std::span<const float> transport) {
  ENFILADE_CHECK(transport.size() == stride_, std::to_string(transport.size()));
  links_.push_back(link);
  transport_.insert(transport_.end(), transport.begin(), transport.end());
}

void LinkSet::clear() {
  links_.clear();
  transport_.clear();
}

}  // namespace enfilade
