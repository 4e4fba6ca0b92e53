// SPDX-License-Identifier: MIT
// The twenty tetrahedra of an icosahedron, divided evenly and blown up.
#include <cmath>
#include <map>

#include "topology/mesh/solids/orient.hpp"
#include "topology/mesh/solids/solids.hpp"

namespace sunder {
namespace {

/// Corners at (0, +-1, +-g) and so on, g the golden ratio.
std::array<Point, 12> icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::array<Point, 12> corners{};
  std::size_t row = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double one : {-1.0, 1.0}) {
      for (const double golden : {-g, g}) {
        corners[row][(axis + 1) % 3] = one;
        corners[row++][(axis + 2) % 3] = golden;
      }
    }
  }
  return corners;
}

bool is_edge(const Point& a, const Point& b) {
  double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) squared += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return squared < 5;  // edges have 4, other pairs 10.5 and more
}

/// A point by the shares, in whole parts, of the icosahedron's corners; the centre has the rest.
using Shares = std::map<std::size_t, std::uint32_t>;

/// Points of the ball, one for each set of shares.
class BallPoints {
 public:
  BallPoints(TetMesh& mesh, double radius, std::uint32_t shells)
      : mesh_(mesh), radius_(radius), shells_(shells) {}

  std::uint32_t row(const Shares& shares) {
    const auto [at, is_new] =
        rows_.try_emplace(shares, static_cast<std::uint32_t>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(place(shares));
    return at->second;
  }

 private:
  Point place(const Shares& shares) const {
    Point p{};
    std::uint32_t shell = 0;
    for (const auto& [corner, share] : shares) {
      shell += share;
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += share * corners_[corner][axis];
    }
    if (shell == 0) return p;
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (double& x : p) x *= radius_ * shell / (shells_ * length);
    return p;
  }

  TetMesh& mesh_;
  double radius_;
  std::uint32_t shells_;
  std::array<Point, 12> corners_ = icosahedron();
  std::map<Shares, std::uint32_t> rows_;
};

/// Divides the tetrahedron of the centre and three corners: it is the part x >= y >= z of a cube of
/// `n` cubes along each edge, each of which has six tetrahedra.
void add_part(TetMesh& mesh, BallPoints& points, const std::array<std::size_t, 3>& corner,
              std::uint32_t n) {
  using Place = std::array<std::uint32_t, 3>;
  const auto row = [&](const Place& p) {
    Shares shares;
    const std::array<std::uint32_t, 3> share = {p[0] - p[1], p[1] - p[2], p[2]};
    for (std::size_t k = 0; k < 3; ++k) {
      if (share[k] > 0) shares[corner[k]] = share[k];
    }
    return points.row(shares);
  };
  const auto is_inside = [](const Place& p) { return p[0] >= p[1] && p[1] >= p[2]; };
  for (std::uint32_t x = 0; x < n; ++x) {
    for (std::uint32_t y = 0; y <= x; ++y) {
      for (std::uint32_t z = 0; z <= y; ++z) {
        for (const auto& order : axis_orders) {
          Place at = {x, y, z};
          std::array<Place, 4> path = {at};
          bool inside = true;
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[order[step]];
            path[step + 1] = at;
            inside = inside && is_inside(at);
          }
          if (!inside) continue;
          add_positive(mesh, {row(path[0]), row(path[1]), row(path[2]), row(path[3])});
        }
      }
    }
  }
}

}  // namespace

TetMesh ball_solid(double radius, std::uint32_t shells) {
  TetMesh mesh;
  const std::array<Point, 12> corners = icosahedron();
  BallPoints points(mesh, radius, shells);
  for (std::size_t a = 0; a < 12; ++a) {
    for (std::size_t b = a + 1; b < 12; ++b) {
      for (std::size_t c = b + 1; c < 12; ++c) {
        const bool is_face = is_edge(corners[a], corners[b]) && is_edge(corners[b], corners[c]) &&
                             is_edge(corners[c], corners[a]);
        if (is_face) add_part(mesh, points, {a, b, c}, shells);
      }
    }
  }
  return mesh;
}

}  // namespace sunder
