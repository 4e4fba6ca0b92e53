// SPDX-License-Identifier: MIT
// The energy that a fan gives up, per area: forces across the crack times how far it opens.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fan_event.hpp"
#include "fracture/energy/settled_crack.hpp"
#include "mechanics/state/step_input.hpp"

namespace sunder {

/// One row of a vertex that a fan parted.
struct CrackSide {
  VertexId vertex;
  Vec3 force = Vec3::Zero();    ///< N, world: of its star on it, when it broke; sums to zero
  Vec3 opening = Vec3::Zero();  ///< m, world: how far its deformation has moved it since
};

/// A fan with an opening that is still followed.
struct OpenCrack {
  std::uint64_t fan = 0;           ///< running number, from 0: `fan` in events.jsonl
  double time = 0;                 ///< s, of the fan
  double area = 0, projected = 0;  ///< m^2, as in `CrackEnergy`
  std::vector<CrackSide> sides;
  double followed = 0;  ///< s
};

/// Half of the forces times the ways: the work to close the crack again [virtual crack closure,
/// Rybicki and Kanninen 1977]. In linear statics that is exactly the energy that the body with its
/// loads gives up. In dynamics it is the energy that left the two sides until then, as motion or
/// loss.
CrackEnergy energy_of(const OpenCrack& crack);

/// Fans right after they were split, before `rebuild`; stresses are those they broke at. A vertex
/// that several fans parted counts with the first. O(|T|).
struct NewCracks {
  std::span<const FanEvent> fans;
  std::uint64_t first_fan = 0;
  double time = 0;
};
void open_cracks(std::vector<OpenCrack>& cracks, const NewCracks& fresh,
                 const MechanicsState& state, const Cells& cells);

/// A part of a step that was just adopted.
struct EnergyPart {
  std::span<const Vec3> displacement_before;
  StepMembers members;
  double length = 0;  ///< s
};

/// Adds the openings of a part. A crack is settled when a wave has crossed the largest of its
/// pieces once (L/c). By then the energy held by its force is gone, and has not come back from the
/// far end. Steps that are longer come to rest within one. Appends settled cracks to `settled` and
/// removes them from `cracks`. Pieces that became rigid tetrahedra do not open: their energy is
/// counted elsewhere.
void follow_cracks(std::vector<CrackEnergy>& settled, std::vector<OpenCrack>& cracks,
                   const MechanicsState& state, const EnergyPart& step);

}  // namespace sunder
