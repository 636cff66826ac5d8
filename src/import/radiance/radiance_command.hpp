// The commands of Radiance files that are carried out here, by their own rules and not by a shell.
#pragma once

#include "import/radiance/radiance_xform.hpp"

namespace enfilade {

/// What a line behind ! makes.
struct RadianceCommand {
  RadianceXform xform;            ///< its files are taken in
  std::string modifier, name;     ///< of the polygons
  std::vector<Polygon> polygons;  ///< of a generator, before the transformation
  std::string left_out;           ///< the program that is passed over; empty for none
};

/// Parses "xform ... file ...", "cat file ...", "genbox ..." and "genprism ...", each perhaps piped
/// into further xforms; gensky and gendaylit are passed over. Fails for any other command, and for
/// all that a shell would read in a special way.
RadianceCommand parse_radiance_command(const std::string& command, const RadiancePlace& place);

}  // namespace enfilade
