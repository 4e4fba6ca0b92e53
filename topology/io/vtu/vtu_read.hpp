// SPDX-License-Identifier: MIT
// Internal to topology/io: VTU (VTK XML unstructured grids) with all its cells and columns.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "topology/io/formats.hpp"

namespace sunder::io {

/// Whether a file begins like XML, and is no VTP.
bool is_vtu(std::string_view text);

/// Whether a file begins like XML and says that it holds PolyData: read_vtu reads these too.
bool is_vtp(std::string_view text);

/// Reads the simplices and columns of every piece. Throws ReadFailure.
Draft read_vtu(std::string_view text);

/// Writes all cells and columns as one VTU file, each column in its type: `text`, `base64`, or
/// `binary` as raw appended data; the latter two packed by zlib if asked for. Errors: cannot_write.
std::optional<Finding> write_vtu(const std::filesystem::path& path, const FileMesh& mesh,
                                 const FileEncoding& how);

/// The same as PolyData. Needs: vertices, edges, triangles, quadrilaterals and polygons alone.
std::optional<Finding> write_vtp(const std::filesystem::path& path, const FileMesh& mesh,
                                 const FileEncoding& how);

}  // namespace sunder::io
