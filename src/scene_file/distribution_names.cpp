#include "scene_file/distribution_names.hpp"

#include "photometry/distribution_json.hpp"

namespace enfilade {

const std::string& DistributionNames::of(
    const std::shared_ptr<const IntensityDistribution>& distribution,
    const LuminousOpening& opening) {
  for (const Entry& entry : entries_) {
    if (entry.distribution == distribution && entry.opening.shape == opening.shape &&
        entry.opening.size == opening.size)
      return entry.name;
  }
  entries_.push_back({"d" + std::to_string(entries_.size() + 1), distribution, opening});
  return entries_.back().name;
}

void DistributionNames::append_to(std::string& text) const {
  if (entries_.empty()) return;
  text += ",\n \"distributions\": {";
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    text += i == 0 ? "\n  \"" : ",\n  \"";
    text += entries_[i].name + "\": ";
    text += to_json({entries_[i].distribution, entries_[i].opening}).dump();
  }
  text += "\n }";
}

}  // namespace enfilade
