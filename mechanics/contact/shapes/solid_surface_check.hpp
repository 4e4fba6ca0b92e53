// SPDX-License-Identifier: MIT
// Whether triangles bound a solid.
#pragma once

#include <vector>

#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder {

/// Faults of the single triangles and of their connections; see `make_solid_surface`. O(n log n).
std::vector<Finding> check_triangles(const TriangleSurface& surface);

/// Faults of a closed surface: no_volume, wrong_orientation (a shell that is turned inside out
/// against the others), self_intersection. Needs: measures and tree.
std::vector<Finding> check_solid(const SolidSurface& surface);

}  // namespace sunder
