// SPDX-License-Identifier: MIT
// Natural frequencies and shapes of one component: K phi = (2 pi f)^2 M phi, M lumped.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mechanics/integrators/scratch.hpp"
#include "mechanics/state/step_input.hpp"

namespace sunder {

/// The lowest modes of a component, its held vertices at rest.
struct Modes {
  /// How many of them are rigid motions (6 of a free body, fewer with one or two held vertices or
  /// held ones on a line, 0 of a held body). They come first and have frequency 0.
  std::size_t rigid = 0;
  /// Hz, ascending.
  std::vector<double> frequency;
  /// 3 n x modes, body frame, rows in the order of `Component::vertices`; phi^T M phi = 1 (kg m^2),
  /// the entry of largest size positive.
  Eigen::MatrixXd shape;
};

/// The rigid modes of `component` and its `count` lowest others, fewer where it has fewer degrees
/// of freedom. Lanczos on the inverse (Spectra) uses the component's own factor, with rigid motions
/// projected out, so that a free body needs no shift near an eigenvalue. Then Sylvester's law
/// counts the negative pivots of K - s M just above the last mode. Modes of equal frequencies that
/// Lanczos missed are searched for until the count agrees. Errors: "modes_not_found" when it does
/// not. Leaves another factor in the state; the next step factors again. Cost: two factors and some
/// 3 `count` solves.
Result<Modes> natural_modes(MechanicsState& state, std::span<const Corners> corners,
                            ComponentId component, std::size_t count);

}  // namespace sunder
