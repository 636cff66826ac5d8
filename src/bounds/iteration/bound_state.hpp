// What the iteration for bounds holds: the tree, the rows, the light.
#pragma once

#include <functional>
#include <vector>

#include "bounds/factors/group_sight.hpp"
#include "bounds/factors/pair_factor.hpp"
#include "bounds/iteration/bound_irradiance.hpp"
#include "bounds/iteration/bound_panes.hpp"
#include "bounds/iteration/bound_tree.hpp"
#include "bounds/iteration/row_bounds.hpp"

namespace enfilade {

/// A leaf's row, and its direct light.
struct Receiver {
  std::uint32_t node = 0;
  std::vector<BoundLink> links;
  std::vector<BoundWall> walls;          ///< polygons of which the row has several parts
  std::vector<LightRange> direct;        ///< per band
  std::vector<RowReference> references;  ///< per band
};

class BoundState {
 public:
  BoundState(const BoundScene& scene, int threads);

  const BoundScene& scene() const { return scene_; }
  const BoundTree& tree() const { return tree_; }
  std::vector<Receiver>& receivers() { return receivers_; }
  const std::vector<Receiver>& receivers() const { return receivers_; }
  std::size_t links() const;
  int threads() const { return threads_; }
  bool closed(std::uint32_t polygon) const { return closed_[polygon] != 0; }
  std::size_t closed_polygons() const;
  bool lights_enclosed() const { return lights_enclosed_; }

  const LightRange& irradiance(std::uint32_t node, std::size_t band) const {
    return irradiance_[node * scene_.bands + band];
  }
  const LightRange& radiosity(std::uint32_t node, std::size_t band) const {
    return radiosity_[node * scene_.bands + band];
  }
  const std::vector<LightRange>& radiosities() const { return radiosity_; }

  /// Bounds of the light from a node on a leaf; `known_open` as in PairFactors.
  PairFactor factor(std::uint32_t leaf, std::uint32_t shooter, bool known_open) const;
  /// Cuts a receiver's leaf in two; its number becomes that of the first half, and the second half
  /// is appended. The new rows have no links yet; their bounds are those of the whole.
  void split_receiver(std::size_t receiver);

  /// One step of the iteration: new bounds from all rows, intersected with the old. `step` is that
  /// of the rows' reference radiosities (row_bounds.hpp).
  void sweep(double step);
  /// The sum over receivers and bands of area times the widths of the irradiance's mean and of its
  /// range at points.
  double total_width() const;
  /// Tries to take a part of all further steps at once: a box of light that one step maps into
  /// itself holds the solution (Banach; as in interval Newton methods). Returns true where it did.
  bool leap(double step);

 private:
  std::vector<LightRange> of_receivers() const;
  std::vector<LightRange> step_of_all_rows(double step);
  void set_leaves(const std::vector<LightRange>& of_receivers);
  void pull();
  void set_direct(Receiver& receiver) const;
  void start_with_global_bounds();

  const BoundScene& scene_;
  int threads_;
  std::vector<Polygon> polygons_;
  BoundPanes panes_;
  PairFactors factors_;
  GroupSight groups_;
  BoundTree tree_;
  std::vector<char> closed_;
  bool lights_enclosed_ = false;
  std::vector<Receiver> receivers_;
  std::vector<LightRange> irradiance_, radiosity_;  ///< [node * bands + band]
  std::vector<LightRange> before_;  ///< irradiance of the receivers before the last sweep
  double change_ = 0.0, change_before_ = 0.0;
};

/// Calls work(i) for i = 0 .. count - 1 on all threads.
void for_all(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

}  // namespace enfilade
