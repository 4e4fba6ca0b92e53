// SPDX-License-Identifier: MIT
// The files of a run and when they are written.
#include "apps/sunder/run/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/output/frame.hpp"
#include "apps/output/tables.hpp"
#include "apps/sunder/run/counters_json.hpp"
#include "apps/sunder/run/pictures.hpp"
#include "apps/sunder/run/settings_report.hpp"
#include "topology/io/output_file.hpp"
#include "topology/io/vtu/vtu.hpp"

namespace sunder {

namespace fs = std::filesystem;

struct Recorder::Parts {
  fs::path folder;
  OutputSettings output;
  std::vector<std::uint64_t> frame_steps, picture_steps;
  RunStatistics statistics;
  std::vector<PvdFrame> frames;
  std::vector<ObstacleMotion> obstacles;  ///< of every frame, and of the end
  std::uint32_t pictures = 0;
  std::optional<std::uint64_t> last_frame, last_picture;
  EventLog events;
  nlohmann::ordered_json counts, settings;
  std::optional<Pictures> drawn;
  nlohmann::ordered_json report;

  explicit Parts(const RecordedRun& run)
      : folder(run.folder), output(run.file.output), events(run.file), counts(run.counts),
        settings(settings_json(run.file)) {}
  std::vector<Finding> write_frame_of(const Simulation& now);
  std::vector<Finding> draw_picture(const Simulation& now);
  std::vector<Finding> write_due(const Simulation& now);
  bool is_time_for_impact(const Simulation& now) const;
};

namespace {

template <class T>
void append(std::vector<T>& all, std::vector<T> more) {
  for (T& one : more) all.push_back(std::move(one));
}

Finding cannot_write(const fs::path& path, const std::error_code& reason) {
  Finding finding;
  finding.code = "cannot_write";
  finding.text = fmt::format("cannot write {}: {}", path.string(), reason.message());
  finding.remedy = "give another folder with -o, or make this one writable";
  finding.file = path.string();
  return finding;
}

bool is_ours(const std::string& name) {
  const auto numbered = [&](std::string_view before, std::string_view after) {
    return name.size() > before.size() + after.size() && name.starts_with(before) &&
           name.ends_with(after) &&
           std::all_of(name.begin() + static_cast<std::ptrdiff_t>(before.size()),
                       name.end() - static_cast<std::ptrdiff_t>(after.size()),
                       [](char c) { return c >= '0' && c <= '9'; });
  };
  return numbered("frame_", ".vtu") || numbered("picture_", ".png") || name == "frames.pvd" ||
         name == "events.jsonl" || name == "cracks.csv" || name == "fragments.csv" ||
         name == "obstacles.csv" || name == "report.json";
}

/// Makes the folders and removes what an earlier run left: frames of two runs must not mix.
std::error_code prepare_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder / "frames", error);
  for (const fs::path& place : {folder, folder / "frames"}) {
    if (error) return error;
    std::vector<fs::path> old;
    for (const fs::directory_entry& entry : fs::directory_iterator(place, error)) {
      if (is_ours(entry.path().filename().string())) old.push_back(entry.path());
    }
    for (const fs::path& path : old) {
      if (!error) fs::remove(path, error);
    }
  }
  return error;
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
    if (step <= static_cast<double>(steps)) due.push_back(static_cast<std::uint64_t>(step));
  }
  std::ranges::sort(due);
  due.erase(std::unique(due.begin(), due.end()), due.end());
  return due;
}

}  // namespace

std::vector<std::uint64_t> even_steps(std::uint64_t steps, std::uint64_t count) {
  std::vector<std::uint64_t> due;
  if (count == 1) due = {steps};
  for (std::uint64_t k = 0; count > 1 && k < count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(count - 1);
    due.push_back(static_cast<std::uint64_t>(std::llround(part * static_cast<double>(steps))));
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
    due.push_back(static_cast<std::uint64_t>(step));
  }
}

Recorder::Recorder(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

Result<Recorder> Recorder::open(const RecordedRun& run, const Simulation& start,
                                std::vector<Finding> warnings) {
  auto parts = std::make_unique<Parts>(run);
  parts->frame_steps = due_frames(run.file);
  parts->picture_steps = due_pictures(run.file);
  parts->statistics = begin_statistics(start, std::move(warnings));
  Result<Recorder> result;
  if (!parts->picture_steps.empty()) {
    Result<Pictures> drawn = Pictures::open(start, parts->output);
    append(result.findings, std::move(drawn.findings));
    if (!drawn) return result;
    parts->drawn = std::move(*drawn);
  }
  if (const std::error_code error = prepare_folder(run.folder)) {
    result.findings.push_back(cannot_write(run.folder, error));
    return result;
  }
  append(result.findings, parts->write_due(start));
  if (!has_error(result.findings)) result.value = Recorder(std::move(parts));
  return result;
}

std::vector<Finding> Recorder::Parts::write_frame_of(const Simulation& now) {
  const std::string name = fmt::format("frames/frame_{:06}.vtu", frames.size());
  std::vector<Finding> findings = write_frame(folder / name, now);
  if (has_error(findings)) return findings;
  frames.push_back({now.state->mechanics.time, name});
  last_frame = now.state->step;
  append(obstacles, free_obstacles(now));
  append(findings, write_pvd(folder / "frames.pvd", frames));
  return findings;
}

std::vector<Finding> Recorder::Parts::draw_picture(const Simulation& now) {
  std::vector<Finding> findings =
      drawn->draw(folder / fmt::format("picture_{:03}.png", pictures++), now);
  if (!has_error(findings)) last_picture = now.state->step;
  return findings;
}

std::vector<Finding> Recorder::Parts::write_due(const Simulation& now) {
  std::vector<Finding> findings;
  if (std::ranges::binary_search(frame_steps, now.state->step)) findings = write_frame_of(now);
  if (std::ranges::binary_search(picture_steps, now.state->step)) {
    append(findings, draw_picture(now));
  }
  return findings;
}

bool Recorder::Parts::is_time_for_impact(const Simulation& now) const {
  constexpr double least = 1.0 / 240;
  return output.frames_at_impacts &&
         (frames.empty() || now.state->mechanics.time - frames.back().time >= least);
}

std::vector<Finding> Recorder::record(const Simulation& now, const StepReport& report,
                                      double step_ms) {
  add_step(parts_->statistics, now, report, step_ms);
  const std::uint64_t fans = parts_->statistics.fans - report.fracture.fans.size();
  const std::uint64_t releases = parts_->statistics.ties.releases - report.releases.size();
  for (const auto& line : events_of(report, fans, releases, now.state->cells.map)) {
    parts_->events.add(line);
  }
  std::vector<Finding> findings = parts_->write_due(now);
  if (report.impact.opened > 0 && parts_->is_time_for_impact(now)) {
    append(findings, parts_->write_frame_of(now));
  }
  return findings;
}

std::vector<Finding> Recorder::finish(const Simulation& now, RunEnd end) {
  Parts& p = *parts_;
  std::vector<Finding> findings;
  if (end != RunEnd::finished) {
    if (!p.frame_steps.empty() && p.last_frame != now.state->step) findings = p.write_frame_of(now);
    if (p.drawn && p.last_picture != now.state->step) append(findings, p.draw_picture(now));
  }
  if (!p.counts.is_null()) read_counters(p.statistics.search, p.counts);
  p.events.add({{"end", to_string(end)},
                {"steps", now.state->step},
                {"fans", p.statistics.fans},
                {"releases", p.statistics.ties.releases},
                {"search", counters_json(p.statistics.search)}});
  const std::vector<Fragment> pieces = fragments(now);
  p.report = run_report(p.statistics, now, pieces, end);
  p.report["settings"] = p.settings;
  const auto write = [&](const char* name, const std::string& text) {
    if (auto finding = write_file(p.folder / name, text)) findings.push_back(std::move(*finding));
  };
  write("events.jsonl", p.events.text());
  write("cracks.csv", cracks_csv(p.statistics.cracks));
  write("fragments.csv", fragments_csv(pieces));
  if (p.last_frame != now.state->step) append(p.obstacles, free_obstacles(now));
  if (!p.obstacles.empty()) write("obstacles.csv", obstacles_csv(p.obstacles));
  write("report.json", p.report.dump(2) + "\n");
  return findings;
}

const RunStatistics& Recorder::statistics() const { return parts_->statistics; }
const EventLog& Recorder::events() const { return parts_->events; }
const nlohmann::ordered_json& Recorder::report() const { return parts_->report; }

}  // namespace sunder
