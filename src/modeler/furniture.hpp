// Furniture: what each kind looks like, standing at the origin of a frame.
#pragma once

#include "modeler/shapes.hpp"

namespace enfilade {

/// How long and how deep (x, y) the place is that a piece takes up, from its frame's origin; a
/// round one stands around it.
Vec2 footprint_m(FurnitureKind kind);

/// Adds a piece of furniture. Its parts keep a gap from each other and stand on glides: where
/// polygons lie on each other, light reaches no more than a part of each, and the floor would have
/// to be cut around every foot.
/// `variant` chooses cloth and wood. The frame's y points to its user (a chair's sitter looks
/// along y; a shelf's back is at y = 0), its z is the floor, the desk's top or the ceiling.
void add_furniture(SurfaceSink& sink, FurnitureKind kind, const Frame& frame, unsigned variant);

constexpr double desk_height_m = 0.73;
/// How many polygons of a kind there are; one of them emits where the kind is a light.
int surfaces_of(FurnitureKind kind);
bool is_light(FurnitureKind kind);

}  // namespace enfilade
