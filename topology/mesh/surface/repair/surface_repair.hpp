// SPDX-License-Identifier: MIT
// Small faults of a surface that is to bound a body, repaired: seams, doubled and turned faces,
// small holes.
#pragma once

#include <cstddef>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/mesh/file_mesh.hpp"
#include "topology/mesh/surface/repair/stitch.hpp"
#include "topology/mesh/surface/repair/walls.hpp"

namespace sunder {

/// The changes of a repair.
struct SurfaceRepair {
  Stitching stitching;
  Walls walls;
  std::size_t turned = 0;      ///< triangles
  std::size_t holes = 0;       ///< that were closed
  std::size_t cover = 0;       ///< triangles that close them
  double widest_hole = 0;      ///< of those, the unit of the points
  std::size_t wide_holes = 0;  ///< that were left: wider than allowed, or no cover found
  double widest_left = 0;      ///< of those
  Point place_left{};          ///< middle of the widest hole that was left

  bool changed() const {
    return stitching.points + stitching.sides + walls.doubled + walls.inner + turned + holes > 0;
  }
};

/// Repairs triangles in place. `widest`: the widest hole to be closed, in the unit of the points.
/// Needs: a mesh of points and triangles with an area, no columns. Leaves points without triangles
/// out.
SurfaceRepair repair_surface(FileMesh& surface, double widest);

/// The words for it: "3 holes closed, 12 faces turned"; lengths are in `unit` (m) each.
std::vector<std::string> repair_words(const SurfaceRepair& repair);

}  // namespace sunder
