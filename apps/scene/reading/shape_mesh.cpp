// SPDX-License-Identifier: MIT
// Counts of cells from their size, then the solids of topology/mesh/solids.
#include "apps/scene/reading/shape_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "topology/base/elementary.hpp"
#include "topology/mesh/solids/solids.hpp"

namespace sunder {
namespace {

/// Of a scene's body; more need gigabytes.
constexpr double most_tetrahedra = 1e8;

constexpr double pi = M_PI;

double volume_of(const BoxShape& b) { return b.size.prod(); }
double volume_of(const CylinderShape& c) { return pi * c.radius * c.radius * c.height; }
double volume_of(const TubeShape& t) {
  return pi * (t.outer_radius * t.outer_radius - t.inner_radius * t.inner_radius) * t.height;
}
double volume_of(const BallShape& b) { return 4 * pi / 3 * b.radius * b.radius * b.radius; }

/// Cells along a length, at least `least`. Within 32 bits: `too_many` has looked before.
std::uint32_t cells_along(double length, double cell, double least = 1) {
  return static_cast<std::uint32_t>(std::max(least, std::round(length / cell)));
}

/// The size of cells that gives a plate its number of tetrahedra, with its layers.
double cell_for(const PlateShape& p, double tetrahedra) {
  return std::sqrt(6 * p.layers * p.width * p.length / tetrahedra);
}
template <class Solid>
double cell_for(const Solid& solid, double tetrahedra) {
  return cube_root(6 * volume_of(solid) / tetrahedra);
}

/// Tetrahedra of a mesh, before it is made.
double count_of(const PlateShape& p, double cell) {
  return 6 * p.layers * std::max(1.0, p.width / cell) * std::max(1.0, p.length / cell);
}
template <class Solid>
double count_of(const Solid& solid, double cell) {
  return 6 * volume_of(solid) / (cell * cell * cell);
}

/// Lengths that a count is taken along.
double longest_of(const BoxShape& b) { return b.size.maxCoeff(); }
double longest_of(const PlateShape& p) { return std::max(p.width, p.length); }
double longest_of(const CylinderShape& c) { return std::max(c.radius, c.height); }
double longest_of(const TubeShape& t) { return std::max(2 * pi * t.outer_radius, t.height); }
double longest_of(const BallShape& b) { return b.radius; }

TetMesh mesh_of(const BoxShape& b, double cell) {
  return box_solid(
      {b.size[0], b.size[1], b.size[2]},
      {cells_along(b.size[0], cell), cells_along(b.size[1], cell), cells_along(b.size[2], cell)});
}
TetMesh mesh_of(const PlateShape& p, double cell) {
  return box_solid({p.width, p.length, p.thickness},
                   {cells_along(p.width, cell), cells_along(p.length, cell), p.layers});
}
TetMesh mesh_of(const CylinderShape& c, double cell) {
  return cylinder_solid(c.radius, c.height, cells_along(c.radius, cell),
                        cells_along(c.height, cell));
}
TetMesh mesh_of(const TubeShape& t, double cell) {
  const double middle = pi * (t.inner_radius + t.outer_radius);
  return tube_solid(t.inner_radius, t.outer_radius, t.height,
                    {.through = cells_along(t.outer_radius - t.inner_radius, cell),
                     .around = 2 * cells_along(middle / 2, cell, 4),
                     .layers = cells_along(t.height, cell)});
}
TetMesh mesh_of(const BallShape& b, double cell) {
  // 20 n^3 tetrahedra in 4 pi / 3 r^3.
  return ball_solid(b.radius, cells_along(b.radius * cube_root(0.4 * pi), cell));
}

}  // namespace

Result<TetMesh> shape_mesh(const ShapeSettings& shape, const std::string& place) {
  const auto* tube = std::get_if<TubeShape>(&shape.solid);
  if (tube != nullptr && !(tube->inner_radius < tube->outer_radius)) {
    return Finding{.code = "no_wall",
                   .text = fmt::format("{} has an inner_radius of {:.6g} m and an outer_radius of "
                                       "{:.6g} m",
                                       place, tube->inner_radius, tube->outer_radius),
                   .remedy = "give the tube an outer_radius above its inner_radius"};
  }
  return std::visit(
      [&](const auto& solid) -> Result<TetMesh> {
        const double cell = shape.cell ? *shape.cell : cell_for(solid, shape.tetrahedra);
        const double count = count_of(solid, cell);
        if (!(count <= most_tetrahedra) || longest_of(solid) / cell > most_tetrahedra / 6) {
          return Finding{.code = "too_many_cells",
                         .text = fmt::format("{} would have {:.2g} tetrahedra with cells of {:.3g} "
                                             "m; allowed are {:.0g}",
                                             place, std::max(count, 6 * longest_of(solid) / cell),
                                             cell, most_tetrahedra),
                         .remedy = "give a larger \"cell\" in m, or a number of \"tetrahedra\""};
        }
        return mesh_of(solid, cell);
      },
      shape.solid);
}

}  // namespace sunder
