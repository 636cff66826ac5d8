#include "photometry/distribution_json.hpp"

#include <array>
#include <stdexcept>

#include "base/error.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

using nlohmann::json;

constexpr std::array shapes{
    OpeningShape::point,       OpeningShape::rectangle, OpeningShape::disc,
    OpeningShape::box,         OpeningShape::cylinder,  OpeningShape::cylinder_right,
    OpeningShape::cylinder_up, OpeningShape::ellipsoid, OpeningShape::upright_disc};

class Reader {
 public:
  Reader(const std::string& file, const std::string& where) : file_(file), where_(where) {}

  InlineDistribution read(const json& value) const {
    if (!value.is_object())
      fail("", "is " + shown(value) + ", not an object",
           "write {\"planes\": [...], \"angles\": [...], \"candela\": [[...]]}");
    IntensityTable table;
    const std::string type = value.value("type", json("C")).is_string()
                                 ? value.value("type", json("C")).get<std::string>()
                                 : "";
    if (type != "C" && type != "B" && type != "A")
      fail(".type", "is " + shown(value["type"]), "write \"A\", \"B\" or \"C\"");
    table.type = type == "C"   ? PhotometryType::c
                 : type == "B" ? PhotometryType::b
                               : PhotometryType::a;
    table.planes = numbers(value, "planes", ".planes");
    table.angles = numbers(value, "angles", ".angles");
    const json& rows = need(value, "candela");
    if (!rows.is_array() || rows.size() != table.planes.size())
      fail(".candela", "is not one list for each plane", "write [[...], ...]");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::vector<double> row = list(rows[i], ".candela[" + std::to_string(i) + "]");
      if (row.size() != table.angles.size())
        fail(".candela[" + std::to_string(i) + "]", "has not one intensity for each angle",
             "write as many numbers as angles");
      table.candela.insert(table.candela.end(), row.begin(), row.end());
    }
    InlineDistribution result;
    try {
      result.distribution = std::make_shared<const IntensityDistribution>(std::move(table));
    } catch (const std::invalid_argument& fault) {
      fail("", fault.what(), "correct its planes, angles or intensities");
    }
    if (value.contains("opening")) result.opening = opening(value["opening"]);
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& what,
                         const std::string& hint) const {
    throw InputError(file_, where_ + key, what, hint);
  }
  const json& need(const json& value, const char* key) const {
    const auto it = value.find(key);
    if (it == value.end()) fail("", std::string("has no \"") + key + "\"", "add it");
    return *it;
  }
  std::vector<double> list(const json& value, const std::string& key) const {
    if (!value.is_array()) fail(key, "is " + shown(value) + ", not a list", "write [...]");
    std::vector<double> numbers;
    for (const json& number : value) {
      if (!number.is_number()) fail(key, "holds " + shown(number), "write numbers");
      numbers.push_back(number.get<double>());
    }
    return numbers;
  }
  std::vector<double> numbers(const json& value, const char* key, const std::string& where) const {
    return list(need(value, key), where);
  }

  LuminousOpening opening(const json& value) const {
    if (!value.is_object()) fail(".opening", "is " + shown(value), "write {\"shape\", \"size\"}");
    LuminousOpening result;
    const json shape = value.value("shape", json("point"));
    bool known = false;
    for (const OpeningShape s : shapes) {
      if (shape != name_of(s)) continue;
      result.shape = s;
      known = true;
    }
    if (!known) fail(".opening.shape", "is " + shown(shape), "write a shape that the schema lists");
    if (result.shape == OpeningShape::point) return result;
    const std::vector<double> size = numbers(value, "size", ".opening.size");
    if (size.size() != 3) fail(".opening.size", "is not three lengths", "write [x, y, z], metres");
    for (int i = 0; i < 3; ++i) {
      const double x = size[static_cast<std::size_t>(i)];
      if (!(x >= 0.0) || x > 1e4)
        fail(".opening.size", "has a length out of range", "write 0 to 10000 m");
      result.size[i] = x;
    }
    if (std::max({result.size.x, result.size.y, result.size.z}) <= 0.0)
      fail(".opening.size", "is zero", "write \"point\" as its shape");
    return result;
  }

  const std::string& file_;
  const std::string& where_;
};

}  // namespace

InlineDistribution distribution_from_json(const json& value, const std::string& file,
                                          const std::string& where) {
  return Reader(file, where).read(value);
}

nlohmann::ordered_json to_json(const InlineDistribution& inline_distribution) {
  const IntensityTable& table = inline_distribution.distribution->table();
  nlohmann::ordered_json value;
  value["type"] = table.type == PhotometryType::c   ? "C"
                  : table.type == PhotometryType::b ? "B"
                                                    : "A";
  value["planes"] = table.planes;
  value["angles"] = table.angles;
  for (std::size_t p = 0; p < table.planes.size(); ++p) {
    auto& row = value["candela"].emplace_back(nlohmann::ordered_json::array());
    for (std::size_t a = 0; a < table.angles.size(); ++a) row.push_back(table.at(p, a));
  }
  const LuminousOpening& opening = inline_distribution.opening;
  if (opening.shape != OpeningShape::point) {
    value["opening"] = {{"shape", name_of(opening.shape)},
                        {"size", {opening.size.x, opening.size.y, opening.size.z}}};
  }
  return value;
}

}  // namespace enfilade
