// SPDX-License-Identifier: MIT
// Units and scale of a mesh that `sunder convert` writes in metres.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "apps/scene/reading/length_unit.hpp"
#include "topology/base/finding.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

struct ScaleOptions {
  LengthUnit units = LengthUnit::m;
  double scale = 1;
};

/// Adds `--units` and `--scale`.
void add_scale_options(CLI::App& command, ScaleOptions& options);

/// Gives the points in metres. Data of points and cells stay. A note where anything changes; the
/// error out_of_range where a coordinate would not be finite.
std::optional<Finding> scale_points(FileMesh& mesh, const ScaleOptions& options);

}  // namespace sunder
