// SPDX-License-Identifier: MIT
// Universal files read: data sets between lines of -1; coordinate systems, nodes, elements, groups.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "topology/io/text/scan.hpp"
#include "topology/io/unv/unv.hpp"
#include "topology/io/unv/unv_reader.hpp"

namespace sunder::io {
namespace {

constexpr std::string_view node_number = "the number of a node";

std::string_view line_at(std::string_view text, std::size_t begin) {
  return text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin);
}

bool is_mark(std::string_view line) {
  Scanner s{line};
  return next_word(s) == "-1" && next_word(s).empty();
}

/// The places of all data sets.
void find_sections(UnvReader& r) {
  const std::string_view text = r.draft.text;
  bool is_open = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view line = line_at(text, at);
    const std::size_t next = std::min(at + line.size() + 1, text.size());
    if (is_mark(line)) {
      if (is_open) r.sections.back().end = at;
      is_open = !is_open;
      if (is_open) {
        // Some data sets have letters behind their number: 58b.
        UnvSection& section = r.sections.emplace_back();
        const std::string_view number = first_word(line_at(text, next));
        std::from_chars(number.data(), number.data() + number.size(), section.number);
        section.begin = std::min(next + line_at(text, next).size() + 1, text.size());
        section.end = text.size();
        at = section.begin;
        continue;
      }
    }
    at = next;
  }
  if (!is_open) return;
  fail(text, text.size(),
       {.code = "truncated_file",
        .text = fmt::format("the data set {} has no line -1 behind it", r.sections.back().number),
        .remedy = "the file was cut short: copy or write it again"});
}

UnvLines lines_of(const UnvReader& r, const UnvSection& section) {
  return {.text = r.draft.text, .next = section.begin, .end = section.end};
}

template <class Work>
void for_each_section(UnvReader& r, std::initializer_list<std::int64_t> numbers, Work work) {
  for (const UnvSection& section : r.sections) {
    if (std::ranges::find(numbers, section.number) == numbers.end()) continue;
    UnvLines lines = lines_of(r, section);
    work(section, lines);
  }
}

/// 2420: those that are not the basic system are kept by name, to refuse nodes in them.
void read_systems(UnvReader& r, UnvLines& lines) {
  std::array<std::int64_t, 3> head{};
  expect_line(lines, "the number of a part");
  expect_line(lines, "the name of a part");
  while (next_line(lines)) {
    if (integers_of(lines, head, "a coordinate system: number, type, colour") == 0) continue;
    expect_line(lines, "the name of a coordinate system");
    const std::string name = in_quotes(lines.line.substr(0, 40));
    bool is_basic = head[1] == 0;
    for (std::size_t row = 0; row < 4; ++row) {
      expect_line(lines, "a row of a coordinate system");
      const Point p = point_of(lines, "a number of a coordinate system");
      for (std::size_t k = 0; k < 3; ++k) is_basic = is_basic && p[k] == (row == k ? 1 : 0);
    }
    if (!is_basic) r.systems.emplace(head[0], name);
  }
}

void add_node(UnvReader& r, const UnvLines& lines, std::int64_t number, std::int64_t system,
              const Point& point, std::size_t at) {
  const auto found = r.systems.find(system);
  if (found != r.systems.end()) {
    fail(lines.text, at,
         {.code = "unsupported_keyword",
          .text = fmt::format("node {} is given in the coordinate system {} {}: only the basic one "
                              "is read",
                              number, system, found->second),
          .remedy = "write the nodes in the global Cartesian system"});
  }
  r.draft.mesh.source_point_id.push_back(number);
  const double u = r.unit;
  add_point(r.draft, u == 1 ? point : Point{point[0] / u, point[1] / u, point[2] / u}, at);
}

/// 164: the units and their name; then the divisors that convert lengths, forces and temperatures
/// to SI units.
double read_length_unit(UnvLines lines) {
  expect_line(lines, "the number and name of a system of units");
  expect_line(lines, "the factors of units");
  const double unit = first_real_of(lines, "the factor of lengths");
  if (unit > 0 && std::isfinite(unit)) return unit;
  fail(lines.text, lines.at,
       {.code = "bad_number",
        .text = fmt::format("lengths are to be divided by {}: a number above 0 was expected", unit),
        .remedy = "correct the data set 164: 1 stands for metres, 1000 for millimetres"});
}

/// The units that hold for a data set: those before it, else the first of the file.
void take_units(UnvReader& r, const UnvSection& of) {
  const UnvSection* units = nullptr;
  for (const UnvSection& section : r.sections) {
    if (section.number != 164) continue;
    if (units == nullptr || section.begin < of.begin) units = &section;
  }
  r.unit = units == nullptr ? 1 : read_length_unit(lines_of(r, *units));
  if (r.unit == 1) return;
  add_counted(r.draft, "units_converted", [&] {
    return Finding{.severity = Severity::note,
                   .text = fmt::format("the file has its own units (data set 164): lengths are "
                                       "divided by {} to be metres",
                                       r.unit),
                   .remedy = "nothing to do, if the data set 164 is right",
                   .line = line_of(r.draft.text, units->begin)};
  });
}

/// 2411 and 781: a line with the number, a line with the place.
void read_nodes(UnvReader& r, UnvLines& lines) {
  std::array<std::int64_t, 4> head{};
  while (next_line(lines)) {
    const std::size_t at = lines.at;
    const std::size_t found = integers_of(lines, head, node_number);
    if (found == 0) continue;
    expect_line(lines, "a node's coordinates");
    add_node(r, lines, head[0], found > 1 ? head[1] : 0, point_of(lines, "a coordinate"), at);
    r.node_colors.add(found > 3 ? head[3] : 0);
  }
}

/// 15: number and place in one line.
void read_old_nodes(UnvReader& r, UnvLines& lines) {
  std::array<std::int64_t, 4> head{};
  while (next_line(lines)) {
    Scanner s{lines.line};
    if (peek_word(s).empty()) continue;
    if (integers_of(lines, head, node_number) < head.size()) {
      fail(lines.text, lines.at,
           {.code = "wrong_count",
            .text = "a node of the data set 15 has a number, two systems, a colour and its place",
            .remedy = "complete the line, or write the file again"});
    }
    skip_words(s, head.size(), "a number");
    UnvLines rest = lines;
    rest.line = lines.line.substr(s.at);
    add_node(r, lines, head[0], head[1], point_of(rest, "a coordinate"), lines.at);
    r.node_colors.add(head[3]);
  }
}

/// Where the node of a row stands.
std::size_t place_of_node(UnvReader& r, std::int64_t row) {
  std::size_t place = 0;
  for_each_section(r, {2411, 781, 15}, [&](const UnvSection& section, UnvLines& lines) {
    while (row >= 0 && next_line(lines)) {
      if (first_word(lines.line).empty()) continue;
      place = lines.at;
      if (section.number != 15) next_line(lines);
      --row;
    }
  });
  return place;
}

void index_nodes(UnvReader& r) {
  const std::vector<std::int64_t>& numbers = r.draft.mesh.source_point_id;
  if (numbers.empty()) {
    fail(r.draft.text, r.draft.text.size(),
         {.code = "missing_section",
          .text = "the file has no nodes: no data set 2411, 781 or 15",
          .remedy = "give a file with nodes and elements"});
  }
  std::array<std::int64_t, 2> twice;
  if (index_numbers(r.node_rows, numbers, twice)) return;
  fail(r.draft.text, place_of_node(r, twice[1]),
       {.code = "duplicate_id",
        .ids = {twice[0], twice[1]},
        .text = fmt::format("the nodes in rows {} and {} have the same number {}", twice[0],
                            twice[1], numbers[static_cast<std::size_t>(twice[0])]),
        .remedy = "give every node its own number"});
}

/// The nodes of an element that begins at `at`, on as many lines as they need.
void read_element_nodes(UnvReader& r, UnvLines& lines, std::size_t nodes,
                        std::span<const std::uint8_t> order) {
  constexpr std::size_t in_line = 8;
  std::array<std::int64_t, in_line> numbers{};
  FileCell& cell = r.draft.cell;
  for (std::size_t k = 0; k < nodes;) {
    expect_line(lines, node_number);
    const std::size_t found = integers_of(lines, numbers, node_number);
    if (found == 0 || found > nodes - k) {
      fail(lines.text, lines.at,
           {.code = "wrong_count",
            .text = fmt::format("an element of {} nodes has {} in this line, behind {}", nodes,
                                found, k),
            .remedy = "correct the count, or write the file again"});
    }
    for (std::size_t i = 0; i < found; ++i, ++k) {
      const std::size_t place = order.empty() ? k : order[k];
      cell.numbers[place] = numbers[i];
      cell.rows[place] = row_of(r.node_rows, numbers[i]);
    }
  }
}

/// Passes the line with a beam's orientation. A rod (11) has none, but some programs write it.
void skip_orientation(UnvLines& lines, std::int64_t type, std::size_t nodes) {
  std::array<std::int64_t, 4> numbers{};
  UnvLines ahead = lines;
  if (!next_line(ahead)) return;
  const bool is_beam = is_unv_beam(type);
  if (!is_beam && (type != 11 || integers_of(ahead, numbers, "a number") == nodes)) return;
  lines = ahead;
}

/// Number, type, tables of physical properties and of materials, colour, how many nodes; 780 has
/// the tables' places besides their numbers.
void read_elements(UnvReader& r, UnvLines& lines, bool is_old) {
  std::array<std::int64_t, 8> head{};
  const std::size_t needed = is_old ? 8 : 6;
  while (next_line(lines)) {
    const std::size_t at = lines.at;
    const std::size_t found = integers_of(lines, std::span(head).first(needed), "a number");
    if (found == 0) continue;
    const std::int64_t nodes = head[needed - 1];
    if (found < needed || nodes < 1) {
      fail(lines.text, at,
           {.code = "wrong_count",
            .text = fmt::format(
                "an element begins with {} numbers, the last of which is how many nodes "
                "it has",
                needed),
            .remedy = "correct the line, or write the file again"});
    }
    check_count({lines.text.substr(0, lines.end), lines.next}, at, nodes, "nodes", 2);
    const auto count = static_cast<std::size_t>(nodes);
    const UnvType* const type = unv_type(head[1]);
    skip_orientation(lines, head[1], count);
    const bool is_ours = type != nullptr && traits_of(type->kind).nodes == count;
    r.draft.cell.begin(count, at);
    read_element_nodes(r, lines, count,
                       is_ours ? unv_order(type->kind) : std::span<const std::uint8_t>{});
    if (!is_ours) {
      constexpr std::size_t most = 12;
      if (r.other_types.size() < most) r.other_types.insert(head[1]);
      const std::string name = r.other_types.contains(head[1])
                                   ? fmt::format("elements of type {}", head[1])
                                   : "elements of other types";
      add_other_cells(r.draft, name, 2, 1, at);
      continue;
    }
    add_cell(r.draft, type->kind, r.draft.cell);
    CellColumns& columns = columns_of(r.draft.mesh, type->kind);
    columns.source_id.push_back(head[0]);
    const std::int64_t table = head[is_old ? 3 : 2];
    const bool fits = table == static_cast<std::int32_t>(table);
    columns.entity.push_back(fits ? static_cast<std::int32_t>(table) : 0);
    r.cell_materials[index_of(type->kind)].add(head[is_old ? 5 : 3]);
    r.cell_colors[index_of(type->kind)].add(head[is_old ? 6 : 4]);
  }
}

/// Colours or materials become columns where they differ within the file: programs give all cells
/// the same where nobody chose any.
void add_column(FileMesh& mesh, std::array<VaryingNumbers, cell_kinds>& numbers,
                std::string_view name) {
  const VaryingNumbers* known = nullptr;
  bool varies = false;
  for (const VaryingNumbers& n : numbers) {
    if (n.rows == 0) continue;
    varies = varies || !n.values.empty() || (known != nullptr && n.first != known->first);
    known = &n;
  }
  for (const CellKind kind : all_cell_kinds) {
    VaryingNumbers& n = numbers[index_of(kind)];
    if (!varies || n.rows == 0) continue;
    if (n.values.empty()) n.values.assign(n.rows, n.first);
    columns_of(mesh, kind)
        .data.push_back({std::string(name), 1, NumberType::int64, std::move(n.values)});
  }
}

void add_columns(UnvReader& r) {
  FileMesh& mesh = r.draft.mesh;
  add_column(mesh, r.cell_materials, "material");
  add_column(mesh, r.cell_colors, "color");
  if (r.node_colors.values.empty()) return;
  mesh.point_data.push_back({"color", 1, NumberType::int64, std::move(r.node_colors.values)});
}

/// Tables of properties: where cells of a dimension are in no group they are their regions. Those
/// that are all the first (or 0) say nothing.
void take_tables(FileMesh& mesh) {
  for (int d = 0; d < 4; ++d) {
    bool has_regions = false, are_usual = true;
    const auto for_each = [&](auto work) {
      for (const CellKind kind : all_cell_kinds) {
        if (traits_of(kind).dimension == d) work(columns_of(mesh, kind));
      }
    };
    for_each([&](CellColumns& cells) {
      has_regions = has_regions || !cells.region.empty();
      are_usual =
          are_usual && std::ranges::all_of(cells.entity, [](auto e) { return e == 0 || e == 1; });
    });
    for_each([&](CellColumns& cells) {
      if (!has_regions && !are_usual) cells.region = cells.entity;
      if (!has_regions || are_usual || cells.entity == cells.region) cells.entity.clear();
    });
  }
}

/// Data sets that are neither read nor about the file itself (151, 2400: its header).
void skip_others(UnvReader& r) {
  constexpr std::int64_t ours[] = {15,   151,  164,  780,  781,  2400, 2411, 2412, 2417,
                                   2420, 2429, 2430, 2432, 2435, 2452, 2467, 2477};
  for (const UnvSection& section : r.sections) {
    if (std::ranges::find(ours, section.number) != std::end(ours)) continue;
    add_skipped(r.draft, "data sets", std::to_string(section.number), section.begin);
  }
}

}  // namespace

bool is_unv(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size() && first_word(line_at(text, at)).empty())
    at += line_at(text, at).size() + 1;
  if (at >= text.size() || !is_mark(line_at(text, at))) return false;
  at += line_at(text, at).size() + 1;
  if (at >= text.size()) return false;
  const std::string_view number = first_word(line_at(text, at));
  return !number.empty() && number.size() <= 5 && number.front() >= '1' && number.front() <= '9';
}

Draft read_unv(std::string_view text) {
  UnvReader r{.draft = {.text = text}};
  find_sections(r);
  for_each_section(r, {2420}, [&](const UnvSection&, UnvLines& lines) { read_systems(r, lines); });
  for_each_section(r, {2411, 781, 15}, [&](const UnvSection& section, UnvLines& lines) {
    take_units(r, section);
    section.number == 15 ? read_old_nodes(r, lines) : read_nodes(r, lines);
  });
  index_nodes(r);
  for_each_section(r, {2412, 780}, [&](const UnvSection& section, UnvLines& lines) {
    read_elements(r, lines, section.number == 780);
  });
  read_unv_groups(r);
  take_tables(r.draft.mesh);
  add_columns(r);
  skip_others(r);
  return std::move(r.draft);
}

}  // namespace sunder::io
