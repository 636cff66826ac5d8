// Names of the distributions that a scene file holds, each once.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace enfilade {

/// Gives each distribution with its opening a name ("d1"), in the order of use.
class DistributionNames {
 public:
  const std::string& of(const std::shared_ptr<const IntensityDistribution>& distribution,
                        const LuminousOpening& opening);
  /// Appends the "distributions" of a scene file to its text; nothing where there are none.
  void append_to(std::string& text) const;

 private:
  struct Entry {
    std::string name;
    std::shared_ptr<const IntensityDistribution> distribution;
    LuminousOpening opening;
  };
  std::vector<Entry> entries_;
};

}  // namespace enfilade
