// SPDX-License-Identifier: MIT
// What a user chooses about fracture.
#pragma once

#include <cstdint>

#include "topology/kernel/components.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {

/// How many cracks may be made.
enum class FractureMode {
  /// None: the threshold is never tested.
  off,
  /// Every vertex over its threshold breaks (the paper's shattering).
  all,
  /// At most `max_fans` and `max_new_pieces` a `budget_time`, the most overstressed first; the others
  /// wait.
  budget,
};

/// How the stress of a vertex follows from those of the tetrahedra near it.
enum class NodeStress {
  /// Mean over the tetrahedra around it, weighted by rest volume.
  volume,
  /// The same by mass (eq. 6 as printed).
  mass,
  /// Linear least-squares fit over two rings of tetrahedra, evaluated at the vertex
  /// (docs/explanation/theory.md); `volume` where that is not to be trusted.
  fit,
};

/// What breaks a vertex at the tip of a crack where the material has a toughness K_Ic.
enum class FractureCriterion {
  /// Its largest principal stress: C K_Ic / sqrt(h) (`vertex_strength`).
  stress,
  /// The energy that the crack's front would release there per area: K_Ic^2 (1 - nu^2) / E
  /// (docs/explanation/cracks.md).
  energy,
};

/// What a crack is.
enum class CrackMode {
  /// Faces that were unsewn: the plane of each fan is its vertex' own (the paper's).
  paper,
  /// A surface with sides that grows along its front (docs/explanation/cracks.md).
  object,
  /// The same, and what has come apart is tied until the crack has taken its fracture energy
  /// (docs/explanation/cracks.md).
  cohesive,
};

/// How vertices are tested against their thresholds; the result is the same.
enum class ThresholdTest {
  /// Eigenvalues of every tensor.
  eigenvalues,
  /// Gershgorin's bound, eigenvalues of what it lets through (the paper's).
  gershgorin,
  /// Leading minors of every tensor.
  exact,
  /// Gershgorin's bound, leading minors of what it lets through.
  chain,
};

struct FractureSettings {
  FractureMode mode = FractureMode::all;
  /// Fans that may be made in a `budget_time` in the mode `budget`.
  std::uint32_t max_fans = 64;
  /// Pieces that may come off in that time: no fan follows the one that reaches it.
  std::uint32_t max_new_pieces = 4294967295u;
  /// s, rounded to whole steps: what a budget is for, such as a frame. 0: a step.
  double budget_time = 0;
  NodeStress node_stress = NodeStress::volume;
  ThresholdTest test = ThresholdTest::chain;
  /// What breaks a crack tip of a material with a toughness.
  FractureCriterion criterion = FractureCriterion::stress;
  /// `paper` and `cohesive` on request (docs/explanation/cracks.md compares the three).
  CrackMode crack = CrackMode::object;
  /// Rings of tetrahedra around each fan whose stresses are solved for again within the step, so
  /// that the load of the crack passes to its tip at once; 0: none (the paper's).
  std::uint32_t relax = 0;
  /// kg; a fan that would separate a lighter piece is refused. 0: no limit.
  double smallest_piece = 0;
  /// Largest number in the scene; a fan that would make more is refused. 0: no limit.
  std::uint32_t max_pieces = 0;
  /// How new connected components are found (section 4.2).
  Detection detection = Detection::exact;
  /// In which order the faces of a fan are unsewn (figure 5).
  FaceOrder face_order = FaceOrder::paper;
};

}  // namespace sunder
