// SPDX-License-Identifier: MIT
// Internal to topology/io: the OBJ format of Wavefront (.obj).
#pragma once

#include <string>
#include <string_view>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Whether a file's first line that is no comment begins with one of OBJ's words (v, f, g, ...).
bool is_obj(std::string_view text);

/// Reads OBJ: points, faces by the number of their corners, lines as edges from point to point,
/// points of p as vertices. The group (g) of a cell is its region, in files without groups the
/// object (o), in files without either the material. Colours, normals, texture coordinates, free
/// forms and faces of fewer corners are left out. No other file is opened. Throws ReadFailure.
Draft read_obj(std::string_view text);

/// The text of an OBJ file with points, vertices, edges and faces; regions are groups.
std::string write_obj(const FileMesh& mesh);

}  // namespace sunder::io
