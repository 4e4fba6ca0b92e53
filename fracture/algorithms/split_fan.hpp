// SPDX-License-Identifier: MIT
// Algorithm 4: a crack at one vertex, from its plane to the new connected components.
#pragma once

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/choose_fan.hpp"
#include "fracture/algorithms/fan_event.hpp"
#include "fracture/algorithms/fracture_settings.hpp"

namespace sunder {

/// Working memory of `split_fan`, kept between calls.
struct FanScratch {
  ComponentScratch components;
};

/// Splits the faces of a fan (algorithm 4), but for those that another fan has split since it was
/// decided on: each is unsewn in turn and the oracle asked after each, then the components. Appends
/// the columns of every vertex that split, in `mechanics.vertices` and `cells.strength`; masses and
/// frames are left to `rebuild`, `elements.component` to its caller.
///
///        +   |   -            before: one vertex v        after: v on the side of the half-face
///      ______v______    ->    ______v | v'______          that was passed, a copy on the other
///            |                      + | -
///
/// Needs: a living vertex. Cost: the star, the faces' stars, the smaller sides of what comes off.
FanEvent split_fan(Cells& cells, MechanicsState& mechanics, PlannedFan fan,
                   const FractureSettings& settings, FanScratch& scratch);

}  // namespace sunder
