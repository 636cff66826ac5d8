#include "import/emissive_strength.hpp"

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

namespace enfilade {
namespace {

// The JSON text: the whole of a .gltf, the first chunk of a .glb (glTF 2.0, section 4.4).
std::string json_part(const std::string& bytes) {
  constexpr std::size_t header = 12, chunk_header = 8;
  if (bytes.compare(0, 4, "glTF") != 0) return bytes;
  if (bytes.size() < header + chunk_header) return {};
  const auto* b = reinterpret_cast<const unsigned char*>(bytes.data()) + header;
  const std::size_t length = b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::size_t>(b[3]) << 24;
  return bytes.substr(header + chunk_header, length);
}

}  // namespace

std::vector<double> emissive_strengths(const std::string& bytes) {
  std::vector<double> strengths;
  const nlohmann::json document = nlohmann::json::parse(json_part(bytes), nullptr, false);
  if (!document.is_object() || !document.contains("materials")) return strengths;
  const nlohmann::json::json_pointer key(
      "/extensions/KHR_materials_emissive_strength/emissiveStrength");
  for (const nlohmann::json& material : document["materials"]) {
    const bool given = material.contains(key) && material[key].is_number();
    strengths.push_back(given ? material[key].get<double>() : 1.0);
  }
  return strengths;
}

}  // namespace enfilade
