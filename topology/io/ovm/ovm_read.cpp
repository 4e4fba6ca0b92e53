// SPDX-License-Identifier: MIT
// OpenVolumeMesh's text read: vertices, edges of vertices, faces of half-edges, polyhedra of
// half-faces.
#include <fmt/format.h>

#include <algorithm>

#include "topology/io/named_regions.hpp"
#include "topology/io/ovm/ovm.hpp"
#include "topology/io/ovm/ovm_reader.hpp"

namespace sunder::io {
namespace {

void skip_comments(Scanner& s) {
  while (peek_word(s).starts_with('#')) rest_of_line(s);
}

/// The name of a section, in any case, then its number of rows of at least `least_bytes` each.
std::size_t read_head(OvmReader& r, std::string_view name, std::string_view rows,
                      std::size_t least_bytes) {
  skip_comments(r.s);
  const std::size_t at = r.s.at;
  const std::string_view word = next_word(r.s);
  if (lower_case(word) != lower_case(name)) {
    fail(r.s.text, at,
         {.code = word.empty() ? "truncated_file" : "wrong_count",
          .text = word.empty()
                      ? fmt::format("the file ends where {} was expected", name)
                      : fmt::format("{} stands where {} was expected", in_quotes(word), name),
          .remedy = word.empty() ? "the file was cut short: write it again"
                                 : "the section before has more or fewer rows than it announces"});
  }
  skip_comments(r.s);
  return read_count(r.s, rows, least_bytes);
}

/// The next number, which is below `count`.
std::uint32_t read_index(OvmReader& r, std::string_view what, std::size_t count) {
  skip_blanks(r.s);
  const std::size_t at = r.s.at;
  const auto index = read_number<std::int64_t>(r.s, what);
  if (index >= 0 && static_cast<std::size_t>(index) < count) {
    return static_cast<std::uint32_t>(index);
  }
  fail(r.s.text, at,
       {.code = "index_out_of_range",
        .text = fmt::format("{} stands where {} was expected: 0 to {}", index, what,
                            static_cast<std::int64_t>(count) - 1),
        .remedy = "correct the number, or write the file again"});
}

void read_vertices(OvmReader& r) {
  const std::size_t n = read_head(r, "Vertices", "vertices", 6);
  r.draft.mesh.points.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    skip_comments(r.s);
    const std::size_t at = r.s.at;
    Point p;
    for (double& x : p) x = read_number<double>(r.s, "a coordinate");
    add_point(r.draft, p, at);
  }
}

void read_edges(OvmReader& r) {
  const std::size_t n = read_head(r, "Edges", "edges", 4);
  const std::size_t points = r.draft.mesh.points.size();
  r.edges.resize(n);
  r.edge_has_face.resize(n, false);
  for (auto& edge : r.edges) {
    skip_comments(r.s);
    for (std::uint32_t& vertex : edge) vertex = read_index(r, "a vertex", points);
  }
}

/// The ends of a half-edge.
std::array<std::uint32_t, 2> ends_of(const OvmReader& r, std::uint32_t half_edge) {
  const auto& edge = r.edges[half_edge / 2];
  return half_edge % 2 == 0 ? edge : std::array{edge[1], edge[0]};
}

/// A face: its half-edges are to follow each other around.
void read_face(OvmReader& r, std::size_t row) {
  skip_comments(r.s);
  const std::size_t at = r.s.at;
  const std::size_t edges = read_count(r.s, "half-edges of a face", 2);
  std::array<std::uint32_t, 3> corners{no_corner, no_corner, no_corner};
  std::uint32_t first = 0, end = 0;
  bool follows = true;
  for (std::size_t k = 0; k < edges; ++k) {
    const std::uint32_t half_edge = read_index(r, "a half-edge", 2 * r.edges.size());
    r.edge_has_face[half_edge / 2] = true;
    const auto [from, to] = ends_of(r, half_edge);
    if (k == 0) first = from;
    follows = follows && (k == 0 || from == end);
    end = to;
    if (edges == 3) corners[k] = from;
  }
  if (edges == 0 || !follows || end != first) {
    fail(r.s.text, at,
         {.code = "broken_face",
          .text = fmt::format("the {} half-edges of face {} do not follow each other around it",
                              edges, row),
          .remedy = "correct the face's half-edges"});
  }
  r.faces.push_back(corners);
}

/// The corners of a half-face, in its own order.
std::array<std::uint32_t, 3> corners_of(const OvmReader& r, std::uint32_t half_face) {
  const auto& face = r.faces[half_face / 2];
  return half_face % 2 == 0 ? face : std::array{face[0], face[2], face[1]};
}

void read_polyhedron(OvmReader& r, std::size_t row) {
  skip_comments(r.s);
  const std::size_t at = r.s.at;
  const std::size_t faces = read_count(r.s, "half-faces of a polyhedron", 2);
  std::array<std::uint32_t, 4> half_faces{};
  bool is_tetrahedron = faces == 4;
  for (std::size_t k = 0; k < faces; ++k) {
    const std::uint32_t half_face = read_index(r, "a half-face", 2 * r.faces.size());
    r.face_has_cell[half_face / 2] = true;
    if (k < 4) half_faces[k] = half_face;
    is_tetrahedron = is_tetrahedron && r.faces[half_face / 2][0] != no_corner;
  }
  r.is_tetrahedron.push_back(is_tetrahedron);
  if (!is_tetrahedron) return add_other_cells(r.draft, "polyhedra", 3, 1, at);
  const auto base = corners_of(r, half_faces[0]);
  // Each of the other faces has two of these corners, each time others, and the one corner more.
  std::uint32_t apex = no_corner;
  unsigned left_out = 0;
  bool is_one = true;
  for (std::size_t k = 1; k < 4; ++k) {
    unsigned own = 0;
    for (const std::uint32_t corner : corners_of(r, half_faces[k])) {
      const auto place = std::ranges::find(base, corner) - base.begin();
      own |= place < 3 ? 1u << place : 0;
      is_one = is_one && (place < 3 || apex == no_corner || corner == apex);
      if (place == 3) apex = corner;
    }
    left_out |= own == 3 ? 4 : own == 5 ? 2 : own == 6 ? 1 : 0;
  }
  if (left_out != 7 || !is_one) {
    fail(
        r.s.text, at,
        {.code = "wrong_polyhedron",
         .ids = {static_cast<std::int64_t>(row)},
         .text = fmt::format("the four triangles of polyhedron {} do not bound a tetrahedron", row),
         .remedy = "correct its half-faces"});
  }
  FileCell& cell = r.draft.cell;
  cell.begin(4, at);
  cell.rows = {base[0], base[1], base[2], apex};
  cell.numbers = cell.rows;
  add_cell(r.draft, CellKind::tetrahedron, cell);
}

}  // namespace

std::string_view next_ovm_word(Scanner& s) {
  skip_comments(s);
  return next_word(s);
}

bool is_ovm(std::string_view text) {
  Scanner s{text};
  return lower_case(next_ovm_word(s)) == "ovm";
}

Draft read_ovm(std::string_view text) {
  OvmReader r{.s = {.text = text}, .draft = {.text = text}};
  next_ovm_word(r.s);
  const std::string_view kind = next_word(r.s);
  if (lower_case(kind) != "ascii") {
    fail(text, r.s.at,
         {.code = "unknown_version",
          .text = fmt::format("OVM {} is not read: ASCII is", in_quotes(kind)),
          .remedy = "write the file as OVM ASCII"});
  }
  read_vertices(r);
  read_edges(r);
  const std::size_t faces = read_head(r, "Faces", "faces", 4);
  r.faces.reserve(faces);
  for (std::size_t i = 0; i < faces; ++i) read_face(r, i);
  r.face_has_cell.resize(faces, false);
  const std::size_t cells = read_head(r, "Polyhedra", "polyhedra", 4);
  r.draft.mesh.tetrahedra.corners.reserve(cells);
  for (std::size_t i = 0; i < cells; ++i) read_polyhedron(r, i);
  find_ovm_properties(r);
  read_ovm_properties(r);
  return std::move(r.draft);
}

}  // namespace sunder::io
