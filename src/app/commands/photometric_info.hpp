// The figures of a photometric file, as `info` prints them.
#pragma once

#include "app/frame/console.hpp"
#include "app/frame/text_table.hpp"

namespace enfilade {

/// Adds the figures of the file; warnings go to the console. Throws InputError.
void add_photometric_file(TextTable& table, const std::string& path, const Console& console);

}  // namespace enfilade
