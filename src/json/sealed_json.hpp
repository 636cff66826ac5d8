// JSON files of a RUN: each carries a checksum of its content, so that no edit and no damage is
// taken for what a program has written.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

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

}  // namespace enfilade
