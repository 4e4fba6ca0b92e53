// SPDX-License-Identifier: MIT
// The common part of `sunder refine` and `sunder cut`: a mesh with its map, before and after.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "apps/sunder/exit_code.hpp"
#include "apps/sunder/telling.hpp"
#include "topology/cells/file_cells.hpp"
#include "topology/mesh/check.hpp"

namespace sunder {

/// A mesh as it is at one moment.
struct MeshState {
  /// Points, edges, triangles, tetrahedra.
  std::array<std::size_t, 4> sizes;
  MeshCheck check;
};

/// A mesh file with the map of it, to be divided.
struct DividedMesh {
  FileMesh mesh;
  VolumeMap map;
  std::vector<Finding> findings;
  MeshState before;
};

/// Reads the mesh and builds its map. With errors among the findings there is no value.
Result<DividedMesh> read_to_divide(const std::filesystem::path& in, MapKernel kernel);

/// The arguments that both commands have.
struct DivideArguments : Telling {
  std::filesystem::path in, out;
  MapKernel kernel = MapKernel::dense;
  /// Names of columns that are divided by volume: "a,b".
  std::string shared;
};

void add_divide_arguments(CLI::App& command, DivideArguments& arguments);

/// The names in `arguments.shared`; an error for one that is no column of fractions of tetrahedra.
Result<std::set<std::string>> shared_columns(const DivideArguments& arguments,
                                             const FileMesh& mesh);

/// Writes the mesh and prints counts and shapes before and after, `lines` or `json` of the command
/// below them, and the findings.
ExitCode finish(const DivideArguments& arguments, DividedMesh& body, const std::string& lines,
                const nlohmann::ordered_json& json);

/// Prints the findings, and as JSON when that was asked for; gives `code`.
ExitCode refuse(const DivideArguments& arguments, const std::vector<Finding>& findings,
                ExitCode code);

}  // namespace sunder
