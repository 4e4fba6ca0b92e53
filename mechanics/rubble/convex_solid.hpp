// SPDX-License-Identifier: MIT
// Bodies of many tetrahedra that are one small convex solid: bricks, boxes, prisms.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "mechanics/contact/shapes/polytope.hpp"

namespace sunder {

/// The solid that triangles enclose, seen from outside counter-clockwise, if it is convex and has
/// at most six faces of at most four corners; else nothing. Points within `tolerance` (m) of the
/// plane of a face lie in it. Triangles that close no surface may give a solid all the same.
/// O(triangles); it returns at once if there are more faces.
std::optional<ConvexSolid> find_convex_solid(std::span<const std::array<Vec3, 3>> triangles,
                                             double tolerance);

}  // namespace sunder
