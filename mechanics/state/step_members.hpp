// SPDX-License-Identifier: MIT
// Which components and obstacles a step or a part of one moves.
#pragma once

#include <cstddef>
#include <span>

#include "topology/kernel/ids.hpp"

namespace sunder {

/// What a step moves, by rows of components and obstacles: 0 keeps still and meets nothing.
/// Empty: everything moves.
struct StepMembers {
  std::span<const char> component, ball;
  bool has(ComponentId id) const { return component.empty() || component[id.index()] != 0; }
  bool has_ball(std::size_t row) const { return ball.empty() || ball[row] != 0; }
};

}  // namespace sunder
