// SPDX-License-Identifier: MIT
// Cracks that are there before anything moves.
#pragma once

#include <span>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/strength/body_settings.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// Unsews the faces of every body's `cuts` in the map of all bodies, before there is any state: as
/// `sunder split --plane` and `--faces` do it. A face that two cuts name is cut once.
/// Errors, with the cut's place: nothing_cut (no interior face of the body in it), not_interior (a
/// listed face that cannot be cut). Needs: settings without errors. O(|T|) a cut.
std::vector<Finding> make_cuts(VolumeMap& map, std::span<const BodySettings> bodies,
                               std::span<const BodyRows> rows);

}  // namespace sunder
