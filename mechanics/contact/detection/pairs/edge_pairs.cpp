// SPDX-License-Identifier: MIT
// Boxes of edges, and which of their pairs are kept.
#include "mechanics/contact/detection/pairs/edge_pairs.hpp"

#include "mechanics/contact/detection/face_touch.hpp"
#include "mechanics/contact/detection/pairs/solid_pairs.hpp"

namespace sunder {
namespace {

/// Whether a piece is convex at an edge by more than an angle of this sine; of a negative one,
/// whether it is not concave by more.
bool is_convex(const StepPaths& paths, const SurfaceEdge& edge, double sine) {
  if (edge.face[1].is_none()) return true;
  const std::array<Vec3, 3> x = places_at(paths, corners_of(paths, edge.face[0]), 0);
  const Vec3 across = paths.at_start(edge.beside[1]) - paths.at_start(edge.end[0]);
  return normal_of(x).dot(across) < -sine * across.norm();
}

/// Whether strains could make an edge sharp.
bool may_be_sharp(const StepPaths& paths, const SurfaceEdge& edge) {
  constexpr double strained = 0.2;
  return is_convex(paths, edge, -strained);
}

/// The number of an edge. It lasts until the surface of the piece changes.
std::uint32_t edge_number(const SurfaceEdge& edge) {
  return 6 * tetrahedron_of(edge.face[0]).value + edge.place;
}

/// Rows of all edges by their numbers, where the surface has changed.
void number_edges(DetectScratch& scratch, std::size_t tetrahedra) {
  if (scratch.edge_row_version == scratch.surface.version) return;
  scratch.edge_row_version = scratch.surface.version;
  scratch.edge_row.resize(6 * tetrahedra);
  for (std::uint32_t row = 0; row < scratch.surface.edges.size(); ++row) {
    scratch.edge_row[edge_number(scratch.surface.edges[row])] = row;
  }
}

}  // namespace

bool is_sharp(const StepPaths& paths, const SurfaceEdge& edge) {
  return is_convex(paths, edge, flat_sine);
}

void find_swept_edges(DetectScratch& scratch, const StepPaths& paths, double margin) {
  SolidPairs& pairs = scratch.solid_pairs;
  pairs.boxes.clear();
  pairs.body.clear();
  pairs.ways.clear();
  std::vector<std::uint32_t> rows;
  mark_inside(pairs.moves, paths);
  for (std::uint32_t row = 0; row < scratch.surface.edges.size(); ++row) {
    const SurfaceEdge& edge = scratch.surface.edges[row];
    const ComponentId id = paths.state.vertices.component[edge.end[0].index()];
    if (!paths.is_searched(id) || !is_sharp(paths, edge)) continue;
    const Vec3 &p = paths.at_start(edge.end[0]), &q = paths.at_start(edge.end[1]);
    const Vec3 way_of_p = paths.at_end(edge.end[0]) - p, way_of_q = paths.at_end(edge.end[1]) - q;
    const Vec3 way = 0.5 * (way_of_p + way_of_q), turned = way_of_p - way;
    // Edges that turn that far go on no straight ways: overlaps are found as the step ends.
    if (turned.norm() > (q - p).norm()) continue;
    const Vec3 wide = Vec3::Constant(margin) + turned.cwiseAbs();
    pairs.boxes.push_back({p.cwiseMin(q) - wide, p.cwiseMax(q) + wide});
    pairs.ways.push_back(way);
    pairs.body.push_back(id.value);
    rows.push_back(row);
  }
  find_box_pairs(pairs.found, pairs.grid, {pairs.boxes, pairs.body, pairs.moves, pairs.ways});
  scratch.swept.clear();
  for (const auto& [a, b] : pairs.found) scratch.swept.emplace_back(rows[a], rows[b]);
}

void refresh_edges(DetectScratch& scratch, const StepPaths& paths, double margin) {
  number_edges(scratch, paths.corners.size());
  const NearQuery query = near_query(scratch);
  if (!find_stale(scratch.near_edges, query)) return;
  SolidPairs& pairs = scratch.solid_pairs;
  pairs.boxes.clear();
  pairs.body.clear();
  std::vector<std::uint32_t> numbers, rows;
  const std::vector<SurfaceEdge>& edges = scratch.surface.edges;
  for (std::uint32_t row = 0; row < edges.size(); ++row) {
    const SurfaceEdge& edge = edges[row];
    if (!may_be_sharp(paths, edge)) continue;
    const std::uint32_t body = paths.state.vertices.component[edge.end[0].index()].value;
    const Vec3 wide = Vec3::Constant(margin + width_of(query, body));
    const Vec3 &p = paths.at_start(edge.end[0]), &q = paths.at_start(edge.end[1]);
    pairs.boxes.push_back({p.cwiseMin(q) - wide, p.cwiseMax(q) + wide});
    pairs.body.push_back(body);
    numbers.push_back(edge_number(edge));
    rows.push_back(row);
  }
  find_stale_pairs(pairs.found, scratch.near_edges, pairs);
  // Boxes of long edges overlap far from the edges.
  std::erase_if(pairs.found, [&](const RowPair& pair) {
    const auto [p, q] = pair;
    const double reach =
        2 * margin + width_of(query, pairs.body[p]) + width_of(query, pairs.body[q]);
    return distance_at_start(paths, edges[rows[p]], edges[rows[q]]) > reach;
  });
  add_pairs(scratch.near_edges, pairs.found, pairs.body, numbers);
}

double distance_at_start(const StepPaths& paths, const SurfaceEdge& a, const SurfaceEdge& b) {
  const Vec3 &p = paths.at_start(a.end[0]), &q = paths.at_start(b.end[0]);
  const Vec3 u = paths.at_start(a.end[1]) - p, v = paths.at_start(b.end[1]) - q;
  const auto [s, t] = nearest_of_segments(p, u, q, v);
  return (p + s * u - q - t * v).norm();
}

}  // namespace sunder
