// SPDX-License-Identifier: MIT
// The state of a simulation as a file for viewers.
#pragma once

#include <filesystem>
#include <vector>

#include "fracture/simulation/simulation.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// Writes one frame as VTU: the present positions with every vertex as often as the map has it.
/// Point data: `displacement` (m, world: position minus rigid reference), `velocity` (m/s),
/// `node_stress` (Pa, world; six components XX, YY, ZZ, XY, YZ, XZ, VTK's order) and
/// `largest_principal_stress` (Pa). Cell data: `component`, `body`, `region`.
/// Bodies of second order are ten-node tetrahedra, with the point data at all nodes.
/// Node stress is averaged as the scene says (`FractureSettings::node_stress`).
/// Leaves: the whole new file, or what was there before. Errors: cannot_write.
std::vector<Finding> write_frame(const std::filesystem::path& path, const Simulation& simulation);

}  // namespace sunder
