// SPDX-License-Identifier: MIT
// OpenVolumeMesh's text read: vertices, edges of vertices, faces of half-edges, polyhedra of
// half-faces.
#include <fmt/format.h>

#include <algorithm>

#include "topology/io/ovm/ovm.hpp"
#include "topology/io/ovm/ovm_reader.hpp"
#include "topology/io/regions/named_regions.hpp"

namespace sunder::io {
namespace {

void skip_comments(Scanner& s) {
  while (peek_word(s).starts_with('#')) rest_of_line(s);
}

/// Where the next row begins, comments passed.
std::size_t begin_row(OvmReader& r) {
  skip_comments(r.s);
  begin_row(r.watch, r.s.at);
  return r.s.at;
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
    const std::size_t at = begin_row(r);
    Point p;
    for (double& x : p) x = read_number<double>(r.s, "a coordinate");
    add_point(r.draft, p, at);
    end_row(r.watch, r.s);
  }
}

void read_edges(OvmReader& r) {
  const std::size_t n = read_head(r, "Edges", "edges", 4);
  const std::size_t points = r.draft.mesh.points.size();
  r.edges.resize(n);
  r.edge_has_face.resize(n, false);
  for (auto& edge : r.edges) {
    begin_row(r);
    for (std::uint32_t& vertex : edge) vertex = read_index(r, "a vertex", points);
    end_row(r.watch, r.s);
  }
}

/// The ends of a half-edge.
std::array<std::uint32_t, 2> ends_of(const OvmReader& r, std::uint32_t half_edge) {
  const auto& edge = r.edges[half_edge / 2];
  return half_edge % 2 == 0 ? edge : std::array{edge[1], edge[0]};
}

/// A face: its half-edges are to follow each other around.
void read_face(OvmReader& r, std::size_t row) {
  const std::size_t at = begin_row(r);
  const std::size_t edges = read_count(r.s, "half-edges of a face", 2);
  std::uint32_t first = 0, end = 0;
  bool follows = true;
  for (std::size_t k = 0; k < edges; ++k) {
    const std::uint32_t half_edge = read_index(r, "a half-edge", 2 * r.edges.size());
    r.edge_has_face[half_edge / 2] = true;
    const auto [from, to] = ends_of(r, half_edge);
    if (k == 0) first = from;
    follows = follows && (k == 0 || from == end);
    end = to;
    r.face_points.push_back(from);
  }
  end_row(r.watch, r.s);
  if (edges == 0 || !follows || end != first) {
    fail(r.s.text, at,
         {.code = "broken_face",
          .text = fmt::format("the {} half-edges of face {} do not follow each other around it",
                              edges, row),
          .remedy = "correct the face's half-edges"});
  }
  r.face_ends.push_back(r.face_points.size());
}

/// The corners of a half-face, in its own order.
struct HalfFace {
  std::array<std::uint32_t, 4> points;
  /// 3 or 4; 0 where it has others.
  std::size_t corners = 0;
};
HalfFace half_face_of(const OvmReader& r, std::uint32_t half_face) {
  const auto face = face_of(r, half_face / 2);
  HalfFace h;
  if (face.size() != 3 && face.size() != 4) return h;
  h.corners = face.size();
  std::ranges::copy(face, h.points.begin());
  const auto end = h.points.begin() + static_cast<std::ptrdiff_t>(h.corners);
  if (half_face % 2 == 1) std::reverse(h.points.begin() + 1, end);
  return h;
}

/// The possible kind of a polyhedron with such faces.
std::optional<CellKind> kind_of(const std::vector<HalfFace>& faces) {
  std::size_t triangles = 0, quads = 0;
  for (const HalfFace& f : faces) {
    if (f.corners == 0) return std::nullopt;
    ++(f.corners == 3 ? triangles : quads);
  }
  constexpr struct {
    std::size_t triangles, quads;
    CellKind kind;
  } kinds[] = {{4, 0, CellKind::tetrahedron},
               {0, 6, CellKind::hexahedron8},
               {2, 3, CellKind::prism6},
               {4, 1, CellKind::pyramid5}};
  for (const auto& k : kinds) {
    if (k.triangles == triangles && k.quads == quads) return k.kind;
  }
  return std::nullopt;
}

using HalfFaceKey = std::array<std::uint32_t, 4>;

HalfFaceKey key_of(std::span<const std::uint32_t> corners) {
  HalfFaceKey key{no_corner, no_corner, no_corner, no_corner};
  std::ranges::copy(corners, key.begin());
  std::ranges::sort(key);
  return key;
}

/// Whether the half-faces are those of a cell with these nodes.
bool are_faces_of(CellKind kind, const std::vector<std::uint32_t>& nodes,
                  const std::vector<HalfFace>& half_faces) {
  std::vector<HalfFaceKey> own, read;
  for (const FaceCorners& f : faces_of(kind)) {
    const HalfFaceKey corners{nodes[f[0]], nodes[f[1]], nodes[f[2]], nodes[f[3]]};
    own.push_back(key_of(std::span(corners).first(f[2] == f[3] ? 3 : 4)));
  }
  for (const HalfFace& h : half_faces) read.push_back(key_of(std::span(h.points).first(h.corners)));
  std::ranges::sort(own);
  std::ranges::sort(read);
  return own == read;
}

/// The nodes of a cell: the corners of its base, then for each of them its neighbour off the base;
/// empty where the half-faces do not bound such a cell.
std::vector<std::uint32_t> nodes_of_cell(CellKind kind, const std::vector<HalfFace>& half_faces) {
  const std::size_t n = corners_of_base(kind);
  const auto base = std::ranges::find(half_faces, n, &HalfFace::corners);
  std::vector<std::uint32_t> nodes(base->points.begin(),
                                   base->points.begin() + static_cast<std::ptrdiff_t>(n));
  std::vector<std::uint32_t> above(n, no_corner);
  const auto place = [&](std::uint32_t corner) {
    return static_cast<std::size_t>(std::find(base->points.begin(),
                                              base->points.begin() + static_cast<std::ptrdiff_t>(n),
                                              corner) -
                                    base->points.begin());
  };
  for (const HalfFace& h : half_faces) {
    for (std::size_t k = 0; k < h.corners; ++k) {
      const std::uint32_t a = h.points[k], b = h.points[(k + 1) % h.corners];
      const std::size_t i = place(a), j = place(b);
      if (i < n && j == n) above[i] = b;
      if (j < n && i == n) above[j] = a;
    }
  }
  const bool is_pointed = kind == CellKind::tetrahedron || kind == CellKind::pyramid5;
  nodes.insert(nodes.end(), above.begin(), is_pointed ? above.begin() + 1 : above.end());
  std::vector<std::uint32_t> sorted = nodes;
  std::ranges::sort(sorted);
  const bool repeats = std::ranges::adjacent_find(sorted) != sorted.end();
  if (repeats || sorted.back() == no_corner) return {};
  return are_faces_of(kind, nodes, half_faces) ? nodes : std::vector<std::uint32_t>{};
}

void read_polyhedron(OvmReader& r, std::size_t row) {
  const std::size_t at = begin_row(r);
  const std::size_t faces = read_count(r.s, "half-faces of a polyhedron", 2);
  constexpr std::size_t most = 6;
  std::vector<HalfFace> half_faces;
  for (std::size_t k = 0; k < faces; ++k) {
    const std::uint32_t half_face = read_index(r, "a half-face", 2 * r.face_ends.size());
    r.face_has_cell[half_face / 2] = true;
    if (k <= most) half_faces.push_back(half_face_of(r, half_face));
  }
  end_row(r.watch, r.s);
  std::optional<CellKind> kind = kind_of(half_faces);
  std::vector<std::uint32_t> nodes;
  if (kind) nodes = nodes_of_cell(*kind, half_faces);
  if (kind == CellKind::tetrahedron && nodes.empty()) {
    fail(
        r.s.text, at,
        {.code = "wrong_polyhedron",
         .ids = {static_cast<std::int64_t>(row)},
         .text = fmt::format("the four triangles of polyhedron {} do not bound a tetrahedron", row),
         .remedy = "correct its half-faces"});
  }
  if (nodes.empty()) kind.reset();
  r.polyhedra.push_back(kind);
  if (!kind) return add_other_cells(r.draft, "polyhedra", 3, 1, at);
  FileCell& cell = r.draft.cell;
  cell.begin(nodes.size(), at);
  std::ranges::copy(nodes, cell.rows.begin());
  cell.numbers = cell.rows;
  add_cell(r.draft, *kind, cell);
}

void read_topology(OvmReader& r) {
  read_vertices(r);
  read_edges(r);
  const std::size_t faces = read_head(r, "Faces", "faces", 4);
  r.face_ends.reserve(faces);
  r.face_points.reserve(3 * faces);
  for (std::size_t i = 0; i < faces; ++i) read_face(r, i);
  r.face_has_cell.resize(faces, false);
  const std::size_t cells = read_head(r, "Polyhedra", "polyhedra", 4);
  r.draft.mesh.tetrahedra.corners.reserve(cells);
  for (std::size_t i = 0; i < cells; ++i) read_polyhedron(r, i);
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
  try {
    read_topology(r);
  } catch (ReadFailure& failure) {
    blame_row(r.watch, text, failure);
    throw;
  }
  find_ovm_properties(r);
  read_ovm_properties(r);
  return std::move(r.draft);
}

}  // namespace sunder::io
