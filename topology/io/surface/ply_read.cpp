// SPDX-License-Identifier: MIT
// PLY read: the role of each property of a row, then the rows.
#include <fmt/format.h>

#include <algorithm>

#include "topology/io/surface/ply.hpp"
#include "topology/io/surface/ply_reader.hpp"
#include "topology/io/vtk/vtk_columns.hpp"
#include "topology/mesh/kinds/move_cells.hpp"

namespace sunder::io {

std::int64_t read_integer(PlyReader& r, NumberType type, std::string_view what) {
  return with_stored(type, [&](auto zero) {
    return number_cast<std::int64_t>(read_scalar<decltype(zero)>(r, what));
  });
}

/// The length of a list that stands next.
std::size_t read_length(PlyReader& r, const Property& p) {
  const std::size_t at = place_of_next(r.in);
  const std::int64_t length = read_integer(r, p.count_type, "the length of a list");
  check_count(r.in.s, at, length, "items of a list", r.in.is_binary ? size_of(p.type) : 2);
  return static_cast<std::size_t>(length);
}

void skip_property(PlyReader& r, const Property& p) {
  const std::size_t length = p.is_list ? read_length(r, p) : 1;
  skip_numbers(r.in, length, length * size_of(p.type), "a number");
}

std::size_t begin_row(PlyReader& r) {
  Scanner& s = r.in.s;
  std::size_t at = place_of_next(r.in);
  while (!r.in.is_binary && at < s.text.size() && (s.text[at] == 'c' || s.text[at] == 'o')) {
    const std::string_view word = peek_word(s);
    if (word != "comment" && word != "obj_info") break;
    rest_of_line(s);
    at = place_of_next(r.in);
  }
  begin_row(r.watch, at);
  return at;
}

void end_row(PlyReader& r) {
  if (!r.in.is_binary) end_row(r.watch, r.in.s);
}

/// The list of a face's corners.
void assign_corners(const PlyReader& r, Element& e) {
  for (Property& p : e.properties) {
    if (!p.is_list || (p.name != "vertex_indices" && p.name != "vertex_index")) continue;
    if (is_real(p.type)) continue;
    p.role = Role::corners;
    return;
  }
  fail(r.in.s.text, e.at,
       {.code = "missing_array",
        .text = fmt::format("the element {} has no list of integers vertex_indices", e.name),
        .remedy = "correct the header, or write the file again"});
}

namespace {

struct Column {
  DataColumn data;
  /// Named by a comment: data whatever the name is.
  bool is_joined = false;
};

/// How many properties from `first` on a comment joins to one column, and its name.
const JoinedColumn* joined_from(const PlyReader& r, const Element& e, std::size_t first) {
  const Property& p = e.properties[first];
  for (const JoinedColumn& j : r.header.joined) {
    if (j.element != e.name || j.property != p.name || j.components == 0) continue;
    if (j.components > e.properties.size() - first) continue;
    const auto begin = e.properties.begin() + static_cast<std::ptrdiff_t>(first);
    const bool fits = std::all_of(
        begin, begin + static_cast<std::ptrdiff_t>(j.components),
        [&](const Property& other) { return other.role == Role::data && other.type == p.type; });
    if (fits) return &j;
  }
  return nullptr;
}

/// A column for each property that is data; reserved where the file has the bytes.
std::vector<Column> plan_columns(const PlyReader& r, Element& e) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < e.properties.size(); ++i) {
    const Property& p = e.properties[i];
    if (p.role != Role::data) continue;
    const JoinedColumn* const joined = joined_from(r, e, i);
    const std::size_t components = joined == nullptr ? 1 : joined->components;
    Column& column = columns.emplace_back();
    column.is_joined = joined != nullptr;
    column.data = {std::string(joined == nullptr ? p.name : joined->name), components, p.type, {}};
    if (!is_real(p.type)) column.data.values = std::vector<std::int64_t>{};
    std::visit([&](auto& values) { values.reserve(e.count * components); }, column.data.values);
    for (std::size_t k = 0; k < components; ++k) e.properties[i + k].place = columns.size() - 1;
    i += components - 1;
  }
  return columns;
}

double read_coordinate(PlyReader& r, NumberType type) {
  // A text's digits are more than a float keeps.
  if (!r.in.is_binary) return read_number<double>(r.in.s, "a coordinate");
  return with_stored(type, [&](auto zero) {
    return static_cast<double>(read_raw<decltype(zero)>(r.in, "a coordinate"));
  });
}

void read_value(PlyReader& r, const Property& p, DataColumn& column) {
  with_stored(p.type, [&](auto zero) {
    const auto value = read_scalar<decltype(zero)>(r, "a number");
    if constexpr (std::is_floating_point_v<decltype(zero)>) {
      std::get<std::vector<double>>(column.values).push_back(static_cast<double>(value));
    } else {
      std::get<std::vector<std::int64_t>>(column.values)
          .push_back(static_cast<std::int64_t>(value));
    }
  });
}

/// The contents of a row besides data.
struct Row {
  Point point{};
  FileCell& cell;
};

void read_corners(PlyReader& r, const Property& p, Row& row) {
  const std::size_t corners = read_length(r, p);
  const std::size_t taken = std::min(corners, most_corners + 1);
  row.cell.begin(taken, row.cell.at);
  for (std::size_t k = 0; k < taken; ++k) {
    row.cell.numbers[k] = row.cell.rows[k] = read_integer(r, p.type, "a point's row");
  }
  skip_numbers(r.in, corners - taken, (corners - taken) * size_of(p.type), "a point's row");
}

void read_row(PlyReader& r, const Element& e, Row& row, std::vector<Column>& columns) {
  row.cell.at = begin_row(r);
  for (const Property& p : e.properties) {
    switch (p.role) {
      case Role::skipped:
        skip_property(r, p);
        break;
      case Role::coordinate:
        row.point[p.place] = read_coordinate(r, p.type);
        break;
      case Role::corners:
        read_corners(r, p, row);
        break;
      case Role::edge_end:
        row.cell.numbers[p.place] = row.cell.rows[p.place] =
            read_integer(r, p.type, "a point's row");
        break;
      case Role::data:
        read_value(r, p, columns[p.place].data);
    }
  }
  end_row(r);
}

/// The fewest bytes that a row takes.
std::size_t least_bytes(const PlyReader& r, const Element& e) {
  std::size_t bytes = 0;
  for (const Property& p : e.properties) {
    bytes += r.in.is_binary ? size_of(p.is_list ? p.count_type : p.type) : 2;
  }
  // The last number of a file may end without a blank.
  return r.in.is_binary || bytes == 0 ? bytes : bytes - 1;
}

/// Gives the properties of these names their role; `needed` fails where one is not there.
void assign(const PlyReader& r, Element& e, Role role,
            std::initializer_list<std::string_view> names) {
  std::size_t place = 0;
  for (const std::string_view name : names) {
    const auto p = std::ranges::find_if(e.properties, [&](const Property& property) {
      return property.name == name && !property.is_list && property.role != role;
    });
    const bool is_there =
        p != e.properties.end() && (role == Role::coordinate || !is_real(p->type));
    if (!is_there) {
      fail(r.in.s.text, e.at,
           {.code = "missing_array",
            .text = fmt::format("the element {} has no property {}{}", in_quotes(e.name),
                                role == Role::coordinate ? "" : "of integers ", in_quotes(name)),
            .remedy = "correct the header, or write the file again"});
    }
    p->role = role;
    p->place = place++;
  }
}

/// Properties without another role are data; lists are left out.
void assign_data(PlyReader& r, Element& e) {
  for (Property& p : e.properties) {
    if (p.role != Role::skipped) continue;
    if (!p.is_list) p.role = Role::data;
    if (p.is_list) {
      add_skipped(r.draft, "lists", fmt::format("{} of {}", p.name, e.name), e.at, e.count);
    }
  }
}

/// The numbers of a column as labels of 32 bits, if they are.
bool take_labels(const DataColumn& column, std::vector<std::int32_t>& labels) {
  const auto* const values = std::get_if<std::vector<std::int64_t>>(&column.values);
  if (values == nullptr || !labels.empty() || values->empty()) return false;
  if (!std::ranges::all_of(*values,
                           [](std::int64_t x) { return x == static_cast<std::int32_t>(x); })) {
    return false;
  }
  labels.assign(values->begin(), values->end());
  return true;
}

bool take_numbers(DataColumn& column, std::vector<std::int64_t>& numbers) {
  auto* const values = std::get_if<std::vector<std::int64_t>>(&column.values);
  if (values == nullptr || !numbers.empty()) return false;
  numbers = std::move(*values);
  return true;
}

void take_columns(CellColumns& cells, std::vector<Column>& columns) {
  for (Column& c : columns) {
    const std::string_view name = c.data.name;
    if (!c.is_joined) {
      if (is_region_name(name) && take_labels(c.data, cells.region)) continue;
      if (is_entity_name(name) && take_labels(c.data, cells.entity)) continue;
      if (is_cell_id_name(name) && take_numbers(c.data, cells.source_id)) continue;
    }
    cells.data.push_back(std::move(c.data));
  }
}

void drop_last(std::vector<Column>& columns) {
  for (Column& c : columns) {
    std::visit([&](auto& values) { values.resize(values.size() - c.data.components); },
               c.data.values);
  }
}

void read_vertices(PlyReader& r, Element& e) {
  assign(r, e, Role::coordinate, {"x", "y", "z"});
  assign_data(r, e);
  std::vector<Column> columns = plan_columns(r, e);
  FileMesh& mesh = r.draft.mesh;
  mesh.points.reserve(e.count);
  Row row{.cell = r.draft.cell};
  for (std::size_t i = 0; i < e.count; ++i) {
    read_row(r, e, row, columns);
    add_point(r.draft, row.point, row.cell.at);
  }
  for (Column& c : columns) {
    if (!c.is_joined && c.data.name == "source_point_id" &&
        take_numbers(c.data, mesh.source_point_id)) {
      continue;
    }
    if (!c.is_joined && c.data.name == "point_region" && take_labels(c.data, mesh.point_region)) {
      continue;
    }
    mesh.point_data.push_back(std::move(c.data));
  }
}

void read_faces(PlyReader& r, Element& e) {
  assign_corners(r, e);
  assign_data(r, e);
  std::vector<Column> columns = plan_columns(r, e);
  FileMesh& mesh = r.draft.mesh;
  std::vector<CellKind> kind_of_row;
  const auto is_one_kind = [&] {
    return kind_of_row.empty() || rows_of(mesh, kind_of_row[0]).count == kind_of_row.size();
  };
  for (std::size_t i = 0; i < e.count; ++i) {
    Row row{.cell = r.draft.cell};
    read_row(r, e, row, columns);
    const std::optional<CellKind> kind = add_face(r.draft, row.cell);
    kind ? kind_of_row.push_back(*kind) : drop_last(columns);
  }
  if (kind_of_row.empty()) return;
  if (is_one_kind()) return take_columns(columns_of(mesh, kind_of_row[0]), columns);
  CellColumns all;
  take_columns(all, columns);
  deal_columns(mesh, std::move(all), kind_of_row);
}

void read_edges(PlyReader& r, Element& e) {
  assign(r, e, Role::edge_end, {"vertex1", "vertex2"});
  assign_data(r, e);
  std::vector<Column> columns = plan_columns(r, e);
  for (std::size_t i = 0; i < e.count; ++i) {
    Row row{.cell = r.draft.cell};
    row.cell.begin(2, 0);
    read_row(r, e, row, columns);
    add_cell(r.draft, CellKind::edge, row.cell);
  }
  take_columns(r.draft.mesh.edges, columns);
}

void skip_element(PlyReader& r, const Element& e) {
  if (e.properties.empty()) return;  // its rows take no bytes: there may be any number
  std::vector<Column> none;
  Row row{.cell = r.draft.cell};
  for (std::size_t i = 0; i < e.count; ++i) read_row(r, e, row, none);
  add_skipped(r.draft, "elements", e.name, e.at, e.count);
}

void read_element(PlyReader& r, Element& e) {
  const std::size_t least = least_bytes(r, e);
  if (least > 0) {
    check_count(r.in.s, e.at, static_cast<std::int64_t>(e.count),
                fmt::format("rows of {}", in_quotes(e.name)), least);
  }
  if (e.name == "vertex") return read_vertices(r, e);
  const bool is_strip = e.name == "tristrips";
  const bool is_cell = e.name == "face" || e.name == "edge" || is_strip;
  if (!is_cell) return skip_element(r, e);
  if (e.count > 0 && &e == &r.header.elements.front()) {
    fail(r.in.s.text, e.at,
         {.code = "wrong_section_order",
          .text = fmt::format("the element {} stands before the vertices", e.name),
          .remedy = "put the element vertex first"});
  }
  if (is_strip) return pass_strips(r, e);
  e.name == "face" ? read_faces(r, e) : read_edges(r, e);
}

}  // namespace

bool is_ply(std::string_view text) {
  if (!text.starts_with("ply")) return false;
  const std::size_t end = text.find_first_not_of(" \t\r", 3);
  return end != std::string_view::npos && text[end] == '\n';
}

Draft read_ply(std::string_view text) {
  PlyReader r{.in = {.s = {.text = text}}, .draft = {.text = text}};
  r.header = read_ply_header(r.in.s);
  for (const UnknownLine& line : r.header.unknown) {
    add_skipped(r.draft, "unknown lines of the header", line.word, line.at);
  }
  r.in.is_binary = r.header.is_binary;
  r.in.swap = r.header.swap;
  if (r.in.is_binary) r.draft.text = {};  // there are no lines to count
  try {
    for (Element& e : r.header.elements) read_element(r, e);
    add_strips(r);
    check_end(r.draft, r.in, "row");
  } catch (ReadFailure& failure) {
    if (!r.in.is_binary) blame_row(r.watch, text, failure);
    throw;
  }
  return std::move(r.draft);
}

}  // namespace sunder::io
