// SPDX-License-Identifier: MIT
// Signs of determinants of points, exact whatever the rounding.
#pragma once

#include <array>

#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// The sign of det(b - a, c - a, d - a): 1 where d lies on the side of a, b, c from which they run
/// anticlockwise, 0 where all four lie in a plane. Exact, as long as no product over- or
/// underflows. Needs: finite coordinates.
int side_of_plane(const Point& a, const Point& b, const Point& c, const Point& d);

/// The sign of det(b - a, c - a) in a plane.
int side_of_line(const std::array<double, 2>& a, const std::array<double, 2>& b,
                 const std::array<double, 2>& c);

}  // namespace sunder
