// SPDX-License-Identifier: MIT
// The steps of a run after which a frame, a picture or a row of the history is written.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/scene/scene_json.hpp"

namespace sunder {

/// Steps from 0 (the start) to `steps`, ascending: `count` of them, spread evenly with both ends.
/// 1: the end only.
std::vector<std::uint64_t> even_steps(std::uint64_t steps, std::uint64_t count);

/// The steps nearest to each multiple of `interval` (s, above 0), ascending, from 0.
std::vector<std::uint64_t> interval_steps(const Scene& scene, double interval);

/// Steps of frames, of pictures, and of rows of history.csv, ascending. Empty: none is written.
std::vector<std::uint64_t> due_frames(const SceneFile& file);
std::vector<std::uint64_t> due_pictures(const SceneFile& file);
std::vector<std::uint64_t> due_history_rows(const SceneFile& file);

}  // namespace sunder
