// SPDX-License-Identifier: MIT
// Internal to the reader of PLY: the header, which describes the contents of the rows.
#pragma once

#include <string_view>
#include <vector>

#include "topology/io/text/scan.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder::io {

/// The use of a property: decided by the reader of its element.
enum class Role { skipped, coordinate, corners, edge_end, data };

struct Property {
  std::string_view name;
  NumberType type = NumberType::float64;
  bool is_list = false;
  NumberType count_type = NumberType::uint8;
  Role role = Role::skipped;
  /// The coordinate, the end of the edge, or the column.
  std::size_t place = 0;
};

/// Rows of one kind.
struct Element {
  std::string_view name;
  std::size_t count = 0;
  std::size_t at = 0;
  std::vector<Property> properties;
};

/// A comment that joins properties to one column.
struct JoinedColumn {
  std::string_view element, property;
  std::size_t components = 0;
  std::string_view name;
};

/// A line before the first element that PLY does not know, by its first word.
struct UnknownLine {
  std::string_view word;
  std::size_t at = 0;
};

struct PlyHeader {
  bool is_binary = false;
  /// Raw numbers have the other byte order than this machine.
  bool swap = false;
  std::vector<Element> elements;
  std::vector<JoinedColumn> joined;
  /// Lines that name the program that wrote the file are left out.
  std::vector<UnknownLine> unknown;
};

/// Reads up to the line end_header, that included. Throws ReadFailure.
PlyHeader read_ply_header(Scanner& s);

}  // namespace sunder::io
