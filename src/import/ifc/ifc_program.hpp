// The program that reads IFC files: reader/read_ifc.cjs under Node.js.
#pragma once

#include <string>

namespace enfilade {

/// Returns what the program wrote about these bytes of `file`, a JSON document. Throws InputError
/// where Node.js or web-ifc is missing, and where the program crashed or ran out of time or memory.
std::string run_ifc_program(const std::string& file, const std::string& bytes);

}  // namespace enfilade
