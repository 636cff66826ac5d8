// One primitive of a Radiance scene: "modifier type identifier" and three lists of arguments.
#pragma once

#include <vector>

#include "import/radiance/radiance_text.hpp"

namespace enfilade {

enum class RadianceKind {
  shape,     ///< geometry that a scene can hold
  material,  ///< ends a chain of modifiers
  pattern,   ///< a pattern or texture: modifies the material behind it
  alias,     ///< another name of a modifier
  object     ///< sources, instances, meshes: not carried over
};

struct RadiancePrimitive {
  RadiancePlace place;
  std::string modifier, type, name;
  RadianceKind kind = RadianceKind::shape;
  std::vector<std::string> words;  ///< of an alias: the one name that it stands for
  std::vector<double> numbers;

  /// "polygon "floor"", for messages.
  std::string label() const;
  /// Fails unless there are `count` numbers; `meaning` lists them.
  void need_numbers(std::size_t count, const std::string& meaning) const;
};

/// Fails for an unknown type, a count that is none, and a list that breaks off.
RadiancePrimitive read_radiance_primitive(RadianceText& text);

}  // namespace enfilade
