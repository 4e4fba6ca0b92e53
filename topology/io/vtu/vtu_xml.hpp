// SPDX-License-Identifier: MIT
// Internal to the VTU reader: the XML part of the file as plain data, no array decoded yet.
#pragma once

#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/vtu/vtu_data.hpp"

namespace sunder::io {

/// One Piece: its counts as they are announced, and the tags of its arrays.
struct VtuPiece {
  std::size_t points = 0;
  std::size_t cells = 0;
  /// Into VtuLayout::text.
  std::size_t at = 0;
  std::list<VtuArray> point_arrays;
  std::list<VtuArray> cell_arrays;
  /// Of PolyData: how many cells each list has, in the order of PolyList; empty where none has any.
  std::vector<std::size_t> poly_cells;
  std::list<VtuArray> point_data;
  std::list<VtuArray> cell_data;
};

/// Content that is passed over: its kind and name as add_skipped takes them, and its tag's place.
struct VtuSkipped {
  std::string kind;
  std::string name;
  std::size_t at = 0;
};

struct VtuDocument {
  VtuLayout layout;
  std::vector<VtuSkipped> skipped;
  bool is_polydata = false;
  std::vector<VtuPiece> pieces;
};

/// Parses the tags with expat, which stops where appended data begin: those need not be XML.
/// Throws ReadFailure (bad_xml, truncated_file, unknown_format, bad_attribute, count_too_big,
/// unsupported_compressor).
VtuDocument parse_vtu(std::string_view text);

}  // namespace sunder::io
