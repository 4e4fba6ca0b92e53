// SPDX-License-Identifier: MIT
// Internal to topology/io: Nastran's bulk data (.bdf, .nas, .dat).
#pragma once

#include <string>
#include <string_view>

#include "topology/io/formats.hpp"
#include "topology/io/msh/msh.hpp"

namespace sunder::io {

/// Whether a file looks like Nastran's: behind comments ($) and blank lines it begins with a card
/// of bulk data that we know, or with lines of executive and case control, which lead to BEGIN BULK
/// or to points and elements.
bool is_nastran(std::string_view text);

/// Reads GRID and elements of a file and of those it includes, free, small and large fields; the
/// region of an element is its property. Throws ReadFailure.
Draft read_nastran(const FileSource& source);

/// The kinds of cells that are written.
inline constexpr KindSet nastran_cells =
    kind_set({CellKind::edge, CellKind::edge3, CellKind::triangle, CellKind::triangle6,
              CellKind::quad4, CellKind::quad8, CellKind::quad9, CellKind::tetrahedron,
              CellKind::tetrahedron10, CellKind::hexahedron8, CellKind::hexahedron20,
              CellKind::prism6, CellKind::prism15, CellKind::pyramid5, CellKind::pyramid13});

/// Which numbers the file can hold: from 1 to 99 999 999, each once; of elements all or none.
HeldNumbers nastran_holds(const FileMesh& mesh);

/// Losses besides those of the format's traits: digits of coordinates beyond their sixteen
/// characters, and regions that are no properties, from 1 to 99 999 999 (0 stands for none).
std::vector<Finding> lost_in_nastran(const FileMesh& mesh);

/// The text of a file: GRID* and elements. Regions that are no properties are written as none. A
/// comment names the property that stands for no region, where that is needed.
std::string write_nastran(const FileMesh& mesh);

}  // namespace sunder::io
