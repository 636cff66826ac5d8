// Where a rank's memory takes the clusters from that its gathers need, and where it puts those that
// they changed. The interface deals in clusters; only implementations that need bytes make them:
// files (cluster_store.hpp) and messages (schemes/master/remote_files.hpp). A recorded run
// (schemes/replay/recorded_clusters.hpp) has none.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "base/ids.hpp"

namespace enfilade {

/// While iteration k is under way, a cluster has its light as iteration k-1 committed it. Where
/// this rank may see that the cluster has been gathered for in iteration k, it has newer light as
/// well.
enum class Light { newest, committed };

/// A cluster that is about to be read as a shooter.
struct ShooterRequest {
  ClusterId cluster;
  Light light = Light::newest;
  bool geometry_known = false;  ///< read_shooter() will get the cluster of another iteration
};

/// Bytes that a cluster's sections take where they are kept in the format of files; 0 = not
/// written, or kept otherwise.
struct SectionBytes {
  std::uint64_t patches = 0, links = 0;
};

/// State: ClusterState, or RecordedCluster where a run is replayed.
template <class State>
class ClusterSource {
 public:
  virtual ~ClusterSource() = default;
  /// Makes `iteration` the committed one.
  virtual void set_committed(int iteration) = 0;
  virtual int committed() const = 0;
  /// True where the cluster has been gathered for in this iteration and this rank may read that
  /// light.
  virtual bool written(ClusterId id) const = 0;

  /// Announces the clusters that read_shooter() will be called for, in this order, so that they can
  /// be fetched at once.
  virtual void announce(std::span<const ShooterRequest>) {}
  /// Returns the cluster without its links. `known`: the same cluster as of any iteration, whose
  /// geometry is not read again; may be null. Throws RunError where the cluster cannot be read.
  virtual std::unique_ptr<State> read_shooter(ClusterId id, Light light, const State* known) = 0;
  /// Gives a cluster with its newest light the links that go with it. Throws RunError.
  virtual void read_links(State& cluster) = 0;
  /// Writes the cluster after its gather: its patches, and its links if they changed.
  virtual SectionBytes write(const State& cluster, bool links_changed) = 0;
  /// MoveToCommonDirectory of figure 2: all that was written in this iteration becomes visible to
  /// the other ranks once they call set_committed().
  virtual void move_to_common() = 0;
};

}  // namespace enfilade
