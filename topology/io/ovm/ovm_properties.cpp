// SPDX-License-Identifier: MIT
// Properties of OpenVolumeMesh's text: labels, numbers and data of points and cells.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "topology/io/ovm/ovm.hpp"
#include "topology/io/ovm/ovm_reader.hpp"
#include "topology/io/regions/named_regions.hpp"
#include "topology/io/tetgen/tetgen.hpp"
#include "topology/mesh/kinds/move_cells.hpp"

namespace sunder::io {
namespace {

constexpr std::string_view entity_words[] = {"vprop",  "eprop",  "fprop", "cprop",
                                             "heprop", "hfprop", "mprop"};

struct TypeName {
  std::string_view name;
  NumberType type;
  std::size_t components;
};
constexpr TypeName value_types[] = {
    {"int", NumberType::int32, 1},     {"uint", NumberType::uint32, 1},
    {"short", NumberType::int16, 1},   {"long", NumberType::int64, 1},
    {"ulong", NumberType::uint64, 1},  {"bool", NumberType::uint8, 1},
    {"float", NumberType::float32, 1}, {"double", NumberType::float64, 1},
    {"vec2f", NumberType::float32, 2}, {"vec2d", NumberType::float64, 2},
    {"vec2i", NumberType::int32, 2},   {"vec2ui", NumberType::uint32, 2},
    {"vec3f", NumberType::float32, 3}, {"vec3d", NumberType::float64, 3},
    {"vec3i", NumberType::int32, 3},   {"vec3ui", NumberType::uint32, 3},
    {"vec4f", NumberType::float32, 4}, {"vec4d", NumberType::float64, 4},
    {"vec4i", NumberType::int32, 4},   {"vec4ui", NumberType::uint32, 4},
};

std::size_t rows_of(const OvmReader& r, std::size_t dimension) {
  return dimension == 0   ? r.draft.mesh.points.size()
         : dimension == 1 ? r.edges.size()
         : dimension == 2 ? r.face_ends.size()
                          : r.polyhedra.size();
}

const TypeName* type_of(const OvmProperty& p) {
  const auto* const found = std::ranges::find(value_types, lower_case(p.type), &TypeName::name);
  return found == std::end(value_types) ? nullptr : found;
}

/// Calls `take(row, component, value)` for every value.
template <class Value, class Take>
void for_values(OvmReader& r, const OvmProperty& p, Take take) {
  const std::size_t rows = rows_of(r, p.dimension), components = type_of(p)->components;
  Scanner s{r.s.text, p.at};
  check_count(s, p.at, static_cast<std::int64_t>(rows), "values of a property", 2 * components - 1);
  for (std::size_t i = 0; i < rows; ++i) {
    while (peek_word(s).starts_with('#')) rest_of_line(s);
    for (std::size_t k = 0; k < components; ++k) {
      take(i, k, read_number<Value>(s, "a property's value"));
    }
  }
}

bool is_real(const TypeName& t) {
  return t.type == NumberType::float32 || t.type == NumberType::float64;
}

/// Values of the rows that `is_kept` keeps; all where it is empty.
DataColumn read_column(OvmReader& r, const OvmProperty& p, const std::vector<bool>& is_kept) {
  const TypeName& type = *type_of(p);
  DataColumn column{unescaped_name(p.name), type.components, type.type, {}};
  const auto fill = [&](auto values) {
    using Value = typename decltype(values)::value_type;
    const auto kept =
        is_kept.empty()
            ? rows_of(r, p.dimension)
            : static_cast<std::size_t>(std::count(is_kept.begin(), is_kept.end(), true));
    values.reserve(kept * type.components);
    for_values<Value>(r, p, [&](std::size_t row, std::size_t, Value value) {
      if (is_kept.empty() || is_kept[row]) values.push_back(value);
    });
    column.values = std::move(values);
  };
  is_real(type) ? fill(std::vector<double>{}) : fill(std::vector<std::int64_t>{});
  return column;
}

/// The property of Sunder's own, an integer a row, if it is there.
const OvmProperty* find_own(const OvmReader& r, std::size_t dimension, OvmOwn own) {
  const std::string_view name = ovm_own[static_cast<std::size_t>(own)];
  for (const OvmProperty& p : r.properties) {
    const TypeName* const type = type_of(p);
    if (p.dimension == dimension && p.name == name && type != nullptr && type->components == 1 &&
        !is_real(*type)) {
      return &p;
    }
  }
  return nullptr;
}

template <class Number>
std::vector<Number> read_own(OvmReader& r, std::size_t dimension, OvmOwn own,
                             const std::vector<bool>& is_kept) {
  std::vector<Number> values;
  const OvmProperty* const p = find_own(r, dimension, own);
  if (p == nullptr) return values;
  for_values<Number>(r, *p, [&](std::size_t row, std::size_t, Number value) {
    if (is_kept.empty() || is_kept[row]) values.push_back(value);
  });
  return values;
}

bool is_own(const OvmReader& r, const OvmProperty& p) {
  for (std::size_t own = 0; own < std::size(ovm_own); ++own) {
    const bool of_points = static_cast<OvmOwn>(own) == OvmOwn::point_id;
    const bool of_cells = static_cast<OvmOwn>(own) != OvmOwn::region && !of_points;
    if ((of_points && p.dimension != 0) || (of_cells && p.dimension == 0)) continue;
    if (find_own(r, p.dimension, static_cast<OvmOwn>(own)) == &p) return true;
  }
  return false;
}

/// k and n of a name that ends with [k/n], one of the n components of a column.
std::optional<std::array<std::size_t, 2>> part_of(std::string_view name) {
  std::array<std::size_t, 2> part{};
  const std::size_t begin = name.rfind('[');
  if (begin == std::string_view::npos || !name.ends_with(']')) return std::nullopt;
  const char* const end = name.data() + name.size() - 1;
  const auto [slash, reason] = std::from_chars(name.data() + begin + 1, end, part[0]);
  if (reason != std::errc{} || slash == end || *slash != '/') return std::nullopt;
  const auto [stop, why] = std::from_chars(slash + 1, end, part[1]);
  if (why != std::errc{} || stop != end || part[0] >= part[1] || part[1] <= 4) return std::nullopt;
  return part;
}

/// Joins columns NAME[0/n] to NAME[n-1/n], which stand one after the other.
void join_parts(std::vector<DataColumn>& columns) {
  std::vector<DataColumn> joined;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto part = part_of(columns[i].name);
    const std::string stem = columns[i].name.substr(0, columns[i].name.rfind('['));
    const auto belongs = [&](const DataColumn& c, std::size_t k) {
      return c.components == 1 && c.type == NumberType::float64 &&
             c.name == fmt::format("{}[{}/{}]", stem, k, (*part)[1]);
    };
    bool is_whole = part && (*part)[1] <= columns.size() - i;
    for (std::size_t k = 0; is_whole && k < (*part)[1]; ++k) is_whole = belongs(columns[i + k], k);
    if (!is_whole) {
      joined.push_back(std::move(columns[i]));
      continue;
    }
    const std::size_t n = (*part)[1];
    const std::size_t rows = std::get<0>(columns[i].values).size();
    std::vector<double> values(n * rows);
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t row = 0; row < rows; ++row) {
        values[row * n + k] = std::get<0>(columns[i + k].values)[row];
      }
    }
    joined.push_back({stem, n, NumberType::float64, std::move(values)});
    i += n - 1;
  }
  columns = std::move(joined);
}

constexpr std::string_view left_out = "properties";

/// Properties of other things than numbers.
void skip_words_of(OvmReader& r) {
  for (const OvmProperty& p : r.properties) {
    if (type_of(p) == nullptr) add_skipped(r.draft, left_out, p.name, p.at);
  }
}

/// Data of the dimension's rows that are kept.
std::vector<DataColumn> read_data(OvmReader& r, std::size_t dimension,
                                  const std::vector<bool>& is_kept) {
  std::vector<DataColumn> columns;
  for (const OvmProperty& p : r.properties) {
    if (p.dimension != dimension || is_own(r, p) || type_of(p) == nullptr) continue;
    columns.push_back(read_column(r, p, is_kept));
  }
  join_parts(columns);
  return columns;
}

/// Which edges or faces are cells of the mesh.
std::vector<bool> cells_among(OvmReader& r, std::size_t dimension, const std::vector<bool>& used) {
  std::vector<bool> is_cell(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) is_cell[i] = !used[i];
  const OvmProperty* const marks = find_own(r, dimension, OvmOwn::cell);
  if (marks == nullptr) return is_cell;
  for_values<std::int64_t>(r, *marks, [&](std::size_t row, std::size_t, std::int64_t mark) {
    is_cell[row] = mark != 0;
  });
  return is_cell;
}

/// Turns bases back to the order of corners before writing, and the nodes above them likewise.
void turn_cells(OvmReader& r, CellKind kind, const std::vector<bool>& is_cell) {
  const auto turns = read_own<std::int64_t>(r, 3, OvmOwn::turn, is_cell);
  const std::size_t n = corners_of_base(kind), nodes = traits_of(kind).nodes;
  const std::span<std::uint32_t> all = nodes_of(r.draft.mesh, kind);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (turns[i] < 1 || turns[i] >= static_cast<std::int64_t>(n)) continue;
    for (std::size_t begin = 0; begin + n <= nodes; begin += n) {
      const auto part = all.subspan(i * nodes + begin, n);
      std::rotate(part.begin(), part.begin() + turns[i], part.end());
    }
  }
}

/// Values of edges, faces and polyhedra that are no cells. Our own files mark those that are, and
/// fill the others.
void skip_others(OvmReader& r, std::size_t dimension,
                 const std::vector<std::optional<CellKind>>& kind_of_row) {
  const auto others = std::ranges::count_if(kind_of_row, [](const auto& kind) { return !kind; });
  const bool is_ours = find_own(r, dimension, OvmOwn::cell) != nullptr;
  for (const OvmProperty& p : r.properties) {
    if (p.dimension != dimension || is_own(r, p) || type_of(p) == nullptr || is_ours) continue;
    add_skipped(r.draft, "properties of edges, faces or polyhedra that are no cells", p.name, p.at,
                static_cast<std::size_t>(others));
  }
}

/// The columns of the cells of one dimension; `kind_of_row`: those of its edges, faces or polyhedra
/// that are cells.
void read_columns(OvmReader& r, std::size_t dimension,
                  const std::vector<std::optional<CellKind>>& kind_of_row) {
  std::size_t kinds = 0;
  for (const CellKind kind : all_cell_kinds) {
    if (traits_of(kind).dimension != static_cast<int>(dimension)) continue;
    if (rows_of(r.draft.mesh, kind).count == 0) continue;
    ++kinds;
    std::vector<bool> is_cell(kind_of_row.size());
    for (std::size_t i = 0; i < is_cell.size(); ++i) is_cell[i] = kind_of_row[i] == kind;
    CellColumns& cells = columns_of(r.draft.mesh, kind);
    cells.region = read_own<std::int32_t>(r, dimension, OvmOwn::region, is_cell);
    cells.entity = read_own<std::int32_t>(r, dimension, OvmOwn::entity, is_cell);
    cells.source_id = read_own<std::int64_t>(r, dimension, OvmOwn::cell_id, is_cell);
    cells.data = read_data(r, dimension, is_cell);
    if (dimension == 3) turn_cells(r, kind, is_cell);
  }
  skip_others(r, dimension, kind_of_row);
  if (kinds < 2) return;
  for (const CellKind kind : all_cell_kinds) {
    if (traits_of(kind).dimension != static_cast<int>(dimension)) continue;
    drop_filling(columns_of(r.draft.mesh, kind));
  }
}

void read_edge_properties(OvmReader& r) {
  const std::vector<bool> is_cell = cells_among(r, 1, r.edge_has_face);
  std::vector<std::optional<CellKind>> kind_of_row(is_cell.size());
  for (std::size_t i = 0; i < is_cell.size(); ++i) {
    if (!is_cell[i]) continue;
    r.draft.mesh.edges.corners.push_back(r.edges[i]);
    kind_of_row[i] = CellKind::edge;
  }
  read_columns(r, 1, kind_of_row);
}

void read_faces(OvmReader& r) {
  const std::vector<bool> is_cell = cells_among(r, 2, r.face_has_cell);
  std::vector<std::optional<CellKind>> kind_of_row(is_cell.size());
  std::size_t few = 0;
  for (std::size_t i = 0; i < is_cell.size(); ++i) {
    if (!is_cell[i]) continue;
    const auto corners = face_of(r, i);
    if (corners.size() < 3) {
      ++few;
      continue;
    }
    kind_of_row[i] = kind_of_face(corners.size());
    append_cell(r.draft.mesh, *kind_of_row[i], corners);
  }
  add_other_cells(r.draft, "faces of fewer than three corners", 2, few, 0);
  read_columns(r, 2, kind_of_row);
}

/// Whether a line begins with the word of a property.
std::size_t entity_of(std::string_view word) {
  return static_cast<std::size_t>(std::ranges::find(entity_words, lower_case(word)) -
                                  std::begin(entity_words));
}

}  // namespace

void find_ovm_properties(OvmReader& r) {
  Scanner& s = r.s;
  rest_of_line(s);
  while (s.at < s.text.size()) {
    skip_blanks(s);
    Scanner line{rest_of_line(s)};
    const std::string_view text = line.text;
    if (text.empty()) continue;
    const bool may_be = std::string_view("VEHFCMvehfcm").find(text[0]) != std::string_view::npos;
    const std::size_t entity = may_be ? entity_of(next_word(line)) : std::size(entity_words);
    if (entity == std::size(entity_words)) continue;  // values
    OvmProperty p{.dimension = entity, .type = next_word(line), .name = {}, .at = s.at};
    const std::size_t begin = text.find('"'), end = text.rfind('"');
    if (begin == std::string_view::npos || end == begin) {
      fail(s.text, static_cast<std::size_t>(text.data() - s.text.data()),
           {.code = "bad_name",
            .text = fmt::format("{} stands where a property's type and its name in quotes were "
                                "expected",
                                in_quotes(text)),
            .remedy = "write the line as: VProp double \"name\""});
    }
    p.name = text.substr(begin + 1, end - begin - 1);
    constexpr std::size_t most = 1000;
    if (r.properties.size() >= most) {
      fail(s.text, p.at,
           {.code = "count_too_big",
            .text = fmt::format("there are more than {} properties", most),
            .remedy = "leave some out"});
    }
    if (entity <= 3) r.properties.push_back(p);
    if (entity > 3) add_skipped(r.draft, left_out, p.name, p.at);
  }
}

void read_ovm_properties(OvmReader& r) {
  FileMesh& mesh = r.draft.mesh;
  mesh.point_region = read_own<std::int32_t>(r, 0, OvmOwn::region, {});
  mesh.source_point_id = read_own<std::int64_t>(r, 0, OvmOwn::point_id, {});
  mesh.point_data = read_data(r, 0, {});
  read_edge_properties(r);
  read_faces(r);
  read_columns(r, 3, r.polyhedra);
  skip_words_of(r);
}

}  // namespace sunder::io
