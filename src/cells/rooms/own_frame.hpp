// A building in its own frame and about its own middle: its cells do not depend on where it stands.
#pragma once

#include <span>
#include <vector>

#include "cells/partition/cell_complex.hpp"
#include "cells/partition/plane_set.hpp"

namespace enfilade {

/// `in` takes the scene's coordinates into the building's own, `out` takes them back.
class OwnFrame {
 public:
  OwnFrame(std::span<const Piece> pieces, const Vec3& middle)
      : axes_(dominant_frame(pieces)), middle_(middle) {}

  Vec3 in(const Vec3& p) const {
    const Vec3 q = p - middle_;
    return {glm::dot(axes_[0], q), glm::dot(axes_[1], q), glm::dot(axes_[2], q)};
  }
  Vec3 direction_out(const Vec3& q) const {
    return q.x * axes_[0] + q.y * axes_[1] + q.z * axes_[2];
  }
  Vec3 out(const Vec3& q) const { return middle_ + direction_out(q); }
  std::vector<Piece> in(std::span<const Piece> pieces) const {
    std::vector<Piece> moved(pieces.begin(), pieces.end());
    for (Piece& piece : moved) {
      for (Vec3& p : piece.polygon) p = in(p);
    }
    return moved;
  }
  std::vector<BspNode> out(std::vector<BspNode> nodes) const {
    for (BspNode& node : nodes) {
      const Vec3 n = direction_out(node.plane.n);
      node.plane = {n, node.plane.d + glm::dot(n, middle_)};
    }
    return nodes;
  }
  std::vector<Portal> out(std::vector<Portal> portals) const {
    for (Portal& portal : portals) {
      for (Vec3& p : portal.polygon) p = out(p);
    }
    return portals;
  }

 private:
  Frame axes_;
  Vec3 middle_;
};

}  // namespace enfilade
