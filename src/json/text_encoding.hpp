// Text in UTF-8, whatever a file is written in.
#pragma once

#include <string>
#include <string_view>

namespace enfilade {

/// Returns text of another encoding, named as iconv does ("UTF-16LE", "ISO-8859-1"), in UTF-8. What
/// is no character of that encoding is left out.
std::string in_utf8(std::string_view bytes, const char* encoding);

/// Returns the encoding that the byte order mark of UTF-16 tells; null where there is none.
const char* utf16_by_mark(std::string_view bytes);

/// Returns a file's text in UTF-8: from UTF-16 where it begins with the mark of that ("Unicode
/// text" of spreadsheets and editors), else as it is.
std::string file_in_utf8(std::string bytes);

}  // namespace enfilade
