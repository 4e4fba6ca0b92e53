// SPDX-License-Identifier: MIT
// Checks the output settings of a scene, on their own and against the scene.
#include "apps/scene/check_output.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/scene/scene_fields.hpp"

namespace sunder {
namespace {

/// Frames or rows of an interval: one for the start, and at most one per step.
double count_by_interval(double interval, const Scene& scene) {
  return scene.duration / std::max(interval, scene.integrator.time_step) + 1;
}

void check_history(fields::SettingsCheck& check, const OutputSettings& output, const Scene& scene) {
  if (!output.history.interval) return;
  const double interval = *output.history.interval;
  if (!(interval >= 0)) {
    check.add("out_of_range", "history", fmt::format("is {}; allowed are 0 and more", interval),
              "give a time in s, or 0 for no history");
  } else if (interval > 0 && count_by_interval(interval, scene) > most_frames()) {
    check.add("too_many_rows", "history",
              fmt::format("is {} s: {:.3g} rows in {} s; allowed are {:.6g}", interval,
                          count_by_interval(interval, scene), scene.duration, most_frames()),
              "take a longer interval or a shorter duration");
  }
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
  if (output.frame_interval > 0 &&
      count_by_interval(output.frame_interval, scene) > most_frames()) {
    check.add(
        "too_many_frames", "frame_interval",
        fmt::format("is {} s: {:.3g} frames in {} s; allowed are {:.6g}", output.frame_interval,
                    count_by_interval(output.frame_interval, scene), scene.duration, most_frames()),
        "take a longer interval or a shorter duration");
  }
  check_history(check, output, scene);
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
