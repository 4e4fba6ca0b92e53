// SPDX-License-Identifier: MIT
// Contacts in explicit steps: impulses on lumped masses and rigid bodies, row by row.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mechanics/contact/waves/wave_bodies.hpp"
#include "mechanics/state/impulse.hpp"

namespace sunder {

/// The change of a velocity in the sweeps of a step.
struct LumpedMotion {
  double sum = 0;           ///< m/s: of all changes
  std::uint32_t stirs = 0;  ///< the number of those that count
};

/// A rigid body in a part of a step: a component or a free obstacle.
struct WaveRigid {
  ComponentId component;                                ///< none() for an obstacle
  std::uint32_t obstacle = 0;                           ///< its row
  double inverse_mass = 0;                              ///< 1/kg; 0: supports lead it
  Mat3 inverse_inertia = Mat3::Zero();                  ///< 1/(kg m^2), world, at the last turn
  Eigen::Quaterniond orientation{1, 0, 0, 0};           ///< likewise (`turn_rigid`)
  Vec3 angular_momentum{0, 0, 0};                       ///< kg m^2/s, as the part begins
  Vec3 centre{0, 0, 0};                                 ///< m
  Vec3 velocity{0, 0, 0};                               ///< m/s
  Vec3 spin{0, 0, 0};                                   ///< rad/s
  Vec3 velocity_before{0, 0, 0}, spin_before{0, 0, 0};  ///< as the step at hand began
  Vec3 turned{0, 0, 0};                                 ///< rad, since the last turn
  Vec3 missed{0, 0, 0};         ///< N m s, since then: of `twist`, that `spin` does not contain yet
  Vec3 twist_at_turn{0, 0, 0};  ///< N m s: `twist` at the last turn
  double since_turn = 0;        ///< s
  Vec3 impulse{0, 0, 0};        ///< N s, got in the part from contacts
  Vec3 twist{0, 0, 0};          ///< N m s, from contacts and loads, about its centre where that was
  Vec3 fall{0, 0, 0};           ///< m/s^2: gravity, where it acts
  Vec3 weight_place{0, 0, 0};   ///< m s: places of the centre, times the lengths of steps
  Vec3 push{0, 0, 0};           ///< N: surface loads
  Vec3 torque{0, 0, 0};         ///< N m, about the centre, as the part begins: of surface loads
  Impulse loads = Impulse::Zero();  ///< N s and N m s about the origin: got from them
  double reach = 0;                 ///< m: the longest arm of its rows
  LumpedMotion motion;              ///< of its places within reach
};

/// A share of a side at a node.
struct LumpedEnd {
  std::uint32_t node = 0;
  double weight = 0;
};

/// One side of a row: nodes of a body, a rigid body, or a driven obstacle.
struct LumpedSide {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t first = 0, count = 0;  ///< of the ends
  std::uint32_t body = none;           ///< of the nodes
  std::uint32_t rigid = none;
  bool is_component = false;
  Vec3 arm{0, 0, 0};       ///< m, of a rigid body: to where the row acts, at its last turn
  Vec3 velocity{0, 0, 0};  ///< m/s, of a driven obstacle
  Vec3 start{0, 0, 0};     ///< m, of a driven obstacle: its place as the part begins
  Vec3 place{0, 0, 0};     ///< m, where the side is as the step begins
};

/// A contact: a gap, pressure and friction between two sides. In each step
///   u_n + gap / h >= 0,  j_n >= 0,  one of them zero,  |j_t| <= mu j_n against the slip,
/// u the velocity of A against B after it.
struct LumpedRow {
  std::array<LumpedSide, 2> sides;
  Vec3 normal{0, 0, 1};
  double gap_start = 0;  ///< m: as the part begins, less its target (`target_gap`)
  double gap = 0;        ///< m: as the step begins
  Vec3 apart{0, 0, 0};   ///< m: A against B as the part begins
  double push = 0;       ///< m/s, >= 0: at which the sides should part, if that takes little
  double push_most = 0;  ///< N s: with that pressed nothing pushes any more
  double friction = 0;
  double normal_response = 0, tangential_response = 0;  ///< 1/kg: of both sides
  double give = 0;                                      ///< m/(N s), of the row itself over a step
  Vec3 impulse{0, 0, 0};  ///< N s, of the step at hand, before: of the last one
  Vec3 total{0, 0, 0};    ///< N s, of the part
  Vec3 moment{0, 0, 0};   ///< N m s, of the part, about the origin, on A
};

/// The rows of a part, with the rigid bodies and the shares of nodes that they act on.
struct LumpedContacts {
  std::vector<LumpedEnd> ends;
  std::vector<LumpedRow> rows;
  std::vector<WaveRigid> rigid;
  std::vector<Vec3> twist;  ///< N m s, row = body of nodes: moments that its nodes did not get
  std::vector<std::uint32_t> pressed;     ///< rows that the last sweep over all found so
  std::vector<LumpedMotion> node_motion;  ///< row = node
  /// Row = row: the stirs of both sides at its last visit, and the sum up to which another visit
  /// would change nothing that counts.
  std::vector<LumpedMotion> seen;
  std::vector<Mat3> turn;  ///< scratch of `turn_rigid`, row = rigid body
  RowWork work;
};

/// Response of a side to an impulse, 1/kg: along a unit vector, and at most across it.
std::array<double, 2> response_of(const LumpedSide& side, const LumpedContacts& contacts,
                                  const WaveNodes& nodes, const Vec3& normal);

/// Where the sides of all rows are `elapsed` s after the part began, and their gaps.
void measure_gaps(LumpedContacts& contacts, const WaveNodes& nodes, double elapsed);

/// Turns rigid bodies that have turned by at least `least` rad since their last turn, and the arms
/// on them. Spins follow from the angular momenta then. The turn keeps the energy of a body without
/// impulses. For others the change counts as work of contact: they turned before the impulses.
void turn_rigid(LumpedContacts& contacts, double least);

/// The step of a kick with its impulses.
struct RowStep {
  double length = 0;   ///< s, of the drift after it
  double share = 1;    ///< of that, in which forces act: a half at the ends of a part
  double growth = 1;   ///< this share over that of the kick before
  bool drifts = true;  ///< false at the end of a part
};

/// Impulses of the last kick as a first guess, on the velocities as they are.
void begin_rows(LumpedContacts& contacts, WaveNodes& nodes, const RowStep& step);

/// One sweep of projected Gauss-Seidel over a step of `step` s. Gives the largest change of a
/// velocity, m/s.
double sweep_rows(LumpedContacts& contacts, WaveNodes& nodes, double step);

/// Where sweeps end.
struct SweepLimits {
  double tolerance = 0;  ///< m/s: a change that counts as none
  int most = 0;          ///< sweeps
};

/// Sweeps over all rows, each followed by sweeps over those that press, until the former would
/// change no velocity by more than the tolerance, or there were too many. A change counts from a
/// quarter of the tolerance on. The latter leave rows alone whose sides no such change has stirred
/// since their last visit. The former leave rows alone that all changes since then cannot have
/// moved so far. Adds the sweeps to `sweeps`. Gives the last change, m/s.
double relax_rows(LumpedContacts& contacts, WaveNodes& nodes, double step,
                  const SweepLimits& limits, int& sweeps);

/// Adds the impulses of a step to the sums of the part. Both sides get an impulse at the place of
/// A. The nodes of B miss a part of its moment, and `twist` gets that part. So momentum and angular
/// momentum are conserved to rounding after any number of sweeps.
void settle_rows(LumpedContacts& contacts, const WaveBodies& waves);

}  // namespace sunder
