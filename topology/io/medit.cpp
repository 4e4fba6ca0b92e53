// SPDX-License-Identifier: MIT
// Reading MEDIT in ASCII: keywords in any order, each with a count and that many rows.
#include "topology/io/medit.hpp"

#include <fmt/format.h>

#include <algorithm>

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
    {"Edges", 3, 1, "edges"},
    {"Triangles", 4, 2, "triangles"},
    {"Quadrilaterals", 5, 2, "quadrilaterals"},
    {"Hexahedra", 9, 3, "hexahedra"},
    {"Hexaedra", 9, 3, "hexahedra"},
    {"Prisms", 7, 3, "prisms"},
    {"Pentahedra", 7, 3, "prisms"},
    {"Pyramids", 6, 3, "pyramids"},
    {"TetrahedraP2", 11, 3, "second-order tetrahedra"},
    {"TrianglesP2", 7, 2, "second-order triangles"},
    {"EdgesP2", 4, 1, "second-order edges"},
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

struct MeditReader {
  Scanner s;
  Draft draft;
  bool has_vertices = false;
  bool has_tetrahedra = false;
  /// Tetrahedra may stand before the vertices: judged at the end.
  std::vector<FileTetrahedron> tetrahedra;
  std::vector<std::int32_t> region;
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
  for (std::size_t i = 0; i < n; ++i) {
    skip_blanks(r.s);
    const std::size_t at = r.s.at;
    Point p;
    for (double& x : p) x = read_number<double>(r.s, "a coordinate");
    add_point(r.draft, p, at);
    read_number<std::int64_t>(r.s, "a vertex's reference");
  }
}

void read_tetrahedra(MeditReader& r) {
  refuse_second(r, r.has_tetrahedra, "Tetrahedra");
  r.has_tetrahedra = true;
  const std::size_t n = read_count(r.s, "tetrahedra", 10);
  r.tetrahedra.reserve(n);
  r.region.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    skip_blanks(r.s);
    FileTetrahedron t;
    t.at = r.s.at;
    for (int k = 0; k < 4; ++k) {
      t.numbers[k] = read_number<std::int64_t>(r.s, "a vertex number");
      t.rows[k] = t.numbers[k] > 0 ? t.numbers[k] - 1 : -1;
    }
    r.tetrahedra.push_back(t);
    r.region.push_back(read_number<std::int32_t>(r.s, "a tetrahedron's reference"));
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
  } else if (keyword == "Tetrahedra") {
    read_tetrahedra(r);
  } else {
    skip_section(r, keyword, at);
  }
}

void finish_tetrahedra(MeditReader& r) {
  r.draft.mesh.tetrahedra.reserve(r.tetrahedra.size());
  for (const FileTetrahedron& t : r.tetrahedra) add_tetrahedron(r.draft, t);
  const bool referenced =
      std::any_of(r.region.begin(), r.region.end(), [](std::int32_t x) { return x != 0; });
  if (referenced) r.draft.mesh.region = std::move(r.region);
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
  finish_tetrahedra(r);
  return std::move(r.draft);
}

}  // namespace sunder::io
