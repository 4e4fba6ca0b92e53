// SPDX-License-Identifier: MIT
// Makes the state of a body at rest, places it, and brings components up to date after splits.
#pragma once

#include <span>

#include "mechanics/state/mechanics_state.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

struct MechanicsScratch;

/// The input of `make_state`. Spans must live during the call only.
struct BodyDescription {
  std::span<const Vec3> rest_positions;  ///< |V|, m
  std::span<const Corners> corners;      ///< |T|
  /// |T|; empty: all of material 0
  std::span<const MaterialId> material = {};
  /// |T|; empty: all of component 0
  std::span<const ComponentId> component = {};
  std::span<const Material> materials;
};

/// Columns at rest: position = rest position, velocity 0, nothing held; stress 0; and the
/// components. Afterwards set `vertices.support` with `motions` and call `rebuild` for held
/// vertices, and `place` for bodies elsewhere. Errors: bad materials (see `check`), flat or
/// inverted tetrahedra, rows out of range, spans of different lengths; all of them are found, not
/// the first only. O(|V| + |T|).
Result<MechanicsState> make_state(const BodyDescription& body);

/// A rigid placement with a rigid velocity.
struct Placement {
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vec3 translation = Vec3::Zero();  ///< m: x = orientation * rest_position + translation
  Vec3 velocity = Vec3::Zero();     ///< m/s, of the component's mass centre
  Vec3 spin = Vec3::Zero();         ///< rad/s, world, about the mass centre
};

/// Puts a component, undeformed, where `placement` says; held vertices keep their motion.
void place(MechanicsState& state, ComponentId component, const Placement& placement);

/// Energies given up by a rebuild.
struct RebuildReport {
  /// J: strain and deformational kinetic energy of pieces that became rigid.
  double energy_released = 0;
  double strain_released = 0;  ///< J, the strain in it
};

/// Brings components up to date after splits or after supports changed. For every component in
/// `touched` (pieces with fresh ids AND the part that kept its id): members from
/// `elements.component`, masses of every vertex from its own star, rest centre, frame, P and L.
/// A free piece gets the frame of shape matching (algorithm 2); x and v of every vertex stay as
/// they are to rounding, so P, L and the kinetic energy are continuous. A supported piece keeps the
/// rotation of its parent. A piece that becomes a free single tetrahedron turns rigid.
/// `corners`: |T|, after the splits. Retires the systems of `touched`; new ones come at the next
/// step. Needs: vertex rows appended by `append_copy`. O(|T|) + the size of `touched`.
RebuildReport rebuild(MechanicsState& state, std::span<const Corners> corners,
                      std::span<const ComponentId> touched, MechanicsScratch& scratch);

/// Makes a rigid body of a free component: it takes its rest shape in the frame that fits it best,
/// keeps P and L, and gives up its deformation; it stays so until it is rebuilt. Needs: not
/// supported. O(size of the component).
RebuildReport turn_rigid(MechanicsState& state, std::span<const Corners> corners,
                         ComponentId component);

/// Takes the frame (c, R), P, L, displacement and its rate of one component from its positions and
/// velocities (algorithm 2): for vertices that were moved from outside. Positions and velocities
/// stay, to rounding. Supported components keep their frame.
void reframe(MechanicsState& state, ComponentId component);

}  // namespace sunder
