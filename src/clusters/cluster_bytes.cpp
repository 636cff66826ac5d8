// Clusters as bytes, and back.
#include "base/byte_stream.hpp"
#include "clusters/cluster.hpp"

namespace enfilade {
namespace {

constexpr std::string_view mark = "enfilade-clusters-4";

}  // namespace

std::string to_bytes(std::span<const Cluster> clusters) {
  ByteWriter out;
  out.put_mark(mark);
  out.put(static_cast<std::uint64_t>(clusters.size()));
  for (const Cluster& cluster : clusters) {
    out.put(cluster.cell.value);
    out.put(cluster.area_m2);
    out.put(cluster.bounds.lo);
    out.put(cluster.bounds.hi);
    out.put_text(cluster.object);
    out.put(static_cast<std::uint64_t>(cluster.polygons.size()));
    for (const ClusterPolygon& polygon : cluster.polygons) {
      out.put(polygon.surface.value);
      out.put_all<std::uint32_t>(polygon.polygon);
      out.put(static_cast<std::uint8_t>((polygon.pane ? 1 : 0) + (polygon.reversed ? 2 : 0) +
                                        (polygon.walked_dark ? 4 : 0)));
      if (polygon.pane) out.put_all<std::uint32_t>(polygon.transmittance);
      out.put(static_cast<std::uint32_t>(polygon.contacts.size()));
      for (const Segment& contact : polygon.contacts) {
        out.put(contact.a);
        out.put(contact.b);
      }
    }
  }
  return out.text();
}

std::vector<Cluster> clusters_from_bytes(std::string_view bytes) {
  ByteReader in(bytes, "clusters");
  in.expect(mark);
  std::vector<Cluster> clusters(in.get_count(sizeof(Vec3)));
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    Cluster& cluster = clusters[i];
    cluster.id = ClusterId(i);
    cluster.cell = CellId(in.get<std::uint32_t>());
    cluster.area_m2 = in.get<double>();
    cluster.bounds.lo = in.get<Vec3>();
    cluster.bounds.hi = in.get<Vec3>();
    cluster.object = in.get_text();
    cluster.polygons.resize(in.get_count(sizeof(std::uint64_t)));
    for (ClusterPolygon& polygon : cluster.polygons) {
      polygon.surface = SurfaceId(in.get<std::uint32_t>());
      polygon.polygon = in.get_all<Vec3, std::uint32_t>();
      const auto kind = in.get<std::uint8_t>();
      polygon.pane = (kind & 1u) != 0;
      polygon.reversed = (kind & 2u) != 0;
      polygon.walked_dark = (kind & 4u) != 0;
      if (polygon.pane) polygon.transmittance = in.get_all<double, std::uint32_t>();
      polygon.contacts.resize(in.get_count<std::uint32_t>(2 * sizeof(Vec3)));
      for (Segment& contact : polygon.contacts) {
        contact.a = in.get<Vec3>();
        contact.b = in.get<Vec3>();
      }
    }
  }
  in.expect_end();
  return clusters;
}

}  // namespace enfilade
