// The text of a file that a user names.
#pragma once

#include <string>

namespace enfilade {

/// Returns the text of a file or of a pipe (/dev/stdin, a FIFO), read once to its end, in UTF-8
/// (text_encoding.hpp). Throws InputError where it is missing, a directory, a device, unreadable,
/// empty, or larger than the machine's memory, and where nobody opens a FIFO to write within five
/// seconds.
std::string read_text(const std::string& path);

}  // namespace enfilade
