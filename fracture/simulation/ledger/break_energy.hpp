// SPDX-License-Identifier: MIT
// Stress that a component must reach, and energy that it must hold, before any part of it can
// break.
#pragma once

#include <cstdint>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fracture_settings.hpp"
#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// Pa, row = ComponentId: strength of each component's weakest vertex; infinite without vertices.
void note_lowest_strengths(std::vector<double>& strength, const MechanicsState& state,
                           const Cells& cells);

/// Kept from call to call.
struct BreakEnergyScratch {
  std::vector<double> modulus, density;  ///< row = ComponentId
  std::vector<std::uint32_t> star;       ///< row = VertexId: tetrahedra
};

/// J, row = ComponentId: least strain energy with which the node stress of a vertex could reach its
/// strength. It is taken over vertices with a star in the component of two or more tetrahedra:
///   V xi^2 / (2 M),   V = 4 m / rho the volume of the star,   M = lambda + 2 mu = rho c_p^2,
/// since a star under a mean stress of largest eigenvalue xi holds that much at least (uniaxial
/// strain). A fitted node stress can exceed the mean: a sixteenth of it then (`NodeStress::fit` may
/// read fourfold at the corner of a cell). The same holds for second order: with xi at a corner and
/// -xi/4 at the others a linear stress has V xi^2 / 16 in place of V xi^2. Infinite for single
/// tetrahedra.
/// Mixed materials: the largest M and rho of a component. O(tetrahedra + vertices).
void note_break_energies(std::vector<double>& energy, const MechanicsState& state,
                         const Cells& cells, NodeStress node_stress, BreakEnergyScratch& scratch);

}  // namespace sunder
