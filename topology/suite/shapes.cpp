// SPDX-License-Identifier: MIT
// Generators of test meshes.
#include "topology/suite/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sunder::suite {
namespace {

using Index4 = std::array<std::uint32_t, 4>;

double determinant(const TetMesh& mesh, const Index4& t) {
  std::array<Point, 3> e;
  for (std::size_t k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) e[k][i] = mesh.points[t[k + 1]][i] - mesh.points[t[0]][i];
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// Exchanges the last two corners where the volume is negative.
void orient(TetMesh& mesh) {
  for (Index4& t : mesh.tetrahedra) {
    if (determinant(mesh, t) < 0) std::swap(t[2], t[3]);
  }
}

Point on_circle(double turn, double radius, double z) {
  const double angle = 2 * std::numbers::pi * turn;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// k tetrahedra round the edge 0-1, one after the other, over `span` turns.
TetMesh fan(int k, int rim, double span) {
  TetMesh mesh;
  mesh.points = {{0, 0, -1}, {0, 0, 1}};
  for (int i = 0; i < rim; ++i) mesh.points.push_back(on_circle(span * i / k, 1, 0));
  for (int i = 0; i < k; ++i) {
    const auto a = static_cast<std::uint32_t>(2 + i);
    const auto b = static_cast<std::uint32_t>(2 + (i + 1) % rim);
    mesh.tetrahedra.push_back({0, 1, a, b});
  }
  orient(mesh);
  return mesh;
}

/// A bar bent into a full turn round z; (k, y, z) lies where (0, y, z) lies.
TetMesh bend(int k) {
  TetMesh mesh = kuhn_box({k, 1, 1});
  for (Point& p : mesh.points) p = on_circle(p[0] / k, 2 - p[1], p[2]);
  return mesh;
}

/// Replaces points by others, and drops those replaced.
void join_points(TetMesh& mesh, std::vector<std::uint32_t> target) {
  std::vector<std::uint32_t> row(mesh.points.size());
  std::vector<Point> points;
  for (std::size_t p = 0; p < target.size(); ++p) {
    if (target[p] != p) continue;
    row[p] = static_cast<std::uint32_t>(points.size());
    points.push_back(mesh.points[p]);
  }
  for (Index4& t : mesh.tetrahedra) {
    for (std::uint32_t& p : t) p = row[target[p]];
  }
  mesh.points = std::move(points);
}

}  // namespace

std::uint32_t grid_point(const Cells& cells, int i, int j, int k) {
  return static_cast<std::uint32_t>((k * (cells[1] + 1) + j) * (cells[0] + 1) + i);
}

TetMesh kuhn_cubes(const Cells& cells, const std::function<bool(int, int, int)>& keep,
                   double cell) {
  TetMesh mesh;
  for (int k = 0; k <= cells[2]; ++k) {
    for (int j = 0; j <= cells[1]; ++j) {
      for (int i = 0; i <= cells[0]; ++i) mesh.points.push_back({cell * i, cell * j, cell * k});
    }
  }
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        if (!keep(i, j, k)) continue;
        std::array<int, 3> axes = {0, 1, 2};
        do {
          std::array<int, 3> at = {i, j, k};
          Index4 t = {grid_point(cells, i, j, k)};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[axes[step]];
            t[step + 1] = grid_point(cells, at[0], at[1], at[2]);
          }
          mesh.tetrahedra.push_back(t);
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
    }
  }
  orient(mesh);
  return mesh;
}

TetMesh kuhn_box(const Cells& cells, double cell) {
  return kuhn_cubes(
      cells, [](int, int, int) { return true; }, cell);
}

TetMesh ring(const Cells& cells, double cell) {
  const auto outline = [&cells](int i, int j, int) {
    return i == 0 || j == 0 || i == cells[0] - 1 || j == cells[1] - 1;
  };
  return kuhn_cubes(cells, outline, cell);
}

TetMesh shell(const Cells& cells, double cell) {
  const auto wall = [&cells](int i, int j, int k) {
    return i == 0 || j == 0 || k == 0 || i == cells[0] - 1 || j == cells[1] - 1 ||
           k == cells[2] - 1;
  };
  return kuhn_cubes(cells, wall, cell);
}

TetMesh crossing_channels() {
  return kuhn_cubes({3, 3, 3}, [](int i, int j, int k) { return k != 1 || (i != 1 && j != 1); });
}

TetMesh closed_fan(int k) { return fan(k, k, 1.0); }
TetMesh open_fan(int k) { return fan(k, k + 1, 0.75); }

TetMesh octahedron_star() {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const std::uint32_t pole : {5U, 6U}) {
    for (std::uint32_t i = 0; i < 4; ++i)
      mesh.tetrahedra.push_back({0, 1 + i, 1 + (i + 1) % 4, pole});
  }
  orient(mesh);
  return mesh;
}

TetMesh one_tetrahedron() {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  return mesh;
}

TetMesh two_tetrahedra() {
  TetMesh mesh = one_tetrahedron();
  mesh.points.push_back({0, 0, -1});
  mesh.tetrahedra.push_back({1, 0, 2, 4});
  return mesh;
}

TetMesh two_tetrahedra_sharing_an_edge() {
  TetMesh mesh = one_tetrahedron();
  mesh.points.insert(mesh.points.end(), {{0, -1, 0}, {0, 0, -1}});
  mesh.tetrahedra.push_back({0, 1, 4, 5});
  orient(mesh);
  return mesh;
}

TetMesh two_tetrahedra_sharing_a_vertex() {
  TetMesh mesh = one_tetrahedron();
  mesh.points.insert(mesh.points.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  mesh.tetrahedra.push_back({0, 4, 5, 6});
  orient(mesh);
  return mesh;
}

TetMesh bent_bar(int k, const std::vector<std::array<int, 2>>& joined) {
  const Cells cells = {k, 1, 1};
  TetMesh mesh = bend(k);
  orient(mesh);
  std::vector<std::uint32_t> target(mesh.points.size());
  std::iota(target.begin(), target.end(), 0U);
  for (const auto& [y, z] : joined) {
    target[grid_point(cells, k, y, z)] = grid_point(cells, 0, y, z);
  }
  join_points(mesh, std::move(target));
  return mesh;
}

TetMesh joined_ring(int k, bool twisted) {
  if (!twisted) return bent_bar(k, {{0, 0}, {0, 1}, {1, 0}, {1, 1}});
  const Cells cells = {k, 1, 1};
  TetMesh mesh = bend(k);
  orient(mesh);
  std::vector<std::uint32_t> target(mesh.points.size());
  std::iota(target.begin(), target.end(), 0U);
  for (const int y : {0, 1}) {
    for (const int z : {0, 1}) target[grid_point(cells, k, y, z)] = grid_point(cells, 0, z, y);
  }
  join_points(mesh, std::move(target));
  return mesh;
}

TetMesh closed_simplex_boundary() {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 1, 1}};
  for (std::uint32_t left_out = 0; left_out < 5; ++left_out) {
    Index4 t;
    std::size_t i = 0;
    for (std::uint32_t p = 0; p < 5; ++p) {
      if (p != left_out) t[i++] = p;
    }
    mesh.tetrahedra.push_back(t);
  }
  orient(mesh);
  return mesh;
}

TetMesh side_by_side(const TetMesh& a, const TetMesh& b) {
  TetMesh mesh = a;
  double right = 0, left = 0;
  for (const Point& p : a.points) right = std::max(right, p[0]);
  for (const Point& p : b.points) left = std::min(left, p[0]);
  const auto first = static_cast<std::uint32_t>(a.points.size());
  for (Point p : b.points) {
    p[0] += right - left + 1;
    mesh.points.push_back(p);
  }
  for (Index4 t : b.tetrahedra) {
    for (std::uint32_t& p : t) p += first;
    mesh.tetrahedra.push_back(t);
  }
  return mesh;
}

TetMesh jittered(TetMesh mesh, double amplitude, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (Point& p : mesh.points) {
    for (double& x : p) x += amplitude * (2 * unit(random) - 1);
  }
  return mesh;
}

TetMesh shuffled(const TetMesh& mesh, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto permutation = [&random](std::size_t n) {
    std::vector<std::uint32_t> p(n);
    std::iota(p.begin(), p.end(), 0U);
    for (std::size_t i = n; i > 1; --i) std::swap(p[i - 1], p[below(random, i)]);
    return p;
  };
  TetMesh other;
  const std::vector<std::uint32_t> point = permutation(mesh.points.size());
  other.points.resize(mesh.points.size());
  for (std::size_t p = 0; p < point.size(); ++p) other.points[point[p]] = mesh.points[p];
  for (const std::uint32_t t : permutation(mesh.tetrahedra.size())) {
    Index4 corners = mesh.tetrahedra[t];
    for (std::uint32_t& p : corners) p = point[p];
    if (below(random, 2) == 1) std::swap(corners[0], corners[1]), std::swap(corners[2], corners[3]);
    for (std::size_t turns = below(random, 3); turns > 0; --turns) {
      std::rotate(corners.begin() + 1, corners.begin() + 2, corners.end());
    }
    other.tetrahedra.push_back(corners);
  }
  return other;
}

std::size_t below(std::mt19937_64& random, std::size_t end) { return random() % end; }
double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

std::vector<NamedMesh> all_shapes() {
  return {{"one tetrahedron", one_tetrahedron()},
          {"two tetrahedra", two_tetrahedra()},
          {"two tetrahedra sharing an edge", two_tetrahedra_sharing_an_edge()},
          {"two tetrahedra sharing a vertex", two_tetrahedra_sharing_a_vertex()},
          {"closed fan of 3", closed_fan(3)},
          {"closed fan of 6", closed_fan(6)},
          {"open fan of 4", open_fan(4)},
          {"octahedron star", octahedron_star()},
          {"ring of figure 4", ring({3, 3, 1})},
          {"cube of figure 5", kuhn_box({2, 2, 2})},
          {"shell", shell({3, 3, 3})},
          {"crossing channels", crossing_channels()},
          {"cube of 384", jittered(kuhn_box({4, 4, 4}), 0.1, 1)},
          {"closed simplex boundary", closed_simplex_boundary()},
          {"bar pinched at a vertex", bent_bar(4, {{0, 0}})},
          {"bar pinched at an edge", bent_bar(4, {{0, 0}, {0, 1}})},
          {"joined ring", joined_ring(4, false)},
          {"two bodies", side_by_side(two_tetrahedra(), one_tetrahedron())},
          {"shuffled cube", shuffled(kuhn_box({3, 2, 2}), 2)}};
}

}  // namespace sunder::suite
