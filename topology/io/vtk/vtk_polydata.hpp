// SPDX-License-Identifier: MIT
// Internal to the readers of VTK's formats: PolyData, which have four lists of cells.
#pragma once

#include "topology/io/vtk/vtk_reader.hpp"

namespace sunder::io {

/// In the order of VTK's cell data.
enum class PolyList { vertices, lines, polygons, strips };
inline constexpr std::size_t poly_lists = 4;

/// Appends cells of a list, by their sizes a vertex or several, a line or a polyline, a triangle, a
/// quadrilateral or a polygon, a strip. Of `more` types are not looked at; ends that fall are left
/// to check_vtk_cells. Fails with count_too_big where more cells have no points than a file of so
/// many bytes may have.
void append_poly_cells(VtkCells& cells, PolyList list, VtkCells&& more, std::size_t bytes);

/// Reads a legacy file behind its head, which says POLYDATA. Throws ReadFailure.
Draft read_polydata(VtkReader&& r);

}  // namespace sunder::io
