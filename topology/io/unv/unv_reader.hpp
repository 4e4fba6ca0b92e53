// SPDX-License-Identifier: MIT
// Internal to the reader of universal files: kinds of elements, and data kept between data sets.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/draft.hpp"
#include "topology/io/text/number_index.hpp"

namespace sunder::io {

/// A kind of element by the number that stands in the file (the FE descriptor).
struct UnvType {
  int number;
  CellKind kind;
};

/// The type of a number; a null pointer where it is none of ours.
const UnvType* unv_type(std::int64_t number);

/// Whether elements of this number have a second line, with their orientation, before their nodes.
bool is_unv_beam(std::int64_t number);

/// For each node as the file lists it, its place in our order; empty where the two are the same.
std::span<const std::uint8_t> unv_order(CellKind kind);

/// A data set: its number, and the text between that and the -1 behind it.
struct UnvSection {
  std::int64_t number = 0;
  std::size_t begin = 0, end = 0;
};

/// A number of each row, kept from the first that differs from that of the first row.
struct VaryingNumbers {
  std::size_t rows = 0;
  std::int64_t first = 0;
  std::vector<std::int64_t> values;

  void add(std::int64_t value) {
    if (rows == 0) first = value;
    if (values.empty() && value != first) values.assign(rows, first);
    if (!values.empty()) values.push_back(value);
    ++rows;
  }
};

struct UnvReader {
  Draft draft;
  /// Of cells by kind: colours and tables of materials. Of nodes: colours.
  std::array<VaryingNumbers, cell_kinds> cell_colors, cell_materials;
  VaryingNumbers node_colors;
  std::vector<UnvSection> sections;
  NumberIndex node_rows;
  /// Coordinate systems that are not the basic one, by their number.
  std::map<std::int64_t, std::string> systems;
  /// The divisor that makes metres of the lengths read.
  double unit = 1;
  /// Numbers of types that are left out, the first few.
  std::set<std::int64_t> other_types;
};

/// Lines of a data set.
struct UnvLines {
  std::string_view text;
  std::size_t next = 0, end = 0;
  /// The line, without its end.
  std::string_view line = {};
  std::size_t at = 0;
};

/// Goes to the next line; false behind the last.
bool next_line(UnvLines& lines);

/// The same for a line that has to be there: fails with truncated_file, naming the expected `what`.
void expect_line(UnvLines& lines, std::string_view what);

/// The whole numbers of the line, `most` of them or fewer. Fails with bad_number.
std::size_t integers_of(const UnvLines& lines, std::span<std::int64_t> numbers,
                        std::string_view what);

/// The first real of the line; its exponent may be written with D.
double first_real_of(const UnvLines& lines, std::string_view what);

/// The three reals of the line; exponents may be written with D.
Point point_of(const UnvLines& lines, std::string_view what);

/// Groups to regions, once all cells are there.
void read_unv_groups(UnvReader& r);

}  // namespace sunder::io
