#include "import/radiance/radiance_primitive.hpp"

#include <algorithm>
#include <charconv>
#include <map>

namespace enfilade {
namespace {

// All the types of Radiance's reference manual (ray.html).
RadianceKind kind_of(const std::string& type, const RadiancePlace& place) {
  static const std::map<RadianceKind, std::vector<std::string>> types{
      {RadianceKind::shape,
       {"polygon", "ring", "cylinder", "cone", "cup", "tube", "bubble", "sphere"}},
      {RadianceKind::material,
       {"plastic",  "metal",     "trans",      "light",     "glow",      "illum",    "spotlight",
        "mirror",   "glass",     "mist",       "prism1",    "prism2",    "plastic2", "metal2",
        "trans2",   "ashik2",    "plasfunc",   "metfunc",   "transfunc", "plasdata", "metdata",
        "BRTDfunc", "transdata", "BSDF",       "aBSDF",     "WGMDfunc",  "mixfunc",  "mixdata",
        "mixpict",  "mixtext",   "antimatter", "interface", "dielectric"}},
      {RadianceKind::pattern,
       {"texfunc", "texdata", "colorfunc", "brightfunc", "colordata", "brightdata", "colorpict",
        "colortext", "brighttext", "spectrum", "specfile", "specfunc", "specdata", "specpict"}},
      {RadianceKind::alias, {"alias"}},
      {RadianceKind::object, {"source", "instance", "mesh"}}};
  for (const auto& [kind, names] : types) {
    if (std::find(names.begin(), names.end(), type) != names.end()) return kind;
  }
  place.fail(radiance_quoted(type) + " is no type of primitive",
             "write \"modifier type identifier\", and check the counts of the primitive before");
}

std::size_t read_count(RadianceText& text, const std::string& of) {
  const std::string word = text.word("the number of " + of);
  std::size_t count = 0;
  const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (fault != std::errc() || stop != word.data() + word.size()) {
    text.place().fail(radiance_quoted(word) + " stands where the number of " + of + " is wanted",
                      "write three lists of arguments, each with its count in front");
  }
  return count;
}

}  // namespace

std::string RadiancePrimitive::label() const { return type + " " + radiance_quoted(name); }

void RadiancePrimitive::need_numbers(std::size_t count, const std::string& meaning) const {
  if (numbers.size() == count) return;
  place.fail(
      label() + " has " + std::to_string(numbers.size()) + " numbers, not " + std::to_string(count),
      "write " + meaning);
}

RadiancePrimitive read_radiance_primitive(RadianceText& text) {
  RadiancePrimitive primitive;
  primitive.modifier = text.word("a modifier");
  primitive.place = text.place();
  primitive.type = text.word("the type of a primitive");
  primitive.kind = kind_of(primitive.type, primitive.place);
  primitive.name = text.word("the identifier of a " + primitive.type);
  if (primitive.kind == RadianceKind::alias) {
    primitive.words.push_back(text.word("the name that an alias stands for"));
    return primitive;
  }
  const auto of = [&](const char* list) { return list + (" of " + primitive.label()); };
  for (std::size_t left = read_count(text, of("words")); left > 0; --left)
    primitive.words.push_back(text.word(std::to_string(left) + " more " + of("words")));
  for (std::size_t left = read_count(text, of("integers")); left > 0; --left)
    text.word(std::to_string(left) + " more " + of("integers"));
  for (std::size_t left = read_count(text, of("numbers")); left > 0; --left) {
    const std::string word = text.word(std::to_string(left) + " more " + of("numbers"));
    primitive.numbers.push_back(radiance_number(word, text.place()));
  }
  return primitive;
}

}  // namespace enfilade
