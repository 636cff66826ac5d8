// glTF documents that the tests of this room put together.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>

#include "import/gltf/gltf_import.hpp"
#include "unit/scene/test_scenes.hpp"

namespace enfilade::test {

/// A document with one buffer; a square of 1 m2, front up, is mesh 0.
class GltfModel {
 public:
  using Json = nlohmann::json;
  Json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};

  GltfModel() {
    const std::vector<float> square{0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0};
    const std::vector<std::uint16_t> corners{0, 1, 2, 0, 2, 3};
    accessor(square, 5126, "VEC3");
    accessor(corners, 5123, "SCALAR");
    document["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
    document["nodes"] = {{{"mesh", 0}, {"name", "square"}}};
    document["scenes"] = {{{"nodes", {0}}}};
  }

  template <class T>
  std::size_t view(const std::vector<T>& values) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    const std::size_t offset = buffer_.size(), bytes = values.size() * sizeof(T);
    buffer_.resize(offset + bytes);
    std::memcpy(buffer_.data() + offset, values.data(), bytes);
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
    return document["bufferViews"].size() - 1;
  }
  template <class T>
  std::size_t accessor(const std::vector<T>& values, int component, const std::string& type) {
    const std::size_t width = type == "SCALAR" ? 1 : static_cast<std::size_t>(type[3] - '0');
    const std::size_t at = view(values);
    document["accessors"].push_back({{"bufferView", at},
                                     {"componentType", component},
                                     {"count", values.size() / width},
                                     {"type", type}});
    return document["accessors"].size() - 1;
  }
  Json& primitive() { return document["meshes"][0]["primitives"][0]; }
  /// Gives the square a material.
  void material(const Json& material) {
    document["materials"].push_back(material);
    primitive()["material"] = document["materials"].size() - 1;
  }

  std::string text() {
    document["buffers"] = {{{"byteLength", buffer_.size()},
                            {"uri", "data:application/octet-stream;base64," + base64(buffer_)}}};
    return document.dump();
  }
  Scene import(Warnings& warnings, const ImportOptions& options = {}) {
    const TemporaryFolder folder;
    return import_gltf(folder.write("m.gltf", text()), options, warnings);
  }
  Scene import() {
    Warnings ignored;
    return import(ignored);
  }
  std::string warnings() {
    Warnings found;
    import(found);
    return all_warnings(found);
  }
  std::string fault() {
    return input_error([&] { import(); });
  }

  static std::string base64(const std::string& bytes) {
    static const char* const digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      unsigned bits = 0;
      for (std::size_t k = 0; k < 3; ++k)
        bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
      for (std::size_t k = 0; k < 4; ++k)
        text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return text;
  }

 private:
  std::string buffer_;
};

inline double area_of(const Scene& scene) {
  double area = 0.0;
  for (const Surface& surface : scene.surfaces) area += area_m2(surface.vertices);
  return area;
}

}  // namespace enfilade::test
