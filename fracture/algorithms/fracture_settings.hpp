// SPDX-License-Identifier: MIT
// Settings of fracture.
#pragma once

#include <cstdint>

#include "topology/kernel/components.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {

/// Limit on the number of cracks.
enum class FractureMode {
  /// None: the threshold is never tested.
  off,
  /// Every vertex over its threshold breaks (the paper's shattering).
  all,
  /// At most `max_fans` and `max_new_pieces` per `budget_time`, the most overstressed first. Other
  /// vertices wait.
  budget,
};

/// Rule for the stress of a vertex from the stresses of nearby tetrahedra.
enum class NodeStress {
  /// Mean over the tetrahedra around it, weighted by rest volume.
  volume,
  /// The same by mass (eq. 6 as printed).
  mass,
  /// Linear least-squares fit over two rings of tetrahedra, evaluated at the vertex
  /// (docs/explanation/theory.md); `volume` where the fit is not reliable.
  fit,
};

/// Criterion for a vertex at the tip of a crack in a material with a toughness K_Ic.
enum class FractureCriterion {
  /// Its largest principal stress: C K_Ic / sqrt(h) (`vertex_strength`).
  stress,
  /// The energy that the crack's front would release there per area: K_Ic^2 (1 - nu^2) / E
  /// (docs/explanation/cracks.md).
  energy,
};

/// Model of a crack.
enum class CrackMode {
  /// Unsewn faces. Each fan has a plane of its own (the paper's).
  paper,
  /// A surface with sides that grows along its front (docs/explanation/cracks.md).
  object,
  /// The same. Ties hold split faces until the crack has taken its fracture energy
  /// (docs/explanation/cracks.md).
  cohesive,
};

/// Test of vertices against their thresholds. All tests give the same result.
enum class ThresholdTest {
  /// Eigenvalues of every tensor.
  eigenvalues,
  /// Gershgorin's bound, then eigenvalues of the remaining tensors (the paper's).
  gershgorin,
  /// Leading minors of every tensor.
  exact,
  /// Gershgorin's bound, then leading minors of the remaining tensors.
  chain,
};

struct FractureSettings {
  FractureMode mode = FractureMode::all;
  /// Most fans per `budget_time` in the mode `budget`.
  std::uint32_t max_fans = 64;
  /// Most new pieces per `budget_time`. No fan follows the one that reaches the limit.
  std::uint32_t max_new_pieces = 4294967295u;
  /// Duration of a budget, such as a frame, s; rounded to whole steps. 0: one step.
  double budget_time = 0;
  NodeStress node_stress = NodeStress::volume;
  ThresholdTest test = ThresholdTest::chain;
  /// Criterion at the crack tips of a material with a toughness.
  FractureCriterion criterion = FractureCriterion::stress;
  /// Model of cracks (docs/explanation/cracks.md compares the three).
  CrackMode crack = CrackMode::object;
  /// Number of rings of tetrahedra around each fan with stresses solved again within the step, so
  /// that the load of the crack passes to its tip at once. 0: none (the paper's).
  std::uint32_t relax = 0;
  /// Mass below which no piece may come off, kg: such a fan is refused. 0: no limit.
  double smallest_piece = 0;
  /// Most pieces in the scene: a fan that would exceed it is refused. 0: no limit.
  std::uint32_t max_pieces = 0;
  /// Method of finding new components (section 4.2 of the paper).
  Detection detection = Detection::exact;
  /// Order in which the faces of a fan are unsewn (figure 5 of the paper).
  FaceOrder face_order = FaceOrder::paper;
};

}  // namespace sunder
