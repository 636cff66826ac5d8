// The bytes of a cluster's sections: how its hierarchy, its aggregates and its links are written
// field by field, and read.
#pragma once

#include <cstddef>

#include "base/byte_stream.hpp"
#include "hierarchy/aggregates.hpp"
#include "hierarchy/link.hpp"
#include "hierarchy/patch_forest.hpp"

namespace enfilade {

/// Writes and reads the private parts of the solver's structures. All numbers have a fixed width
/// (u8, u32, u64, i32, f32, f64; f64 is IEEE 754) and lie in little-endian order without padding. A
/// list is its length (u64), then its elements. The functions that read throw RunError where the
/// bytes are not such a section.
///
///     geometry  cluster u32, cell u32, basis u8 (by ClusterState); bands, lead bands, terms i32
///               polygons: surface u32; origin, u, v, n 3 f64 each; reflectance, exitance (lists of
///                 f64); mesh lines (list of 4 f64)
///               outline of each polygon: root u32, path u32, vertices (list of 2 f64)
///               groups (list): left, right i32; begin, end u32; bounds 6 f64; area_m2 f64
///               order (list of u32)
///               aggregates (list): root, path u32; area_m2 f64
///               their ranges by polygon (list): begin, end u32
///     patches   iteration i32 (by ClusterState)
///               parents of the split nodes in the order of the splits (list of u32): shapes follow
///                 by the same cuts
///               radiosity, irradiance, deviation, kept light (lists of f64),
///               enclosed share (list of f32), lit polygons when that was measured u32, unreachable
///               (list of u8)
///     links     transport coefficients per link u64
///               links (list): shooter's cluster u32; shooter, receiver: root, path u32 each;
///                 shooter's x, y, error, variation f32; flags u8 (1 evaluated, 2 finest);
///                 visibility uncertainty u8
///               transport (list of f32)
class ClusterCodec {
 public:
  static void write_geometry(const PatchForest& forest, ByteWriter& w);
  static PatchForest read_geometry(ByteReader& r);

  static void write_aggregates(const Aggregates& aggregates, ByteWriter& w);
  static Aggregates read_aggregates(ByteReader& r);

  static void write_patches(const PatchForest& forest, ByteWriter& w);
  /// `forest`: as read_geometry returned it.
  static void read_patches(PatchForest& forest, ByteReader& r);

  static void write_links(const LinkSet& links, ByteWriter& w);
  /// `stride`: transport coefficients per link, by the basis.
  static LinkSet read_links(ByteReader& r, std::size_t stride);

  /// Returns roughly the number of bytes that write_patches and write_links produce, to be
  /// reserved.
  static std::size_t patches_bytes(const PatchForest& forest);
  static std::size_t links_bytes(const LinkSet& links);
};

}  // namespace enfilade
