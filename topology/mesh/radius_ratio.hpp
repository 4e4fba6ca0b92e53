// SPDX-License-Identifier: MIT
// The shape of one tetrahedron as a number.
#pragma once

#include <array>

#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// 3 r / R of a tetrahedron by its corners, m: `Quality::smallest_radius_ratio` of it alone.
double radius_ratio(const std::array<Point, 4>& corners);

}  // namespace sunder
