// SPDX-License-Identifier: MIT
// Momenta and energies, all recomputed from the rows of vertices and tetrahedra.
#pragma once

#include <span>

#include "mechanics/state/mechanics_state.hpp"

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

/// Turns stresses of one material into energies: sigma : eps = (sigma : sigma - share tr^2) / 2 mu
/// with share = lambda / (3 lambda + 2 mu) = nu / (1 + nu).
struct StressEnergy {
  double factor = 0;  ///< 1 / (4 mu), 1/Pa
  double share = 0;
  StressEnergy() = default;
  explicit StressEnergy(const Material& material);
  /// sigma : eps / 2, J/m^3. `sigma` symmetric.
  double density(const Mat3& sigma) const {
    const double trace = sigma(0, 0) + sigma(1, 1) + sigma(2, 2);
    const double normal =
        sigma(0, 0) * sigma(0, 0) + sigma(1, 1) * sigma(1, 1) + sigma(2, 2) * sigma(2, 2);
    const double shear =
        sigma(1, 0) * sigma(1, 0) + sigma(2, 0) * sigma(2, 0) + sigma(2, 1) * sigma(2, 1);
    return factor * (normal + 2 * shear - share * trace * trace);
  }
};

/// The integral of sigma : eps / 2 over a tetrahedron with these stresses at its corners, linear
/// between them, J.
double linear_stress_energy(const std::array<Mat3, 4>& stress, double rest_volume,
                            const StressEnergy& energy);

/// - sum m g . x, J.
double gravity_energy(const VertexColumns& vertices, const Vec3& gravity);

}  // namespace sunder
