// x = b + M x in blocks, solved by the SPMD loop: the group iteration of §3.3.2 and §8 with a known
// answer. The blocks' values live in cluster files like patches do.
#pragma once

#include <functional>
#include <vector>

#include "run/manifest.hpp"
#include "schemes/protocol/cluster_work.hpp"
#include "store/cluster_store.hpp"
#include "visibility/cluster_graph.hpp"

namespace enfilade::spmd_tests {

/// M is not negative, with row sums of `reflectance`, and couples the blocks that see each other.
struct LinearSystem {
  std::size_t blocks, block_size;
  std::vector<double> matrix;  ///< row by row
  std::vector<double> b;
  ClusterGraph graph;

  LinearSystem(std::size_t blocks, std::size_t block_size, double reflectance, std::uint64_t seed);
  std::size_t size() const { return b.size(); }
  double m(std::size_t i, std::size_t j) const { return matrix[i * size() + j]; }
  /// By Gaussian elimination of I - M.
  std::vector<double> solve_directly() const;
};

class LinearSystemWork final : public ClusterWork {
 public:
  /// `labour` is called with the cluster before each gather: what makes it long or short.
  using Labour = std::function<void(ClusterId)>;
  LinearSystemWork(const LinearSystem& system, const RunLayout& layout, Rank rank, Machine& machine,
                   Labour labour);

  /// x = b, in the files of the state before the first iteration. On rank 0.
  void initialise();
  void begin(const IterationPlan& plan, std::span<const double>) override {
    store_.set_committed(plan.iteration - 1);
  }
  IterationFigures gather(ClusterId receiver) override;
  std::vector<ClusterId> resident() const override { return gathered_; }
  void move_to_common() override { store_.move_to_common(); }
  void commit(const std::vector<IterationSummary>& history, std::span<const double> changes,
              bool finished) override;

  /// All of x as it was committed.
  static std::vector<double> committed(const LinearSystem& system, const RunLayout& layout);
  /// The clusters that this rank has gathered for, in order.
  const std::vector<ClusterId>& gathered() const { return gathered_; }

 private:
  std::vector<double> values(ClusterId id);

  const LinearSystem& system_;
  RunLayout layout_;
  Machine& machine_;
  ClusterStore store_;
  Labour labour_;
  std::vector<ClusterId> gathered_;
};

}  // namespace enfilade::spmd_tests
