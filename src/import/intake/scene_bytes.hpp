// A scene and its warnings as bytes, to pass them from one process to another.
#pragma once

#include <span>

#include "base/warnings.hpp"
#include "scene/scene.hpp"

namespace enfilade {

std::vector<std::byte> bytes_of(const Scene& scene, const Warnings& warnings);
/// Adds the warnings to `warnings`. Throws RunError where the bytes are cut off.
Scene scene_from(std::span<const std::byte> bytes, Warnings& warnings);

}  // namespace enfilade
