// SPDX-License-Identifier: MIT
// Faulty surfaces made into one that bounds a body, with the changes.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/mesh/file_mesh.hpp"
#include "topology/mesh/surface/surface_check.hpp"

namespace sunder {

/// How far a surface is repaired.
enum class Mending {
  none,   ///< not at all: each fault is refused
  small,  ///< seams, doubled and turned faces, small holes; shells that cross are joined
  wrap,   ///< whatever is left open or crosses is wrapped into a surface around it
};

/// Holes up to this share of the longest side are closed without being asked.
inline constexpr double small_hole = 0.3;

/// A surface that bounds a body, in the unit of the file.
struct Mended {
  FileMesh surface;
  double volume = 0;  ///< that it encloses; 0 where some faces look inward
};

/// Repairs a surface of triangles as far as `mending` allows. `sunder-repair` joins and wraps,
/// where it is in the folder of this program or in PATH. Notes: repaired (all changes, the largest
/// distance and the change of volume), several_parts. Errors, each with place and remedy: no_faces,
/// open_surface, nonmanifold_surface, self_intersection, no_volume.
Result<Mended> mend(FileMesh surface, Mending mending);

/// A surface around a closed one that no mesher fills, by sunder-repair. Findings as of `mend`, and
/// no_repairer, not_repaired.
Result<Mended> wrapped(const FileMesh& surface);

}  // namespace sunder
