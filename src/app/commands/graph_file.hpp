// graph.json: clusters, their cell and input surfaces, and the pairs that can see each other.
#pragma once

#include <string>

#include "run/prepare.hpp"

namespace enfilade {

/// {"clusters": [{"id", "cell", "surfaces": [index in the scene file, ...]}], "visible": [[id, id],
/// ...]}; each visible pair once, the smaller id first. Surfaces in ascending order, each once per
/// cluster.
std::string graph_json(const Prepared& prepared);

}  // namespace enfilade
