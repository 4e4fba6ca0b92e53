// SPDX-License-Identifier: MIT
// What is wrong with a mesh as a file gave it: every finding, and never a crash.
#pragma once

#include <vector>

#include "topology/finding.hpp"
#include "topology/tet_mesh.hpp"

namespace sunder {

/// Everything found in a mesh, errors first, then in the order of the table below; never only the
/// first. Safe on any contents: no number is used as a row before its range was checked.
///
/// | code | severity | ids |
/// |---|---|---|
/// | empty_mesh, no_tetrahedron, column_length, too_large | error | - |
/// | index_out_of_range, repeated_vertex | error | tetrahedra |
/// | nan_coordinate (infinite ones too) | error | points |
/// | duplicate_tetrahedron, mirrored_tetrahedron | error | tetrahedra, the later of each pair |
/// | overfull_face: in more than two tetrahedra | error | 3 points, then its tetrahedra |
/// | non_orientable: neighbours that cannot be oriented alike | error | tetrahedra |
/// | flat_tetrahedron: no volume beyond rounding | `bad_volume` | tetrahedra |
/// | folded_tetrahedron: turned inside out against its neighbours | `bad_volume` | tetrahedra |
/// | inverted_tetrahedron: re-oriented on building | warning | tetrahedra |
/// | pinched_vertex, pinched_edge: several orbits | note | points; pairs of points |
/// | unused_point, coincident_points | note | points |
///
/// `bad_volume`: error for those who compute with volumes, warning for those who only need the map.
/// Cost: about 0.5 us a tetrahedron.
std::vector<Finding> check_mesh(const TetMesh& mesh, Severity bad_volume = Severity::error);

}  // namespace sunder
