// SPDX-License-Identifier: MIT
// Steps of frames, pictures and rows.
#include "apps/sunder/run/due_steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/output/history.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder {

std::vector<std::uint64_t> even_steps(std::uint64_t steps, std::uint64_t count) {
  std::vector<std::uint64_t> due;
  if (count > steps) count = steps + 1;  // there are no more
  if (count == 1) due = {steps};
  for (std::uint64_t k = 0; count > 1 && k < count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(count - 1);
    due.push_back(
        whole_number<std::uint64_t>(std::round(part * static_cast<double>(steps)), steps));
  }
  due.erase(std::unique(due.begin(), due.end()), due.end());
  return due;
}

std::vector<std::uint64_t> interval_steps(const Scene& scene, double interval) {
  const std::uint64_t steps = step_count(scene);
  const double stride = std::max(interval / scene.integrator.time_step, 1.0);
  std::vector<std::uint64_t> due;
  for (std::uint64_t k = 0;; ++k) {
    const double step = std::round(static_cast<double>(k) * stride);
    if (step > static_cast<double>(steps)) return due;
    due.push_back(whole_number<std::uint64_t>(step));
  }
}

std::vector<std::uint64_t> due_frames(const SceneFile& file) {
  return file.output.frame_interval > 0 ? interval_steps(file.scene, file.output.frame_interval)
                                        : even_steps(step_count(file.scene), file.output.frames);
}

std::vector<std::uint64_t> due_pictures(const SceneFile& file) {
  const std::uint64_t steps = step_count(file.scene);
  std::vector<std::uint64_t> due = even_steps(steps, file.output.pictures.count);
  for (const double time : file.output.pictures.times) {
    const double step = std::round(time / file.scene.integrator.time_step);
    if (step <= static_cast<double>(steps)) due.push_back(whole_number<std::uint64_t>(step));
  }
  std::ranges::sort(due);
  due.erase(std::unique(due.begin(), due.end()), due.end());
  return due;
}

std::vector<std::uint64_t> due_history_rows(const SceneFile& file) {
  const std::optional<double>& interval = file.output.history.interval;
  if (interval && *interval == 0) return {};
  if (interval) return interval_steps(file.scene, *interval);
  const std::uint64_t steps = step_count(file.scene), stride = usual_history_stride(steps);
  std::vector<std::uint64_t> due;
  for (std::uint64_t step = 0; step <= steps; step += stride) due.push_back(step);
  return due;
}

}  // namespace sunder
