// Files of places at which glare is rated: the input of `rooms --ugr-at`.
#pragma once

#include <string>
#include <vector>

#include "report/survey/glare.hpp"

namespace enfilade {

/// Places from {"places": [{"p": [x,y,z], "direction": [x,y,z], "name": "..."}, ...]}. A probe file
/// ("probes", with "n" as the direction) will do as well. A place without a name gets its number.
/// Throws InputError that names the key.
std::vector<GlarePlace> read_glare_places(const std::string& path);

}  // namespace enfilade
