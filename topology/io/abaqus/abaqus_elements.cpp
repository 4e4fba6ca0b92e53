// SPDX-License-Identifier: MIT
// Elements of Abaqus' input, and its numbers.
#include <fmt/format.h>

#include <algorithm>

#include "topology/io/abaqus/abaqus.hpp"
#include "topology/io/abaqus/abaqus_reader.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

constexpr std::string_view node_number = "a node number";

/// The next field of an element, in the next line where this one ends with a comma.
std::string_view element_field(DataLines& lines, const AbaqusType& type, std::size_t found) {
  while (true) {
    if (has_field(lines)) {
      const std::string_view field = next_field(lines);
      if (!field.empty() || has_field(lines)) return field;
    }
    // A line that ends with a comma has its last field behind it.
    const bool goes_on = !has_field(lines) && trimmed(lines.line).ends_with(',');
    const std::size_t at = lines.line.size();
    if (goes_on && next_data_line(lines)) continue;
    fail(lines.text, at,
         {.code = "wrong_count",
          .text = fmt::format("the element ends after {} of its {} nodes", found, type.nodes),
          .remedy = "complete the line, or end it with a comma where it goes on in the next"});
  }
}

/// The rest of the line must be empty.
void expect_line_end(DataLines& lines, const AbaqusType& type) {
  while (has_field(lines)) {
    const std::string_view field = next_field(lines);
    if (field.empty()) continue;
    fail(lines.text, static_cast<std::size_t>(field.data() - lines.text.data()),
         {.code = "wrong_count",
          .text = fmt::format("{} follows the {} nodes of an element of type {}", in_quotes(field),
                              type.nodes, type.name),
          .remedy = "correct the line, or the element's type"});
  }
}

void read_block(AbaqusReader& r, const ElementLines& block, CellKind kind) {
  const AbaqusType& type = *block.type;
  DataLines lines{.text = r.files[block.file].text, .next = block.at};
  CellColumns& cells = columns_of(r.draft.mesh, kind);
  const std::size_t most = most_lines(lines.text, block.at, 2 * (type.nodes + 1));
  for_each_cell_list(r.draft.mesh, [&](auto& list, int d) {
    if (kind == simplex_of(d)) reserve_more(list.corners, most);
  });
  reserve_more(cells.source_id, most);
  const std::span<const std::uint8_t> order = abaqus_order(kind);
  const std::size_t first = cells.source_id.size();
  FileCell& cell = r.draft.cell;
  while (next_data_line(lines)) {
    cell.begin(type.nodes, lines.at);
    const std::int64_t number = integer_of(lines, next_field(lines), "an element number");
    for (std::size_t k = 0; k < type.nodes; ++k) {
      const std::size_t place = order.empty() ? k : order[k];
      const std::int64_t node = integer_of(lines, element_field(lines, type, k), node_number);
      cell.numbers[place] = node;
      cell.rows[place] = row_of(r.node_rows, node);
    }
    expect_line_end(lines, type);
    add_cell(r.draft, kind, cell);
    cells.source_id.push_back(number);
  }
  const std::size_t end = cells.source_id.size();
  if (block.set < 0 || first == end) return;
  add_lines(r.element_sets, {.set = block.set,
                             .before = -1,
                             .file = static_cast<std::uint32_t>(kind),
                             .is_block = true,
                             .at = first,
                             .end = end});
}

/// Counts elements that are not cells; a line that ends with a comma goes on in the next.
void count_block(AbaqusReader& r, const ElementLines& block) {
  DataLines lines{.text = r.files[block.file].text, .next = block.at};
  std::size_t count = 0;
  while (skip_record(lines)) ++count;
  if (block.type != &unknown_type) {
    return add_other_cells(r.draft, block.type->plural, block.type->dimension, count, block.at);
  }
  constexpr std::size_t most = 12, longest = 41;
  std::string name(block.type_word.substr(0, longest));
  if (r.unknown.size() >= most && !r.unknown.contains(name)) name.clear();
  UnknownElements& unknown = r.unknown[name];
  if (unknown.file.empty() && unknown.line == 0) {
    unknown = {0, r.draft.file, line_of(lines.text, block.at)};
  }
  unknown.count += count;
}

/// Elements of types that nobody knows here are left out, and no one should miss that.
void warn_unknown(AbaqusReader& r) {
  if (r.unknown.empty()) return;
  const UnknownElements* first = &r.unknown.begin()->second;
  std::string text;
  std::size_t sum = 0;
  for (const auto& [name, elements] : r.unknown) {
    text += fmt::format("{}{} of {}", text.empty() ? "" : ", ", elements.count,
                        name.empty() ? "other types" : fmt::format("type {}", in_quotes(name)));
    sum += elements.count;
    if (elements.file == first->file && elements.line < first->line) first = &elements;
  }
  r.draft.findings.push_back(
      {.code = "unknown_cells",
       .severity = Severity::warning,
       .count = sum,
       .text = fmt::format("elements of unknown types are left out: {}", text),
       .remedy = "nothing to do, unless they are part of the body: write those "
                 "as C3D4, C3D8, S3 or T3D2",
       .file = first->file,
       .line = first->line});
}

void index_elements(AbaqusReader& r) {
  std::vector<std::int64_t> numbers;
  for (const CellKind kind : all_cell_kinds) {
    const std::vector<std::int64_t>& own = columns_of(r.draft.mesh, kind).source_id;
    numbers.insert(numbers.end(), own.begin(), own.end());
  }
  std::array<std::int64_t, 2> twice;
  if (index_numbers(r.element_rows, numbers, twice)) return;
  // Where the second of the two stands: rows of each kind are in the order of the blocks.
  auto row = static_cast<std::size_t>(twice[1]);
  std::size_t kind = 0;
  for (; row >= columns_of(r.draft.mesh, all_cell_kinds[kind]).source_id.size(); ++kind) {
    row -= columns_of(r.draft.mesh, all_cell_kinds[kind]).source_id.size();
  }
  for (const ElementLines& block : r.elements) {
    if (kind_of(*block.type) != all_cell_kinds[kind]) continue;
    const AbaqusText& file = r.files[block.file];
    DataLines lines{.text = file.text, .next = block.at};
    for (DataLines before = lines; skip_record(lines); before = lines) {
      if (row-- > 0) continue;
      next_data_line(before);
      in_file(r.draft, file.name, file.text, [&] {
        fail(file.text, before.at,
             {.code = "duplicate_id",
              .text = fmt::format("two elements have the number {}",
                                  numbers[static_cast<std::size_t>(twice[0])]),
              .remedy = "give every element its own number"});
      });
    }
  }
}

}  // namespace

void read_abaqus_elements(AbaqusReader& r) {
  for (const ElementLines& block : r.elements) {
    const AbaqusText& file = r.files[block.file];
    const std::optional<CellKind> kind = kind_of(*block.type);
    in_file(r.draft, file.name, file.text,
            [&] { kind ? read_block(r, block, *kind) : count_block(r, block); });
  }
  warn_unknown(r);
  index_elements(r);
}

}  // namespace sunder::io
