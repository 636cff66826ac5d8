// An R-tree of boxes: which of them touch a given box.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes = {});
  ~BoxTree();
  BoxTree(BoxTree&&) noexcept;
  BoxTree& operator=(BoxTree&&) noexcept;

  /// Adds a box, whose index is the number of boxes before it.
  void add(const Box& box);

  /// Returns the indices, in ascending order, of the boxes that touch `box` grown by `margin_m` on
  /// all sides.
  std::vector<std::uint32_t> touching(const Box& box, double margin_m) const;
  /// Returns the indices of the `count` boxes nearest to a point, the nearest first. Of
  /// several that are as near as the last one, any may be left out.
  std::vector<std::uint32_t> nearest(const Vec3& p, std::size_t count) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace enfilade
