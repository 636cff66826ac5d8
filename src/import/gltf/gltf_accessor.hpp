// Numbers out of glTF's buffers.
#pragma once

#include "import/gltf/gltf_document.hpp"

namespace enfilade {

/// The values of an accessor, one row an element.
struct GltfValues {
  std::size_t count = 0, width = 0;  ///< elements, and numbers in each
  std::vector<double> numbers;       ///< normalised ones already divided

  double operator()(std::size_t element, std::size_t i) const {
    return numbers[element * width + i];
  }
};

/// Reads accessor `index`, sparse or not, of any component type. Fails where it reaches out of its
/// buffer view, and where an element has not `width` numbers (0 for any).
GltfValues read_accessor(GltfDocument& document, std::size_t index, std::size_t width,
                         const std::string& user);

}  // namespace enfilade
