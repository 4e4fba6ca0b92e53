// SPDX-License-Identifier: MIT
// The size of a body, the fineness of its mesh and the speed of its waves: the basis of checks and
// choices.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fracture/strength/body_settings.hpp"
#include "mechanics/state/vec3.hpp"

namespace sunder {

/// A face of one tetrahedron only: three rows of points, outward, and the tetrahedron.
struct OuterFace {
  std::array<std::uint32_t, 3> points{};
  std::uint32_t tetrahedron = 0;
};

/// Measures of a body where it starts.
struct BodyMeasures {
  /// m, in the world: every point of the mesh.
  std::vector<Vec3> points;
  /// Round the points that tetrahedra use.
  Eigen::AlignedBox3d box;
  /// m, the mass centre, if the body is of one material.
  Vec3 centre = Vec3::Zero();
  /// m: L, twice the distance of the farthest vertex from the centre.
  double extent = 0;
  /// m^3.
  double volume = 0;
  /// m: h, the cube root of six times the mean volume of its tetrahedra.
  double cell = 0;
  /// m/s: c, of compression waves.
  double wave_speed = 0;
  /// Pa, the least of material, regions and field; infinite where nothing breaks.
  double strength = 0;
  /// Length over thickness, from the second moments of its volume: that of a box.
  double slenderness = 1;
  std::vector<OuterFace> outside;
  /// The tetrahedron across each face, the face being opposite the corner of its number; -1: none.
  std::vector<std::array<std::int32_t, 4>> across;
};

/// Measures a body. O(n log n), n tetrahedra. Needs: a mesh without errors, of one tetrahedron at
/// least, and settings without errors.
BodyMeasures measure(const BodySettings& body);

/// False strain seen by one rigid reference, eps (L/t)^2 / 2, over the strain eps at which the bent
/// body breaks (docs/explanation/theory.md). Infinite where nothing breaks. Needs: `measure(body)`.
double false_strain(const BodySettings& body, const BodyMeasures& measures);

/// With fewer layers linear tetrahedra show less than two thirds of the true bending: `few_layers`.
inline constexpr double too_few_layers = 2.9;
/// From so many on they are less than a tenth too stiff (docs/lab/second_order.md): no need of
/// order 2.
inline constexpr double enough_layers = 5.5;

/// Advice never asks for a mesh of more tetrahedra: runs of them take days.
inline constexpr double most_advised_tetrahedra = 3e5;

/// Cells through the thickness: a third of the tetrahedra that a ray meets which goes in across a
/// face of the surface, the median of 200 rays spread over the surface by its area. A cube of six
/// tetrahedra counts as one cell. Needs: `measure(body)`.
double layers_through(const BodySettings& body, const BodyMeasures& measures);

}  // namespace sunder
