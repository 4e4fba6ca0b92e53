// SPDX-License-Identifier: MIT
// Internal to the readers: a mesh while it is read, and the cells that turn out to be wrong.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/io/number_source.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder::io {

/// A mesh under construction. Wrong cells do not stop the reading: each kind becomes one finding
/// with its count, its first rows and the line of the first.
struct Draft {
  /// The file's text; lines of findings are counted in it. Empty for binary data.
  std::string_view text;
  /// The name of another file of the mesh while that is read; findings name it. Empty for the mesh
  /// file itself.
  std::string file;
  FileMesh mesh;
  std::vector<Finding> findings;
  /// Cells of one kind, and the place of the first.
  struct Others {
    std::size_t count = 0;
    std::string file;
    std::size_t line = 0;
  };
  /// Cells that are left out, by their plural name: below dimension 3, and volume cells.
  std::map<std::string, Others> surface_cells;
  std::map<std::string, Others> volume_cells;
  /// Cells of higher order, read by their corners, by their plural name.
  std::map<std::string, Others> curved_cells;
};

/// Appends a point; counts it under nan_coordinate where one is no finite number.
void add_point(Draft& draft, const Point& point, std::size_t at);

/// A cell as a file gives it, its corners first.
struct FileCell {
  /// Rows of points; -1 where the file's number belongs to no point. Those beyond the corners of
  /// the cell are not looked at.
  std::array<std::int64_t, 4> rows;
  /// The file's own numbers, for messages.
  std::array<std::int64_t, 4> numbers;
  /// Byte of the text.
  std::size_t at = 0;
};

/// Appends a simplex of `dimension` 0 to 3 to its list of cells (region, entity and ids are left to
/// the reader). Counted under index_out_of_range where it names points that are not there yet, and
/// under repeated_vertex (a tetrahedron: an error) or degenerate_cell (others: a warning).
void add_cell(Draft& draft, int dimension, const FileCell& cell);

/// Counts `count` cells that are left out: those of dimension 3 will be refused.
void add_other_cells(Draft& draft, std::string_view plural_name, int dimension, std::size_t count,
                     std::size_t at);

/// Counts `count` cells of higher order that are read by their corners.
void add_curved_cells(Draft& draft, std::string_view plural_name, std::size_t count,
                      std::size_t at);

/// Counts one more finding of that code; `words()` gives the whole finding and is asked for once. A
/// file can give reason for as many findings as it has bytes.
template <class Words>
void add_counted(Draft& draft, std::string_view code, Words words) {
  for (Finding& f : draft.findings) {
    if (f.code == code) {
      ++f.count;
      return;
    }
  }
  draft.findings.push_back(words());
  draft.findings.back().code = code;
}

/// Looks at what stands behind the last `row` ("face"): in text anything but blanks ends the
/// reading (wrong_count), raw bytes are a warning (trailing_bytes).
void check_end(Draft& draft, NumberSource& in, std::string_view row);

/// Ends the reading: numbers that only repeat the row are dropped; volume cells that are left out
/// become an error (with `tetrahedra_only` a warning), cells below dimension 3 and those read by
/// their corners notes. Errors stand first; no value when there is one.
Result<FileMesh> finish(Draft&& draft, bool tetrahedra_only);

}  // namespace sunder::io
