// A cluster as the solver holds it: its polygons, its hierarchy of patches with their light, and
// its links.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "clusters/cluster.hpp"
#include "hierarchy/aggregates.hpp"
#include "hierarchy/link.hpp"
#include "hierarchy/patch_forest.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Radiosity over a patch: one number per band (constant), or an affine function (linear).
enum class Basis : std::uint8_t { constant = 1, linear = 3 };

/// The sections of a cluster, each a file of its own: other ranks need the first two, its owner all
/// three (§4.1, §4.3). Geometry never changes, links change only where they are refined, patches in
/// every iteration.
enum class Section : std::uint8_t { geometry = 0, patches = 1, links = 2 };

/// A cluster's patches with their light, its aggregates and its links.
class ClusterState {
 public:
  /// Makes a fresh cluster: one patch per polygon, radiosity = exitance, no links yet. The coarse
  /// system has at most `aggregates` unknowns for it.
  ClusterState(const Cluster& cluster, const Scene& scene, Basis basis, std::size_t aggregates = 1);
  /// Reads a cluster from the sections of its file, as bytes_of returned them (layout:
  /// cluster_codec.hpp); `links` may be empty for a cluster that only shoots. Throws RunError where
  /// the bytes are not such sections.
  ClusterState(std::span<const std::byte> geometry, std::span<const std::byte> patches,
               std::span<const std::byte> links);

  /// Returns a copy without the links: all that other receivers need.
  ClusterState shooter() const;
  /// Gives back the memory that growing vectors have reserved.
  void shrink();
  /// Applies a coarse correction: the relative change of its light, [aggregate * bands + band].
  void correct(std::span<const double> changes);
  /// Returns the iteration in which it was last the receiving cluster; 0 = never.
  int iteration() const { return iteration_; }
  void set_iteration(int iteration) { iteration_ = iteration; }

  /// Returns the bytes of one section of its file.
  std::vector<std::byte> bytes_of(Section section) const;
  /// Returns the bytes in memory, of the object and on the heap.
  std::size_t memory_bytes() const;

  ClusterId id() const { return id_; }
  CellId cell() const { return cell_; }
  int bands() const { return bands_; }
  Basis basis() const { return basis_; }
  const PatchForest& patches() const { return patches_; }
  PatchForest& patches() { return patches_; }
  const Aggregates& aggregates() const { return aggregates_; }
  const LinkSet& links() const { return links_; }
  LinkSet& links() { return links_; }

 private:
  ClusterState() = default;

  ClusterId id_;
  CellId cell_;
  int bands_ = 1;
  int iteration_ = 0;
  Basis basis_ = Basis::linear;
  PatchForest patches_;
  Aggregates aggregates_;
  LinkSet links_;
};

}  // namespace enfilade
