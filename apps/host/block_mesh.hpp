// SPDX-License-Identifier: MIT
// A box of tetrahedra that needs no file.
#pragma once

#include <array>
#include <cstdint>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// A box with one corner at the origin, divided into cubes of six tetrahedra each around a diagonal
/// [Kuhn 1960]. `lengths`: m, above 0. `cells`: cubes along each axis, at least 1. Point (i, j, k)
/// has row i + (nx + 1) (j + (ny + 1) k). Errors: bad_shape (also for more than 50 million
/// tetrahedra). O(cells).
Result<TetMesh> block_mesh(const std::array<double, 3>& lengths,
                           const std::array<std::uint32_t, 3>& cells);

}  // namespace sunder
