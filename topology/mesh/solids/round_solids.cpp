// SPDX-License-Identifier: MIT
// Triangles in a plane, drawn out along z into prisms of three tetrahedra.
#include <algorithm>
#include <cmath>
#include <vector>

#include "topology/base/elementary.hpp"
#include "topology/mesh/solids/orient.hpp"
#include "topology/mesh/solids/solids.hpp"

namespace sunder {
namespace {

/// Triangles of the cross section.
struct Section {
  std::vector<std::array<double, 2>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

void add_circle(Section& section, double radius, std::uint32_t points) {
  for (std::uint32_t p = 0; p < points; ++p) {
    const double angle = 2 * M_PI * p / points;
    section.points.push_back({radius * cosine(angle), radius * sine(angle)});
  }
}

/// Circle k has 6 k points: triangles are nearly regular everywhere.
Section disc(double radius, std::uint32_t rings) {
  Section section;
  section.points.push_back({0, 0});
  std::uint32_t inner = 0, outer = 1;  // the first points of two circles
  for (std::uint32_t ring = 1; ring <= rings; ++ring) {
    add_circle(section, radius * ring / rings, 6 * ring);
    const std::uint32_t within = std::max(6 * (ring - 1), 1U);
    for (std::uint32_t sector = 0; sector < 6; ++sector) {
      for (std::uint32_t j = 0; j < ring; ++j) {
        const std::uint32_t a = inner + (sector * (ring - 1) + j) % within;
        const std::uint32_t b = outer + (sector * ring + j);
        const std::uint32_t c = outer + (sector * ring + j + 1) % (6 * ring);
        section.triangles.push_back({a, b, c});
        if (j + 1 == ring) continue;
        section.triangles.push_back({a, c, inner + (sector * (ring - 1) + j + 1) % within});
      }
    }
    inner = outer;
    outer += 6 * ring;
  }
  return section;
}

/// Quadrilaterals, each cut the other way than its neighbours.
Section annulus(double inner, double outer, const TubeCells& cells) {
  Section section;
  for (std::uint32_t circle = 0; circle <= cells.through; ++circle) {
    add_circle(section, inner + (outer - inner) * circle / cells.through, cells.around);
  }
  for (std::uint32_t circle = 0; circle < cells.through; ++circle) {
    for (std::uint32_t p = 0; p < cells.around; ++p) {
      const std::uint32_t next = (p + 1) % cells.around;
      const std::uint32_t a = circle * cells.around + p, b = circle * cells.around + next;
      const std::uint32_t d = a + cells.around, c = b + cells.around;
      if ((circle + p) % 2 == 0) {
        section.triangles.push_back({a, b, c});
        section.triangles.push_back({a, c, d});
      } else {
        section.triangles.push_back({a, b, d});
        section.triangles.push_back({b, c, d});
      }
    }
  }
  return section;
}

/// The diagonal of each side begins at its lesser point, below in even layers and above in odd
/// ones: neighbours agree.
TetMesh drawn_out(const Section& section, double height, std::uint32_t layers) {
  TetMesh mesh;
  const auto plane = static_cast<std::uint32_t>(section.points.size());
  for (std::uint32_t layer = 0; layer <= layers; ++layer) {
    const double z = height * (static_cast<double>(layer) / layers - 0.5);
    for (const auto& p : section.points) mesh.points.push_back({p[0], p[1], z});
  }
  for (std::uint32_t layer = 0; layer < layers; ++layer) {
    const std::uint32_t from = (layer + layer % 2) * plane, to = (layer + 1 - layer % 2) * plane;
    for (auto [a, b, c] : section.triangles) {
      if (a > b) std::swap(a, b);
      if (b > c) std::swap(b, c);
      if (a > b) std::swap(a, b);
      add_positive(mesh, {from + a, from + b, from + c, to + c});
      add_positive(mesh, {from + a, from + b, to + b, to + c});
      add_positive(mesh, {from + a, to + a, to + b, to + c});
    }
  }
  return mesh;
}

}  // namespace

TetMesh cylinder_solid(double radius, double height, std::uint32_t rings, std::uint32_t layers) {
  return drawn_out(disc(radius, rings), height, layers);
}

TetMesh tube_solid(double inner, double outer, double height, const TubeCells& cells) {
  return drawn_out(annulus(inner, outer, cells), height, cells.layers);
}

}  // namespace sunder
