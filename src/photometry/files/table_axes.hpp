// Angles of a photometric file put in order.
#pragma once

#include "photometry/files/photometric_text.hpp"
#include "photometry/intensity_table.hpp"

namespace enfilade {

/// Puts planes and angles in ascending order and drops the second of two that are alike, with a
/// warning each; takes intensities below zero as zero where they are few and small, else fails.
void put_in_order(IntensityTable& table, PhotometricReport& report);

}  // namespace enfilade
