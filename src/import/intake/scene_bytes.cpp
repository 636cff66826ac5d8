#include "import/intake/scene_bytes.hpp"

#include <map>

#include "base/byte_stream.hpp"

namespace enfilade {
namespace {

// Each value is named once: the same function writes it and reads it back.
struct Writing {
  ByteWriter& out;
  void number(double value) { out.put(value); }
  void integer(std::int32_t value) { out.put(value); }
  void distribution(const std::shared_ptr<const IntensityDistribution>& value) {
    out.put(static_cast<std::uint8_t>(value != nullptr));
    if (!value) return;
    const IntensityTable& table = value->table();
    out.put(static_cast<std::uint8_t>(table.type));
    out.put_all(table.planes);
    out.put_all(table.angles);
    out.put_all(table.candela);
  }
  void cone(const std::optional<SpotCone>& value) {
    out.put(static_cast<std::uint8_t>(value.has_value()));
    if (!value) return;
    out.put(value->inner);
    out.put(value->outer);
  }
  void shape(const OpeningShape& value) { out.put(static_cast<std::uint8_t>(value)); }
  void text(const std::string& value) { out.put_text(value); }
  template <class T>
  void values(const std::vector<T>& list) {
    out.put_all(list);
  }
  template <class T, class Function>
  void list(const std::vector<T>& items, Function each) {
    out.put(std::uint64_t{items.size()});
    for (const T& item : items) each(item);
  }
};

struct Reading {
  ByteReader& in;
  /// Lights that shared a distribution share it again.
  std::map<std::vector<double>, std::shared_ptr<const IntensityDistribution>> known{};

  void number(double& value) { value = in.get<double>(); }
  void integer(std::int32_t& value) { value = in.get<std::int32_t>(); }
  void distribution(std::shared_ptr<const IntensityDistribution>& value) {
    if (in.get<std::uint8_t>() == 0) return;
    IntensityTable table;
    table.type = static_cast<PhotometryType>(in.get<std::uint8_t>());
    table.planes = in.get_all<double>();
    table.angles = in.get_all<double>();
    table.candela = in.get_all<double>();
    std::vector<double> key{static_cast<double>(table.type)};
    for (const auto* list : {&table.planes, &table.angles, &table.candela})
      key.insert(key.end(), list->begin(), list->end());
    auto& shared = known[std::move(key)];
    if (!shared) shared = std::make_shared<const IntensityDistribution>(std::move(table));
    value = shared;
  }
  void cone(std::optional<SpotCone>& value) {
    if (in.get<std::uint8_t>() == 0) return;
    const double inner = in.get<double>();
    value = SpotCone{inner, in.get<double>()};
  }
  void shape(OpeningShape& value) { value = static_cast<OpeningShape>(in.get<std::uint8_t>()); }
  void text(std::string& value) { value = in.get_text(); }
  template <class T>
  void values(std::vector<T>& list) {
    list = in.get_all<T>();
  }
  template <class T, class Function>
  void list(std::vector<T>& items, Function each) {
    items.resize(in.get_count(1));
    for (T& item : items) each(item);
  }
};

template <class Stream, class Point>
void point(Stream& stream, Point& p) {
  for (int i = 0; i < 3; ++i) stream.number(p[i]);
}
template <class Stream, class SomeBox>
void box(Stream& stream, SomeBox& b) {
  point(stream, b.lo);
  point(stream, b.hi);
}

template <class Stream, class Building>
void building(Stream& stream, Building& data) {
  stream.list(data.rooms, [&](auto& room) {
    stream.text(room.name);
    stream.text(room.long_name);
    stream.text(room.storey);
    box(stream, room.box);
    stream.values(room.outline);
    stream.number(room.floor_area_m2);
    stream.number(room.required_lx);
  });
  stream.list(data.portals, [&](auto& portal) {
    stream.text(portal.kind);
    stream.text(portal.name);
    box(stream, portal.box);
    stream.number(portal.transmittance);
  });
  stream.list(data.luminaires, [&](auto& lamp) {
    stream.text(lamp.name);
    stream.text(lamp.type);
    point(stream, lamp.p);
    stream.number(lamp.flux_lm);
    point(stream, lamp.aim);
    point(stream, lamp.up);
    stream.integer(lamp.light);
  });
}

template <class Stream, class SomeScene>
void scene_parts(Stream& stream, SomeScene& scene) {
  stream.text(scene.file);
  stream.list(scene.surfaces, [&](auto& surface) {
    stream.values(surface.vertices);
    stream.values(surface.reflectance);
    stream.values(surface.exitance);
    stream.values(surface.transmittance);
    stream.text(surface.name);
    stream.text(surface.object);
    stream.distribution(surface.distribution);
    point(stream, surface.up);
  });
  stream.list(scene.lights, [&](auto& light) {
    point(stream, light.p);
    stream.values(light.intensity);
    stream.text(light.name);
    stream.distribution(light.distribution);
    for (auto* axis : {&light.frame.right, &light.frame.up, &light.frame.aim}) point(stream, *axis);
    stream.cone(light.cone);
    stream.shape(light.shape.shape);
    point(stream, light.shape.size);
  });
  building(stream, scene.building);
}

}  // namespace

std::vector<std::byte> bytes_of(const Scene& scene, const Warnings& warnings) {
  ByteWriter out;
  out.put(std::uint64_t{warnings.all().size()});
  for (const Warning& w : warnings.all()) {
    out.put_text(w.where);
    out.put_text(w.what);
  }
  out.put(std::int32_t{scene.bands});
  out.put(static_cast<std::uint8_t>(scene.unit == ExitanceUnit::lumen_per_m2));
  out.put(scene.hash);
  Writing writing{out};
  scene_parts(writing, scene);
  for (const Surface& surface : scene.surfaces)
    out.put(static_cast<std::uint8_t>(surface.two_sided));
  return out.take();
}

Scene scene_from(std::span<const std::byte> bytes, Warnings& warnings) {
  ByteReader in(bytes, "the imported scene");
  for (std::size_t left = in.get_count(1); left > 0; --left) {
    std::string where = in.get_text();
    warnings.add(std::move(where), in.get_text());
  }
  Scene scene;
  scene.bands = in.get<std::int32_t>();
  scene.unit = in.get<std::uint8_t>() != 0 ? ExitanceUnit::lumen_per_m2 : ExitanceUnit::watt_per_m2;
  scene.hash = in.get<std::uint64_t>();
  Reading reading{in};
  scene_parts(reading, scene);
  for (Surface& surface : scene.surfaces) surface.two_sided = in.get<std::uint8_t>() != 0;
  in.expect_end();
  return scene;
}

}  // namespace enfilade
