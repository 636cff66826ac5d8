// A plan as cells and clusters.
#pragma once

#include "cells/rooms/build_cells.hpp"
#include "clusters/cluster.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"

namespace enfilade::testing {

struct Building {
  CellComplex complex;
  std::vector<Cluster> clusters;
  Scene scene;

  explicit Building(const plan::Plan& plan) : scene(plan.scene()) {
    complex = build_cells(plan.pieces(), {});
    std::vector<CellPiece> parts;
    for (const Piece& piece : plan.pieces()) {
      for (CellPiece& part : complex.cut(piece)) parts.push_back(std::move(part));
    }
    clusters = build_clusters(scene, parts, {});
  }
};

}  // namespace enfilade::testing
