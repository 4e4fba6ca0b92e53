// SPDX-License-Identifier: MIT
// Internal to topology/io: VTK's legacy format (.vtk), unstructured grids.
#pragma once

#include <string>
#include <string_view>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Whether a line among the first comments is VTK's head.
bool is_vtk(std::string_view text);

/// Reads the simplices and columns of versions 1.0 to 5.1, text or binary. Throws ReadFailure.
Draft read_vtk(std::string_view text);

/// The bytes of a legacy VTK file; `version` 42 (cells as counted lists, which everybody reads) or
/// 51 (offsets and connectivity). Columns are field arrays, each in its type.
std::string write_vtk(const FileMesh& mesh, int version, bool is_binary);

}  // namespace sunder::io
