// SPDX-License-Identifier: MIT
// Requests in the output settings of a scene that no run of it can fulfil.
#pragma once

#include <vector>

#include "apps/scene/output_settings.hpp"
#include "fracture/scene/scene.hpp"
#include "mechanics/state/settings/check_settings.hpp"
#include "topology/base/limits.hpp"

namespace sunder {

/// As many frames, or pictures, as a run may have, whichever key asks.
inline double most_frames() { return static_cast<double>(limits().frames); }

/// Numbers out of range, which files of others may hold, and settings that do not go together.
/// no_crack_planes: `CrackSurface::smooth` with `CrackMode::paper`. too_many_frames,
/// too_many_pictures: more than `Limits::frames`. Places are keys of the whole scene
/// ("output.frames").
std::vector<SettingFinding> check_output(const OutputSettings& output, const Scene& scene);

}  // namespace sunder
