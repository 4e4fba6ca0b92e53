// SPDX-License-Identifier: MIT
// Equilibrium of a scene's bodies, measured: what `sunder static` tells.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"

namespace sunder {

/// A largest value and where it is.
struct Extreme {
  double value = 0;
  /// Row of the body's mesh points.
  std::size_t point = 0;
  /// m, world, of the undeformed body where the scene places it.
  Vec3 position = Vec3::Zero();
};

/// What one box of held vertices carries.
struct SupportAnswer {
  std::size_t vertices = 0;
  Vec3 force = Vec3::Zero();   ///< N, world, of the support on the body
  Vec3 moment = Vec3::Zero();  ///< N m, world, about the body's mass centre
};

/// Equilibrium of one body.
struct StaticBody {
  std::string name;
  std::size_t vertices = 0, tetrahedra = 0;
  double mass = 0;           ///< kg
  Extreme displacement;      ///< m, size, against the place in the scene
  double strain_energy = 0;  ///< J
  Extreme principal_stress;  ///< Pa, largest eigenvalue of a node stress (eq. 6)
  Extreme strength_share;    ///< the same over the vertex's tensile strength; from 1 on it breaks
  Vec3 load = Vec3::Zero();  ///< N, world: gravity, pressure and forces, those at supports too
  std::vector<SupportAnswer> supports;  ///< as the scene's `held`
  /// N: largest force that is missing at a free vertex. Rounding.
  double residual = 0;
};

struct StaticAnswer {
  std::vector<StaticBody> bodies;
  std::vector<Mat3> node_stress;  ///< |V|, Pa, rest frame
};

/// Puts the bodies of `sim`, which stands at its start, where a slow run of the scene would leave
/// them at its end: gravity and loads fully raised, held vertices displaced by velocity times
/// duration. Obstacles have no part in it. Notes tell of starting velocities, which have none
/// either, and a warning of parts that turn too far for the linear model. Errors: "not_supported"
/// with the body's name; "not_a_number".
Result<StaticAnswer> solve_scene(Simulation& sim);

/// Node stress with the weights the scene chooses (eq. 6), |V|, Pa, rest frame.
std::vector<Mat3> scene_node_stress(const Simulation& sim);

/// Which body of the scene each vertex belongs to, |V|.
std::vector<std::size_t> body_of_vertices(const Simulation& sim);

}  // namespace sunder
