// SPDX-License-Identifier: MIT
// Which side of a plane a tetrahedron is on: one rule with one tolerance for runs, `sunder split`,
// `sunder convert --crack-plane` and fixtures (docs/reference/suite.md). No map here.
#pragma once

#include <array>
#include <optional>

#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// Directions, and distances relative to a tetrahedron's size, count as equal within this: far
/// above what solvers leave in an eigenvector (1e-9), far below anything a mesh resolves.
inline constexpr double equal_directions = 1e-6;

/// A plane {x : normal . x = offset}, m; the normal need not have unit length.
struct CuttingPlane {
  Point normal;
  double offset = 0;
};

/// A plane by a point of it, m, and its normal, of any length but 0.
struct PlaneThrough {
  Point at;
  Point normal;
};

/// The canonical one of the two directions `n` and `-n`: the component of largest magnitude is
/// positive, the lowest axis where magnitudes are equal to `equal_directions`. `octant`: signs (+1
/// or -1) that the components are multiplied with before they are looked at.
/// Needs: finite, not zero. The length is kept.
Point canonical_direction(const Point& n, const Point& octant = {1, 1, 1});

/// The canonical direction of a normal as users give it, with a largest component of magnitude 1,
/// so that no square over- or underflows. Nothing when it is zero or not finite.
std::optional<Point> read_direction(const Point& normal);

/// A user's plane by its point nearest to the origin and its canonical direction. Nothing when the
/// normal is zero or not finite, or the offset is not finite.
std::optional<PlaneThrough> read_plane(const CuttingPlane& plane);

/// Side of a plane; `on` counts as positive wherever there are but two.
enum class PlaneSide { negative, on, positive };

/// The centre of a tetrahedron as seen from a point of the plane.
struct CentreOffset {
  Point away;            ///< m, from the point to the centre
  double tolerance = 0;  ///< m: a plane that passes nearer to the centre holds it
};

/// `corners`: rest positions of a tetrahedron, m. The tolerance is 1e-6 of the tetrahedron's radius
/// (from its centre to the farthest corner) and 8 roundings of the largest magnitude among the
/// coordinates of `at` and the corners: it depends on the tetrahedron alone, not on which point of
/// the plane is given, nor, to rounding, on where the body lies.
CentreOffset centre_offset(const std::array<Point, 4>& corners, const Point& at);

/// The side that the centre is on (algorithm 4: getSign(center(t), plane(v, u))): `on` when its
/// distance from the plane is within the tolerance. `normal` of any length but 0.
PlaneSide plane_side(const Point& normal, const CentreOffset& centre);

/// Whether a tetrahedron counts as positive: its centre is on the side of the normal, or on the
/// plane.
bool is_positive(const PlaneThrough& plane, const std::array<Point, 4>& corners);

}  // namespace sunder
