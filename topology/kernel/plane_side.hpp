// SPDX-License-Identifier: MIT
// Which side of a plane a tetrahedron is on: one rule with one tolerance for runs, `sunder split`,
// `sunder convert --crack-plane` and fixtures (docs/reference/suite.md). No map here.
#pragma once

#include <array>
#include <optional>

#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// Tolerance within which directions, and distances relative to a tetrahedron's size, count as
/// equal. It is far above the error of an eigenvector (1e-9) and far below the resolution of a
/// mesh.
inline constexpr double equal_directions = 1e-6;

/// A plane {x : normal . x = offset}, m; the normal need not have unit length.
struct CuttingPlane {
  Point normal;
  double offset = 0;
};

/// A plane by one of its points, m, and its normal, of any length but 0.
struct PlaneThrough {
  Point at;
  Point normal;
};

/// The canonical one of the two directions `n` and `-n`: its component of largest magnitude is
/// positive. Among magnitudes equal within `equal_directions` the lowest axis decides. `octant`:
/// signs (+1 or -1) that multiply the components before the comparison. Requires: finite, not zero.
/// The length is kept.
Point canonical_direction(const Point& n, const Point& octant = {1, 1, 1});

/// The canonical direction of a user's normal, scaled to a largest component of magnitude 1, so
/// that no square over- or underflows. Empty if the normal is zero or not finite.
std::optional<Point> read_direction(const Point& normal);

/// A user's plane by its point nearest to the origin and its canonical direction. Empty if the
/// normal is zero or not finite, or the offset is not finite.
std::optional<PlaneThrough> read_plane(const CuttingPlane& plane);

/// Side of a plane; `on` counts as positive where only two sides exist.
enum class PlaneSide { negative, on, positive };

/// The centre of a tetrahedron as seen from a point of the plane.
struct CentreOffset {
  Point away;            ///< m, from the point to the centre
  double tolerance = 0;  ///< m; a plane nearer to the centre than this contains it
};

/// `corners`: rest positions of a tetrahedron, m. The tolerance is 1e-6 of the tetrahedron's radius
/// (from its centre to the farthest corner) and 8 roundings of the largest magnitude among the
/// coordinates of `at` and the corners: it depends on the tetrahedron alone. The choice of the
/// plane's point has no effect, nor, up to rounding, the position of the body.
CentreOffset centre_offset(const std::array<Point, 4>& corners, const Point& at);

/// The side of the centre (algorithm 4: getSign(center(t), plane(v, u))): `on` if its distance from
/// the plane is within the tolerance. `normal` has any length but 0.
PlaneSide plane_side(const Point& normal, const CentreOffset& centre);

/// True if the tetrahedron counts as positive: its centre is on the side of the normal, or on the
/// plane.
bool is_positive(const PlaneThrough& plane, const std::array<Point, 4>& corners);

}  // namespace sunder
