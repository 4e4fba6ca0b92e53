// SPDX-License-Identifier: MIT
// The stability matrix: scenarios where methods fail, times methods, with the expected outcomes.
#pragma once

#include <functional>
#include <map>

#include "tests/stability/cell.hpp"

namespace sunder::stability {

/// A scenario for every method: its run, and the expected outcomes by method. Methods that are not
/// named are expected to hold.
struct Scenario {
  std::string name;
  std::function<Cell(const Method&)> run;
  std::map<std::string, Outcome> expected = {};
  /// Where tetrahedra of second order come to another outcome.
  std::map<std::string, Outcome> of_second_order = {};

  Outcome expected_of(const Method& method) const {
    const auto other = of_second_order.find(method.name);
    if (method.order == 2 && other != of_second_order.end()) return other->second;
    const auto at = expected.find(method.name);
    return at == expected.end() ? Outcome::holds : at->second;
  }
};

/// A ball on a block on a plane, the block `ratio` times as heavy as the ball.
struct BallOnBlock {
  double ratio = 1e6;
  double time_step = 1e-3;
  int steps = 1000;  ///< figures are those of the second half
};

/// Figure: how far the impulses are from the weights, relative to each weight.
Cell ball_on_block(const BallOnBlock& pile, const Method& method);

/// Scenarios of bodies in motion, for every method.
std::vector<Scenario> motions();

/// Scenarios of bodies that meet, for every method of `contact_methods`.
std::vector<Scenario> contacts();

/// Scenarios that no integrator takes part in: rotations of degenerate shapes, contact, splits,
/// input. Their one cell is run with the default method.
std::vector<Scenario> others();

}  // namespace sunder::stability
