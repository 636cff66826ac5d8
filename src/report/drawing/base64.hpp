// Bytes as text, for pages that hold all that they need.
#pragma once

#include <string>
#include <string_view>

namespace enfilade {

/// Returns the bytes as base64 (RFC 4648, section 4), with padding.
std::string base64(std::string_view bytes);

}  // namespace enfilade
