// How a model is to be read, where its format leaves that open.
#pragma once

#include <string>

namespace enfilade {

struct ImportOptions {
  std::string units;           ///< "m", "cm", "mm", "ft", "in"; empty for what the format has
  std::string up;              ///< "y" or "z"; empty for what the format has
  double scale = 1.0;          ///< lengths times this, besides the units
  bool open_doors = false;     ///< leave out the leaves of doors (IFC)
  bool allow_outside = false;  ///< files may lie outside the model's own folder
};

}  // namespace enfilade
