#include "import/gltf/gltf_draco.hpp"

#include <draco/compression/decode.h>

namespace enfilade {
namespace {

GltfValues values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute) {
  GltfValues values;
  values.count = mesh.num_points();
  values.width = static_cast<std::size_t>(attribute.num_components());
  values.numbers.resize(values.count * values.width);
  std::array<float, 4> row{};
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    // Integers that are normalised come out as 0..1.
    attribute.ConvertValue(attribute.mapped_index(point), attribute.num_components(), row.data());
    for (std::size_t i = 0; i < values.width; ++i)
      values.numbers[point.value() * values.width + i] = row[i];
  }
  return values;
}

}  // namespace

DracoMesh decode_draco(GltfDocument& document, const nlohmann::json& compression,
                       const std::string& where) {
  const std::string_view bytes =
      document.buffer_view(document.need_whole(compression, "bufferView", where), where);
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) document.fail(where, "cannot be decompressed", "export the model again");
  const draco::Mesh& mesh = *decoded.value();
  const auto attribute = [&](const char* name) -> const draco::PointAttribute* {
    const auto all = compression.find("attributes");
    if (all == compression.end() || !all->is_object() || !all->contains(name)) return nullptr;
    const auto* found = mesh.GetAttributeByUniqueId(
        static_cast<std::uint32_t>(document.whole(*all, name, 0, where + ".attributes")));
    return found != nullptr && found->num_components() <= 4 ? found : nullptr;
  };
  DracoMesh result;
  const draco::PointAttribute* points = attribute("POSITION");
  if (points == nullptr || points->num_components() != 3)
    document.fail(where, "holds no positions", "export the model again");
  result.points = values_of(mesh, *points);
  if (const auto* colours = attribute("COLOR_0")) result.colours = values_of(mesh, *colours);
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
    for (const auto& corner : mesh.face(face)) result.corners.push_back(corner.value());
  }
  return result;
}

}  // namespace enfilade
