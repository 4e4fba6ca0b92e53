// SPDX-License-Identifier: MIT
// Cells that become cells of another kind.
#pragma once

#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// Appends rows to the columns of a list. Where only one of the two has a column the other's rows
/// get 0, data not-a-number (integers: 0). `rows`, `more`: how many cells each has.
void append_columns(CellColumns& columns, std::size_t rows, CellColumns&& others, std::size_t more);

/// The cells of `from` become cells of `to`, which has fewer nodes: their first ones. They stand
/// behind those that are there. The other nodes stay as points.
void move_cells(FileMesh& mesh, CellKind from, CellKind to);

/// Takes all cells of a kind out.
void drop_cells(FileMesh& mesh, CellKind kind);

/// Distributes the columns of rows of several kinds to the list of each, in their order, and drops
/// filling values there. Needs: the lists have those cells, and no columns.
void deal_columns(FileMesh& mesh, CellColumns&& all, const std::vector<CellKind>& kind_of_row);

/// Drops columns that say nothing: labels and numbers that are all 0, data that are all
/// not-a-number. Writers of formats with one table for cells of several kinds fill with these.
void drop_filling(CellColumns& cells);

/// All cells of higher order become those of first order with the same corners.
void make_linear(FileMesh& mesh);

}  // namespace sunder
