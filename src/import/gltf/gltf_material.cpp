#include "import/gltf/gltf_material.hpp"

#include <cmath>
#include <numbers>

#include "json/json_text.hpp"

namespace enfilade {
namespace {

const nlohmann::json& member(const nlohmann::json& object, const char* key) {
  static const nlohmann::json none = nlohmann::json::object();
  const auto it = object.find(key);
  return it != object.end() && it->is_object() ? *it : none;
}

}  // namespace

ModelMaterial GltfMaterials::material(std::optional<std::size_t> index, const Spectrum& colour,
                                      const std::string& user) {
  Entry entry;
  std::string where = "faces without a material";
  if (index) {
    entry = read(*index, user);
    where = "materials[" + std::to_string(*index) + "] " + in_quotes(entry.material.name);
  } else {
    entry.colour = {1.0, 1.0, 1.0};
  }
  for (std::size_t i = 0; i < 3; ++i) entry.colour[i] *= colour[i];
  entry.material.reflectance = reflectance_of(entry.colour, where, warnings_);
  if (entry.passing <= 0.0) return entry.material;
  // What passes has the base colour, as what is reflected; both share the light.
  for (double& band : entry.material.reflectance) {
    entry.material.transmittance.push_back(entry.passing * band);
    band *= 1.0 - entry.passing;
  }
  return entry.material;
}

const GltfMaterials::Entry& GltfMaterials::read(std::size_t index, const std::string& user) {
  const auto known = read_.find(index);
  if (known != read_.end()) return known->second;
  const Json& source = document_.entry("materials", index, user);
  Entry entry;
  entry.material.name = document_.text(source, "name");
  const std::string where = "materials[" + std::to_string(index) + "]";
  double alpha = 1.0;
  read_colours(source, entry, alpha, where);
  read_emission(source, entry, where);
  entry.passing = transmission(source, where);
  entry.material.open = !opaque(source, alpha, where);
  const auto sides = source.find("doubleSided");
  entry.material.two_sided = sides != source.end() && *sides == true;
  return read_.emplace(index, std::move(entry)).first->second;
}

void GltfMaterials::read_colours(const Json& source, Entry& entry, double& alpha,
                                 const std::string& where) {
  const Json* glossiness = document_.extension(source, "KHR_materials_pbrSpecularGlossiness");
  const Json& from = glossiness != nullptr ? *glossiness : member(source, "pbrMetallicRoughness");
  const char* factor = glossiness != nullptr ? "diffuseFactor" : "baseColorFactor";
  const char* image = glossiness != nullptr ? "diffuseTexture" : "baseColorTexture";
  const std::vector<double> colour = document_.reals(from, factor, {1.0, 1.0, 1.0, 1.0}, where);
  entry.colour.assign(colour.begin(), colour.begin() + 3);
  alpha = colour[3];
  if (const std::optional<TextureMean> mean = texture(from, image, where)) {
    for (std::size_t i = 0; i < 3; ++i) entry.colour[i] *= mean->srgb[i];
    alpha *= mean->linear[3];
  } else if (from.contains(image)) {
    constexpr double unknown = 0.5;  // the mean of an unknown texture
    for (double& c : entry.colour) c *= unknown;
    warnings_.add(where, "the texture of its colour is not known: taken as 0.5");
  }
}

void GltfMaterials::read_emission(const Json& source, Entry& entry, const std::string& where) {
  const std::vector<double> factor =
      document_.reals(source, "emissiveFactor", {0.0, 0.0, 0.0}, where);
  double strength = 1.0;
  if (const Json* given = document_.extension(source, "KHR_materials_emissive_strength"))
    strength = document_.real(*given, "emissiveStrength", 1.0, where);
  const std::optional<TextureMean> mean = texture(source, "emissiveTexture", where);
  for (std::size_t i = 0; i < 3; ++i) {
    const double light = strength * factor[i] * (mean ? mean->srgb[i] : 1.0);
    if (!std::isfinite(light) || light < 0.0)
      document_.fail(where + ".emissiveFactor", "is below zero or not finite", "write 0 or more");
    entry.material.exitance[i] = std::numbers::pi * light;
  }
}

double GltfMaterials::transmission(const Json& source, const std::string& where) {
  const Json* given = document_.extension(source, "KHR_materials_transmission");
  if (given == nullptr) return 0.0;
  double passing = document_.real(*given, "transmissionFactor", 0.0, where);
  if (const std::optional<TextureMean> mean = texture(*given, "transmissionTexture", where))
    passing *= mean->linear[0];
  return std::clamp(passing, 0.0, 1.0);
}

bool GltfMaterials::opaque(const Json& source, double alpha, const std::string& where) {
  const std::string mode = document_.text(source, "alphaMode");
  if (mode == "MASK") return alpha >= document_.real(source, "alphaCutoff", 0.5, where);
  if (mode != "BLEND") return true;  // OPAQUE, the default: alpha says nothing
  if (alpha >= 0.5 && alpha < 1.0) warnings_.add(where, "alpha of half or more: taken as opaque");
  return alpha >= 0.5;
}

std::optional<TextureMean> GltfMaterials::texture(const Json& object, const char* key,
                                                  const std::string& where) {
  const auto it = object.find(key);
  if (it == object.end()) return {};
  const std::string place = where + "." + key;
  if (!it->is_object()) document_.fail(place, "is not an object", "export the model again");
  const Json& used = document_.entry("textures", document_.need_whole(*it, "index", place), place);
  const Json* source = &used;
  for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds"}) {
    if (!used.contains("source") && document_.extension(used, name) != nullptr)
      source = document_.extension(used, name);
  }
  if (!source->contains("source")) return {};
  return image_mean(document_.whole(*source, "source", 0, place), place);
}

std::optional<TextureMean> GltfMaterials::image_mean(std::size_t image, const std::string& where) {
  const auto known = means_.find(image);
  if (known != means_.end()) return known->second;
  std::optional<TextureMean> mean = texture_mean(document_.image(image, where));
  if (!mean) {
    const std::string uri = document_.text(document_.entry("images", image, where), "uri");
    const bool named = !uri.empty() && !uri.starts_with("data:");
    warnings_.add("images[" + std::to_string(image) + "]" + (named ? " " + in_quotes(uri) : ""),
                  "is missing, outside the model's folder, or neither PNG nor JPEG: its texture is "
                  "left out");
  }
  return means_.emplace(image, mean).first->second;
}

}  // namespace enfilade
