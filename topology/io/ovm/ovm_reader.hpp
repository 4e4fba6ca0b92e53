// SPDX-License-Identifier: MIT
// Internal to the OVM reader: the state that its parts share.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/draft.hpp"
#include "topology/io/text/row_watch.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {

/// Stands for a corner that is not found.
inline constexpr std::uint32_t no_corner = std::numeric_limits<std::uint32_t>::max();

/// A property of all vertices, edges, faces or cells, and where its values begin.
struct OvmProperty {
  /// 0 to 3: of vertices, edges, faces, cells.
  std::size_t dimension = 0;
  std::string_view type;
  std::string_view name;
  std::size_t at = 0;
};

struct OvmReader {
  Scanner s;
  Draft draft;
  RowWatch watch;
  std::vector<std::array<std::uint32_t, 2>> edges;
  /// The vertices of the faces, one after the other, and where those of each end.
  std::vector<std::uint32_t> face_points;
  std::vector<std::size_t> face_ends;
  std::vector<bool> edge_has_face, face_has_cell;
  /// The kind of each polyhedron; none where it is left out.
  std::vector<std::optional<CellKind>> polyhedra;
  std::vector<OvmProperty> properties;
};

/// The vertices of a face.
inline std::span<const std::uint32_t> face_of(const OvmReader& r, std::size_t face) {
  const std::size_t begin = face == 0 ? 0 : r.face_ends[face - 1];
  return {r.face_points.data() + begin, r.face_ends[face] - begin};
}

/// How many vertices the first half-face of a polyhedron has, which the cell begins with.
constexpr std::size_t corners_of_base(CellKind kind) {
  return kind == CellKind::tetrahedron || kind == CellKind::prism6 ? 3 : 4;
}

/// The next word, passing comments at the beginnings of lines.
std::string_view next_ovm_word(Scanner& s);

/// Finds the properties behind the polyhedra, to the end of the file.
void find_ovm_properties(OvmReader& r);

/// Edges and triangles that are cells, and all data.
void read_ovm_properties(OvmReader& r);

}  // namespace sunder::io
