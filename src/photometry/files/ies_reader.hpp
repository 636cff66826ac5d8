// IES LM-63 files.
#pragma once

#include "photometry/files/photometric_file.hpp"
#include "photometry/files/photometric_text.hpp"

namespace enfilade {

PhotometricFile read_ies(const std::vector<std::string>& lines, const SideFile& beside,
                         PhotometricReport& report);

/// Makes the distribution of a table whose angles are in order, or fails.
std::shared_ptr<const IntensityDistribution> distribution_of(IntensityTable table,
                                                             PhotometricReport& report);

}  // namespace enfilade
