// SPDX-License-Identifier: MIT
// A rod that flies and spins in its equilibrium: momenta, energy and stress over a long time.
#pragma once

#include <cstddef>
#include <string>

#include "mechanics/state/settings/settings.hpp"

namespace sunder::accuracy {

/// A rod of 1 x 0.1 x 0.1 m in 10 x 2 x 2 cells, nu = 0, spinning about the principal axis of
/// largest inertia and flying, weightless, with fracture on. It starts in the equilibrium of its
/// spin.
struct FreeFlight {
  double time_step = 1e-3;  ///< s
  double duration = 10;     ///< s
  double spin = 50;         ///< rad/s
  double young_modulus = 30e9;
  bool ladder = true;  ///< whether it may fly as a rigid body
  IntegratorSettings integrator = {};
};

/// Recomputed from the rows of vertices after every step, the worst of all of them.
struct FlightDrift {
  double momentum = 0;          ///< |P - P0| / |P0|
  double angular_momentum = 0;  ///< |L - L0| / |L0|, about the mass centre
  double energy = 0;            ///< |E - E0| / E0
  /// Largest eigenvalue of a node stress over rho w^2 L^2 / 8: the least and the most there was.
  double least_stress = 0, most_stress = 0;
  std::size_t fans = 0;
  std::string failure;  ///< the message of the step that failed; empty: none failed
};

FlightDrift run_free_flight(const FreeFlight& flight);

}  // namespace sunder::accuracy
