// SPDX-License-Identifier: MIT
// Points against shapes, and points against tetrahedra by a grid.
#include "fracture/scene/overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/elementary.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

/// Of points that lie inside a body so many are measured; which are the deepest is then known to
/// their spacing.
constexpr std::size_t most_measured = 200;

std::array<Vec3, 4> corners_of(const BodySettings& body, const BodyMeasures& m, std::size_t t) {
  const auto& c = body.mesh.tetrahedra[t];
  return {m.points[c[0]], m.points[c[1]], m.points[c[2]], m.points[c[3]]};
}

/// A body's tetrahedra in the cells of a grid over its box.
class TetGrid {
 public:
  TetGrid(const BodySettings& body, const BodyMeasures& m) : body_(body), measures_(m) {
    const std::size_t count = body.mesh.tetrahedra.size();
    const double width = cube_root(m.box.volume() / static_cast<double>(count));
    for (int i = 0; i < 3; ++i) {
      const double cells = width > 0 ? std::ceil(m.box.sizes()[i] / width) : 1;
      counts_[i] = std::max(1, whole_number<int>(cells, 200));
    }
    rows_.resize(static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(counts_[1]) *
                 static_cast<std::size_t>(counts_[2]));
    for (std::size_t t = 0; t < count; ++t) {
      Eigen::AlignedBox3d box;
      for (const Vec3& x : corners_of(body, m, t)) box.extend(x);
      const Eigen::Vector3i low = cell_at(box.min()), high = cell_at(box.max());
      for (int i = low[0]; i <= high[0]; ++i) {
        for (int j = low[1]; j <= high[1]; ++j) {
          for (int k = low[2]; k <= high[2]; ++k) {
            rows_[row_of({i, j, k})].push_back(static_cast<std::uint32_t>(t));
          }
        }
      }
    }
  }

  /// Whether a point lies in a tetrahedron.
  bool contains(const Vec3& x) const {
    if (!measures_.box.contains(x)) return false;
    return std::ranges::any_of(rows_[row_of(cell_at(x))], [&](std::uint32_t t) {
      return std::ranges::min(barycentric(corners_of(body_, measures_, t), x)) >= 0;
    });
  }

 private:
  Eigen::Vector3i cell_at(const Vec3& x) const {
    Eigen::Vector3i cell;
    for (int i = 0; i < 3; ++i) {
      const double size = measures_.box.sizes()[i];
      const double part = size > 0 ? (x[i] - measures_.box.min()[i]) / size : 0;
      cell[i] = std::clamp(whole_number<int>(part * counts_[i]), 0, counts_[i] - 1);
    }
    return cell;
  }
  std::size_t row_of(const Eigen::Vector3i& cell) const {
    return static_cast<std::size_t>((cell[0] * counts_[1] + cell[1]) * counts_[2] + cell[2]);
  }

  const BodySettings& body_;
  const BodyMeasures& measures_;
  Eigen::Vector3i counts_;
  std::vector<std::vector<std::uint32_t>> rows_;
};

/// m, from a point to the surface of a body.
double distance_to_surface(const BodyMeasures& m, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const OuterFace& face : m.outside) {
    const std::array<Vec3, 3> c = {m.points[face.points[0]], m.points[face.points[1]],
                                   m.points[face.points[2]]};
    const auto share = nearest_on_triangle(c, x);
    least =
        std::min(least, (share[0] * c[0] + share[1] * c[1] + share[2] * c[2] - x).squaredNorm());
  }
  return std::sqrt(least);
}

/// m, the deepest of those points that lie in a body; 0 where none does.
double deepest_in(const TetGrid& grid, const BodyMeasures& m, std::span<const Vec3> points) {
  std::vector<Vec3> inside;
  for (const Vec3& x : points) {
    if (grid.contains(x)) inside.push_back(x);
  }
  const std::size_t stride = inside.size() / most_measured + 1;
  double depth = 0;
  for (std::size_t i = 0; i < inside.size(); i += stride) {
    depth = std::max(depth, distance_to_surface(m, inside[i]));
  }
  return depth;
}

/// Vertices and centres of the tetrahedra of a body that lie in a box.
std::vector<Vec3> points_in(const BodySettings& body, const BodyMeasures& m,
                            const Eigen::AlignedBox3d& box) {
  std::vector<Vec3> points;
  for (const Vec3& x : m.points) {
    if (box.contains(x)) points.push_back(x);
  }
  for (std::size_t t = 0; t < body.mesh.tetrahedra.size(); ++t) {
    const auto c = corners_of(body, m, t);
    const Vec3 centre = (c[0] + c[1] + c[2] + c[3]) / 4;
    if (box.contains(centre)) points.push_back(centre);
  }
  return points;
}

std::vector<Vec3> corners_of(const Shape& shape) {
  std::vector<Vec3> corners;
  const auto count = static_cast<std::uint32_t>(corner_count(shape));
  for (std::uint32_t k = 0; k < count; ++k) corners.push_back(corner_at(shape, k));
  return corners;
}

/// m, how deep a body lies in an obstacle.
double depth_in(const Shape& shape, const BodySettings& body, const BodyMeasures& m) {
  double depth = 0;
  for (const auto& t : body.mesh.tetrahedra) {
    for (const std::uint32_t p : t) {
      depth = std::max(depth, -surface_distance(shape, m.points[p]).gap);
    }
  }
  if (const auto* ball = std::get_if<Sphere>(&shape)) {
    if (m.box.exteriorDistance(ball->center) > ball->radius) return depth;
    const double to_surface = distance_to_surface(m, ball->center);
    const bool within = TetGrid(body, m).contains(ball->center);
    depth = std::max(depth, ball->radius + (within ? to_surface : -to_surface));
  }
  std::vector<Vec3> corners = corners_of(shape);
  std::erase_if(corners, [&](const Vec3& x) { return !m.box.contains(x); });
  if (!corners.empty()) depth = std::max(depth, deepest_in(TetGrid(body, m), m, corners));
  return depth;
}

}  // namespace

std::vector<Overlap> overlaps_at_start(const Scene& scene, std::span<const BodyMeasures> measures,
                                       double allowed) {
  std::vector<Overlap> found;
  std::vector<std::optional<TetGrid>> grids(scene.bodies.size());
  const auto grid_of = [&](std::size_t b) -> const TetGrid& {
    if (!grids[b]) grids[b].emplace(scene.bodies[b], measures[b]);
    return *grids[b];
  };
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
      const double depth = depth_in(scene.obstacles[k].shape, scene.bodies[b], measures[b]);
      if (depth > allowed) found.push_back({b, k, true, depth});
    }
    std::size_t whole = 0;
    for (std::size_t o = 0; o < b && whole <= most_whole_overlaps; ++o) {
      const Eigen::AlignedBox3d both = measures[b].box.intersection(measures[o].box);
      if (both.isEmpty() || !(both.sizes().minCoeff() > allowed)) continue;
      const double depth = std::max(
          deepest_in(grid_of(o), measures[o], points_in(scene.bodies[b], measures[b], both)),
          deepest_in(grid_of(b), measures[b], points_in(scene.bodies[o], measures[o], both)));
      if (!(depth > allowed)) continue;
      const bool is_whole =
          both.contains(measures[b].box.center()) && both.contains(measures[o].box.center());
      whole += is_whole;
      found.push_back({b, o, false, depth, is_whole});
    }
  }
  return found;
}

}  // namespace sunder
