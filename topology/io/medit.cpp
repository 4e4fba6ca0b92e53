// SPDX-License-Identifier: MIT
// MEDIT in ASCII, read and written: keywords in any order, each with a count and that many rows.
#include "topology/io/medit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "topology/io/number_sink.hpp"
#include "topology/io/scan.hpp"

namespace sunder::io {
namespace {

/// Sections whose rows are passed over: numbers in a row, and what cells they are.
struct Section {
  std::string_view keyword;
  std::size_t numbers;
  /// -1 where the rows are no cells.
  int dimension;
  std::string_view name;
};
constexpr Section sections[] = {
    {"Quadrilaterals", 5, 2, "quadrilaterals"},
    {"Hexahedra", 9, 3, "hexahedra"},
    {"Hexaedra", 9, 3, "hexahedra"},
    {"Prisms", 7, 3, "prisms"},
    {"Pentahedra", 7, 3, "prisms"},
    {"Pyramids", 6, 3, "pyramids"},
    {"Corners", 1, -1, ""},
    {"RequiredVertices", 1, -1, ""},
    {"Ridges", 1, -1, ""},
    {"RequiredEdges", 1, -1, ""},
    {"RequiredTriangles", 1, -1, ""},
    {"RequiredTetrahedra", 1, -1, ""},
    {"Normals", 3, -1, ""},
    {"NormalAtVertices", 2, -1, ""},
    {"NormalAtTriangleVertices", 3, -1, ""},
    {"NormalAtQuadrilateralVertices", 3, -1, ""},
    {"Tangents", 3, -1, ""},
    {"TangentAtVertices", 2, -1, ""},
    {"TangentAtEdges", 3, -1, ""},
};

/// Sections of simplices: their corners come first, a reference last.
struct Simplices {
  std::string_view keyword;
  int dimension;
  std::size_t nodes;
  std::string_view name;
};
constexpr Simplices simplices[] = {
    {"Edges", 1, 2, "edges"},
    {"Triangles", 2, 3, "triangles"},
    {"Tetrahedra", 3, 4, "tetrahedra"},
    {"EdgesP2", 1, 3, "second-order edges"},
    {"TrianglesP2", 2, 6, "second-order triangles"},
    {"TetrahedraP2", 3, 10, "second-order tetrahedra"},
};

struct MeditReader {
  Scanner s;
  Draft draft;
  bool has_vertices = false;
  /// Whether a section of simplices was read, by its place in the table.
  std::array<bool, std::size(simplices)> has_cells{};
  /// Cells may stand before the vertices: judged at the end.
  struct Row {
    int dimension;
    FileCell cell;
    std::int32_t reference;
  };
  std::vector<Row> rows;
};

/// The next word, passing comments (# to the end of the line).
std::string_view next_keyword(Scanner& s) {
  while (peek_word(s).substr(0, 1) == "#") rest_of_line(s);
  return next_word(s);
}

void refuse_second(MeditReader& r, bool seen, std::string_view keyword) {
  if (!seen) return;
  fail(r.s.text, r.s.at,
       {.code = "wrong_section_order",
        .text = fmt::format("a second section {}", keyword),
        .remedy = "join the two sections"});
}

void read_dimension(MeditReader& r) {
  const auto dimension = read_number<std::int64_t>(r.s, "the dimension");
  if (dimension == 3) return;
  fail(r.s.text, r.s.at,
       {.code = "unsupported_cells",
        .text = fmt::format("the mesh has dimension {}: 3 was expected", dimension),
        .remedy = "give a volume mesh of tetrahedra"});
}

void read_vertices(MeditReader& r) {
  refuse_second(r, r.has_vertices, "Vertices");
  r.has_vertices = true;
  const std::size_t n = read_count(r.s, "vertices", 8);
  r.draft.mesh.points.reserve(n);
  r.draft.mesh.point_region.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    skip_blanks(r.s);
    const std::size_t at = r.s.at;
    Point p;
    for (double& x : p) x = read_number<double>(r.s, "a coordinate");
    add_point(r.draft, p, at);
    r.draft.mesh.point_region.push_back(read_number<std::int32_t>(r.s, "a vertex's reference"));
  }
}

void read_cells(MeditReader& r, std::size_t kind, std::size_t section_at) {
  const Simplices& section = simplices[kind];
  refuse_second(r, r.has_cells[kind], section.keyword);
  r.has_cells[kind] = true;
  const std::size_t n = read_count(r.s, section.name, 2 * (section.nodes + 1));
  const std::size_t corners = static_cast<std::size_t>(section.dimension) + 1;
  if (section.nodes > corners) add_curved_cells(r.draft, section.name, n, section_at);
  r.rows.reserve(r.rows.size() + n);
  for (std::size_t i = 0; i < n; ++i) {
    skip_blanks(r.s);
    MeditReader::Row& row = r.rows.emplace_back();
    row.dimension = section.dimension;
    row.cell.at = r.s.at;
    for (std::size_t k = 0; k < corners; ++k) {
      const auto number = read_number<std::int64_t>(r.s, "a vertex number");
      row.cell.numbers[k] = number;
      row.cell.rows[k] = number > 0 ? number - 1 : -1;
    }
    skip_words(r.s, section.nodes - corners, "a vertex number");
    row.reference = read_number<std::int32_t>(r.s, "a cell's reference");
  }
}

/// Rows that are not used; an unknown keyword is passed up to the next word that is no number.
void skip_section(MeditReader& r, std::string_view keyword, std::size_t at) {
  const bool letters = std::all_of(keyword.begin(), keyword.end(),
                                   [](unsigned char c) { return std::isalnum(c) || c == '_'; }) &&
                       std::isalpha(static_cast<unsigned char>(keyword.front()));
  if (!letters) {
    fail(r.s.text, at,
         {.code = "wrong_count",
          .text = fmt::format("{} stands where a section's name (Tetrahedra, ...) was expected",
                              in_quotes(keyword)),
          .remedy = "the section before has more rows than it announces: correct its count"});
  }
  const auto* const section = std::find_if(std::begin(sections), std::end(sections),
                                           [&](const Section& x) { return x.keyword == keyword; });
  if (section != std::end(sections)) {
    const std::size_t rows =
        read_count(r.s, section->name.empty() ? "rows" : section->name, 2 * section->numbers);
    skip_words(r.s, rows * section->numbers, "a number");
    if (section->dimension >= 0) {
      add_other_cells(r.draft, section->name, section->dimension, rows, at);
    }
    return;
  }
  r.draft.findings.push_back({.code = "unknown_section",
                              .severity = Severity::note,
                              .text = fmt::format("section {} is passed over", in_quotes(keyword)),
                              .remedy = "nothing to do, if it holds no cells",
                              .line = line_of(r.s.text, at)});
  for (std::string_view word = peek_word(r.s); !word.empty(); word = peek_word(r.s)) {
    if (std::isalpha(static_cast<unsigned char>(word.front())) || word.front() == '#') return;
    next_word(r.s);
  }
}

void read_section(MeditReader& r, std::string_view keyword, std::size_t at) {
  if (keyword == "MeshVersionFormatted") {
    read_number<std::int64_t>(r.s, "a format version");
  } else if (keyword == "Dimension") {
    read_dimension(r);
  } else if (keyword == "Vertices") {
    read_vertices(r);
  } else {
    for (std::size_t kind = 0; kind < std::size(simplices); ++kind) {
      if (simplices[kind].keyword == keyword) return read_cells(r, kind, at);
    }
    skip_section(r, keyword, at);
  }
}

/// References that are all 0 say nothing.
void drop_zeros(std::vector<std::int32_t>& references) {
  if (std::ranges::all_of(references, [](std::int32_t x) { return x == 0; })) references.clear();
}

void finish_cells(MeditReader& r) {
  FileMesh& mesh = r.draft.mesh;
  for (const MeditReader::Row& row : r.rows) {
    add_cell(r.draft, row.dimension, row.cell);
    for_each_cell_list(mesh, [&](auto& cells, int dimension) {
      if (dimension == row.dimension) cells.region.push_back(row.reference);
    });
  }
  drop_zeros(mesh.point_region);
  for_each_cell_list(mesh, [](auto& cells, int) { drop_zeros(cells.region); });
}

}  // namespace

Draft read_medit(std::string_view text) {
  MeditReader r{.s = {.text = text}, .draft = {.text = text}};
  while (true) {
    const std::string_view keyword = next_keyword(r.s);
    if (keyword.empty() || keyword == "End") break;
    read_section(r, keyword, r.s.at - keyword.size());
  }
  if (!r.has_vertices) {
    fail(text, text.size(),
         {.code = "missing_section",
          .text = "the file ends without a section Vertices",
          .remedy = "the file was cut short, or holds no mesh: write it again"});
  }
  finish_cells(r);
  return std::move(r.draft);
}

std::string write_medit(const FileMesh& mesh) {
  NumberSink out;
  out.bytes.reserve(64 * mesh.points.size() + 32 * cell_count(mesh));
  put_text(out, "MeshVersionFormatted 2\nDimension 3\n");
  const auto section = [&out](std::string_view keyword, std::size_t rows) {
    put_text(out, keyword);
    out.bytes += '\n';  // meshio wants the count on a line of its own
    put_text(out, rows);
    out.bytes += '\n';
  };
  section("Vertices", mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (const double x : mesh.points[i]) put<double>(out, x);
    put<std::int32_t>(out, mesh.point_region.empty() ? 0 : mesh.point_region[i], '\n');
  }
  constexpr std::string_view keywords[] = {"", "Edges", "Triangles", "Tetrahedra"};
  for_each_cell_list(mesh, [&](const auto& cells, int dimension) {
    if (dimension == 0 || cells.corners.empty()) return;
    const std::vector<std::int32_t>& label = label_of(cells);
    section(keywords[dimension], cells.corners.size());
    for (std::size_t i = 0; i < cells.corners.size(); ++i) {
      for (const std::uint32_t corner : cells.corners[i]) put<std::int64_t>(out, corner + 1L);
      put<std::int32_t>(out, label.empty() ? 0 : label[i], '\n');
    }
  });
  put_text(out, "End\n");
  return std::move(out.bytes);
}

}  // namespace sunder::io
