// SPDX-License-Identifier: MIT
// Sides of cracks that grow at the same moment.
#pragma once

#include <span>

#include "fracture/breaking/planned_fan.hpp"
#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// Gives the fans of one tie their signs, and those that start a crack its id.
///
/// Starts within 3 h of each other (h: the smaller mean edge of their stars), in one component,
/// with planes within the branch angle of each other that each pass the other's vertex within h /
/// 2, from one to the next, are one crack; their normals are turned to the side of the first. A
/// tetrahedron that its crack has decided on keeps its side. One that several fans of a crack
/// decide on lies on the side of the sum of its distances from their planes: so the order of the
/// fans does not matter. Nothing is labelled: fans may yet be refused. O(stars + starts squared).
void decide_sides(Cells& cells, const MechanicsState& mechanics, std::span<PlannedFan> plans);

/// Labels the star of a fan of a crack that has been made, and notes its faces and its anchor. That
/// holds back others within 3 h, or the way of a compression wave in `PlannedFan::untested`.
void note_crack(Cells& cells, const MechanicsState& mechanics, const PlannedFan& fan,
                FanEvent& event);

}  // namespace sunder
