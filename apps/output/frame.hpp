// SPDX-License-Identifier: MIT
// The state of a simulation as a file for viewers.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "fracture/simulation/simulation.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// Writes one frame as VTU: the present positions, with split vertices as separate points. Point
/// data: `displacement` (m, world: position minus rigid reference), `velocity` (m/s), `node_stress`
/// (Pa, world; six components XX, YY, ZZ, XY, YZ, XZ, VTK's order) and `largest_principal_stress`
/// (Pa). Cell data: `component`, `body`, `region`. Bodies of second order are ten-node tetrahedra,
/// with the point data at all nodes. The scene chooses the averaging of node stress
/// (`FractureSettings::node_stress`). `moves`: those of `smooth_crack_moves` (m, rest, row =
/// point), which become the point data `crack_move` (m, world); empty: no such column. After an
/// error an older file stays as it was. Errors: cannot_write.
std::vector<Finding> write_frame(const std::filesystem::path& path, const Simulation& simulation,
                                 std::span<const Vec3> moves = {});

}  // namespace sunder
