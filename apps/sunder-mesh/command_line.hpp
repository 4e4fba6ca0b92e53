// SPDX-License-Identifier: GPL-3.0-or-later
// The user's request to sunder-mesh.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/sunder-mesh/solid_mesh.hpp"
#include "apps/sunder-mesh/surface.hpp"

namespace sunder {

/// Everything the command line can say. Exactly one of `surface`, `box` and `ring` is given.
struct MeshJob {
  std::filesystem::path surface;
  std::optional<std::array<double, 3>> box;
  std::optional<RingShape> ring;
  std::filesystem::path output;
  UpAxis up = UpAxis::z;
  /// m; the surface as it is when not given.
  std::optional<double> height;
  bool stand_on_ground = false;
  /// m; not given: facet is a twentieth of the surface's bounding diagonal, edge and cell equal
  /// facet, distance is a tenth of it.
  std::optional<double> edge_size, facet_size, cell_size, facet_distance;
  MeshQualityBounds bounds;
  /// Degrees; not given: 60 for boxes and rings, none for files.
  std::optional<double> feature_angle;
  std::optional<std::size_t> tetrahedra;
  int tries = 24;
  bool largest_component = false;
  std::string region = "body";
  bool json = false;
};

/// The request: a job, or the code to exit with at once (after --help, or a usage error that has
/// been printed on stderr).
struct CommandLine {
  std::optional<MeshJob> job;
  int exit_code = 0;
};

/// Reads the command line. Prints help on stdout and usage errors on stderr (exit code 2).
CommandLine read_command_line(int argc, char** argv);

}  // namespace sunder
