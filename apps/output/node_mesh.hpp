// SPDX-License-Identifier: MIT
// Bodies of second order as mesh files hold them: ten-node tetrahedra with columns on all nodes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fracture_settings.hpp"
#include "fracture/simulation/simulation.hpp"
#include "mechanics/state/vec3.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// Cell data of a frame: the newest crack that a tetrahedron has a side of, -1 for none, and that
/// side, 1 or -1, 0 for none. Nothing with `CrackMode::paper`.
struct CrackData {
  std::vector<std::int32_t> crack, side;
};
CrackData crack_data(const Cells& cells, CrackMode mode);

/// The bodies at their present positions, a point a node: tetrahedra of each order in a list of
/// their own, with the mesh's regions, the cell data `component` and `body`, and those of cracks.
FileMesh node_mesh(const Simulation& simulation);

/// Appends a column of the points. `values`: `components` numbers a node.
void add_node_column(FileMesh& mesh, std::string name, std::span<const double> values,
                     std::size_t components);
void add_node_column(FileMesh& mesh, std::string name, std::span<const Vec3> values);

}  // namespace sunder
