// SPDX-License-Identifier: MIT
// The sides to which the triangles of a surface look.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "topology/base/tet_mesh.hpp"
#include "topology/mesh/surface/edges.hpp"

namespace sunder {

/// The shell of each triangle: triangles that share an edge are of one shell, which is named by its
/// lowest triangle. O(n log n).
std::vector<std::uint32_t> shells_of(const std::vector<Triangle>& triangles);

/// Turns triangles so that those on an edge of two run along it in opposite ways, and the fewest of
/// each shell are turned. A closed shell that lies in no other one looks outward; one inside
/// another looks as it did, seen against the outer one, so that cavities stay cavities. Gives the
/// number of triangles turned. Shells with one side only (a Moebius strip) keep a seam. O(n log n).
std::size_t face_outward(const std::vector<Point>& points, std::vector<Triangle>& triangles);

/// Volume that a closed surface encloses, in the cube of the unit; negative where it looks inward.
double enclosed_volume(const std::vector<Point>& points, const std::vector<Triangle>& triangles);

}  // namespace sunder
