// SPDX-License-Identifier: MIT
// Internal to topology/io: universal files (.unv) of I-DEAS, which Gmsh and Salome share.
#pragma once

#include <string>
#include <string_view>

#include "topology/io/draft.hpp"
#include "topology/io/msh/msh.hpp"

namespace sunder::io {

/// Whether a file begins with a data set: a line -1, then a line with its number.
bool is_unv(std::string_view text);

/// Reads nodes, elements and groups, which become regions; an element's table of physical
/// properties is its region where its dimension has no groups, else its entity. Throws ReadFailure.
Draft read_unv(std::string_view text);

/// The kinds of cells that are written.
inline constexpr KindSet unv_cells = kind_set(
    {CellKind::vertex, CellKind::edge, CellKind::edge3, CellKind::triangle, CellKind::triangle6,
     CellKind::quad4, CellKind::quad8, CellKind::tetrahedron, CellKind::tetrahedron10,
     CellKind::hexahedron8, CellKind::hexahedron20, CellKind::prism6, CellKind::prism15});

/// Whether a group can have this name: 40 characters, plain ones; `region_N` stands for none.
bool is_unv_name(std::string_view name);

/// Which numbers the file can hold: from 1 to 999 999 999, each once; of elements all or none.
HeldNumbers unv_holds(const FileMesh& mesh);

/// Losses besides those of the format's traits: names that no group can have, and those of regions
/// without cells.
std::vector<Finding> lost_in_unv(const FileMesh& mesh);

/// The text of a file. Coordinates keep every bit.
std::string write_unv(const FileMesh& mesh);

}  // namespace sunder::io
