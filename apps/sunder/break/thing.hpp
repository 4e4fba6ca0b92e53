// SPDX-License-Identifier: MIT
// The object that `sunder break` breaks: a file of a surface or of tetrahedra, judged.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/sunder/break/mend.hpp"
#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// A file as it was read, in its own unit. Either there are tetrahedra, or a closed surface.
struct Thing {
  TetMesh solid;
  /// Triangles alone; points at one place are one.
  FileMesh surface;
  /// Volume that the surface encloses, in the file's unit.
  double volume = 0;

  bool is_solid() const { return !solid.tetrahedra.empty(); }
};

/// Reads any file of a surface or a body. Coincident points of a surface become one, triangles
/// without area are dropped, and the rest is repaired as far as `mending` allows. Errors, each with
/// a remedy: those of `read_file_mesh`, `check_mesh` and `mend`.
Result<Thing> read_thing(const std::filesystem::path& path, Mending mending = Mending::small);

/// The longest side of the box around the thing, in the file's unit.
double longest_side(const Thing& thing);

/// Metres per unit of the file, and a note where that is a guess.
struct ThingScale {
  double metres = 1;
  std::optional<Finding> guess;
};

/// The scale that makes the longest side `size` m, else that of `units` (a name of a length unit),
/// else a guess: a longest side above 3 is taken as millimetres, a smaller one as metres.
ThingScale scale_of(const Thing& thing, std::optional<double> size, const std::string& units,
                    const std::string& file);

}  // namespace sunder
