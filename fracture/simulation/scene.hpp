// SPDX-License-Identifier: MIT
// What a user says about a simulation: bodies, obstacles, time, options. Plain settings, no state.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "fracture/strength/body_settings.hpp"
#include "fracture/algorithms/threshold_test.hpp"
#include "mechanics/contact/contact.hpp"
#include "mechanics/integrators/settings.hpp"
#include "mechanics/element/material.hpp"
#include "mechanics/contact/obstacle.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/fan.hpp"
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

/// How many cracks a step may make.
enum class FractureMode {
  /// None: the threshold is never tested.
  off,
  /// Every vertex over its threshold breaks (the paper's shattering).
  all,
  /// At most `max_fans` a step, the most overstressed first; the others wait.
  budget,
};

/// How the stress of a vertex follows from those of the tetrahedra near it.
enum class NodeStress {
  /// Mean over the tetrahedra around it, weighted by rest volume.
  volume,
  /// The same by mass (eq. 6 as printed).
  mass,
  /// Linear least-squares fit over two rings of tetrahedra, evaluated at the vertex
  /// (fracture/algorithms/stress_fit.hpp); `volume` where that is not to be trusted.
  fit,
};

/// What breaks a vertex at the tip of a crack where the material has a toughness K_Ic.
enum class FractureCriterion {
  /// Its largest principal stress: 0.54 K_Ic / sqrt(h) (`vertex_strength`).
  stress,
  /// The energy that the crack's front would release there per area: K_Ic^2 (1 - nu^2) / E
  /// (fracture/energy/tip_energy.hpp).
  energy,
};

struct FractureSettings {
  FractureMode mode = FractureMode::all;
  /// Fans a step may make in the mode `budget`.
  std::uint32_t max_fans = 64;
  NodeStress node_stress = NodeStress::volume;
  ThresholdTest test = ThresholdTest::chain;
  /// What breaks a crack tip of a material with a toughness.
  FractureCriterion criterion = FractureCriterion::stress;
  /// Rings of tetrahedra around each fan whose stresses are solved for again within the step, so
  /// that a crack's tip bears what the crack no longer bears; 0: none (the paper's).
  std::uint32_t relax = 0;
  /// kg; a fan that would part a lighter piece is refused. 0: none is too small.
  double smallest_piece = 0;
  /// Of the whole scene; a fan that would make more is refused. 0: no limit.
  std::uint32_t max_pieces = 0;
  /// How new connected components are found (section 4.2).
  Detection detection = Detection::exact;
  /// In which order the faces of a fan are unsewn (figure 5).
  FaceOrder face_order = FaceOrder::paper;
};

/// How little of a component's motion may be computed (docs/ladder.md).
struct LadderSettings {
  /// Whether components in free flight that cannot break move as rigid bodies.
  bool rigid = true;
  /// Whether supported components under slow loads go from equilibrium to equilibrium.
  bool quasi_static = true;
  /// Whether components that lie still are left alone until something touches them.
  bool sleep = true;
  /// How long they must have lain still, s.
  double sleep_after = 0.1;
};

/// What is wrong with the settings, each an error with value and remedy.
std::vector<Finding> check(const LadderSettings& settings);

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

}  // namespace sunder
