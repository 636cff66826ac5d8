#include "json/json_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "base/error.hpp"
#include "base/memory_wanted.hpp"

namespace enfilade {
namespace {

bool in_token(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '+' || c == '.';
}

// True for NaN, Infinity and their kin, and for digits that overflow a double.
bool is_nonfinite(const std::string& token) {
  if (token == "true" || token == "false" || token == "null" || token.empty()) return false;
  char* end = nullptr;
  const double value = std::strtod(token.c_str(), &end);
  return *end == '\0' && !std::isfinite(value);
}

// Puts the numbers that JSON can't hold in quotes; true if there was one.
bool quote_nonfinite(const std::string& text, std::string& out) {
  bool any = false, in_string = false;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (in_string || c == '"' || !in_token(c)) {
      if (in_string && c == '\\' && i + 1 < text.size())
        out += text[i++];
      else if (c == '"')
        in_string = !in_string;
      out += text[i++];
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && in_token(text[end])) ++end;
    const std::string token = text.substr(i, end - i);
    const bool quote = is_nonfinite(token);
    any |= quote;
    out += quote ? '"' + token + '"' : token;
    i = end;
  }
  return any;
}

std::string line_and_column(const std::string& text, std::size_t byte) {
  const std::size_t at = std::min(byte == 0 ? 0 : byte - 1, text.size());
  const auto begin = text.begin(), end = begin + static_cast<std::ptrdiff_t>(at);
  const auto line = 1 + std::count(begin, end, '\n');
  const std::size_t newline = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t column = newline == std::string::npos ? at + 1 : at - newline;
  return "line " + std::to_string(line) + ":" + std::to_string(column);
}

// The library's message without its prefix "[json.exception...] parse error at line 1, column 2: ".
std::string plain_fault(const std::string& message) {
  const std::size_t syntax = message.find("syntax error");
  if (syntax != std::string::npos) return message.substr(syntax);
  const std::size_t colon = message.rfind(": ");
  if (colon != std::string::npos) return message.substr(colon + 2);
  return message.substr(message.find("] ") == std::string::npos ? 0 : message.find("] ") + 2);
}

/// Values deeper than this are refused before they are parsed: whoever walks them may recurse.
constexpr std::size_t deepest = 100;

void check_depth(const std::string& text, const std::string& path) {
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_string = !in_string;
    } else if (!in_string && (c == '[' || c == '{')) {
      if (++depth <= deepest) continue;
      throw InputError(
          path, line_and_column(text, i + 1),
          "lists and objects lie in each other more than " + std::to_string(deepest) + " deep",
          "no file of enfilade needs that: correct the text there");
    } else if (!in_string && (c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
}

/// A number that overflows is no syntax error, and is told without its place.
[[noreturn]] void refuse_number(const std::string& text, const std::string& path,
                                const std::string& fault) {
  const std::size_t begin = fault.find('\'') + 1, end = fault.rfind('\'');
  const std::size_t at = end > begin ? text.find(fault.substr(begin, end - begin)) : text.size();
  throw InputError(path, at < text.size() ? line_and_column(text, at + 1) : "file",
                   "not valid JSON: " + fault, "write another number there");
}

template <class Json>
[[noreturn]] void refuse(const std::string& text, const std::string& path,
                         const typename Json::exception& error) {
  const auto* syntax = dynamic_cast<const typename Json::parse_error*>(&error);
  if (syntax == nullptr) refuse_number(text, path, plain_fault(error.what()));
  const bool truncated = syntax->byte >= text.size();
  throw InputError(
      path, line_and_column(text, syntax->byte), "not valid JSON: " + plain_fault(error.what()),
      truncated ? "the file ends too early, write it again" : "correct the text there");
}

template <class Json>
Json parse(const std::string& text, const std::string& path) {
  const MemoryPurpose purpose(path.c_str());
  check_depth(text, path);
  std::string repaired;
  try {
    return Json::parse(text);
  } catch (const typename Json::exception& error) {
    if (!quote_nonfinite(text, repaired)) refuse<Json>(text, path, error);
  }
  try {
    return Json::parse(repaired);
  } catch (const typename Json::exception& error) {
    refuse<Json>(repaired, path, error);
  }
}

}  // namespace

nlohmann::json parse_json(const std::string& text, const std::string& path) {
  return parse<nlohmann::json>(text, path);
}

nlohmann::ordered_json parse_ordered_json(const std::string& text, const std::string& path) {
  return parse<nlohmann::ordered_json>(text, path);
}

std::string shown(const nlohmann::json& value) {
  constexpr std::size_t longest = 40;
  const std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

std::string in_quotes(const std::string& name) {
  return nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace enfilade
