// Suggestions for misspelt words.
#pragma once

#include <span>
#include <string>

namespace enfilade {

/// Returns the known word that is within two single-letter edits of this one, the nearest of them,
/// or that begins with it (three letters or more); empty where there is none.
std::string nearest_word(const std::string& word, std::span<const std::string> known);

}  // namespace enfilade
