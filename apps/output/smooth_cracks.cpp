// SPDX-License-Identifier: MIT
// Planes of cracks at points, the moves that the outer surface allows, and the bound by shapes.
#include "apps/output/smooth_cracks.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "mechanics/element/strain_displacement.hpp"
#include "topology/base/elementary.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {
namespace {

/// sin^2 of 0.35 rad, half the angle at which pictures take an edge of the skin for sharp. A
/// direction is free where the spread of the skin's normals along it is less than this share.
constexpr double sharp = 0.118;

/// Least eigenvalue of the squared normals of the planes: points do not move along directions below
/// it. Two planes at 41 degrees have it, or the normal of one at 60 degrees to the skin.
constexpr double well_conditioned = 0.25;

/// A bad tetrahedron shortens the moves of its points by this factor. After so many times the moves
/// are zero.
constexpr double shorter = 0.9;
constexpr int most_shortenings = 80;

/// The surroundings of a point on crack faces.
struct CrackPoint {
  std::uint32_t point = 0;
  std::vector<CrackId> cracks;                     ///< of its faces
  std::vector<std::array<std::uint32_t, 2>> skin;  ///< other two points of its outer faces
  double edges = 0;                                ///< m, of its tetrahedra
  std::size_t edge_count = 0;
};

struct Body {
  const Cells& cells;

  Vec3 at(std::uint32_t point) const { return Vec3(cells.map.points()[point].data()); }
  std::array<std::uint32_t, 4> points(TetId t) const {
    std::array<std::uint32_t, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) {
      rows[i] = cells.map.point_of_vertex(cells.map.corners(t)[i]);
    }
    return rows;
  }
};

/// Calls `visit(face, its three points)` for each half-face with `is_wanted`.
template <class Wanted, class Visit>
void each_face(const Body& body, Wanted is_wanted, Visit visit) {
  for (std::size_t f = 0; f < 4 * body.cells.map.tetrahedra(); ++f) {
    const HalfFaceId face{f};
    if (!is_wanted(face)) continue;
    visit(face, corners_of_face(body.points(tetrahedron_of(face)), face));
  }
}

/// The points on crack faces, in rising order, with all that decides where they go.
std::vector<CrackPoint> crack_points(const Body& body) {
  const Cells& cells = body.cells;
  std::vector<CrackPoint> points;
  std::vector<std::uint32_t> row(cells.map.points().size(), 0);  // 1 + that of `points`
  const auto is_cracked = [&](HalfFaceId f) { return !cells.cracks.of_face[f.index()].is_none(); };
  each_face(body, is_cracked, [&](HalfFaceId, const auto& three) {
    for (const std::uint32_t p : three) row[p] = 1;
  });
  for (std::uint32_t p = 0; p < row.size(); ++p) {
    if (row[p] == 0) continue;
    points.push_back({.point = p});
    row[p] = static_cast<std::uint32_t>(points.size());
  }
  each_face(body, is_cracked, [&](HalfFaceId f, const auto& three) {
    for (const std::uint32_t p : three) {
      points[row[p] - 1].cracks.push_back(cells.cracks.of_face[f.index()]);
    }
  });
  for (CrackPoint& p : points) sort_unique(p.cracks);
  each_face(
      body, [&](HalfFaceId f) { return cells.skin[f.index()] != 0; },
      [&](HalfFaceId, const auto& three) {
        for (std::size_t i = 0; i < 3; ++i) {
          if (row[three[i]] == 0) continue;
          points[row[three[i]] - 1].skin.push_back({three[(i + 1) % 3], three[(i + 2) % 3]});
        }
      });
  for (std::size_t t = 0; t < cells.map.tetrahedra(); ++t) {
    const auto four = body.points(TetId{t});
    double edges = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) edges += (body.at(four[i]) - body.at(four[j])).norm();
    }
    for (const std::uint32_t p : four) {
      if (row[p] == 0) continue;
      points[row[p] - 1].edges += edges;
      points[row[p] - 1].edge_count += 6;
    }
  }
  return points;
}

/// The outer surface at a point.
struct SkinAtPoint {
  Vec3 normal = Vec3::Zero();    ///< mean by angles, of any length
  Mat3 free = Mat3::Identity();  ///< projection on the directions along the surface
};

SkinAtPoint skin_at(const Body& body, const CrackPoint& p) {
  SkinAtPoint skin;
  if (p.skin.empty()) return skin;
  Mat3 spread = Mat3::Zero();
  double angles = 0;
  for (const auto& [a, b] : p.skin) {
    const Vec3 to_a = body.at(a) - body.at(p.point), to_b = body.at(b) - body.at(p.point);
    const Vec3 area = to_a.cross(to_b);
    if (area.isZero(0)) continue;
    const double angle = direction_angle(area.norm(), to_a.dot(to_b));
    const Vec3 n = area.normalized();
    skin.normal += angle * n;
    spread += angle * n * n.transpose();
    angles += angle;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  skin.free.setZero();
  for (int i = 0; i < 3; ++i) {
    if (axes.eigenvalues()[i] >= sharp * angles) continue;
    skin.free += axes.eigenvectors().col(i) * axes.eigenvectors().col(i).transpose();
  }
  return skin;
}

/// The move, brought along the mean normal onto the outer faces of the point and cut off where it
/// would leave them. It ends in the face with the corner that it points into.
Vec3 on_skin(const Body& body, const CrackPoint& p, const Vec3& normal, const Vec3& move) {
  double best = -1e-9;  // rounding of a move along an edge between two faces
  Vec3 on = Vec3::Zero();
  for (const auto& [a, b] : p.skin) {
    Mat3 frame;
    frame << body.at(a) - body.at(p.point), body.at(b) - body.at(p.point), normal;
    const Eigen::FullPivLU<Mat3> solver(frame);
    if (!solver.isInvertible()) continue;
    Vec3 x = solver.solve(move);
    const double least = std::min(x[0], x[1]);
    if (least <= best) continue;
    best = least;
    x = x.cwiseMax(0) / std::max(1.0, x[0] + x[1]);
    on = x[0] * frame.col(0) + x[1] * frame.col(1);
  }
  return on;
}

/// Where a point would go.
Vec3 wanted_move(const Body& body, const CrackPoint& p) {
  const Vec3 place = body.at(p.point);
  const double h = p.edges / static_cast<double>(p.edge_count);
  const SkinAtPoint skin = skin_at(body, p);
  Mat3 normals = Mat3::Zero();
  Vec3 distances = Vec3::Zero();
  for (const CrackId crack : p.cracks) {
    const AnchorSums near =
        anchors_near(body.cells.cracks, crack, place, h, {}, ComponentId::none());
    if (near.normal.isZero(0)) continue;
    const Vec3 n = near.normal.normalized(), along = skin.free * n;
    normals += along * along.transpose();
    distances += n.dot(near.at / near.weight - place) * along;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(normals);
  Vec3 move = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (axes.eigenvalues()[i] < well_conditioned) continue;
    const Vec3 axis = axes.eigenvectors().col(i);
    move += axis.dot(distances) / axes.eigenvalues()[i] * axis;
  }
  return p.skin.empty() || move.isZero(0) ? move : on_skin(body, p, skin.normal, move);
}

/// Mean ratio to the power 3/2, but for a factor; negative where it is turned over.
double shape_of(const std::array<Vec3, 4>& x) {
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) squares += (x[i] - x[j]).squaredNorm();
  }
  return tetrahedron_volume(x) / (squares * std::sqrt(squares));
}

/// A tetrahedron with points that move.
struct MovedTetrahedron {
  std::array<std::uint32_t, 4> points;
  double shape = 0;  ///< at rest

  bool is_kept(const Body& body, std::span<const Vec3> moves) const {
    std::array<Vec3, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = body.at(points[i]) + moves[points[i]];
    static const double share = smooth_shape_share * std::sqrt(smooth_shape_share);
    return (shape < 0 ? -1 : 1) * shape_of(x) >= share * std::abs(shape);
  }
};

/// Shortens the moves of all points of tetrahedra that lose their shape, all at once, until there
/// are none: which tetrahedron comes first is of no matter.
void keep_shapes(const Body& body, std::vector<Vec3>& moves) {
  std::vector<MovedTetrahedron> moved;
  for (std::size_t t = 0; t < body.cells.map.tetrahedra(); ++t) {
    const auto four = body.points(TetId{t});
    if (std::ranges::all_of(four, [&](std::uint32_t p) { return moves[p].isZero(0); })) continue;
    moved.push_back(
        {four, shape_of({body.at(four[0]), body.at(four[1]), body.at(four[2]), body.at(four[3])})});
  }
  std::vector<int> shortened(moves.size(), 0);
  for (std::vector<std::uint32_t> bad;; bad.clear()) {
    for (const MovedTetrahedron& t : moved) {
      if (!t.is_kept(body, moves)) bad.insert(bad.end(), t.points.begin(), t.points.end());
    }
    if (bad.empty()) return;
    sort_unique(bad);
    for (const std::uint32_t p : bad) {
      moves[p] *= ++shortened[p] > most_shortenings ? 0 : shorter;
    }
  }
}

}  // namespace

std::vector<Vec3> smooth_crack_moves(const Cells& cells) {
  const Body body{cells};
  std::vector<Vec3> moves(cells.map.points().size(), Vec3::Zero());
  if (cells.cracks.anchors.empty()) return moves;
  for (const CrackPoint& p : crack_points(body)) moves[p.point] = wanted_move(body, p);
  keep_shapes(body, moves);
  return moves;
}

}  // namespace sunder
