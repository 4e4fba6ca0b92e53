// SPDX-License-Identifier: MIT
// Faces by their sides and corners, places instead of points, and the properties that follow.
#include "topology/mesh/surface/surface_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "topology/base/point_math.hpp"
#include "topology/base/union_find.hpp"
#include "topology/mesh/kinds/move_cells.hpp"
#include "topology/mesh/surface/crossing.hpp"
#include "topology/mesh/surface/edges.hpp"

namespace sunder {
namespace {

using detail::cross, detail::difference, detail::dot, detail::length;
using Row = std::uint32_t;

/// Faces by the places of their corners: points with the same coordinates are one place.
struct Surface {
  const FileMesh& mesh;
  SurfaceCheck& check;
  std::vector<Row> place_of_point;
  std::vector<Row> corners;
  /// Where the corners of each face begin; one more at the end.
  std::vector<std::size_t> first{0};
  std::vector<FaceSide> sides;  ///< ends by places
  /// Those that have an area.
  std::vector<SurfaceTriangle> triangles;

  std::size_t faces() const { return first.size() - 1; }
  std::span<const Row> face(std::size_t f) const {
    return std::span(corners).subspan(first[f], first[f + 1] - first[f]);
  }
};

void tell(Surface& s, std::string_view code, Severity severity, const std::vector<Row>& rows,
          std::size_t a_place, std::string_view text, std::string_view remedy) {
  if (rows.empty()) return;
  const std::size_t count = rows.size() / a_place;
  Finding& f = s.check.findings.emplace_back();
  f.code = code;
  f.severity = severity;
  f.count = count;
  f.text = fmt::format("{} {}", count, text);
  f.remedy = remedy;
  for (std::size_t i = 0; i < std::min(rows.size(), Finding::max_ids / a_place * a_place); ++i) {
    f.ids.push_back(rows[i]);
  }
}

/// The lowest point at each point's place.
void find_places(Surface& s) {
  const std::vector<Point>& x = s.mesh.points;
  std::vector<Row> order(x.size()), later;
  std::iota(order.begin(), order.end(), Row{0});
  std::ranges::sort(order, [&](Row a, Row b) { return x[a] != x[b] ? x[a] < x[b] : a < b; });
  s.place_of_point.resize(x.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_new = i == 0 || x[order[i]] != x[order[i - 1]];
    s.place_of_point[order[i]] = is_new ? order[i] : s.place_of_point[order[i - 1]];
    if (!is_new) later.push_back(order[i]);
  }
  std::ranges::sort(later);
  tell(s, "coincident_points", Severity::note, later, 1,
       "points are exactly where earlier ones are: "
       "they count as one here",
       "merge them: sunder convert FILE NEW --merge-points 0");
}

/// Where the fan of a face begins: at its least corner, or at the next one behind it from which all
/// triangles have an area (a corner may lie on the line between two others).
std::size_t start_of_fan(const std::vector<Point>& points, std::span<const Row> face) {
  const auto least = static_cast<std::size_t>(std::ranges::min_element(face) - face.begin());
  const std::size_t n = face.size();
  for (std::size_t start = least; start < least + n; ++start) {
    std::size_t k = 1;
    while (k + 1 < n &&
           has_area(points, {face[start % n], face[(start + k) % n], face[(start + k + 1) % n]}))
      ++k;
    if (k + 1 >= n) return start % n;
  }
  return least;
}

void take_faces(Surface& s) {
  for (const CellKind kind : {CellKind::triangle, CellKind::quad4, CellKind::polygon}) {
    const CellRows rows = rows_of(s.mesh, kind);
    for (std::size_t i = 0; i < rows.count; ++i) {
      for (const Row node : rows[i]) s.corners.push_back(s.place_of_point[node]);
      s.first.push_back(s.corners.size());
    }
  }
  s.check.triangles = rows_of(s.mesh, CellKind::triangle).count;
  s.check.quadrilaterals = rows_of(s.mesh, CellKind::quad4).count;
  s.check.polygons = rows_of(s.mesh, CellKind::polygon).count;
  for (std::size_t f = 0; f < s.faces(); ++f) {
    const auto face = s.face(f);
    const std::size_t n = face.size();
    const std::size_t start = start_of_fan(s.mesh.points, face);
    for (std::size_t k = 0; k < n; ++k) {
      const Row a = face[k], b = face[(k + 1) % n];
      if (a != b) s.sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<Row>(f), a < b});
      const std::array<Row, 3> t{face[start], face[(start + k) % n], face[(start + k + 1) % n]};
      if (has_area(s.mesh.points, t)) s.triangles.push_back({t, static_cast<Row>(f)});
    }
  }
  std::ranges::sort(s.sides);
}

/// Edges, and components joined across them.
void find_edges(Surface& s) {
  std::vector<Row> open, thick, twisted;
  UnionFind parts(s.faces());
  for_each_edge(s.sides, [&](std::span<const FaceSide> edge) {
    ++s.check.edges;
    for (const FaceSide& side : edge) parts.join(edge[0].face, side.face);
    const auto add = [&](std::vector<Row>& list) {
      list.insert(list.end(), edge[0].ends.begin(), edge[0].ends.end());
    };
    if (edge.size() == 1) add(open);
    if (edge.size() > 2) add(thick);
    if (edge.size() == 2 && edge[0].is_forward == edge[1].is_forward) add(twisted);
  });
  const std::vector<std::uint32_t> roots = std::move(parts).roots();
  for (std::size_t f = 0; f < roots.size(); ++f) s.check.components += roots[f] == f;
  s.check.boundary_edges = open.size() / 2;
  s.check.is_closed = open.empty() && thick.empty() && s.faces() > 0;
  s.check.is_manifold = thick.empty();
  s.check.is_oriented = twisted.empty();
  tell(s, "nonmanifold_edge", Severity::warning, thick, 2, "edges have three faces or more",
       "take the faces between away, if it is to bound a body");
  tell(s, "open_edge", Severity::warning, open, 2, "edges have one face: the surface is open there",
       "nothing, if it is meant to be a sheet; else close the holes");
  tell(s, "inconsistent_orientation", Severity::warning, twisted, 2,
       "edges lie between faces that look to different sides",
       "turn faces over (in a mesh editor: recalculate normals outside)");
}

/// The faces at a vertex hang together across its edges, where it is manifold.
void find_vertices(Surface& s) {
  // Corners of faces by their place; neighbours share a side at that place.
  std::vector<std::size_t> order(s.corners.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t c) { return s.corners[c]; });
  std::vector<Row> face_of(s.corners.size()), pinched;
  for (std::size_t f = 0; f < s.faces(); ++f) {
    for (std::size_t c = s.first[f]; c < s.first[f + 1]; ++c) face_of[c] = static_cast<Row>(f);
  }
  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    const Row place = s.corners[order[i]];
    for (end = i; end < order.size() && s.corners[order[end]] == place;) ++end;
    ++s.check.vertices;
    std::vector<std::pair<Row, Row>> spokes;  // the other end, and the face's place here
    for (std::size_t k = i; k < end; ++k) {
      const auto face = s.face(face_of[order[k]]);
      const std::size_t at = order[k] - s.first[face_of[order[k]]], n = face.size();
      spokes.emplace_back(face[(at + 1) % n], static_cast<Row>(k - i));
      spokes.emplace_back(face[(at + n - 1) % n], static_cast<Row>(k - i));
    }
    std::ranges::sort(spokes);
    UnionFind around(end - i);
    for (std::size_t k = 1; k < spokes.size(); ++k) {
      if (spokes[k].first == spokes[k - 1].first)
        around.join(spokes[k].second, spokes[k - 1].second);
    }
    const std::vector<std::uint32_t> roots = std::move(around).roots();
    if (std::ranges::any_of(roots, [&](std::uint32_t r) { return r != roots[0]; })) {
      pinched.push_back(place);
    }
  }
  s.check.is_manifold = s.check.is_manifold && pinched.empty();
  tell(s, "nonmanifold_vertex", Severity::note, pinched, 1,
       "points are where parts of the surface only touch", "nothing, unless a manifold is needed");
}

void find_duplicates(Surface& s) {
  std::vector<std::pair<std::vector<Row>, Row>> faces;
  for (std::size_t f = 0; f < s.faces(); ++f) {
    const auto face = s.face(f);
    faces.emplace_back(std::vector<Row>(face.begin(), face.end()), static_cast<Row>(f));
    std::ranges::sort(faces.back().first);
  }
  std::ranges::sort(faces);
  std::vector<Row> again;
  for (std::size_t i = 1; i < faces.size(); ++i) {
    if (faces[i].first == faces[i - 1].first) again.push_back(faces[i].second);
  }
  std::ranges::sort(again);
  tell(s, "duplicate_face", Severity::warning, again, 1, "faces have the corners of an earlier one",
       "take them away");
}

/// Area, volume, box and centre; faces without area.
void measure(Surface& s) {
  SurfaceCheck& c = s.check;
  const std::vector<Point>& x = s.mesh.points;
  if (s.corners.empty()) return;
  c.extent.box = box_around(x, s.corners);
  Point middle;
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = c.extent.box.low[k] / 2 + c.extent.box.high[k] / 2;
  }
  Point by_area{}, by_volume{};
  double volume = 0;
  std::vector<double> area_of(s.faces(), 0);
  for (const SurfaceTriangle& t : s.triangles) {
    std::array<Point, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = difference(x[t.corners[k]], middle);
    const double area = length(cross(difference(p[1], p[0]), difference(p[2], p[0]))) / 2;
    const double part = dot(p[0], cross(p[1], p[2])) / 6;
    c.area += area;
    volume += part;
    area_of[t.face] += area;
    for (std::size_t k = 0; k < 3; ++k) {
      const double sum = p[0][k] + p[1][k] + p[2][k];
      by_area[k] += area * sum / 3;
      by_volume[k] += part * sum / 4;
    }
  }
  if (c.is_closed && c.is_oriented) c.volume = volume;
  const bool has_volume = c.volume && volume != 0;
  for (std::size_t k = 0; k < 3; ++k) {
    c.extent.centre[k] = middle[k] + (has_volume   ? by_volume[k] / volume
                                      : c.area > 0 ? by_area[k] / c.area
                                                   : 0);
  }
  std::vector<Row> flat;
  for (std::size_t f = 0; f < area_of.size(); ++f) {
    if (!(area_of[f] > 0)) flat.push_back(static_cast<Row>(f));
  }
  tell(s, "flat_face", Severity::warning, flat, 1, "faces have no area", "take them away");
  if (!c.volume || volume >= 0) return;
  c.findings.push_back({.code = "inside_out",
                        .severity = Severity::warning,
                        .text = "the surface is closed, and its faces look inward",
                        .remedy = "turn all faces over"});
}

void cross_itself(Surface& s) {
  const Crossings found = find_crossings(s.mesh.points, s.triangles);
  if (found.is_finished || !found.pairs.empty()) s.check.crosses_itself = !found.pairs.empty();
  std::vector<Row> rows;
  for (const auto& pair : found.pairs) rows.insert(rows.end(), pair.begin(), pair.end());
  tell(s, "self_intersection", Severity::error, rows, 2,
       "pairs of faces cross or touch each other beside what they share",
       "move points, or join the parts (a union in a mesh editor)");
  if (found.is_finished) return;
  s.check.findings.push_back(
      {.code = "crossings_unfinished",
       .severity = Severity::warning,
       .text = "not all faces were held against those near them: too many lie through each other",
       .remedy = "repair the other findings first"});
}

}  // namespace

std::optional<Extent> extent_of_tetrahedra(const FileMesh& mesh) {
  const std::vector<Point>& x = mesh.points;
  if (mesh.tetrahedra.corners.empty()) return std::nullopt;
  const Point origin = x[mesh.tetrahedra.corners[0][0]];
  Extent extent{{origin, origin}};
  Point sum{};
  double volume = 0;
  for (const auto& t : mesh.tetrahedra.corners) {
    const double part = std::abs(detail::six_volumes(x[t[0]], x[t[1]], x[t[2]], x[t[3]]));
    volume += part;
    for (const Row corner : t) {
      extend(extent.box, x[corner]);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += part / 4 * (x[corner][k] - origin[k]);
    }
  }
  if (!(volume > 0)) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k) extent.centre[k] = origin[k] + sum[k] / volume;
  return extent;
}

SurfaceCheck check_surface(const FileMesh& mesh) {
  FileMesh linear = mesh;
  make_linear(linear);
  SurfaceCheck check;
  Surface s{linear, check, {}, {}, {0}, {}, {}};
  find_places(s);
  take_faces(s);
  find_edges(s);
  find_vertices(s);
  find_duplicates(s);
  measure(s);
  cross_itself(s);
  check.euler_characteristic = static_cast<std::ptrdiff_t>(check.vertices + s.faces()) -
                               static_cast<std::ptrdiff_t>(check.edges);
  std::ranges::stable_sort(check.findings, std::ranges::greater{}, &Finding::severity);
  return check;
}

}  // namespace sunder
