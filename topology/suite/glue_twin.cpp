// SPDX-License-Identifier: MIT
// Union-find over tetrahedron corners, edges and faces.
#include "topology/suite/glue_twin.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace sunder::suite {
namespace {

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }
  std::size_t classes() {
    std::size_t n = 0;
    for (std::uint32_t i = 0; i < parent_.size(); ++i) n += root(i) == i ? 1 : 0;
    return n;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

using Face = std::array<std::uint32_t, 3>;

Face face_points(const GlueTwin& twin, HalfFaceId f) {
  Face face;
  std::size_t n = 0;
  for (int i = 0; i < 4; ++i) {
    if (i != place_of(f)) face[n++] = twin.tetrahedra[f.index() / 4][i];
  }
  return face;
}

std::uint32_t place_of_point(const GlueTwin& twin, std::uint32_t t, std::uint32_t point) {
  const auto& corners = twin.tetrahedra[t];
  const auto found = std::find(corners.begin(), corners.end(), point);
  return static_cast<std::uint32_t>(found - corners.begin());
}

/// Number 6 t + e of the edge between two points of a tetrahedron.
std::uint32_t edge_of(const GlueTwin& twin, std::uint32_t t, std::uint32_t a, std::uint32_t b) {
  constexpr std::array<std::array<std::uint32_t, 4>, 4> number = {
      {{9, 0, 1, 2}, {0, 9, 3, 4}, {1, 3, 9, 5}, {2, 4, 5, 9}}};
  return 6 * t + number[place_of_point(twin, t, a)][place_of_point(twin, t, b)];
}

/// Whether tetrahedra a and b hang together through glued faces that contain all `points`.
bool joined_around(const GlueTwin& twin, std::uint32_t a, std::uint32_t b,
                   const std::vector<std::uint32_t>& points) {
  const std::vector<std::uint32_t>& star = twin.around[points[0]];
  UnionFind sets(star.size());
  const auto local = [&star](std::uint32_t t) {
    return static_cast<std::uint32_t>(std::lower_bound(star.begin(), star.end(), t) - star.begin());
  };
  for (const std::uint32_t t : star) {
    for (std::uint32_t p = 0; p < 4; ++p) {
      const HalfFaceId across = twin.glued[4 * t + p];
      if (across.is_none()) continue;
      const Face face = face_points(twin, HalfFaceId{4 * t + p});
      const bool contains = std::all_of(points.begin(), points.end(), [&face](std::uint32_t x) {
        return std::find(face.begin(), face.end(), x) != face.end();
      });
      if (contains) sets.join(local(t), local(across.value / 4));
    }
  }
  return sets.root(local(a)) == sets.root(local(b));
}

/// Whether b can be reached from a over glued faces.
bool reaches(GlueTwin& twin, std::uint32_t a, std::uint32_t b) {
  twin.stamp.resize(twin.tetrahedra.size(), 0);
  ++twin.now;
  std::vector<std::uint32_t> stack = {a};
  twin.stamp[a] = twin.now;
  while (!stack.empty()) {
    const std::uint32_t t = stack.back();
    stack.pop_back();
    if (t == b) return true;
    for (std::uint32_t p = 0; p < 4; ++p) {
      const HalfFaceId across = twin.glued[4 * t + p];
      if (across.is_none() || twin.stamp[across.value / 4] == twin.now) continue;
      twin.stamp[across.value / 4] = twin.now;
      stack.push_back(across.value / 4);
    }
  }
  return false;
}

}  // namespace

GlueTwin glue_twin(const std::vector<std::array<std::uint32_t, 4>>& tetrahedra,
                   std::size_t points) {
  GlueTwin twin;
  twin.tetrahedra = tetrahedra;
  twin.glued.assign(4 * tetrahedra.size(), HalfFaceId::none());
  twin.around.resize(points);
  std::map<Face, HalfFaceId> first;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    for (const std::uint32_t p : tetrahedra[t]) {
      twin.around[p].push_back(static_cast<std::uint32_t>(t));
    }
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId f = half_face(TetId{t}, p);
      Face face = face_points(twin, f);
      std::sort(face.begin(), face.end());
      const auto [it, fresh] = first.emplace(face, f);
      if (!fresh) glue_again(twin, it->second, f);
    }
  }
  return twin;
}

void glue_again(GlueTwin& twin, HalfFaceId a, HalfFaceId b) {
  twin.glued[a.index()] = b;
  twin.glued[b.index()] = a;
}

TwinCounts union_find_counts(const GlueTwin& twin) {
  const std::size_t tetrahedra = twin.tetrahedra.size();
  UnionFind corners(4 * tetrahedra), edges(6 * tetrahedra), bodies(tetrahedra);
  TwinCounts counts;
  counts.tetrahedra = tetrahedra;
  for (std::uint32_t f = 0; f < twin.glued.size(); ++f) {
    const HalfFaceId across = twin.glued[f];
    counts.boundary_faces += across.is_none() ? 1 : 0;
    if (across.is_none()) continue;
    const std::uint32_t t = f / 4, u = across.value / 4;
    bodies.join(t, u);
    const Face face = face_points(twin, HalfFaceId{f});
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = face[i], b = face[(i + 1) % 3];
      corners.join(4 * t + place_of_point(twin, t, a), 4 * u + place_of_point(twin, u, a));
      edges.join(edge_of(twin, t, a, b), edge_of(twin, u, a, b));
    }
  }
  // Boundary faces that meet in one class of edges belong to one sheet.
  UnionFind sheets(4 * tetrahedra);
  std::map<std::uint32_t, std::uint32_t> face_at_edge;
  std::set<std::uint32_t> sheet_roots;
  for (std::uint32_t f = 0; f < twin.glued.size(); ++f) {
    if (!twin.glued[f].is_none()) continue;
    const Face face = face_points(twin, HalfFaceId{f});
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t e = edges.root(edge_of(twin, f / 4, face[i], face[(i + 1) % 3]));
      const auto [it, fresh] = face_at_edge.emplace(e, f);
      if (!fresh) sheets.join(it->second, f);
    }
  }
  for (std::uint32_t f = 0; f < twin.glued.size(); ++f) {
    if (twin.glued[f].is_none()) sheet_roots.insert(sheets.root(f));
  }
  counts.vertices = corners.classes();
  counts.edges = edges.classes();
  counts.components = bodies.classes();
  counts.faces = (4 * tetrahedra + counts.boundary_faces) / 2;
  counts.boundary_sheets = sheet_roots.size();
  return counts;
}

LocalTruth unglue(GlueTwin& twin, HalfFaceId face) {
  const HalfFaceId across = twin.glued[face.index()];
  const std::uint32_t a = face.value / 4, b = across.value / 4;
  twin.glued[face.index()] = twin.glued[across.index()] = HalfFaceId::none();
  LocalTruth truth;
  truth.points = face_points(twin, face);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t p = truth.points[i], q = truth.points[(i + 1) % 3];
    truth.vertex_split[i] = !joined_around(twin, a, b, {p});
    truth.edge_split[i] = !joined_around(twin, a, b, {p, q});
  }
  truth.separated = !reaches(twin, a, b);
  return truth;
}

}  // namespace sunder::suite
