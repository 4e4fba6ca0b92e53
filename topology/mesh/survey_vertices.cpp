// SPDX-License-Identifier: MIT
// Vertex and edge orbits of a mesh: which points are pinched, and which row each corner gets.
#include <algorithm>
#include <cmath>

#include "topology/kernel/kernel.hpp"
#include "topology/mesh/survey.hpp"

namespace sunder {
namespace {

constexpr FindingWords pinched_vertex = {
    "pinched_vertex", Severity::note,
    "% [point joins|points join] parts that share no face there; each part has its own vertex",
    "nothing to do, unless the parts were meant to hang together: then add tetrahedra"};
constexpr FindingWords pinched_edge = {
    "pinched_edge", Severity::note,
    "% [edge joins|edges join] parts that share no face there; each part has its own edge (ids: "
    "the two points "
    "of each)",
    "nothing to do, unless the parts were meant to hang together: then add tetrahedra"};
constexpr FindingWords unused_point = {
    "unused_point", Severity::note,
    "% [point belongs|points belong] to no tetrahedron: no vertex is made", "nothing to do"};
constexpr FindingWords coincident_points = {
    "coincident_points", Severity::note,
    "% [point lies|points lie] exactly where an earlier one lies",
    "nothing to do if a crack is meant there; otherwise merge them"};

constexpr std::uint32_t none = 0xffffffffU;
// Rows of the further orbits of a pinched point, before their final order is known.
constexpr std::uint32_t further = 0x80000000U;

/// Corners in buckets of their points: first[p] to first[p + 1], rising.
struct CornerBuckets {
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> corners;
};

CornerBuckets bucket_corners(const Survey& s) {
  CornerBuckets buckets;
  buckets.first.assign(s.mesh.points.size() + 2, 0);
  const auto& tetrahedra = s.mesh.tetrahedra;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    for (int i = 0; s.usable[t] && i < 4; ++i) ++buckets.first[tetrahedra[t][i] + 2];
  }
  for (std::size_t p = 2; p < buckets.first.size(); ++p) buckets.first[p] += buckets.first[p - 1];
  buckets.corners.resize(buckets.first.back());
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    for (int i = 0; s.usable[t] && i < 4; ++i) {
      const std::size_t at = buckets.first[tetrahedra[t][i] + 1]++;
      buckets.corners[at] = static_cast<std::uint32_t>(4 * t + static_cast<unsigned>(i));
    }
  }
  return buckets;
}

void flood_orbit(Survey& s, std::uint32_t start, std::uint32_t row,
                 std::vector<std::uint32_t>& stack) {
  const std::uint32_t point = s.mesh.tetrahedra[start / 4][start % 4];
  s.rows[start / 4][start % 4] = row;
  stack.assign(1, start);
  while (!stack.empty()) {
    const std::uint32_t c = stack.back();
    stack.pop_back();
    for (std::uint32_t p = 0; p < 4; ++p) {
      const HalfFaceId across = s.neighbours[c / 4][p];
      if (p == c % 4 || across.is_none()) continue;
      const std::uint32_t u = across.value / 4;
      const int i = place_of_point(s.mesh.tetrahedra[u], point);
      if (s.rows[u][i] != none) continue;
      s.rows[u][i] = row;
      stack.push_back(4 * u + static_cast<std::uint32_t>(i));
    }
  }
}

/// Gives the further orbits their rows, behind all points: by lowest tetrahedron, then by point.
/// `start_corner` and `edges`: a corner of each, and how many edges end in it.
void finish_further_rows(Survey& s, const std::vector<std::uint32_t>& start_corner,
                         const std::vector<std::uint32_t>& edges) {
  struct Orbit {
    std::uint32_t tetrahedron, point, index;
    auto operator<=>(const Orbit&) const = default;
  };
  std::vector<Orbit> orbits;
  for (std::uint32_t i = 0; i < start_corner.size(); ++i) {
    const std::uint32_t c = start_corner[i];
    orbits.push_back({c / 4, s.mesh.tetrahedra[c / 4][c % 4], i});
  }
  std::sort(orbits.begin(), orbits.end());
  std::vector<std::uint32_t> row(orbits.size());
  for (const Orbit& orbit : orbits) {
    row[orbit.index] = static_cast<std::uint32_t>(s.point_of_row.size());
    s.point_of_row.push_back(orbit.point);
    s.edges_at_row.push_back(edges[orbit.index]);
  }
  for (auto& rows : s.rows) {
    for (std::uint32_t& r : rows) {
      if (r != none && r >= further) r = row[r - further];
    }
  }
}

/// Number (0 to 5) of the edge between two places of a tetrahedron.
unsigned edge_bit(int i, int j) {
  constexpr std::array<std::array<unsigned, 4>, 4> number = {
      {{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}}};
  return number[i][j];
}

/// Marks the edge orbit through places i and j of tetrahedron t in the others that it goes through,
/// turning both ways if it is open.
void mark_edge(const Survey& s, std::uint32_t t, int i, int j, std::vector<std::uint8_t>& marked) {
  const std::uint32_t p = s.mesh.tetrahedra[t][i], q = s.mesh.tetrahedra[t][j];
  for (int leave = 0; leave < 4; ++leave) {
    if (leave == i || leave == j) continue;
    HalfFaceId across = s.neighbours[t][leave];
    while (!across.is_none() && across.value / 4 != t) {
      const std::uint32_t u = across.value / 4;
      const int a = place_of_point(s.mesh.tetrahedra[u], p);
      const int b = place_of_point(s.mesh.tetrahedra[u], q);
      marked[u] |= static_cast<std::uint8_t>(1U << edge_bit(a, b));
      across = s.neighbours[u][6 - a - b - static_cast<int>(across.value % 4)];
    }
    if (!across.is_none()) return;  // closed: the other way round is the same
  }
}

/// The further orbits met so far, each by a corner; working memory.
struct Flood {
  std::vector<std::uint32_t> further_start;
  std::vector<std::uint32_t> stack;
};

/// Results about edges, gathered while points are visited.
struct EdgeWalk {
  /// Bit k: edge k of the tetrahedron is in an orbit that was met.
  std::vector<std::uint8_t> marked;
  /// For the point at hand: how often an orbit between it and another one has begun.
  struct Seen {
    std::uint32_t from = none;
    std::uint32_t orbits = 0;
  };
  std::vector<Seen> seen;
  /// Ends in each row, of first and of further orbits.
  std::vector<std::uint32_t> at_row, at_further;
  std::size_t edges = 0;
  std::vector<std::array<std::uint32_t, 2>> pinched;
};

void count_end(EdgeWalk& walk, std::uint32_t row) {
  auto& at = row >= further ? walk.at_further : walk.at_row;
  const std::size_t place = row >= further ? row - further : row;
  if (at.size() <= place) at.resize(place + 1, 0);
  ++at[place];
}

/// The edges from `p` to lower points; the corners of both have their rows.
void walk_edges(const Survey& s, const CornerBuckets& buckets, std::uint32_t p, EdgeWalk& walk) {
  for (std::size_t k = buckets.first[p]; k < buckets.first[p + 1]; ++k) {
    const std::uint32_t t = buckets.corners[k] / 4;
    const int i = static_cast<int>(buckets.corners[k] % 4);
    for (int j = 0; j < 4; ++j) {
      const std::uint32_t q = s.mesh.tetrahedra[t][j];
      if (q >= p || (walk.marked[t] >> edge_bit(i, j) & 1U) != 0) continue;
      mark_edge(s, t, i, j, walk.marked);
      ++walk.edges;
      count_end(walk, s.rows[t][i]);
      count_end(walk, s.rows[t][j]);
      EdgeWalk::Seen& other = walk.seen[q];
      if (other.from != p) other = {p, 0};
      if (++other.orbits == 2) walk.pinched.push_back({q, p});
    }
  }
}

/// Rows of the vertex orbits at `p`. Gives how many there are.
std::size_t flood_point(Survey& s, const CornerBuckets& buckets, std::uint32_t p, Flood& flood) {
  std::size_t orbits = 0;
  for (std::size_t i = buckets.first[p]; i < buckets.first[p + 1]; ++i) {
    const std::uint32_t c = buckets.corners[i];
    if (s.rows[c / 4][c % 4] != none) continue;
    std::uint32_t row = further + static_cast<std::uint32_t>(flood.further_start.size());
    if (orbits++ == 0) {
      row = static_cast<std::uint32_t>(s.point_of_row.size());
      s.point_of_row.push_back(p);
    } else {
      flood.further_start.push_back(c);
    }
    flood_orbit(s, c, row, flood.stack);
  }
  return orbits;
}

void report_edges(Survey& s, EdgeWalk& walk) {
  s.edges = walk.edges;
  Places pinched(PlaceKind::edges, s.keeps_places);
  std::sort(walk.pinched.begin(), walk.pinched.end());
  for (const auto& edge : walk.pinched) pinched.add(edge);
  report(s, pinched_edge, pinched);
}

/// Vertices and edges in one go over the points: the tetrahedra at one lie anywhere in memory.
void survey_orbits(Survey& s, const CornerBuckets& buckets) {
  s.rows.assign(s.mesh.tetrahedra.size(), {none, none, none, none});
  Places pinched(PlaceKind::points, s.keeps_places);
  Flood flood;
  EdgeWalk walk;
  walk.marked.assign(s.mesh.tetrahedra.size(), 0);
  walk.seen.resize(s.mesh.points.size());
  for (std::uint32_t p = 0; p < s.mesh.points.size(); ++p) {
    if (flood_point(s, buckets, p, flood) > 1) pinched.add(p);
    walk_edges(s, buckets, p, walk);
  }
  s.edges_at_row = std::move(walk.at_row);
  if (!flood.further_start.empty()) finish_further_rows(s, flood.further_start, walk.at_further);
  report(s, pinched_vertex, pinched);
  report_edges(s, walk);
}

void survey_points(Survey& s) {
  const std::size_t points = s.mesh.points.size();
  // A point counts as used when any entry names it, be that tetrahedron usable or not.
  std::vector<char> used(points, 0);
  for (const auto& t : s.mesh.tetrahedra) {
    for (const std::uint32_t p : t) {
      if (p < points) used[p] = 1;
    }
  }
  Places unused(PlaceKind::points, s.keeps_places), coincident = unused;
  std::vector<std::uint32_t> order;
  for (std::uint32_t p = 0; p < points; ++p) {
    if (!used[p]) unused.add(p);
    const Point& x = s.mesh.points[p];
    if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2])) order.push_back(p);
  }
  std::sort(order.begin(), order.end(), [&s](std::uint32_t a, std::uint32_t b) {
    const Point &x = s.mesh.points[a], &y = s.mesh.points[b];
    return x != y ? x < y : a < b;
  });
  std::vector<std::uint32_t> later;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (s.mesh.points[order[i]] == s.mesh.points[order[i - 1]]) later.push_back(order[i]);
  }
  std::sort(later.begin(), later.end());
  for (const std::uint32_t p : later) coincident.add(p);
  report(s, unused_point, unused);
  report(s, coincident_points, coincident);
}

}  // namespace

void survey_vertices(Survey& s) {
  const CornerBuckets buckets = bucket_corners(s);
  survey_orbits(s, buckets);
  survey_points(s);
}

MapRows finish_rows(Survey&& s) {
  MapRows rows;
  const std::size_t tetrahedra = s.mesh.tetrahedra.size();
  rows.corners.resize(tetrahedra);
  rows.neighbours = std::move(s.neighbours);
  for (std::size_t t = 0; t < tetrahedra; ++t) {
    for (int i = 0; i < 4; ++i) rows.corners[t][i] = VertexId{s.rows[t][i]};
    if (s.flipped[t]) {
      rows.reoriented.push_back(TetId{t});
      std::swap(rows.corners[t][2], rows.corners[t][3]);
      std::swap(rows.neighbours[t][2], rows.neighbours[t][3]);
    }
    for (HalfFaceId& f : rows.neighbours[t]) {
      // Places 2 and 3 of the tetrahedron across are exchanged as well when it is flipped.
      if (!f.is_none() && s.flipped[f.index() / 4] && f.value % 4 >= 2) f.value ^= 1U;
    }
  }
  rows.point_of_vertex = std::move(s.point_of_row);
  rows.points = s.mesh.points;
  return rows;
}

}  // namespace sunder
