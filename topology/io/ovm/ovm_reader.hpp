// SPDX-License-Identifier: MIT
// Internal to the OVM reader: what its parts share.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/draft.hpp"
#include "topology/io/scan.hpp"

namespace sunder::io {

/// Stands for the corners of a face that is no triangle.
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
  std::vector<std::array<std::uint32_t, 2>> edges;
  /// Triangles by their vertices; others begin with no_corner.
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<bool> edge_has_face, face_has_cell;
  /// The rows of polyhedra that are tetrahedra.
  std::vector<bool> is_tetrahedron;
  std::vector<OvmProperty> properties;
  /// Names of properties that are passed over.
  std::vector<std::string> skipped;
};

/// The next word, passing comments at the beginnings of lines.
std::string_view next_ovm_word(Scanner& s);

/// Finds the properties behind the polyhedra, to the end of the file.
void find_ovm_properties(OvmReader& r);

/// Edges and triangles that are cells, and all data.
void read_ovm_properties(OvmReader& r);

}  // namespace sunder::io
