// SPDX-License-Identifier: MIT
// The depth of a tetrahedron in another and in an obstacle, by separating axes.
#pragma once

#include <array>

#include "mechanics/contact/shapes/obstacle.hpp"

namespace sunder::test {

/// The four corners of a tetrahedron, m, of either orientation.
using TetCorners = std::array<Vec3, 4>;
inline constexpr std::array<std::array<int, 2>, 6> tet_edges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
inline const Vec3& corner(const TetCorners& t, int k) { return t[static_cast<std::size_t>(k)]; }

/// m: the shortest way that parts two tetrahedra, by the axes of faces and of pairs of edges;
/// negative: they are apart by at least so much.
double overlap(const TetCorners& a, const TetCorners& b);

/// m: the shortest way that parts a tetrahedron from a shape; negative: apart. Exact for spheres,
/// planes and boxes. For a solid of triangles it is the depth of the corners of each in the other;
/// edges that cross with all corners outside are not seen.
double overlap(const TetCorners& a, const Shape& shape);

}  // namespace sunder::test
