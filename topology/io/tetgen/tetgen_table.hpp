// SPDX-License-Identifier: MIT
// One of TetGen's files as a table: a line with counts, then a line per row; comments from # to the
// line's end. The numbers get their meaning in tetgen_read.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/text/scan.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder::io {

/// More attributes than anybody has: each becomes a column.
inline constexpr std::int64_t most_attributes = 1000;

/// The name of a column as a comment gives it.
struct ColumnName {
  /// As it stands there.
  std::string_view raw;
  std::string name;
  std::size_t components = 1;
};

/// One of the files while it is read. All that fails throws `ReadFailure` with the line.
struct Table {
  std::string_view text;
  /// The line: the text up to its end or its comment.
  Scanner line;
  /// Where the next line begins.
  std::size_t next = 0;
  /// From the comment before the first line, where there is one.
  std::vector<ColumnName> names;
};

/// How many numbers a row has by the names.
std::size_t numbers_named(const Table& table);

/// The next number of the line.
template <class Number>
Number read_in_line(Table& table, std::string_view what);

/// Passes the blanks of the line; whether it ends there.
bool at_line_end(Table& table);

/// The next count of the first line; `usual` where the line ends before.
std::int64_t read_head(Table& table, std::string_view what, std::int64_t usual,
                       std::int64_t highest);

/// The number of rows, the first number of the file, which ends it where there is none.
std::size_t read_rows(Table& table, std::string_view what);

/// Fails where the bytes that follow cannot hold `rows` lines of `words` numbers each.
void bound_rows(const Table& table, std::size_t rows, std::string_view what, std::size_t words);

/// Goes to row `row` of `rows`.
void expect_row(Table& table, std::size_t row, std::size_t rows, std::string_view what);

/// Fails where a line follows.
void expect_end(Table& table, std::size_t rows, std::string_view what);

/// Columns for `numbers` numbers per row: as the comment names them where its names fit, else
/// `attribute` or `attribute_1`, `attribute_2`, ...
std::vector<DataColumn> new_columns(std::span<const ColumnName> names, std::size_t numbers,
                                    std::size_t rows);

/// The next numbers of the line, one for each component of each column.
void read_columns(Table& table, std::vector<DataColumn>& columns);

}  // namespace sunder::io
