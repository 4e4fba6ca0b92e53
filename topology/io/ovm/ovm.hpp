// SPDX-License-Identifier: MIT
// Internal to topology/io: OpenVolumeMesh's text format (.ovm).
#pragma once

#include <string>
#include <string_view>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Whether a file begins like OpenVolumeMesh's: with the word OVM.
bool is_ovm(std::string_view text);

/// Reads vertices, edges, faces, polyhedra and properties. Throws ReadFailure.
///
/// Half-edge 2e is edge e from its first to its second vertex, 2e + 1 the other way; half-face 2f
/// is face f as it is listed, 2f + 1 the other way round. A polyhedron of four triangles is a
/// tetrahedron: the vertices of its first half-face, in their order, then the one that is left. So
/// half-faces look inward where the volume is positive, as in OpenVolumeMesh's own meshes. Six
/// quadrilaterals are a hexahedron, two triangles and three quadrilaterals a prism, four and one a
/// pyramid: the vertices of the first half-face that can be their base, then those above. Other
/// polyhedra are left out. Faces and edges that are cells are those that the property `sunder:cell`
/// marks; without it faces of no polyhedron, and edges of no face.
Draft read_ovm(std::string_view text);

/// The text of a file. Edges and faces that are cells stand before the other edges and faces of
/// polyhedra, as they are. A tetrahedron's half-faces are (0 1 2), (0 2 3), (0 3 1), (1 3 2) of its
/// corners, others begin with their base; where that is listed in another rotation the property
/// `sunder:turn` gives the turn.
std::string write_ovm(const FileMesh& mesh);

/// The names of properties that are not data, in the order of OvmOwn.
enum class OvmOwn { cell, turn, region, entity, point_id, cell_id };
inline constexpr std::string_view ovm_own[] = {"sunder:cell", "sunder:turn",     "region",
                                               "entity",      "source_point_id", "source_cell_id"};

}  // namespace sunder::io
