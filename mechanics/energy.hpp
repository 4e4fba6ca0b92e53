// SPDX-License-Identifier: MIT
// Momenta and energies, all recomputed from the rows of vertices and tetrahedra.
#pragma once

#include <span>

#include "mechanics/mechanics_state.hpp"

namespace sunder {

/// sum m v over all vertices, kg m/s.
Vec3 momentum(const VertexColumns& vertices);

/// sum m x cross v over all vertices, about the world's origin, kg m^2/s.
Vec3 angular_momentum(const VertexColumns& vertices);

/// sum m v^2 / 2, J.
double kinetic_energy(const VertexColumns& vertices);

/// V sigma : eps / 2 of one element from its stress (eq. 5), J.
double element_strain_energy(const MechanicsState& state, TetId element);

/// sum V sigma : eps / 2 from the element stresses (eq. 5), J. Needs: `elements.stress` up to date.
double strain_energy(const MechanicsState& state);

/// - sum m g . x, J.
double gravity_energy(const VertexColumns& vertices, const Vec3& gravity);

}  // namespace sunder
