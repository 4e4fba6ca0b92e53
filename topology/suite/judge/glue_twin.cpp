// SPDX-License-Identifier: MIT
// Union-find over tetrahedron corners, edges and faces.
#include "topology/suite/judge/glue_twin.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

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
  std::vector<std::uint32_t> roots() {
    for (std::uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = root(i);
    return parent_;
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
  // Those at any of the points hold all that have them all.
  const std::uint32_t fewest = *std::ranges::min_element(
      points, {}, [&twin](std::uint32_t p) { return twin.around[p].size(); });
  const std::vector<std::uint32_t>& star = twin.around[fewest];
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

/// Whether b can be reached from a over glued faces; breadth-first, since b is mostly near.
bool reaches(GlueTwin& twin, std::uint32_t a, std::uint32_t b) {
  twin.stamp.resize(twin.tetrahedra.size(), 0);
  ++twin.now;
  std::vector<std::uint32_t> queue = {a};
  twin.stamp[a] = twin.now;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    if (queue[i] == b) return true;
    for (std::uint32_t p = 0; p < 4; ++p) {
      const HalfFaceId across = twin.glued[4 * queue[i] + p];
      if (across.is_none() || twin.stamp[across.value / 4] == twin.now) continue;
      twin.stamp[across.value / 4] = twin.now;
      queue.push_back(across.value / 4);
    }
  }
  return false;
}

/// Corners 4 t + place, edges 6 t + number and tetrahedra, joined across every glued face.
struct Classes {
  UnionFind corners, edges, tetrahedra;
};

Classes join_glued(const GlueTwin& twin) {
  const std::size_t n = twin.tetrahedra.size();
  Classes classes{UnionFind(4 * n), UnionFind(6 * n), UnionFind(n)};
  for (std::uint32_t f = 0; f < twin.glued.size(); ++f) {
    const HalfFaceId across = twin.glued[f];
    if (across.is_none() || across.value < f) continue;
    const std::uint32_t t = f / 4, u = across.value / 4;
    classes.tetrahedra.join(t, u);
    const Face face = face_points(twin, HalfFaceId{f});
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = face[i], b = face[(i + 1) % 3];
      classes.corners.join(4 * t + place_of_point(twin, t, a), 4 * u + place_of_point(twin, u, a));
      classes.edges.join(edge_of(twin, t, a, b), edge_of(twin, u, a, b));
    }
  }
  return classes;
}

/// Boundary faces that meet in one class of edges belong to one sheet.
std::size_t count_sheets(const GlueTwin& twin, UnionFind& edges) {
  constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
  UnionFind sheets(twin.glued.size());
  std::vector<std::uint32_t> face_at_edge(6 * twin.tetrahedra.size(), nobody);
  for (std::uint32_t f = 0; f < twin.glued.size(); ++f) {
    if (!twin.glued[f].is_none()) continue;
    const Face face = face_points(twin, HalfFaceId{f});
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& other =
          face_at_edge[edges.root(edge_of(twin, f / 4, face[i], face[(i + 1) % 3]))];
      if (other == nobody) other = f;
      sheets.join(other, f);
    }
  }
  std::size_t count = 0;
  for (std::uint32_t f = 0; f < twin.glued.size(); ++f) {
    count += twin.glued[f].is_none() && sheets.root(f) == f ? 1 : 0;
  }
  return count;
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
  Classes classes = join_glued(twin);
  TwinCounts counts;
  counts.tetrahedra = twin.tetrahedra.size();
  counts.vertices = classes.corners.classes();
  counts.edges = classes.edges.classes();
  counts.components = classes.tetrahedra.classes();
  for (const HalfFaceId f : twin.glued) counts.boundary_faces += f.is_none() ? 1 : 0;
  counts.faces = (4 * counts.tetrahedra + counts.boundary_faces) / 2;
  counts.boundary_sheets = count_sheets(twin, classes.edges);
  return counts;
}

std::vector<std::uint32_t> corner_classes(const GlueTwin& twin) {
  return join_glued(twin).corners.roots();
}

std::vector<std::uint32_t> component_classes(const GlueTwin& twin) {
  return join_glued(twin).tetrahedra.roots();
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
