// SPDX-License-Identifier: MIT
// Settings of a simulation: bodies, obstacles, time, options. Plain settings, no state.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "fracture/algorithms/fracture_settings.hpp"
#include "fracture/scene/ladder_settings.hpp"
#include "fracture/strength/body_settings.hpp"
#include "mechanics/contact/settings/contact_settings.hpp"
#include "mechanics/contact/settings/impact_settings.hpp"
#include "mechanics/contact/shapes/obstacle.hpp"
#include "mechanics/state/settings/settings.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// Gravity, raised linearly from zero over `ramp_time`.
struct GravitySettings {
  /// Acceleration, m/s^2.
  Eigen::Vector3d acceleration = {0, 0, -9.81};
  /// Time over which the acceleration is raised, s; 0 applies it at once.
  double ramp_time = 0;
};

/// The data structure of the bodies' topology. A library built without CGAL takes `dense` and adds
/// a note.
struct TopologySettings {
  MapKernel kernel = MapKernel::lcc;
};

/// A whole scene, SI units.
struct Scene {
  std::string name;
  std::vector<BodySettings> bodies;
  std::vector<Obstacle> obstacles;
  GravitySettings gravity;
  /// Duration of the run, s. The length of a step is `integrator.time_step`.
  double duration = 1;
  IntegratorSettings integrator;
  ContactSettings contact;
  ImpactSettings impact;
  FractureSettings fracture;
  LadderSettings ladder;
  TopologySettings topology;
  /// True: each step has an energy ledger. It costs a tenth of a step without contact.
  bool energy_ledger = true;
  /// Time constant with which the drawn pose follows the simulation after a split, s (section 3.3
  /// of the paper); 0: at once.
  double display_time_constant = 0.1;
};

/// Gravity at a time, m/s^2: raised linearly over the ramp.
Vec3 gravity_at(const GravitySettings& gravity, double time);

/// Number of steps of a scene: its duration over its time step, rounded up (to rounding errors).
std::uint64_t step_count(const Scene& scene);

}  // namespace sunder
