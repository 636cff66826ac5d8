#include "import/gltf/gltf_primitive.hpp"

#include <numeric>

#include "import/gltf/gltf_accessor.hpp"
#include "import/gltf/gltf_draco.hpp"

namespace enfilade {
namespace {

using Json = nlohmann::json;

/// What glTF calls a mode.
enum class Mode : std::size_t { triangles = 4, strip = 5, fan = 6 };

std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<std::uint32_t>& corners,
                                                       Mode mode) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const std::size_t step = mode == Mode::triangles ? 3 : 1;
  for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
    const std::uint32_t a = corners[mode == Mode::fan ? 0 : i], b = corners[i + 1],
                        c = corners[i + 2];
    if (mode == Mode::strip && i % 2 == 1)
      triangles.push_back({b, a, c});
    else
      triangles.push_back({a, b, c});
  }
  return triangles;
}

std::vector<std::array<double, 3>> colours_of(const GltfValues& values) {
  std::vector<std::array<double, 3>> colours;
  for (std::size_t i = 0; i < values.count && values.width >= 3; ++i)
    colours.push_back({values(i, 0), values(i, 1), values(i, 2)});
  return colours;
}

}  // namespace

GltfPrimitive read_primitive(GltfDocument& document, const Json& primitive,
                             const std::string& where, Warnings& warnings) {
  GltfPrimitive result;
  const auto mode = static_cast<Mode>(document.whole(primitive, "mode", 4, where));
  if (mode < Mode::triangles) {
    warnings.add(where, "points or lines: left out, as they have no area");
    return result;
  }
  if (mode > Mode::fan) document.fail(where + ".mode", "is not known", "write 0 to 6");
  const auto attributes = primitive.find("attributes");
  if (attributes == primitive.end() || !attributes->is_object())
    document.fail(where, "has no \"attributes\"", "export the model again");
  if (primitive.contains("targets")) warnings.add(where, "morph targets are not carried out");
  if (primitive.contains("material"))
    result.material = document.whole(primitive, "material", 0, where);
  GltfValues points, colours;
  std::vector<std::uint32_t> corners;
  if (const Json* compression = document.extension(primitive, "KHR_draco_mesh_compression")) {
    DracoMesh mesh = decode_draco(document, *compression, where);
    points = std::move(mesh.points);
    colours = std::move(mesh.colours);
    corners = std::move(mesh.corners);
  } else {
    if (!attributes->contains("POSITION")) return result;  // the standard: to be passed over
    points = read_accessor(document, document.whole(*attributes, "POSITION", 0, where), 3,
                           where + ".attributes.POSITION");
    if (attributes->contains("COLOR_0")) {
      colours = read_accessor(document, document.whole(*attributes, "COLOR_0", 0, where), 0,
                              where + ".attributes.COLOR_0");
    }
    corners.resize(points.count);
    std::iota(corners.begin(), corners.end(), 0u);
    if (primitive.contains("indices")) {
      const GltfValues indices =
          read_accessor(document, document.whole(primitive, "indices", 0, where), 1, where);
      corners.clear();
      for (const double i : indices.numbers) {
        if (!(i >= 0.0 && i < static_cast<double>(points.count)))
          document.fail(where + ".indices", "names a point that is not there",
                        "export the model again");
        corners.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
  for (std::size_t i = 0; i < points.count; ++i)
    result.points.emplace_back(points(i, 0), points(i, 1), points(i, 2));
  result.colours = colours_of(colours);
  if (result.colours.size() != result.points.size()) result.colours.clear();
  result.triangles = triangles_of(corners, mode);
  return result;
}

}  // namespace enfilade
