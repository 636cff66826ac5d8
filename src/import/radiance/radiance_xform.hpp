// The arguments of Radiance's xform: transformations, arrays and names.
#pragma once

#include <vector>

#include "import/radiance/radiance_text.hpp"
#include "import/radiance/radiance_transform.hpp"

namespace enfilade {

struct RadianceXform {
  std::vector<RadianceTransform> copies{RadianceTransform{}};
  std::string prefix;              ///< of the names of all shapes; may be empty
  std::string modifier;            ///< in place of that of all shapes; empty for their own
  bool inverts = false;            ///< the fronts become the backs
  std::vector<std::string> files;  ///< as written

  /// Returns what one xform after another comes to: this one first. Fails for too many copies.
  RadianceXform then(const RadianceXform& next, const RadiancePlace& place) const;
};

/// More copies than this are a fault.
constexpr std::size_t most_radiance_copies = 1'000'000;

/// Parses the words behind "xform": "[-n name] [-m modifier] [-I] [-e] [-t x y z] [-rx|-ry|-rz
/// degrees] [-s f] [-mx] [-my] [-mz] [-a count ...] [-i count ...] file ...". Steps are taken in
/// order. Those behind -a count make an array: 0 to count - 1 times over; behind -i count they are
/// taken count times. Fails for any other option.
RadianceXform parse_radiance_xform(const std::vector<std::string>& words,
                                   const RadiancePlace& place);

}  // namespace enfilade
