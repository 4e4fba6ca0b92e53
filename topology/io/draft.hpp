// SPDX-License-Identifier: MIT
// Internal to the readers: a mesh while it is read, and the cells that turn out to be wrong.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/io/read_options.hpp"
#include "topology/io/skipped.hpp"
#include "topology/io/text/number_source.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder::io {

/// A cell as a file gives it: one that a reader fills again and again.
struct FileCell {
  /// Rows of points, a node each; -1 where the file's number belongs to no point.
  std::vector<std::int64_t> rows;
  /// The file's own numbers, for messages.
  std::vector<std::int64_t> numbers;
  /// Byte of the text.
  std::size_t at = 0;

  void begin(std::size_t nodes, std::size_t place) {
    rows.resize(nodes);
    numbers.resize(nodes);
    at = place;
  }
};

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
  /// To be filled by the reader.
  FileCell cell;
  /// Cells of one kind, and the place of the first.
  struct Others {
    std::size_t count = 0;
    std::string file;
    std::size_t line = 0;
  };
  /// The places of the first cells that were appended, by kind; counts are made at the end.
  std::array<Others, cell_kinds> kept;
  /// Cells that are left out, by their plural name: below dimension 3, and volume cells.
  std::map<std::string, Others> surface_cells;
  std::map<std::string, Others> volume_cells;
  /// Cells of higher order than the kinds that are kept, read by their corners.
  std::map<std::string, Others> curved_cells;
  /// Other content that is left out (add_skipped).
  SkippedKinds skipped;
};

/// Appends a point; counts it under nan_coordinate where one is no finite number.
void add_point(Draft& draft, const Point& point, std::size_t at);

/// Appends a cell to the list of its kind (region, entity and ids are left to the reader); its
/// nodes stand in our order (cell_kinds.hpp). Counted under index_out_of_range if it names points
/// that are not there yet, and under repeated_vertex (a tetrahedron without four different corners:
/// an error) or degenerate_cell (others: a warning). Needs: as many nodes as the kind has.
void add_cell(Draft& draft, CellKind kind, const FileCell& cell);

/// More corners than any face has; a face takes ten times the memory of its text while it is read.
inline constexpr std::size_t most_corners = 10000;

/// The same for a face with any number of corners: of three a triangle, of four a quadrilateral; of
/// fewer than three, or more than the most, it is counted as left out. Gives the kind; none where
/// it is left out.
std::optional<CellKind> add_face(Draft& draft, const FileCell& cell);

/// The kind of a face with so many corners.
constexpr CellKind kind_of_face(std::size_t corners) {
  return corners == 3 ? CellKind::triangle : corners == 4 ? CellKind::quad4 : CellKind::polygon;
}

/// Counts `count` cells that are left out, as no kind of ours is like them.
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

/// Ends the reading. Numbers that only repeat the row are dropped. Cells that are not kept become
/// findings by ReadOptions: warnings, or notes for callers that compute with simplices. Errors
/// stand first; no value when there is one.
Result<FileMesh> finish(Draft&& draft, const ReadOptions& options);

}  // namespace sunder::io
