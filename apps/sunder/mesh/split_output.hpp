// SPDX-License-Identifier: MIT
// The files of `sunder split -o OUT`: the cut mesh, and a list of the cuts that the mesh cannot
// express.
#pragma once

#include <filesystem>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// A body that was read from a file and cut.
struct CutBody {
  const TetMesh& file;
  const VolumeMap& map;
  const Components& components;
};

/// The body as it is cut now: the file's points in their rows, then one more for each further
/// vertex there; region = component + 1; source numbers of points lead back to the file.
TetMesh cut_mesh(const CutBody& body);

/// Where the list of cuts that `output` cannot express stands: its name with ".cuts" after it.
std::filesystem::path cuts_beside(const std::filesystem::path& output);

/// Writes the cut mesh and, when it has cuts between faces with the same three points, their list:
/// three rows of its points per line, as `--faces` takes them, below a line that describes it.
/// When it has none, a list that an earlier run left there is removed (known by its first line;
/// any other file of that name stays).
/// Each file is there whole or not at all. Findings: those of write_mesh, regions_replaced,
/// cuts_beside (notes), cannot_write.
std::vector<Finding> write_cut_body(const std::filesystem::path& output, const CutBody& body);

}  // namespace sunder
