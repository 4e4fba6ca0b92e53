// SPDX-License-Identifier: MIT
// Output held against the scene it is of.
#include "apps/scene/check_output.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/scene/scene_fields.hpp"

namespace sunder {
namespace {

/// Frames that an interval makes; never more than there are steps, and one for the start.
double frames_by_interval(const OutputSettings& output, const Scene& scene) {
  return scene.duration / std::max(output.frame_interval, scene.integrator.time_step) + 1;
}

}  // namespace

std::vector<SettingFinding> check_output(const OutputSettings& output, const Scene& scene) {
  std::vector<SettingFinding> findings;
  fields::SettingsCheck check("output", findings);
  check.object(output);
  if (output.crack_surface == CrackSurface::smooth && scene.fracture.crack == CrackMode::paper) {
    check.add("no_crack_planes", "crack_surface",
              "is smooth, but with fracture.crack paper cracks have no planes of their own",
              "take mesh, or set fracture.crack to object or cohesive");
  }
  if (output.frame_interval > 0 && frames_by_interval(output, scene) > most_frames()) {
    check.add(
        "too_many_frames", "frame_interval",
        fmt::format("is {} s: {:.3g} frames in {} s; allowed are {:.6g}", output.frame_interval,
                    frames_by_interval(output, scene), scene.duration, most_frames()),
        "take a longer interval or a shorter duration");
  }
  const auto limit = [&](std::uint32_t count, const char* code, const char* key) {
    const bool is_refused = std::ranges::any_of(findings, [&](const SettingFinding& found) {
      return found.place == std::string("output.") + key;
    });
    if (count <= most_frames() || is_refused) return;
    check.add(code, key, fmt::format("is {}; allowed are {:.6g}", count, most_frames()),
              "ask for fewer, or look at SUNDER_LIMITS");
  };
  limit(output.frame_interval > 0 ? 0 : output.frames, "too_many_frames", "frames");
  limit(output.pictures.count, "too_many_pictures", "pictures.count");
  return findings;
}

}  // namespace sunder
