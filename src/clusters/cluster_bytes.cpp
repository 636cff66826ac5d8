// The clusters as bytes.
#include "cells/byte_stream.hpp"
#include "clusters/cluster.hpp"

namespace enfilade {
namespace {

constexpr std::string_view mark = "enfilade-clusters-1";

}  // namespace

std::string to_bytes(std::span<const Cluster> clusters) {
  ByteWriter out;
  for (const char c : mark) out.put(c);
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
      out.put_polygon(polygon.polygon);
    }
  }
  return out.take();
}

std::vector<Cluster> clusters_from_bytes(std::string_view bytes) {
  ByteReader in(bytes, "clusters");
  in.expect(mark);
  std::vector<Cluster> clusters(in.count<Vec3>(in.get<std::uint64_t>()));
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    Cluster& cluster = clusters[i];
    cluster.id = ClusterId(i);
    cluster.cell = CellId(in.get<std::uint32_t>());
    cluster.area_m2 = in.get<double>();
    cluster.bounds.lo = in.get<Vec3>();
    cluster.bounds.hi = in.get<Vec3>();
    cluster.object = in.get_text();
    cluster.polygons.resize(in.count<std::uint64_t>(in.get<std::uint64_t>()));
    for (ClusterPolygon& polygon : cluster.polygons) {
      polygon.surface = SurfaceId(in.get<std::uint32_t>());
      polygon.polygon = in.get_polygon();
    }
  }
  in.expect_end();
  return clusters;
}

}  // namespace enfilade
