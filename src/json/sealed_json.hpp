// JSON files of a RUN: each carries a checksum of its content, so that no edit and no damage is
// taken for what a program has written.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace enfilade {

/// What a sealed file is: its "format", the one "version" of it that is known, and what to do where
/// it is damaged or of another version.
struct SealedFormat {
  const char* format;
  int version;
  const char* remedy;
};

/// Returns the text of the file: {"format", "version", the keys of `content`, "checksum"}, on one
/// line. The checksum is XXH64 of the line without it.
std::string seal(const SealedFormat& format, const nlohmann::ordered_json& content);

/// Reads such a file's text, and calls `take` with the document; `path` is for messages. Throws
/// RunError "PATH: what; remedy" where it is not JSON, of another format or version, or not as it
/// was sealed, and where `take` throws RunError, std::logic_error or an error of nlohmann::json.
void unseal(const SealedFormat& format, const std::string& text, const std::string& path,
            const std::function<void(const nlohmann::ordered_json&)>& take);

/// Returns a whole number that fits T, where json's own conversion would take 1e99 or -1 for some
/// other number. Throws std::out_of_range.
template <std::integral T, class Json>
T whole(const Json& value) {
  if (value.is_number_unsigned()) {
    const auto number = value.template get<std::uint64_t>();
    if (std::in_range<T>(number)) return static_cast<T>(number);
  } else if (value.is_number_integer()) {
    const auto number = value.template get<std::int64_t>();
    if (std::in_range<T>(number)) return static_cast<T>(number);
  }
  throw std::out_of_range("no whole number of its range");
}

/// Returns a list of them.
template <std::integral T, class Json>
std::vector<T> whole_list(const Json& list) {
  std::vector<T> numbers;
  for (const auto& value : list) numbers.push_back(whole<T>(value));
  return numbers;
}

}  // namespace enfilade
