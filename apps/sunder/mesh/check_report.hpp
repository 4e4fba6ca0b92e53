// SPDX-License-Identifier: MIT
// The results of `sunder check` for a mesh, and how they are printed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "topology/mesh/check.hpp"
#include "topology/mesh/surface/surface_check.hpp"
#include "topology/suite/homology/homology.hpp"

namespace sunder {

/// The results for a mesh.
struct CheckReport {
  /// Of the file, of its mesh, and of writing the cells that they name.
  std::vector<Finding> findings;
  /// Whether the file holds a mesh of tetrahedra, or a surface.
  bool is_read = false;
  /// Of a mesh of faces without a body; then there are neither counts nor quality.
  std::optional<SurfaceCheck> surface;
  /// Of a body.
  std::optional<Extent> extent;
  /// kg/m^3
  std::optional<double> density;
  std::size_t points = 0, tetrahedra = 0;
  std::optional<Counts> counts;
  std::optional<Quality> quality;
  /// Where the body may not lie in space, so that its sheets do not tell its Betti numbers.
  std::optional<suite::IntegerHomology> homology;
  /// Where the cells that findings name were to go; empty when nobody asked.
  std::filesystem::path findings_file;
  /// How many cells were written there.
  std::size_t cells_written = 0;
};

/// The object that `--json` prints of a mesh, keys as docs/reference/checks.md has them.
nlohmann::ordered_json report_json(const CheckReport& report);
void print_table(const CheckReport& report);

}  // namespace sunder
