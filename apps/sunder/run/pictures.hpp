// SPDX-License-Identifier: MIT
// From the state of a run to what a picture shows: surfaces, obstacles, ground, camera.
#pragma once

#include <span>

#include "apps/render/camera.hpp"
#include "apps/render/frame_scene.hpp"
#include "apps/scene/output_settings.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// The state that a picture is drawn of.
struct PictureSource {
  const SimulationState& state;
  /// Where they are now.
  std::span<const Obstacle> obstacles;
};

/// What the picture shows: skin and crack faces of the shape asked for (the reference where the
/// display states have it; `both`: the deformed mesh as wires over the filled reference),
/// obstacles, ground. O(|V| + |T|). `extent`: what all pictures of a run share, as `run_view` gives
/// it.
render::FrameScene picture_scene(const PictureSource& source, ShownShape show,
                                 const render::Bounds& extent);

/// What stays the same in all pictures of a run.
struct RunView {
  render::Camera camera;
  /// The bodies as they start, what is static, and the ground below.
  render::Bounds extent;
};

/// The camera asked for, or one that sees the whole extent; `up` is against gravity (z without
/// any).
RunView run_view(const PictureSource& start, const PictureSettings& settings, const Vec3& gravity);

}  // namespace sunder
