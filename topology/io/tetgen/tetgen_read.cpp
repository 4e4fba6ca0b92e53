// SPDX-License-Identifier: MIT
// TetGen's files read: the meaning of their numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "topology/base/whole_number.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/regions/named_regions.hpp"
#include "topology/io/tetgen/tetgen.hpp"
#include "topology/io/tetgen/tetgen_table.hpp"

namespace sunder::io {
namespace {

/// Whether all of them are integers that a region can be.
bool are_labels(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double x) {
    return x >= -2147483648.0 && x <= 2147483647.0 && x == std::floor(x);
  });
}

/// Regions; those that are all 0 say nothing.
std::vector<std::int32_t> labels_of(const std::vector<double>& values) {
  if (std::ranges::all_of(values, [](double x) { return x == 0; })) return {};
  std::vector<std::int32_t> labels;
  labels.reserve(values.size());
  for (const double x : values) labels.push_back(number_cast<std::int32_t>(x));
  return labels;
}

struct TetgenReader {
  Draft draft;
  /// The number of the first point.
  std::int64_t first = 1;
  /// Whether the cells have points on their edges.
  bool is_curved = false;
};

void expect_number(const Table& table, std::int64_t number, std::int64_t expected) {
  if (number == expected) return;
  fail(table.text, table.line.at,
       {.code = "wrong_number",
        .text = fmt::format("point {} stands where point {} was expected: TetGen counts points by "
                            "their place",
                            number, expected),
        .remedy = "number the points one after the other, from 0 or 1"});
}

/// The content of a row behind the numbers that the first line announces.
void skip_rest(TetgenReader& r, Table& table, std::string_view what) {
  if (at_line_end(table)) return;
  add_skipped(r.draft, "numbers behind the rows", what, table.line.at);
}

void refuse_plane(const Table& table, std::string_view text) {
  fail(table.text, table.line.at,
       {.code = "unsupported_cells",
        .text = std::string(text),
        .remedy = "give a mesh of tetrahedra: this looks like a file of Triangle"});
}

void read_points(TetgenReader& r, Table table) {
  const std::size_t rows = read_rows(table, "points");
  const std::int64_t dimension = read_head(table, "the dimension", 3, 1000);
  if (dimension != 3) {
    refuse_plane(table, fmt::format("the points have {} coordinates: 3 were expected", dimension));
  }
  const auto attributes =
      static_cast<std::size_t>(read_head(table, "the number of attributes", 0, most_attributes));
  const auto markers =
      static_cast<std::size_t>(read_head(table, "the number of boundary markers (0 or 1)", 0, 1));
  bound_rows(table, rows, "points", 4 + attributes + markers);
  // The marker's name is the last, where it is there at all.
  std::span<const ColumnName> names = table.names;
  const bool names_marker = markers == 1 && numbers_named(table) == attributes + 1;
  if (names_marker) names = names.first(names.size() - 1);
  std::vector<DataColumn> columns = new_columns(names, attributes, rows);
  std::vector<double> marker;
  marker.reserve(markers * rows);
  FileMesh& mesh = r.draft.mesh;
  mesh.points.reserve(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    expect_row(table, i, rows, "points");
    const std::size_t at = table.line.at;
    const auto number = read_in_line<std::int64_t>(table, "a point's number");
    if (i == 0) r.first = number;
    expect_number(table, number, r.first + static_cast<std::int64_t>(i));
    Point p;
    for (double& x : p) x = read_in_line<double>(table, "a coordinate");
    add_point(r.draft, p, at);
    read_columns(table, columns);
    if (markers == 1) marker.push_back(read_in_line<double>(table, "a boundary marker"));
    skip_rest(r, table, "points");
  }
  expect_end(table, rows, "points");
  mesh.point_data = std::move(columns);
  if (are_labels(marker)) {
    mesh.point_region = labels_of(marker);
  } else {
    mesh.point_data.push_back({names_marker ? table.names.back().name : "marker", 1,
                               NumberType::float64, std::move(marker)});
  }
  if (r.first == 0 || r.first == 1) return;
  for (std::size_t i = 0; i < rows; ++i) {
    mesh.source_point_id.push_back(r.first + static_cast<std::int64_t>(i));
  }
}

/// The number of a cell and its nodes.
std::int64_t read_cell(TetgenReader& r, Table& table, CellKind kind) {
  FileCell& cell = r.draft.cell;
  const std::size_t nodes = traits_of(kind).nodes;
  const std::span<const std::uint8_t> order = tetgen_order(kind);
  cell.begin(nodes, table.line.at);
  const auto number = read_in_line<std::int64_t>(table, "a cell's number");
  for (std::size_t k = 0; k < nodes; ++k) {
    const std::size_t place = order.empty() ? k : order[k];
    cell.numbers[place] = read_in_line<std::int64_t>(table, "a point's number");
    const bool is_below = cell.numbers[place] < r.first;
    cell.rows[place] = is_below ? -1 : cell.numbers[place] - r.first;
  }
  add_cell(r.draft, kind, cell);
  return number;
}

/// Numbers that count on from 0 or 1 say nothing.
void drop_counting(std::vector<std::int64_t>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool starts = numbers.front() == 0 || numbers.front() == 1;
    if (!starts || numbers[i] != numbers.front() + static_cast<std::int64_t>(i)) return;
  }
  numbers.clear();
}

void read_tetrahedra(TetgenReader& r, Table table) {
  const std::size_t rows = read_rows(table, "tetrahedra");
  const std::int64_t nodes = read_head(table, "the number of points a tetrahedron", 4, 1000);
  if (nodes != 4 && nodes != 10) {
    refuse_plane(table, fmt::format("the cells have {} points: 4 or 10 were expected", nodes));
  }
  auto attributes =
      static_cast<std::size_t>(read_head(table, "the number of attributes", 0, most_attributes));
  bound_rows(table, rows, "tetrahedra", 1 + static_cast<std::size_t>(nodes) + attributes);
  r.is_curved = nodes == 10;
  // Without a name the first attribute is the region, where it can be.
  const bool fits = numbers_named(table) == attributes;
  const bool has_region = attributes > 0 && (!fits || is_tetgen_region(table.names.front().raw));
  std::span<const ColumnName> names = table.names;
  if (fits && has_region) names = names.subspan(1);
  std::vector<DataColumn> columns = new_columns(names, attributes - has_region, rows);
  std::vector<double> region;
  const CellKind kind = r.is_curved ? CellKind::tetrahedron10 : CellKind::tetrahedron;
  CellColumns& cells = columns_of(r.draft.mesh, kind);
  if (!r.is_curved) r.draft.mesh.tetrahedra.corners.reserve(rows);
  cells.source_id.reserve(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    expect_row(table, i, rows, "tetrahedra");
    cells.source_id.push_back(read_cell(r, table, kind));
    if (has_region) region.push_back(read_in_line<double>(table, "an attribute"));
    read_columns(table, columns);
    skip_rest(r, table, "tetrahedra");
  }
  expect_end(table, rows, "tetrahedra");
  drop_counting(cells.source_id);
  if (are_labels(region)) {
    cells.region = labels_of(region);
  } else {
    columns.insert(columns.begin(), {fits ? table.names.front().name : "attribute", 1,
                                     NumberType::float64, std::move(region)});
  }
  cells.data = std::move(columns);
}

/// Triangles or edges, which have a marker each at most.
void read_marked_cells(TetgenReader& r, Table table, CellKind kind) {
  const std::string_view what = traits_of(linear_kind(kind)).plural;
  const std::size_t rows = read_rows(table, what);
  const bool has_marker = read_head(table, "the number of boundary markers (0 or 1)", 0, 1) == 1;
  bound_rows(table, rows, what, 1 + traits_of(kind).nodes + has_marker);
  CellColumns& cells = columns_of(r.draft.mesh, kind);
  for (std::size_t i = 0; i < rows; ++i) {
    expect_row(table, i, rows, what);
    cells.source_id.push_back(read_cell(r, table, kind));
    if (has_marker) cells.region.push_back(read_in_line<std::int32_t>(table, "a marker"));
    skip_rest(r, table, what);
  }
  expect_end(table, rows, what);
  drop_counting(cells.source_id);
  if (std::ranges::all_of(cells.region, [](std::int32_t x) { return x == 0; })) {
    cells.region.clear();
  }
}

/// Reads the file of an ending, where it is there; false where it is not.
template <class Work>
bool read_part(TetgenReader& r, const FileSource& source, const std::string& name, Work work) {
  const std::string own = lower_case(source.name), asked = lower_case(name);
  if (asked == own || asked + ".gz" == own) {
    work(Table{.text = source.text});
    return true;
  }
  const std::optional<std::string> text = other_text(source, name);
  if (text) in_file(r.draft, name, *text, [&] { work(Table{.text = *text}); });
  return text.has_value();
}

}  // namespace

std::span<const std::uint8_t> tetgen_order(CellKind kind) {
  static constexpr std::uint8_t triangle[] = {0, 1, 2, 4, 5, 3};
  static constexpr std::uint8_t tetrahedron[] = {0, 1, 2, 3, 9, 7, 4, 5, 8, 6};
  if (kind == CellKind::triangle6) return triangle;
  if (kind == CellKind::tetrahedron10) return tetrahedron;
  return {};
}

std::string unescaped_name(std::string_view raw) {
  std::string name;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    unsigned char byte = 0;
    const char* const digits = raw.data() + i + 1;
    if (raw[i] == '%' && i + 2 < raw.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      name += static_cast<char>(byte);
      i += 2;
    } else {
      name += raw[i];
    }
  }
  return name;
}

bool is_tetgen(std::string_view) { return false; }

bool is_numbers(std::string_view text) {
  const std::string_view word = first_word(text);
  return !word.empty() &&
         std::string_view("0123456789+-.#").find(word[0]) != std::string_view::npos;
}

std::filesystem::path tetgen_stem(const std::filesystem::path& path) {
  const auto ends_as_ours = [](const std::filesystem::path& p) {
    return std::ranges::count(traits_of(MeshFormat::tetgen).extensions,
                              lower_case(p.extension().native())) > 0;
  };
  std::filesystem::path stem = path;
  if (lower_case(stem.extension().native()) == ".gz") stem.replace_extension();
  return ends_as_ours(stem) ? stem.replace_extension() : path;
}

bool is_tetgen_region(std::string_view name) {
  constexpr std::string_view names[] = {"region", "tetgen:ref", "gmsh:physical", "medit:ref"};
  return std::ranges::find(names, name) != std::end(names);
}

Draft read_tetgen(const FileSource& source) {
  TetgenReader r{.draft = {.text = source.text}};
  const std::string stem = tetgen_stem(source.name).string();
  const auto points = [&](Table t) { read_points(r, std::move(t)); };
  if (!read_part(r, source, stem + ".node", points)) {
    throw ReadFailure{{.code = "missing_file",
                       .text = fmt::format("{} is not there: it holds the points of {}",
                                           in_quotes(stem + ".node"), in_quotes(source.name)),
                       .remedy = "put it beside this file"}};
  }
  read_part(r, source, stem + ".ele", [&](Table t) { read_tetrahedra(r, std::move(t)); });
  read_part(r, source, stem + ".face", [&](Table t) {
    read_marked_cells(r, std::move(t), r.is_curved ? CellKind::triangle6 : CellKind::triangle);
  });
  read_part(r, source, stem + ".edge", [&](Table t) {
    read_marked_cells(r, std::move(t), r.is_curved ? CellKind::edge3 : CellKind::edge);
  });
  return std::move(r.draft);
}

}  // namespace sunder::io
