// SPDX-License-Identifier: MIT
// Internal to topology/io: the PLY format (.ply): elements with properties, after a text header.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Whether a file begins like PLY: with that word on a line of its own.
bool is_ply(std::string_view text);

/// Reads PLY, text or binary of either byte order: vertices as points, faces of three corners as
/// triangles, edges. Scalar properties are data, but for `region`, `entity` and the numbers
/// `source_point_id` and `source_cell_id` (and the other names that VTK's files know them by).
/// Comments "column ELEMENT PROPERTY COMPONENTS "NAME"" make one column of several properties.
/// Triangle strips are triangles. Lists, other elements and faces of fewer corners are left out.
/// Throws ReadFailure.
Draft read_ply(std::string_view text);

/// The bytes of a PLY file with points, edges and faces: text or little-endian.
std::string write_ply(const FileMesh& mesh, bool is_binary);

/// The type that a PLY file gives a column: its own, of 64-bit integers one of 32 bits that holds
/// them all. None where there is none, and where the name has a line end in it.
std::optional<NumberType> ply_type(const DataColumn& column);

/// The same for numbers of points or cells.
std::optional<NumberType> ply_type(const std::vector<std::int64_t>& numbers);

/// Words of the header for the types, in the order of NumberType; the last two are nobody's
/// standard, and are read where they are met.
inline constexpr std::string_view ply_types[] = {"double", "float", "char", "uchar", "short",
                                                 "ushort", "int",   "uint", "int64", "uint64"};

}  // namespace sunder::io
