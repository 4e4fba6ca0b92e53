// SPDX-License-Identifier: MIT
// Cells of a surveyed mesh counted as orbits of its map, without a map; and vertices at which the
// surface of one part touches itself.
#include "topology/kernel/invariants_impl.hpp"
#include "topology/mesh/survey.hpp"

namespace sunder {
namespace {

constexpr FindingWords nonmanifold_vertex = {
    "nonmanifold_vertex", Severity::note,
    "% [point lies|points lie] where the surface of one part touches itself: the part hangs "
    "together round them",
    "nothing to do, unless a body with a manifold surface is wanted: then add or remove "
    "tetrahedra there"};

/// The boundary half-face next to boundary face `p` of tetrahedron `t`, across its edge that does
/// not end in corner `e`: turns round the edge through the tetrahedra at it.
std::uint32_t next_on_boundary(const Survey& s, std::uint32_t t, int p, int e) {
  const auto& corners = s.mesh.tetrahedra[t];
  int i = 0;
  while (i == p || i == e) ++i;
  const int j = 6 - p - e - i;
  const std::uint32_t a = corners[i], b = corners[j];
  std::uint32_t face = 4 * t + static_cast<std::uint32_t>(e);
  while (true) {
    const HalfFaceId across = s.neighbours[face / 4][face % 4];
    if (across.is_none()) return face;
    const std::uint32_t u = across.value / 4;
    const int leave = 6 - place_of_point(s.mesh.tetrahedra[u], a) -
                      place_of_point(s.mesh.tetrahedra[u], b) - static_cast<int>(across.value % 4);
    face = 4 * u + static_cast<std::uint32_t>(leave);
  }
}

std::size_t count_sheets(const Survey& s) {
  std::vector<char> met(4 * s.neighbours.size(), 0);
  std::vector<std::uint32_t> stack;
  std::size_t sheets = 0;
  for (std::uint32_t f = 0; f < met.size(); ++f) {
    if (met[f] || !s.neighbours[f / 4][f % 4].is_none()) continue;
    ++sheets;
    met[f] = 1;
    stack.push_back(f);
    while (!stack.empty()) {
      const std::uint32_t at = stack.back();
      stack.pop_back();
      const int p = static_cast<int>(at % 4);
      for (int e = 0; e < 4; ++e) {
        if (e == p) continue;
        const std::uint32_t next = next_on_boundary(s, at / 4, p, e);
        if (met[next]) continue;
        met[next] = 1;
        stack.push_back(next);
      }
    }
  }
  return sheets;
}

}  // namespace

Counts count_cells(const Survey& s) {
  Counts counts;
  const std::size_t tetrahedra = s.mesh.tetrahedra.size();
  counts.tetrahedra = tetrahedra;
  counts.vertices = s.point_of_row.size();
  counts.edges = s.edges;
  counts.components = s.components;
  for (std::size_t t = 0; t < tetrahedra; ++t) {
    std::array<std::uint32_t, 4> c = s.mesh.tetrahedra[t];
    if (s.flipped[t]) std::swap(c[2], c[3]);
    counts.volume += detail::six_volumes(s.mesh.points[c[0]], s.mesh.points[c[1]],
                                         s.mesh.points[c[2]], s.mesh.points[c[3]]) /
                     6;
    for (const HalfFaceId across : s.neighbours[t]) counts.boundary_faces += across.is_none();
  }
  counts.faces = (4 * tetrahedra + counts.boundary_faces) / 2;
  counts.boundary_sheets = count_sheets(s);
  detail::derive_invariants(counts, s.closed_components);
  return counts;
}

void survey_links(Survey& s) {
  // Of the link of each vertex, a surface in one piece: its triangles and its boundary edges.
  struct Link {
    std::uint32_t triangles = 0, boundary = 0;
  };
  std::vector<Link> links(s.point_of_row.size());
  for (std::size_t t = 0; t < s.mesh.tetrahedra.size(); ++t) {
    for (int i = 0; i < 4; ++i) {
      Link& link = links[s.rows[t][i]];
      ++link.triangles;
      for (int p = 0; p < 4; ++p) {
        if (p != i && s.neighbours[t][p].is_none()) ++link.boundary;
      }
    }
  }
  std::vector<char> touches(s.mesh.points.size(), 0);
  for (std::size_t row = 0; row < links.size(); ++row) {
    const auto triangles = static_cast<std::ptrdiff_t>(links[row].triangles);
    const auto boundary = static_cast<std::ptrdiff_t>(links[row].boundary);
    const auto vertices = static_cast<std::ptrdiff_t>(s.edges_at_row[row]);
    const std::ptrdiff_t euler = vertices - (3 * triangles + boundary) / 2 + triangles;
    // A disc or a sphere: any other surface has a smaller characteristic.
    if (euler != (boundary > 0 ? 1 : 2)) touches[s.point_of_row[row]] = 1;
  }
  Places places(PlaceKind::points, s.keeps_places);
  for (std::size_t p = 0; p < touches.size(); ++p) {
    if (touches[p]) places.add(p);
  }
  report(s, nonmanifold_vertex, places);
}

}  // namespace sunder
