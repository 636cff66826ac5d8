#include "json/sealed_json.hpp"

#include "base/checksum.hpp"
#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Json& document) {
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json parsed(const std::string& text, const std::string& path) {
  try {
    return parse_ordered_json(text, path);
  } catch (const InputError&) {
    throw RunError("no JSON");
  }
}

/// Whether all of the text is as seal() writes it: what another spelling of the same values is, was
/// not written by it.
bool is_sealed(const std::string& text, Json document) {
  if (text != line_of(document) + "\n") return false;
  const Json sum = document.value("checksum", Json());
  document.erase("checksum");
  return sum == hash_text(checksum(line_of(document)));
}

void check(const SealedFormat& format, const Json& document, const std::string& text) {
  if (!document.is_object() || document.value("format", Json()) != format.format) {
    throw RunError(std::string("not an ") + format.format);
  }
  const Json version = document.value("version", Json());
  if (version != format.version) {
    throw RunError("of another version of enfilade (" + shown(version) + ", this one knows " +
                   std::to_string(format.version) + ")");
  }
  if (!is_sealed(text, document)) throw RunError("damaged (checksum)");
}

}  // namespace

std::string seal(const SealedFormat& format, const Json& content) {
  Json document = {{"format", format.format}, {"version", format.version}};
  document.update(content);
  document["checksum"] = hash_text(checksum(line_of(document)));
  return line_of(document) + "\n";
}

void unseal(const SealedFormat& format, const std::string& text, const std::string& path,
            const std::function<void(const Json&)>& take) {
  std::string fault;
  try {
    const Json document = parsed(text, path);
    check(format, document, text);
    take(document);
    return;
  } catch (const RunError& error) {
    fault = error.what();
  } catch (const Json::exception&) {
    fault = "damaged (a value is missing, or of another kind)";
  } catch (const std::logic_error&) {
    fault = "damaged (a value is none)";
  }
  throw RunError(path + ": is " + fault + "; " + format.remedy);
}

}  // namespace enfilade
