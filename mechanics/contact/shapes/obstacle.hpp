// SPDX-License-Identifier: MIT
// Obstacles, which do not break: planes, spheres, boxes, solids. No contact is solved here.
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "mechanics/state/vec3.hpp"

#include <Eigen/Geometry>

namespace sunder {

/// The half-space `normal . x <= offset` is solid.
struct Plane {
  /// Unit vector out of the solid.
  Vec3 normal{0, 0, 1};
  /// Distance of the plane from the origin along the normal, m.
  double offset = 0;
};

/// A solid ball.
struct Sphere {
  Vec3 center{0, 0, 0};
  /// m, > 0.
  double radius = 1;
};

/// A solid box with its own axes.
struct Box {
  Vec3 center{0, 0, 0};
  /// Turns the box's own axes into the world's.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /// Half the length of each side along the box's own axes, m, > 0.
  Vec3 half_extent{0.5, 0.5, 0.5};
};

/// A closed surface of triangles, checked, with its measures (solid_surface.hpp).
struct SolidSurface;

/// The solid inside a closed surface of triangles.
struct Solid {
  /// The surface in its own coordinates, m; shared by all copies.
  std::shared_ptr<const SolidSurface> surface;
  /// Placement of these coordinates: x = orientation * X + translation, m.
  Vec3 translation{0, 0, 0};
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

using Shape = std::variant<Plane, Sphere, Box, Solid>;

/// A shape with its motion. Without a mass it is driven and keeps its velocity in every impact.
/// With a mass it is a free rigid body of uniform density, which falls, is pushed back and hits
/// other obstacles. A free obstacle needs a volume.
struct Obstacle {
  Shape shape = Plane{};
  /// Velocity of the mass centre, m/s; zero for a static obstacle.
  Vec3 velocity{0, 0, 0};
  /// Angular velocity, rad/s, world; for free obstacles only.
  Vec3 spin{0, 0, 0};
  /// Coulomb's coefficient, >= 0. Two surfaces in contact take the mean of their coefficients.
  double friction = 0.5;
  /// Mass of a free obstacle, kg, > 0; empty for a driven one.
  std::optional<double> mass = {};
};

}  // namespace sunder
