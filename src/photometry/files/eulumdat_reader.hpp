// EULUMDAT files (.ldt).
#pragma once

#include "photometry/files/photometric_file.hpp"
#include "photometry/files/photometric_text.hpp"

namespace enfilade {

PhotometricFile read_eulumdat(const std::vector<std::string>& lines, PhotometricReport& report);

}  // namespace enfilade
