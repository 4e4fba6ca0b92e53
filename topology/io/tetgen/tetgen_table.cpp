// SPDX-License-Identifier: MIT
// TetGen's lines, counts and column names.
#include "topology/io/tetgen/tetgen_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "topology/io/tetgen/tetgen.hpp"

namespace sunder::io {
namespace {

std::string_view trimmed(std::string_view text) {
  Scanner s{text};
  return rest_of_line(s);
}

/// `height, velocity*3`.
ColumnName column_name(std::string_view word) {
  ColumnName column{.raw = trimmed(word)};
  std::string_view name = column.raw;
  if (const std::size_t star = name.find('*'); star != std::string_view::npos) {
    std::size_t components = 0;
    const auto [stop, reason] =
        std::from_chars(name.data() + star + 1, name.data() + name.size(), components);
    if (reason == std::errc{} && stop == name.data() + name.size()) {
      column.components = std::clamp<std::size_t>(components, 1, most_attributes + 1);
      name = name.substr(0, star);
    }
  }
  column.name = unescaped_name(name);
  return column;
}

/// Takes names from a comment such as meshio and Sunder write.
void read_names(Table& table, std::string_view comment) {
  constexpr std::string_view beginnings[] = {"attribute and marker names:", "attribute names:"};
  comment = trimmed(comment);
  for (const std::string_view beginning : beginnings) {
    if (!comment.starts_with(beginning)) continue;
    comment.remove_prefix(beginning.size());
    table.names.clear();
    while (table.names.size() <= most_attributes) {
      const std::size_t comma = std::min(comment.find(','), comment.size());
      table.names.push_back(column_name(comment.substr(0, comma)));
      if (comma == comment.size()) return;
      comment.remove_prefix(comma + 1);
    }
    return;
  }
}

/// Goes to the next line that holds something; false at the end.
bool next_line(Table& table) {
  while (table.next < table.text.size()) {
    const std::size_t begin = table.next;
    const std::size_t end = std::min(table.text.find('\n', begin), table.text.size());
    const std::string_view line = table.text.substr(begin, end - begin);
    const std::size_t comment = std::min(line.find('#'), line.size());
    table.next = end + 1;
    table.line = {table.text.substr(0, begin + comment), begin};
    skip_blanks(table.line);
    if (table.line.at < table.line.text.size()) return true;
    if (comment < line.size()) read_names(table, line.substr(comment + 1));
  }
  return false;
}

std::size_t numbers_of(std::span<const ColumnName> names) {
  std::size_t numbers = 0;
  for (const ColumnName& n : names) numbers += n.components;
  return numbers;
}

}  // namespace

bool at_line_end(Table& table) {
  skip_blanks(table.line);
  return table.line.at == table.line.text.size();
}

std::size_t numbers_named(const Table& table) { return numbers_of(table.names); }

template <class Number>
Number read_in_line(Table& table, std::string_view what) {
  if (!at_line_end(table)) return read_number<Number>(table.line, what);
  fail(table.text, table.line.at,
       {.code = "wrong_count",
        .text = fmt::format("the line ends where {} was expected", what),
        .remedy = "complete the line, or correct the counts in the file's first line"});
}

template std::int32_t read_in_line<std::int32_t>(Table&, std::string_view);
template std::int64_t read_in_line<std::int64_t>(Table&, std::string_view);
template double read_in_line<double>(Table&, std::string_view);

std::int64_t read_head(Table& table, std::string_view what, std::int64_t usual,
                       std::int64_t highest) {
  if (at_line_end(table)) return usual;
  const std::size_t at = table.line.at;
  const auto count = read_number<std::int64_t>(table.line, what);
  if (count >= 0 && count <= highest) return count;
  fail(table.text, at,
       {.code = count < 0 ? "bad_number" : "count_too_big",
        .text = fmt::format("{} stands where {} was expected: 0 to {}", count, what, highest),
        .remedy = "correct the file's first line, or write the file again"});
}

std::size_t read_rows(Table& table, std::string_view what) {
  if (!next_line(table)) {
    fail(table.text, table.text.size(),
         {.code = "truncated_file",
          .text = fmt::format("the file has no line with the number of {}", what),
          .remedy = "write the file again"});
  }
  return static_cast<std::size_t>(
      read_head(table, fmt::format("the number of {}", what), 0, std::int64_t{1} << 40));
}

void bound_rows(const Table& table, std::size_t rows, std::string_view what, std::size_t words) {
  const Scanner rest{table.text, std::min(table.next, table.text.size())};
  // The last line may end without a line end.
  if (rows == 0 || 2 * words * rows <= rest.text.size() - rest.at + 1) return;
  check_count(rest, 0, static_cast<std::int64_t>(rows), what, 2 * words);
}

void expect_row(Table& table, std::size_t row, std::size_t rows, std::string_view what) {
  if (next_line(table)) return;
  fail(table.text, table.text.size(),
       {.code = "truncated_file",
        .text = fmt::format("the file ends after {} of {} {}", row, rows, what),
        .remedy = "the file was cut short, or its first line has a wrong count: correct it"});
}

void expect_end(Table& table, std::size_t rows, std::string_view what) {
  if (!next_line(table)) return;
  fail(table.text, table.line.at,
       {.code = "wrong_count",
        .text =
            fmt::format("a line follows where the {} {} that the file announces end", rows, what),
        .remedy = "correct the count in the file's first line"});
}

std::vector<DataColumn> new_columns(std::span<const ColumnName> names, std::size_t numbers,
                                    std::size_t rows) {
  std::vector<DataColumn> columns;
  const auto add = [&](std::string name, std::size_t components) {
    std::vector<double> values;
    values.reserve(rows * components);
    columns.push_back({std::move(name), components, NumberType::float64, std::move(values)});
  };
  if (numbers_of(names) == numbers) {
    for (const ColumnName& n : names) add(n.name, n.components);
    return columns;
  }
  for (std::size_t i = 1; i <= numbers; ++i) {
    add(numbers == 1 ? "attribute" : fmt::format("attribute_{}", i), 1);
  }
  return columns;
}

void read_columns(Table& table, std::vector<DataColumn>& columns) {
  for (DataColumn& column : columns) {
    auto& values = std::get<std::vector<double>>(column.values);
    for (std::size_t k = 0; k < column.components; ++k) {
      values.push_back(read_in_line<double>(table, "an attribute"));
    }
  }
}

}  // namespace sunder::io
