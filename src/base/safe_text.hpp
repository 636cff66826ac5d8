// Text from outside (names in models, paths, messages of libraries) as it may leave the program.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace enfilade {

/// Returns the text as valid UTF-8 without characters that do something to whoever shows it rather
/// than being shown: control characters, marks that turn the direction of writing, line and
/// paragraph separators, bytes that are no UTF-8. `shown` gives what stands for each of these;
/// characters of `kept` stay.
std::string safe_text(std::string_view text, std::string_view kept,
                      const std::function<std::string(std::uint32_t)>& shown);

/// For terminals: ESC becomes \x1b, a right-to-left override \u202e; line breaks and tabs stay.
std::string terminal_text(std::string_view text);
/// Line breaks and tabs become single spaces.
std::string on_one_line(std::string_view text);
/// For files: each becomes U+FFFD, the replacement character; line breaks and tabs stay.
std::string file_text(std::string_view text);
/// A field of a CSV file as RFC 4180 has it: in quotes where it holds a comma, a quote or a line
/// break. Where a spreadsheet would take it for a formula, an apostrophe stands before it, which
/// tells the spreadsheet that it is text.
std::string csv_field(std::string_view text);

}  // namespace enfilade
