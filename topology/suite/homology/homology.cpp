// SPDX-License-Identifier: MIT
// The orbit complex of a glued body, its homology by elimination, and orientability.
#include "topology/suite/homology/homology.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "topology/base/union_find.hpp"
#include "topology/suite/homology/homology_matrix.hpp"

namespace sunder::suite {
namespace {

/// Places of a tetrahedron's corners in rising order of their points.
std::array<int, 4> rising_places(const std::array<std::uint32_t, 4>& tetrahedron) {
  std::array<int, 4> places = {0, 1, 2, 3};
  std::sort(places.begin(), places.end(),
            [&](int a, int b) { return tetrahedron[a] < tetrahedron[b]; });
  return places;
}

/// All tetrahedra with their corners in rising order of points. A part of one is a set of its
/// ranks 0 to 3: face i lies opposite to rank i, edge number_of_edge[i][j] joins ranks i and j.
constexpr std::array<std::array<std::uint32_t, 4>, 4> number_of_edge = {
    {{9, 0, 1, 2}, {0, 9, 3, 4}, {1, 3, 9, 5}, {2, 4, 5, 9}}};
constexpr std::array<std::array<int, 2>, 6> ranks_of_edge = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// The number of each row's set, in rising order of lowest members; and how many there are.
std::pair<std::vector<std::uint32_t>, std::size_t> numbered(UnionFind&& sets) {
  std::vector<std::uint32_t> number = std::move(sets).roots();
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    number[i] = number[i] == i ? next++ : number[number[i]];
  }
  return {std::move(number), next};
}

/// Number of the orbit of each tetrahedron's corners, edges and faces, by rank.
struct Orbits {
  std::vector<std::uint32_t> corner, edge, face;
  std::array<std::size_t, 3> counts;
};

Orbits number_orbits(const GlueTwin& twin) {
  const auto tetrahedra = static_cast<std::uint32_t>(twin.tetrahedra.size());
  std::vector<std::array<int, 4>> place(tetrahedra);
  for (std::uint32_t t = 0; t < tetrahedra; ++t) place[t] = rising_places(twin.tetrahedra[t]);
  UnionFind corners(4 * tetrahedra), edges(6 * tetrahedra), faces(4 * tetrahedra);
  for (std::uint32_t t = 0; t < tetrahedra; ++t) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const HalfFaceId across = twin.glued[half_face(TetId{t}, place[t][i]).index()];
      if (across.is_none()) continue;
      const std::uint32_t u = across.value / 4;
      const auto found = std::find(place[u].begin(), place[u].end(), place_of(across));
      const auto j = static_cast<std::uint32_t>(found - place[u].begin());
      faces.join(4 * t + i, 4 * u + j);
      // Both faces have the same points, hence in rising order their corners meet one by one.
      std::array<std::uint32_t, 3> here, there;
      for (std::uint32_t k = 0, a = 0, b = 0; k < 4; ++k) {
        if (k != i) here[a++] = k;
        if (k != j) there[b++] = k;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        corners.join(4 * t + here[k], 4 * u + there[k]);
        edges.join(6 * t + number_of_edge[here[k]][here[next]],
                   6 * u + number_of_edge[there[k]][there[next]]);
      }
    }
  }
  Orbits orbits;
  std::tie(orbits.corner, orbits.counts[0]) = numbered(std::move(corners));
  std::tie(orbits.edge, orbits.counts[1]) = numbered(std::move(edges));
  std::tie(orbits.face, orbits.counts[2]) = numbered(std::move(faces));
  return orbits;
}

/// The boundary matrix of dimension d: a row for each cell of d - 1, a column for each of d.
SparseMatrix boundary_matrix(const OrbitComplex& complex, std::size_t d) {
  SparseMatrix matrix;
  matrix.rows = complex.cells[d - 1];
  for (const auto& terms : complex.boundary[d]) {
    std::vector<MatrixEntry> column;
    for (std::size_t i = 0; i <= d; ++i) column.push_back({terms[i].cell, terms[i].sign});
    std::sort(column.begin(), column.end(),
              [](const MatrixEntry& a, const MatrixEntry& b) { return a.row < b.row; });
    matrix.columns.push_back(std::move(column));
  }
  return matrix;
}

/// Leaves out marked columns and marked rows; rows keep their numbers.
void leave_out(SparseMatrix& matrix, const std::vector<char>& columns,
               const std::vector<char>& rows) {
  std::vector<std::vector<MatrixEntry>> kept;
  for (std::size_t c = 0; c < matrix.columns.size(); ++c) {
    if (columns[c]) continue;
    std::erase_if(matrix.columns[c], [&](const MatrixEntry& e) { return rows[e.row] != 0; });
    kept.push_back(std::move(matrix.columns[c]));
  }
  matrix.columns = std::move(kept);
}

/// The three boundary matrices with their unit pivots taken, [1] to [3]. From the middle one, the
/// only hard one, the rows and columns made redundant by the pivots of the other two are removed
/// first: a spanning forest of edges, and faces through which tetrahedra collapse.
std::array<Elimination, 4> eliminate_boundaries(const OrbitComplex& complex, int prime) {
  std::array<Elimination, 4> result;
  result[1] = eliminate_units(boundary_matrix(complex, 1), prime);
  result[3] = eliminate_units(boundary_matrix(complex, 3), prime);
  SparseMatrix middle = boundary_matrix(complex, 2);
  leave_out(middle, result[3].pivot_row, result[1].pivot_column);
  result[2] = eliminate_units(std::move(middle), prime);
  // The removed rows and columns depend on the others: no pivot is counted twice.
  return result;
}

BettiNumbers betti_from_ranks(const OrbitComplex& complex, const std::array<std::size_t, 5>& rank) {
  BettiNumbers betti;
  for (std::size_t d = 0; d < 4; ++d) betti[d] = complex.cells[d] - rank[d] - rank[d + 1];
  return betti;
}

}  // namespace

OrbitComplex orbit_complex(const GlueTwin& twin) {
  const Orbits orbits = number_orbits(twin);
  OrbitComplex complex;
  const auto tetrahedra = static_cast<std::uint32_t>(twin.tetrahedra.size());
  complex.cells = {orbits.counts[0], orbits.counts[1], orbits.counts[2], tetrahedra};
  for (std::size_t d = 1; d < 4; ++d) complex.boundary[d].resize(complex.cells[d]);
  const auto sign = [](std::size_t i) { return i % 2 == 0 ? 1 : -1; };
  for (std::uint32_t t = 0; t < tetrahedra; ++t) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      complex.boundary[3][t][i] = {orbits.face[4 * t + i], sign(i)};
      std::array<std::uint32_t, 3> ranks;
      for (std::uint32_t k = 0, n = 0; k < 4; ++k) {
        if (k != i) ranks[n++] = k;
      }
      // Every tetrahedron of an orbit writes the same.
      auto& face = complex.boundary[2][orbits.face[4 * t + i]];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = ranks[k == 0 ? 1 : 0], b = ranks[k == 2 ? 1 : 2];
        face[k] = {orbits.edge[6 * t + number_of_edge[a][b]], sign(k)};
      }
    }
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [a, b] = ranks_of_edge[e];
      auto& edge = complex.boundary[1][orbits.edge[6 * t + e]];
      edge[0] = {orbits.corner[4 * t + static_cast<std::size_t>(b)], 1};
      edge[1] = {orbits.corner[4 * t + static_cast<std::size_t>(a)], -1};
    }
  }
  return complex;
}

bool boundaries_are_closed(const OrbitComplex& complex) {
  for (std::size_t d = 2; d < 4; ++d) {
    for (const auto& terms : complex.boundary[d]) {
      std::vector<std::pair<std::uint32_t, int>> sum;
      for (std::size_t i = 0; i <= d; ++i) {
        const auto& lower = complex.boundary[d - 1][terms[i].cell];
        for (std::size_t k = 0; k < d; ++k) {
          sum.emplace_back(lower[k].cell, terms[i].sign * lower[k].sign);
        }
      }
      for (const auto& [cell, ignored] : sum) {
        int total = 0;
        for (const auto& [other, sign] : sum) total += other == cell ? sign : 0;
        if (total != 0) return false;
      }
    }
  }
  return true;
}

BettiNumbers betti_numbers(const OrbitComplex& complex, int prime) {
  const auto eliminations = eliminate_boundaries(complex, prime);
  std::array<std::size_t, 5> rank = {};
  for (std::size_t d = 1; d < 4; ++d) rank[d] = eliminations[d].pivots;
  return betti_from_ranks(complex, rank);
}

IntegerHomology integer_homology(const OrbitComplex& complex) {
  const auto eliminations = eliminate_boundaries(complex, 0);
  IntegerHomology homology;
  std::array<std::size_t, 5> rank = {};
  for (std::size_t d = 1; d < 4; ++d) {
    const std::vector<std::uint64_t> divisors = elementary_divisors(eliminations[d].rest);
    rank[d] = eliminations[d].pivots + divisors.size();
    for (const std::uint64_t divisor : divisors) {
      if (divisor > 1) homology.torsion[d - 1].push_back(divisor);
    }
  }
  homology.betti = betti_from_ranks(complex, rank);
  return homology;
}

bool is_orientable(const GlueTwin& twin) {
  std::vector<int> orientation(twin.tetrahedra.size(), 0);
  std::vector<std::uint32_t> stack;
  // Sign of a face in the boundary of its tetrahedron, corners in rising order of points.
  const auto sign = [&twin](HalfFaceId f) {
    const auto& corners = twin.tetrahedra[f.index() / 4];
    const std::uint32_t opposite = corners[f.index() % 4];
    const auto rank = std::count_if(corners.begin(), corners.end(),
                                    [opposite](std::uint32_t p) { return p < opposite; });
    return rank % 2 == 0 ? 1 : -1;
  };
  for (std::uint32_t first = 0; first < orientation.size(); ++first) {
    if (orientation[first] != 0) continue;
    orientation[first] = 1;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (std::uint32_t p = 0; p < 4; ++p) {
        const HalfFaceId face{4 * t + p}, across = twin.glued[face.index()];
        if (across.is_none()) continue;
        int& other = orientation[across.index() / 4];
        const int needed = -orientation[t] * sign(face) * sign(across);
        if (other == 0) stack.push_back(across.value / 4);
        if (other == -needed) return false;
        other = needed;
      }
    }
  }
  return true;
}

}  // namespace sunder::suite
