// SPDX-License-Identifier: MIT
// Internal to the readers: a mesh while it is read, and the cells that turn out to be wrong.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "topology/finding.hpp"
#include "topology/tet_mesh.hpp"

namespace sunder::io {

/// A mesh under construction. Wrong cells do not stop the reading: each kind becomes one finding
/// with its count, its first rows and the line of the first.
struct Draft {
  /// The file's text; lines of findings are counted in it. Empty for binary data.
  std::string_view text;
  TetMesh mesh;
  std::vector<Finding> findings;
  /// Cells that are not linear tetrahedra, by their plural name, and the place of the first.
  struct Others {
    std::size_t count = 0;
    std::size_t first_at = 0;
  };
  std::map<std::string, Others> surface_cells;
  std::map<std::string, Others> volume_cells;
};

/// Appends a point; counts it under nan_coordinate where one is no finite number.
void add_point(Draft& draft, const Point& point, std::size_t at);

/// A tetrahedron as a file gives it.
struct FileTetrahedron {
  /// Rows of points; -1 where the file's number belongs to no point.
  std::array<std::int64_t, 4> rows;
  /// The file's own numbers, for messages.
  std::array<std::int64_t, 4> numbers;
  /// Byte of the text.
  std::size_t at = 0;
};

/// Appends a tetrahedron; counts it under index_out_of_range or repeated_vertex where it is wrong.
/// Rows are judged against the points there are now.
void add_tetrahedron(Draft& draft, const FileTetrahedron& tetrahedron);

/// Counts `count` cells that are not linear tetrahedra: those of dimension 3 will be refused.
void add_other_cells(Draft& draft, std::string_view plural_name, int dimension, std::size_t count,
                     std::size_t at);

/// Ends the reading: numbers that only repeat the row are dropped, a mesh without tetrahedra and
/// other volume cells become errors, skipped surface cells a note. Errors stand first; no value
/// when there is one.
Result<TetMesh> finish(Draft&& draft);

}  // namespace sunder::io
