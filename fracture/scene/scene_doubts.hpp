// SPDX-License-Identifier: MIT
// Doubts about a scene without errors: most likely another unit, place or mesh than was meant.
#pragma once

#include <vector>

#include "fracture/scene/scene.hpp"
#include "mechanics/state/settings/check_settings.hpp"

namespace sunder {

/// Warnings of a scene, each with place and remedy; `build_simulation` gives them too
/// (docs/reference/scene.md has the figures). odd_unit: a size, a material's number or a ball's
/// mass beyond all solids; run_too_short: it ends before a wave has crossed a body, the slowest of
/// all; step_over_duration; overlap_at_start; faster_than_waves: bodies, spins, held boxes,
/// obstacles; few_layers: fewer than three through a body that may break, is not compact and can be
/// bent; slender_body: one that can be bent breaks only after it has turned too far for one frame;
/// and those of `judge_materials`; and the one error, bodies_at_one_place: more than
/// `most_whole_overlaps` others around the middle of a body. Of each code the worst comes first.
/// O(n log n) in the tetrahedra. Needs: a scene and meshes without errors.
std::vector<SettingFinding> scene_doubts(const Scene& scene);

}  // namespace sunder
