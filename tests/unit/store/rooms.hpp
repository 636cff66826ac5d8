// A few small clusters for the store's tests, and a machine that counts what it is charged.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "base/posix_file.hpp"
#include "hierarchy/cluster_state.hpp"
#include "machine/machine.hpp"
#include "run/sections/run_layout.hpp"
#include "store/cluster_source.hpp"

namespace enfilade::store_tests {

class CountingMachine final : public Machine {
 public:
  void compute(const WorkCount&) override {}
  void read(Disk disk, std::uint64_t, std::uint64_t bytes) override {
    (disk == Disk::common ? common_read : local_read) += bytes;
  }
  void write(Disk disk, std::uint64_t, std::uint64_t bytes) override {
    (disk == Disk::common ? common_written : local_written) += bytes;
  }
  void move_to_common(std::uint64_t, std::uint64_t) override { ++moves; }
  std::uint64_t record_bytes(const RecordCount& count) const override { return count.bytes; }
  std::uint64_t memory_bytes() const override { return 0; }
  double now_s() const override { return 0.0; }
  void pause(int) override {}
  bool time_passes_by_itself() const override { return true; }
  std::string host() const override { return "here"; }

  std::uint64_t common_read = 0, local_read = 0, common_written = 0, local_written = 0, moves = 0;
};

/// `count` unit squares side by side, one a cluster.
struct Rooms {
  Scene scene;
  std::vector<Cluster> clusters;

  explicit Rooms(std::size_t count) {
    scene.bands = 1;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = 2.0 * static_cast<double>(i);
      Surface s;
      s.vertices = {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}};
      s.reflectance = {0.5};
      s.exitance = {1.0 + static_cast<double>(i)};
      scene.surfaces.push_back(s);
      Cluster c;
      c.id = ClusterId(i);
      c.cell = CellId(0u);
      c.polygons = {{SurfaceId(i), s.vertices}};
      c.bounds = bounds(s.vertices);
      c.area_m2 = 1.0;
      clusters.push_back(c);
    }
  }
  ClusterState state(std::size_t i) const {
    return ClusterState(clusters[i], scene, Basis::constant);
  }
};

/// The rooms in memory: as committed, and as gathered for since.
class MemorySource final : public ClusterSource<ClusterState> {
 public:
  MemorySource(const Rooms& rooms, std::size_t count) : newest_(count) {
    for (std::size_t i = 0; i < count; ++i) committed_.push_back(rooms.state(i));
  }
  void set_committed(int iteration) override { iteration_ = iteration; }
  int committed() const override { return iteration_; }
  bool written(ClusterId id) const override { return newest_[id.index()].has_value(); }
  std::unique_ptr<ClusterState> read_shooter(ClusterId id, Light light,
                                             const ClusterState*) override {
    return std::make_unique<ClusterState>(kept(id, light).shooter());
  }
  void read_links(ClusterState& cluster) override {
    cluster.links() = kept(cluster.id(), Light::newest).links();
  }
  SectionBytes write(const ClusterState& cluster, bool) override {
    newest_[cluster.id().index()] = cluster;
    return {};
  }
  void move_to_common() override {
    for (std::size_t i = 0; i < newest_.size(); ++i) {
      if (newest_[i]) committed_[i] = *newest_[i];
      newest_[i].reset();
    }
  }

 private:
  const ClusterState& kept(ClusterId id, Light light) const {
    return light == Light::newest && written(id) ? *newest_[id.index()] : committed_[id.index()];
  }
  int iteration_ = 0;
  std::vector<ClusterState> committed_;
  std::vector<std::optional<ClusterState>> newest_;
};

inline RunLayout fresh_run(const std::string& name) {
  const std::string run = testing::TempDir() + "/" + name;
  remove_directory(run);
  make_directory(run + "/common");
  return RunLayout(run);
}

}  // namespace enfilade::store_tests
