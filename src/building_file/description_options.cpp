#include "building_file/description_options.hpp"

#include <set>
#include <sstream>

#include "json/json_text.hpp"

namespace enfilade {
namespace {

using nlohmann::json;

std::vector<std::string> parts_of(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream in(list);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

// A number, or the text itself, which whoever reads the value will refuse.
json value_of(const std::string& text) {
  json value = json::parse(text, nullptr, false);
  return value.is_discarded() ? json(text) : value;
}

json wings_of(const std::string& text) {
  json wings = json::array();
  for (const std::string& part : parts_of(text)) {
    const auto colon = part.find(':');
    json wing{{"bays", value_of(part.substr(0, colon))}};
    if (colon != std::string::npos) wing["turn"] = value_of(part.substr(colon + 1));
    wings.push_back(std::move(wing));
  }
  return wings;
}

}  // namespace

void put_option(json& document, const Building& building, const std::string& key,
                const std::string& value) {
  if (key == "wings") {
    document[key] = wings_of(value);
  } else if (key == "furniture" || key == "ground_furniture") {
    json& counts = document[key];
    if (!counts.is_object()) counts = json::object();
    std::set<std::string> given;
    for (const std::string& part : parts_of(value)) {
      const auto equals = part.find('=');
      if (equals == std::string::npos) {
        throw building.fault(key, "has " + in_quotes(part), "write kind=number,kind=number");
      }
      const std::string kind = part.substr(0, equals);
      if (!given.insert(kind).second) {
        throw building.fault(key, "has " + kind + " twice", "write each kind once");
      }
      counts[kind] = value_of(part.substr(equals + 1));
    }
  } else {
    document[key] = value_of(value);
  }
}

}  // namespace enfilade
