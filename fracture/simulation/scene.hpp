// SPDX-License-Identifier: MIT
// What a user says about a simulation: bodies, obstacles, time, options. Plain settings, no state.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "fracture/strength/body_settings.hpp"
#include "fracture/algorithms/fracture_settings.hpp"
#include "fracture/simulation/ladder_settings.hpp"
#include "mechanics/contact/contact_settings.hpp"
#include "mechanics/contact/impact_settings.hpp"
#include "mechanics/integrators/settings.hpp"
#include "mechanics/element/material.hpp"
#include "mechanics/contact/obstacle.hpp"
#include "topology/mesh/tet_mesh.hpp"

namespace sunder {

/// Vertices held by the outside world: those whose rest position lies in a box of the body.
struct HeldBox {
  /// Corners of the box in the mesh's own coordinates, m; its surface belongs to it.
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
  /// Velocity the vertices are moved with, m/s; zero holds them fixed.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
};

/// What pushes or pulls a body from outside: on its surface inside a box, or on the vertices there.
struct LoadBox {
  /// Corners of the box in the mesh's own coordinates, m; its surface belongs to it.
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
  /// On every boundary face whose three vertices lie in the box, Pa; positive pushes into the body.
  /// Follows the body's rigid motion.
  double pressure = 0;
  /// In all, in equal parts on every vertex in the box, N, world; keeps its direction.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Time over which both are raised linearly, s; 0 applies them at once.
  double ramp_time = 0;
};

/// One breakable body.
struct BodySettings {
  std::string name;
  TetMesh mesh;
  Material material;
  /// Where the mesh's coordinates are placed: x = rotation * X + translation (m).
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  /// Velocity of the mass centre, m/s, and spin about it, rad/s, both in the world.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  std::vector<HeldBox> held;
  std::vector<LoadBox> loads;
  std::vector<CutSettings> cuts;
  StrengthSettings strength;
  std::vector<UnbreakablePart> unbreakable;
};

/// Gravity, raised linearly from zero over `ramp_time`.
struct GravitySettings {
  /// m/s^2.
  Eigen::Vector3d acceleration = {0, 0, -9.81};
  /// Time over which it is raised, s; 0 applies it at once.
  double ramp_time = 0;
};

/// A whole scene, SI units.
struct Scene {
  std::string name;
  std::vector<BodySettings> bodies;
  std::vector<Obstacle> obstacles;
  GravitySettings gravity;
  /// Length of a step and of the run, s.
  double time_step = 1e-3;
  double duration = 1;
  IntegratorSettings integrator;
  ContactSettings contact;
  ImpactSettings impact;
  FractureSettings fracture;
  LadderSettings ladder;
  /// Whether each step's energy ledger is kept (a tenth of a step in which nothing else happens).
  bool energy_ledger = true;
  /// How fast what is drawn follows the simulation after a split, s (section 3.3); 0: at once.
  double display_time_constant = 0.1;
};

/// Gravity at a time, m/s^2: raised linearly over the ramp.
Vec3 gravity_at(const GravitySettings& gravity, double time);

}  // namespace sunder
