// SPDX-License-Identifier: MIT
// The energy that a fan would release, per area, found on the body as it is and without changing
// it.
#pragma once

#include <span>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/parted_vertices.hpp"
#include "mechanics/state/loads.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

struct MechanicsScratch;

/// A supported body in equilibrium, with its loads.
struct ReleaseInput {
  const Cells& cells;
  MechanicsState& mechanics;        ///< displacements and stresses in equilibrium
  Vec3 gravity = Vec3::Zero();      ///< m/s^2
  std::span<const Vec3> node_load;  ///< N, world: see `node_loads`; empty: none
};

/// Loads as they are at `time` (s; infinite: fully raised), N, world, by node of each tetrahedron:
/// 4 |T| rows, 10 |T| where any is of second order. Empty without loads.
std::vector<Vec3> node_loads(std::span<const CornerLoad> loads, const MechanicsState& state,
                             double time);

/// The energy that splitting some faces would release.
struct EnergyRelease {
  double area = 0;         ///< m^2, of the faces
  double projected = 0;    ///< m^2, of them on the crack's plane, as in `CrackEnergy`
  std::size_t copies = 0;  ///< rows that would be added
  /// J: fall of the potential energy, strain less work of the loads, from equilibrium to
  /// equilibrium. Infinite where a piece comes free that its loads carry away.
  double energy = 0;
  bool comes_free = false;  ///< a piece comes off, or can turn, without support
  double per_area() const { return projected > 0 ? energy / projected : 0; }
};

/// Potential energy that splitting `faces` (of one component) would release, through the factor of
/// K with the copies as a border (factor_border.hpp). With r the missing force of each copy on its
/// side and S the remaining corner of the bordered matrix,
///   Delta Pi = r . S^-1 r / 2,
/// which is exact in linear statics and equals the virtual crack closure of crack_energy.hpp.
/// Faces on the boundary count for nothing. Held vertices do not part. Errors: "not_supported"
/// where the component has no equilibrium; "not_a_number". Cost: twelve half back-solves for four
/// copies, 0.2 ms at 6 000 tetrahedra, once K is factored. Where a piece comes free, it is three
/// whole ones per copy instead. Leaves that factor in the state, as `solve_static` and quasi-static
/// steps do; a step of another kind factors again.
/// `normal`: of the crack's plane, rest frame, of any length but 0.
Result<EnergyRelease> energy_release(const ReleaseInput& input, std::span<const HalfFaceId> faces,
                                     const Vec3& normal);

}  // namespace sunder
