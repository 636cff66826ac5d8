// The modifiers that a Radiance scene has defined so far, and the material that each leads to.
#pragma once

#include <map>
#include <optional>

#include "base/warnings.hpp"
#include "import/radiance/radiance_material.hpp"
#include "json/model_files.hpp"

namespace enfilade {

class RadianceModifiers {
 public:
  /// Data of patterns come from `files`.
  explicit RadianceModifiers(ModelFiles& files) : files_(files) {}

  /// Takes in a material, pattern or alias. A name that is defined again stands for the later one
  /// from there on. Fails for a modifier or an alias of something not defined.
  void define(const RadiancePrimitive& primitive);

  /// Returns the material of a shape; its first use warns of the properties that are lost. Fails
  /// where the shape's modifier is not defined. A chain that ends at void leads to none, which
  /// passes light.
  RadianceMaterial material_of(const RadiancePrimitive& shape, Warnings& warnings);

 private:
  using Link = std::optional<std::size_t>;  ///< number of a modifier; none for void

  struct Modifier {
    std::string name;
    Link before;                                               ///< what modifies it
    std::optional<RadianceMaterial> material;                  ///< none for a pattern
    Link alternate;                                            ///< of an illum: what it looks like
    std::shared_ptr<const RadianceDistribution> distribution;  ///< of a pattern
    bool warned = false;
  };

  Link find(const std::string& name, const RadiancePrimitive& user) const;
  /// What stands before a material in a chain.
  struct Patterns {
    bool any_left_out = false;
    std::shared_ptr<const RadianceDistribution> distribution;
  };
  /// Returns the first material of a chain; its number, none for void.
  Link end_of(Link link, Patterns& patterns) const;
  /// Returns the material that is a mixture of two others.
  RadianceMaterial mixture(const RadiancePrimitive& primitive) const;

  ModelFiles& files_;
  std::vector<Modifier> modifiers_;
  std::map<std::string, std::size_t> by_name_;
};

}  // namespace enfilade
