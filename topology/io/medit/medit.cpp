// SPDX-License-Identifier: MIT
// Reading MEDIT: keywords in any order, each with a count and that many rows. In binary
// files keywords are numbers, and each gives the place of the next.
#include "topology/io/medit/medit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "topology/io/medit/medit_order.hpp"
#include "topology/io/medit/medit_skipped.hpp"
#include "topology/io/text/number_source.hpp"
#include "topology/io/text/row_watch.hpp"

namespace sunder::io {
namespace {

/// Sections of cells: their nodes, then a reference.
struct CellSection {
  std::string_view keyword;
  /// Of binary files; 0 for a second spelling.
  int code;
  CellKind kind;

  std::size_t nodes() const { return traits_of(kind).nodes; }
  /// Another section may give the order of its nodes: it is read once all were seen.
  bool has_order() const { return medit_order_of(kind) != nullptr; }
};
constexpr CellSection cell_sections[] = {
    {"Edges", 5, CellKind::edge},
    {"Triangles", 6, CellKind::triangle},
    {"Quadrilaterals", 7, CellKind::quad4},
    {"Tetrahedra", 8, CellKind::tetrahedron},
    {"Prisms", 9, CellKind::prism6},
    {"Pentahedra", 0, CellKind::prism6},
    {"Hexahedra", 10, CellKind::hexahedron8},
    {"Hexaedra", 0, CellKind::hexahedron8},
    {"Pyramids", 49, CellKind::pyramid5},
    {"EdgesP2", 25, CellKind::edge3},
    {"TrianglesP2", 24, CellKind::triangle6},
    {"TetrahedraP2", 30, CellKind::tetrahedron10},
    {"QuadrilateralsQ2", 27, CellKind::quad9},
    {"HexahedraQ2", 33, CellKind::hexahedron27},
    {"PrismsP2", 86, CellKind::prism18},
    {"PyramidsP2", 87, CellKind::pyramid14},
};

struct MeditReader {
  NumberSource in;
  Draft draft;
  RowWatch watch;
  /// Of binary files: 1 has floats, 3 wide places, 4 wide integers too.
  int version = 2;
  /// 2 or 3: how many coordinates a vertex has.
  std::size_t dimension = 3;
  bool has_vertices = false;
  /// Whether a section of cells was read, by its place in the table.
  std::array<bool, std::size(cell_sections)> has_cells{};
  /// For each node of a kind as the file lists it, its place in our order; empty where no section
  /// gives it.
  std::array<std::vector<std::uint8_t>, cell_kinds> order;
  /// Sections of cells before the vertices, which are needed to judge them: read behind those.
  /// Cells of second order are read behind all.
  struct Early {
    std::size_t place;
    /// Of the keyword, and behind it.
    std::size_t section_at;
    std::size_t at;
  };
  std::vector<Early> early;
};

/// The next word, passing comments (# to the end of the line).
std::string_view next_keyword(Scanner& s) {
  while (peek_word(s).substr(0, 1) == "#") rest_of_line(s);
  return next_word(s);
}

void refuse_second(MeditReader& r, bool seen, std::string_view keyword) {
  if (!seen) return;
  fail(r.in.s.text, r.in.s.at,
       {.code = "wrong_section_order",
        .text = fmt::format("a second section {}", keyword),
        .remedy = "join the two sections"});
}

std::size_t begin_row(MeditReader& r) {
  const std::size_t at = place_of_next(r.in);
  begin_row(r.watch, at);
  return at;
}

void end_row(MeditReader& r) {
  if (!r.in.is_binary) end_row(r.watch, r.in.s);
}

/// Integers of rows: 4 bytes, from version 4 on 8.
std::int64_t read_integer(MeditReader& r, std::string_view what) {
  return r.version == 4 ? read_next<std::int64_t>(r.in, what)
                        : read_next<std::int64_t, std::int32_t>(r.in, what);
}

double read_real(MeditReader& r, std::string_view what) {
  return r.version == 1 ? read_next<double, float>(r.in, what) : read_next<double>(r.in, what);
}

std::int32_t read_reference(MeditReader& r, std::string_view what) {
  if (!r.in.is_binary) return read_number<std::int32_t>(r.in.s, what);
  const std::size_t at = r.in.s.at;
  const std::int64_t value = read_integer(r, what);
  if (value == static_cast<std::int32_t>(value)) return static_cast<std::int32_t>(value);
  fail(r.in.s.text, at,
       {.code = "number_out_of_range",
        .text = fmt::format("{} is too big or too small to be {}", value, what),
        .remedy = "number the references with 32 bits"});
}

/// The count of rows of `numbers` numbers each, bounded by the rest of the file.
std::size_t read_rows(MeditReader& r, std::string_view what, std::size_t numbers) {
  const std::size_t bytes = numbers * (r.version == 4 ? 8 : 4);
  return r.version == 4 ? read_bounded<std::int64_t>(r.in, what, 2 * numbers, bytes)
                        : read_bounded<std::int32_t>(r.in, what, 2 * numbers, bytes);
}

void read_dimension(MeditReader& r) {
  const std::size_t at = place_of_next(r.in);
  const auto dimension = read_next<std::int64_t, std::int32_t>(r.in, "the dimension");
  if ((dimension == 2 || dimension == 3) && !r.has_vertices) {
    r.dimension = static_cast<std::size_t>(dimension);
    return;
  }
  const bool is_late = dimension == 2 || dimension == 3;
  fail(r.in.s.text, at,
       {.code = is_late ? "wrong_section_order" : "unsupported_cells",
        .text = is_late ? std::string("Dimension stands behind Vertices")
                        : fmt::format("the mesh has dimension {}: 2 or 3 was expected", dimension),
        .remedy = is_late ? "put Dimension first" : "give a mesh in the plane or in space"});
}

/// The rows of a section, behind its keyword.
void read_cell_rows(MeditReader& r, std::size_t place, std::size_t section_at) {
  const CellSection& section = cell_sections[place];
  const std::size_t n = read_rows(r, section.keyword, section.nodes() + 1);
  const std::vector<std::uint8_t>& order = r.order[index_of(section.kind)];
  const bool is_open = order.empty() && needs_medit_order(section.kind);
  const CellKind kind = is_open ? linear_kind(section.kind) : section.kind;
  const std::size_t nodes = traits_of(kind).nodes;
  if (is_open) {
    add_curved_cells(r.draft, fmt::format("cells of {}", section.keyword), n, section_at);
  }
  CellColumns& cells = columns_of(r.draft.mesh, kind);
  cells.region.reserve(cells.region.size() + n);
  FileCell& cell = r.draft.cell;
  for (std::size_t i = 0; i < n; ++i) {
    cell.begin(nodes, begin_row(r));
    for (std::size_t k = 0; k < nodes; ++k) {
      const std::int64_t number = read_integer(r, "a vertex number");
      const std::size_t node = order.empty() ? k : order[k];
      cell.numbers[node] = number;
      cell.rows[node] = number > 0 ? number - 1 : -1;
    }
    const std::size_t others = section.nodes() - nodes;
    skip_numbers(r.in, others, (r.version == 4 ? 8 : 4) * others, "a vertex number");
    add_cell(r.draft, kind, cell);
    cells.region.push_back(read_reference(r, "a cell's reference"));
    end_row(r);
  }
}

void read_cells(MeditReader& r, std::size_t place, std::size_t section_at) {
  const CellSection& section = cell_sections[place];
  refuse_second(r, r.has_cells[place], section.keyword);
  r.has_cells[place] = true;
  if (r.has_vertices && !section.has_order()) return read_cell_rows(r, place, section_at);
  r.early.push_back({place, section_at, r.in.s.at});
  const std::size_t numbers = section.nodes() + 1;
  const std::size_t n = read_rows(r, section.keyword, numbers);
  if (r.in.is_binary) {
    skip_numbers(r.in, 0, (r.version == 4 ? 8 : 4) * n * numbers, "a vertex number");
  } else {
    for (std::size_t i = 0; i < n; ++i) {
      begin_row(r);
      for (std::size_t k = 0; k < numbers; ++k) read_integer(r, "a vertex number");
      end_row(r);
    }
  }
}

/// Cells with a node order that may still come (`with_order`), or the others.
void read_early_cells(MeditReader& r, bool with_order) {
  const std::size_t at = r.in.s.at;
  for (const MeditReader::Early& early : r.early) {
    if (cell_sections[early.place].has_order() != with_order) continue;
    r.in.s.at = early.at;
    read_cell_rows(r, early.place, early.section_at);
  }
  r.in.s.at = at;
}

/// A section like HexahedraQ2Ordering, behind its keyword.
void read_order(MeditReader& r, const MeditOrder& section) {
  const std::size_t at = r.in.s.at;
  std::vector<std::uint8_t>& order = r.order[index_of(section.kind)];
  refuse_second(r, !order.empty(), section.keyword);
  const std::size_t nodes = traits_of(section.kind).nodes;
  const std::size_t rows = read_rows(r, "rows", section.numbers);
  std::vector<BezierPlace> places(rows == nodes ? nodes : 0);
  for (BezierPlace& place : places) {
    for (std::size_t k = 0; k < section.numbers; ++k) place[k] = read_integer(r, "an index");
  }
  auto found = order_of_places(section.kind, places);
  if (!found) {
    fail(r.in.s.text, at,
         {.code = "wrong_count",
          .text = fmt::format("{} does not give each of the {} nodes its own place",
                              section.keyword, nodes),
          .remedy = "write it as libMeshb does: Bezier indices from 0 to 2, a row for each node"});
  }
  order = std::move(*found);
}

void read_vertices(MeditReader& r) {
  refuse_second(r, r.has_vertices, "Vertices");
  r.has_vertices = true;
  const std::size_t n = read_rows(r, "vertices", r.dimension + 1);
  r.draft.mesh.points.reserve(n);
  r.draft.mesh.point_region.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = begin_row(r);
    Point p{};  // those of the plane have z = 0
    for (std::size_t k = 0; k < r.dimension; ++k) p[k] = read_real(r, "a coordinate");
    add_point(r.draft, p, at);
    r.draft.mesh.point_region.push_back(read_reference(r, "a vertex's reference"));
    end_row(r);
  }
  read_early_cells(r, false);
}

void read_section(MeditReader& r, std::string_view keyword, std::size_t at) {
  if (keyword == "MeshVersionFormatted") {
    read_number<std::int64_t>(r.in.s, "a format version");
  } else if (keyword == "Dimension") {
    read_dimension(r);
  } else if (keyword == "Vertices") {
    read_vertices(r);
  } else {
    for (std::size_t i = 0; i < std::size(cell_sections); ++i) {
      if (cell_sections[i].keyword == keyword) return read_cells(r, i, at);
    }
    for (const MeditOrder& order : medit_orders) {
      if (order.keyword == keyword) return read_order(r, order);
    }
    skip_medit_section(r.in.s, r.draft, keyword, r.dimension, at);
  }
}

/// References that are all 0 say nothing.
void drop_zeros(std::vector<std::int32_t>& references) {
  if (std::ranges::all_of(references, [](std::int32_t x) { return x == 0; })) references.clear();
}

void drop_empty_references(MeditReader& r) {
  drop_zeros(r.draft.mesh.point_region);
  for (const CellKind kind : all_cell_kinds) drop_zeros(columns_of(r.draft.mesh, kind).region);
}

/// One keyword of a binary file, up to the next; unused content is reported.
void read_binary_section(MeditReader& r, int code, std::size_t at) {
  if (code == dimension_code) return read_dimension(r);
  if (code == vertices_code) return read_vertices(r);
  for (std::size_t i = 0; i < std::size(cell_sections); ++i) {
    if (code > 0 && cell_sections[i].code == code) return read_cells(r, i, at);
  }
  for (const MeditOrder& order : medit_orders) {
    if (order.code == code) return read_order(r, order);
  }
  // One without a row is none.
  NumberSource ahead = r.in;
  const bool has_count = ahead.s.text.size() - ahead.s.at >= 4;
  if (has_count && read_raw<std::int32_t>(ahead, "a count") == 0) return;
  add_skipped(r.draft, "sections", medit_keyword_of(code), at);
}

[[noreturn]] void fail_place(const MeditReader& r, std::size_t at, int code, std::int64_t next) {
  fail(r.in.s.text, at,
       {.code = static_cast<std::size_t>(next) > r.in.s.text.size() && next > 0 ? "truncated_file"
                                                                                : "wrong_count",
        .text = fmt::format("keyword {} at byte {} says that the next stands at byte {} of {}; its "
                            "own rows end at byte {}",
                            code, at, next, r.in.s.text.size(), r.in.s.at),
        .remedy = "the file is damaged or cut short: copy or write it again"});
}

void read_binary(MeditReader& r) {
  r.in.is_binary = true;
  const auto one = read_raw<std::int32_t>(r.in, "the number 1 that tells the byte order");
  r.in.swap = one != 1;
  r.version = read_raw<std::int32_t>(r.in, "a format version");
  if (r.version < 1 || r.version > 4) {
    fail(r.in.s.text, 4,
         {.code = "unknown_version",
          .text = fmt::format("binary MEDIT of version {} is not read: 1 to 4 are", r.version),
          .remedy = "write it again as version 2 or 3"});
  }
  while (r.in.s.at < r.in.s.text.size()) {
    const std::size_t at = r.in.s.at;
    const int code = read_raw<std::int32_t>(r.in, "a keyword");
    const std::int64_t next = r.version >= 3
                                  ? read_raw<std::int64_t>(r.in, "the next keyword's place")
                                  : read_raw<std::int32_t>(r.in, "the next keyword's place");
    if (code == end_code) return;
    read_binary_section(r, code, at);
    if (next == 0) return;
    // Forward only: else a file could be read for ever.
    if (next < static_cast<std::int64_t>(r.in.s.at) ||
        next > static_cast<std::int64_t>(r.in.s.text.size())) {
      fail_place(r, at, code, next);
    }
    r.in.s.at = static_cast<std::size_t>(next);
  }
}

void read_text(MeditReader& r) {
  while (true) {
    const std::string_view keyword = next_keyword(r.in.s);
    if (keyword.empty() || keyword == "End") break;
    read_section(r, keyword, r.in.s.at - keyword.size());
  }
}

/// Whether the bytes are the number 1 in either order.
bool is_binary_medit(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("\1\0\0\0"sv) || bytes.starts_with("\0\0\0\1"sv);
}

}  // namespace

bool is_medit(std::string_view text) {
  return is_binary_medit(text) || first_word(text) == "MeshVersionFormatted";
}

Draft read_medit(std::string_view text) {
  MeditReader r{.in = {.s = {.text = text}}, .draft = {.text = text}};
  if (is_binary_medit(text)) {
    r.draft.text = {};  // there are no lines to count
    read_binary(r);
  } else {
    try {
      read_text(r);
    } catch (ReadFailure& failure) {
      blame_row(r.watch, text, failure);
      throw;
    }
  }
  if (!r.has_vertices) {
    fail(text, text.size(),
         {.code = "missing_section",
          .text = "the file ends without a section Vertices",
          .remedy = "the file was cut short, or holds no mesh: write it again"});
  }
  read_early_cells(r, true);
  drop_empty_references(r);
  return std::move(r.draft);
}

}  // namespace sunder::io
