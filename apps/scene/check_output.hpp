// SPDX-License-Identifier: MIT
// What the output settings of a scene ask for that no run of it can give.
#pragma once

#include <vector>

#include "apps/scene/output_settings.hpp"
#include "fracture/scene/scene.hpp"
#include "mechanics/state/check_settings.hpp"

namespace sunder {

/// As many frames as the key `frames` may ask for, whichever key asks.
inline constexpr double most_frames = 1e6;

/// Numbers out of range, which files that others made may hold, and what does not go together.
/// no_crack_planes: `CrackSurface::smooth` with `CrackMode::paper`. too_many_frames: an interval
/// that is too short for the duration. Places are keys of the whole scene ("output.frames").
std::vector<SettingFinding> check_output(const OutputSettings& output, const Scene& scene);

}  // namespace sunder
