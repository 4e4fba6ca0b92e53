// SPDX-License-Identifier: MIT
// Cracks drawn on their planes: moved and fixed points, and no tetrahedron turned over.
#include "apps/output/smooth_cracks.hpp"

#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>

#include "tests/support/tension.hpp"
#include "topology/io/mesh_file.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

constexpr double h = 0.1;  // m, edge of the boxes' cubes

Vec3 point(const sunder::Cells& cells, std::size_t row) {
  return Vec3(cells.map.points()[row].data());
}

std::array<std::uint32_t, 4> points_of(const sunder::Cells& cells, TetId t) {
  std::array<std::uint32_t, 4> rows;
  for (std::size_t i = 0; i < 4; ++i) {
    rows[i] = cells.map.point_of_vertex(cells.map.corners(t)[i]);
  }
  return rows;
}

std::array<std::uint32_t, 3> points_of(const sunder::Cells& cells, HalfFaceId face) {
  const auto all = points_of(cells, tetrahedron_of(face));
  std::array<std::uint32_t, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    const int corner = dart_order::face_corners[static_cast<std::size_t>(place_of(face))][i];
    rows[i] = all[static_cast<std::size_t>(corner)];
  }
  return rows;
}

sunder::Cells cells_of(const TetMesh& mesh) {
  return uniform_tension(mesh, Vec3::UnitX(), 1e6).cells;
}

/// Cracks a body between the tetrahedra with their centres on either side of a plane. Anchors: on
/// the plane but for up to `noise` (m) along the normal.
CrackId crack_along(sunder::Cells& cells, const CrackPlane& plane, double noise = 0,
                    std::uint64_t seed = 1) {
  const CrackId crack = add_crack(cells.cracks, cells.map.tetrahedra());
  std::vector<char> positive(cells.map.tetrahedra());
  for (std::size_t t = 0; t < positive.size(); ++t) {
    Vec3 centre = Vec3::Zero();
    for (const std::uint32_t p : points_of(cells, TetId{t})) centre += 0.25 * point(cells, p);
    positive[t] = plane.normal.dot(centre - plane.at) > 0;
    add_label(cells.cracks, crack, TetId{t}, positive[t] != 0);
  }
  std::mt19937_64 random(seed);
  for (std::size_t f = 0; f < 4 * positive.size(); ++f) {
    const HalfFaceId face{f}, other = cells.map.neighbour(face);
    if (other.is_none() || !positive[tetrahedron_of(face).index()] ||
        positive[tetrahedron_of(other).index()]) {
      continue;
    }
    cells.cracks.of_face[f] = cells.cracks.of_face[other.index()] = crack;
    const Corners corners = cells.map.corners(tetrahedron_of(face));
    for (std::size_t i = 0; i < 4; ++i) {
      if (static_cast<int>(i) == place_of(face)) continue;
      const Vec3 x(cells.map.point(corners[i]).data());
      const double away = noise * (2 * unit(random) - 1) - plane.normal.dot(x - plane.at);
      add_anchor(cells.cracks, {crack, corners[i], {}, x + away * plane.normal, plane.normal});
    }
    split_face(cells.map, face);
  }
  return crack;
}

double shape(const std::array<Vec3, 4>& x) {
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) squares += (x[i] - x[j]).squaredNorm();
  }
  return 12 * std::cbrt(std::pow(3 * tetrahedron_volume(x), 2)) / squares;
}

/// How far `move` is from a point of the outer faces at the point `p`, m.
double off_skin(const sunder::Cells& cells, std::size_t p, const Vec3& move) {
  double least = move.norm();
  for (std::size_t f = 0; f < cells.skin.size(); ++f) {
    if (!cells.skin[f]) continue;
    auto rows = points_of(cells, HalfFaceId{f});
    const auto own = std::ranges::find(rows, p);
    if (own == rows.end()) continue;
    std::rotate(rows.begin(), own, rows.end());
    Eigen::Matrix<double, 3, 2> sides;
    sides << point(cells, rows[1]) - point(cells, p), point(cells, rows[2]) - point(cells, p);
    Eigen::Vector2d x = sides.colPivHouseholderQr().solve(move);
    x = x.cwiseMax(0) / std::max(1.0, x.cwiseMax(0).sum());
    least = std::min(least, (sides * x - move).norm());
  }
  return least;
}

/// Area of a crack's faces on its positive side, with all points moved, m^2.
double area_of(const sunder::Cells& cells, CrackId crack, const std::vector<Vec3>& moves) {
  double area = 0;
  for (std::size_t f = 0; f < cells.cracks.of_face.size(); ++f) {
    if (cells.cracks.of_face[f] != crack) continue;
    const auto p = points_of(cells, HalfFaceId{f});
    const auto x = [&](std::size_t i) -> Vec3 { return point(cells, p[i]) + moves[p[i]]; };
    area += 0.25 * (x(1) - x(0)).cross(x(2) - x(0)).norm();  // each face from both sides
  }
  return area;
}

Vec3 direction(std::mt19937_64& random) {
  Vec3 n;
  for (double& x : n) x = 2 * unit(random) - 1;
  return n.normalized();
}

}  // namespace

TEST_CASE("drawn smooth, every tetrahedron keeps its share of its shape and the skin its place",
          "[output][smooth_cracks]") {
  const TetMesh bunny = *read_mesh(std::filesystem::path(SUNDER_MESHES "/bunny.msh"));
  double least = 1;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    const bool is_box = seed % 8 != 0;
    sunder::Cells cells =
        cells_of(is_box ? jittered(kuhn_box({6, 5, 4}, h), 0.25 * h, seed) : bunny);
    Vec3 middle = Vec3::Zero();
    for (std::size_t p = 0; p < cells.map.points().size(); ++p) middle += point(cells, p);
    middle /= static_cast<double>(cells.map.points().size());
    const double edge = is_box ? h : 0.01;
    for (int k = 0; k < 3; ++k) {
      crack_along(cells, {direction(random), middle + 3 * edge * unit(random) * direction(random)},
                  edge, seed);
    }
    const std::vector<Vec3> moves = smooth_crack_moves(cells);
    INFO("seed " << seed);
    for (std::size_t t = 0; t < cells.map.tetrahedra(); ++t) {
      std::array<Vec3, 4> rest, drawn;
      const auto rows = points_of(cells, TetId{t});
      for (std::size_t i = 0; i < 4; ++i) {
        rest[i] = point(cells, rows[i]);
        drawn[i] = rest[i] + moves[rows[i]];
      }
      const double share = shape(drawn) / shape(rest);
      if (tetrahedron_volume(drawn) <= 0 || share < smooth_shape_share * (1 - 1e-12)) {
        FAIL_CHECK("tetrahedron " << t << " keeps " << share);
      }
      least = std::min(least, share);
    }
    std::vector<char> on_skin(moves.size(), 0);
    for (std::size_t f = 0; f < cells.skin.size(); ++f) {
      if (!cells.skin[f]) continue;
      for (const std::uint32_t p : points_of(cells, HalfFaceId{f})) on_skin[p] = 1;
    }
    for (std::size_t p = 0; p < moves.size(); ++p) {
      // Sides of edge and moves of an edge at most: sums of a few products of numbers below 1.
      if (on_skin[p] && off_skin(cells, p, moves[p]) > 1e-14) FAIL_CHECK("point " << p);
    }
  }
  CHECK(least < 1.1 * smooth_shape_share);  // the bound was reached
}

TEST_CASE("a plane crack is drawn nearly plane, edges of the body stay edges, corners corners",
          "[output][smooth_cracks]") {
  TetMesh mesh = kuhn_box({8, 8, 8}, h);
  const TetMesh moved = jittered(mesh, 0.2 * h, 3);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = mesh.points[p][i];
      if (x > 0.5 * h && x < 7.5 * h) mesh.points[p][i] = moved.points[p][i];
    }
  }
  sunder::Cells cells = cells_of(mesh);
  const Vec3 normal = Vec3(0.2, 0.3, 1).normalized();
  const CrackId crack = crack_along(cells, {normal, Vec3(4, 4, 4.2) * h});
  const std::vector<Vec3> moves = smooth_crack_moves(cells);
  const double section = 64 * h * h / normal[2];
  CHECK(area_of(cells, crack, std::vector<Vec3>(moves.size(), Vec3::Zero())) > 1.4 * section);
  CHECK(area_of(cells, crack, moves) < 1.12 * section);
  double on_edges = 0;
  for (std::size_t p = 0; p < moves.size(); ++p) {
    int faces = 0;
    for (int i = 0; i < 3; ++i) {
      const double x = point(cells, p)[i];
      if (std::abs(x) > 1e-12 && std::abs(x - 8 * h) > 1e-12) continue;
      ++faces;
      CHECK(std::abs(moves[p][i]) < 1e-14);
    }
    if (faces == 2) on_edges = std::max(on_edges, moves[p].norm());
  }
  CHECK(on_edges > 0.1 * h);
}

TEST_CASE("a point of two cracks goes to where their planes meet", "[output][smooth_cracks]") {
  sunder::Cells cells = cells_of(kuhn_box({6, 6, 6}, h));
  // A little off grid planes: moves are too short for the bound.
  const Vec3 at = Vec3(3.05, 3.1, 0) * h;
  const CrackId first = crack_along(cells, {Vec3::UnitX(), at});
  const CrackId second = crack_along(cells, {Vec3::UnitY(), at});
  const std::vector<Vec3> moves = smooth_crack_moves(cells);
  std::vector<int> cracks(moves.size(), 0);
  for (std::size_t f = 0; f < cells.cracks.of_face.size(); ++f) {
    const CrackId crack = cells.cracks.of_face[f];
    for (const std::uint32_t p : points_of(cells, HalfFaceId{f})) {
      cracks[p] |= (crack == first ? 1 : 0) | (crack == second ? 2 : 0);
    }
  }
  std::size_t joints = 0;
  for (std::size_t p = 0; p < moves.size(); ++p) {
    const Vec3 drawn = point(cells, p) + moves[p];
    if (cracks[p] == 0) CHECK(moves[p].isZero(0));
    if (cracks[p] & 1 && moves[p].norm() > 0) CHECK(drawn[0] == Approx(at[0]).margin(0.5 * h));
    if (cracks[p] != 3) continue;
    if (std::abs(point(cells, p)[0] - 3 * h) > 1e-9) continue;
    if (std::abs(point(cells, p)[1] - 3 * h) > 1e-9) continue;
    ++joints;
    CHECK(drawn[0] == Approx(at[0]).epsilon(1e-12));
    CHECK(drawn[1] == Approx(at[1]).epsilon(1e-12));
  }
  CHECK(joints == 7);
}

TEST_CASE("a point of two nearly parallel cracks stays between them", "[output][smooth_cracks]") {
  sunder::Cells cells = cells_of(kuhn_box({6, 6, 6}, h));
  const double turn = 10 * EIGEN_PI / 180;
  const CrackId first = crack_along(cells, {Vec3::UnitX(), Vec3(3.05, 3, 0) * h});
  crack_along(cells, {Vec3(std::cos(turn), std::sin(turn), 0), Vec3(3.15, 3, 0) * h});
  const std::vector<Vec3> moves = smooth_crack_moves(cells);
  std::vector<int> cracks(moves.size(), 0);
  for (std::size_t f = 0; f < cells.cracks.of_face.size(); ++f) {
    const CrackId crack = cells.cracks.of_face[f];
    if (crack.is_none()) continue;
    for (const std::uint32_t p : points_of(cells, HalfFaceId{f})) {
      cracks[p] |= crack == first ? 1 : 2;
    }
  }
  std::size_t common = 0;
  for (std::size_t p = 0; p < moves.size(); ++p) {
    if (cracks[p] != 3 || moves[p].isZero(0)) continue;
    ++common;
    // Along the mean of the normals, though the planes meet a few edges away.
    CHECK(std::abs(moves[p][1]) <= 1.01 * std::tan(turn / 2) * std::abs(moves[p][0]) + 1e-15);
  }
  CHECK(common > 7);
}

TEST_CASE("cracks without planes are drawn where they are", "[output][smooth_cracks]") {
  sunder::Cells cells = cells_of(kuhn_box({2, 2, 2}, h));
  split_face(cells.map, fan_faces(cells.map, VertexId{13}, {1, 0, 0})->front());
  for (const Vec3& move : smooth_crack_moves(cells)) CHECK(move.isZero(0));
}
