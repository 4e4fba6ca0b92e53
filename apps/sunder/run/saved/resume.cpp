// SPDX-License-Identifier: MIT
// From a checkpoint to a run on its way.
#include "apps/sunder/run/saved/resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "apps/scene/check_output.hpp"
#include "apps/scene/scene_hash.hpp"
#include "apps/sunder/run/saved/run_folder.hpp"
#include "fracture/scene/check_scene.hpp"

namespace sunder {

namespace fs = std::filesystem;

namespace {

/// The first `bytes` of a log, or as many as there are.
std::string log_of(const fs::path& folder, std::uint64_t bytes) {
  std::ifstream in(folder / "events.jsonl", std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (text.size() > bytes) text.resize(bytes);
  return text;
}

/// The refusal of a run with more steps, frames, pictures or lines than any may have.
std::optional<Finding> too_long(const SceneFile& file, const fs::path& folder) {
  const double step = file.scene.integrator.time_step, steps = file.scene.duration / step;
  if (!(steps <= most_steps())) {
    return Finding{.code = "too_many_steps",
                   .text = fmt::format("{:.6g} s are {:.3g} steps of {:.6g} s; allowed are {:.6g}",
                                       file.scene.duration, steps, step, most_steps()),
                   .remedy = "end the run earlier",
                   .file = folder.string()};
  }
  std::vector<SettingFinding> asked = check_output(file.output, file.scene);
  if (asked.empty()) return std::nullopt;
  asked.front().finding.file = folder.string();
  return std::move(asked.front().finding);
}

/// Frames, pictures and lines of the history keep their distances in a longer run. Pictures become
/// moments: too many of them are refused before there is a list of them.
std::optional<Finding> extend(SceneFile& file, double until, const fs::path& folder) {
  OutputSettings& output = file.output;
  const double before = file.scene.duration;
  if (output.frame_interval == 0 && output.frames > 1) {
    output.frame_interval = before / (output.frames - 1);
  }
  if (!output.history.interval) {
    const auto stride = static_cast<double>(usual_history_stride(step_count(file.scene)));
    output.history.interval = stride * file.scene.integrator.time_step;
  }
  file.scene.duration = until;
  PictureSettings& pictures = output.pictures;
  if (pictures.count <= 1) return std::nullopt;
  const double interval = before / (pictures.count - 1);
  if (!(until / interval <= most_frames())) {
    return Finding{.code = "too_many_pictures",
                   .text = fmt::format("a picture every {:.6g} s up to {:.6g} s: {:.3g}; allowed "
                                       "are {:.6g}",
                                       interval, until, until / interval, most_frames()),
                   .remedy = "end the run earlier",
                   .file = folder.string()};
  }
  for (double time = before + interval; time < until * (1 + 1e-9); time += interval) {
    pictures.times.push_back(std::min(time, until));
  }
  for (std::uint32_t k = 0; k < pictures.count; ++k) pictures.times.push_back(k * interval);
  pictures.count = 0;
  return std::nullopt;
}

Result<RunOnItsWay> without_value(std::vector<Finding> findings) {
  Result<RunOnItsWay> result;
  result.findings = std::move(findings);
  return result;
}

Result<RunOnItsWay> go_on(const fs::path& folder, Checkpoint checkpoint, std::string_view log_text,
                          std::optional<std::uint64_t> branched_at, std::vector<Finding> findings) {
  Result<RunOnItsWay> result = without_value(std::move(findings));
  if (std::optional<Finding> refused = too_long(checkpoint.file, folder)) {
    result.findings.push_back(std::move(*refused));
    return result;
  }
  std::optional<EventLog> log = EventLog::of(checkpoint.file, log_text, branched_at);
  if (!log || log_text.size() != checkpoint.record.log_bytes) {
    result.findings.push_back(
        {.code = "other_log",
         .text = "it is not the log of the run that the checkpoint is of: lines are changed or "
                 "missing",
         .remedy = "put the log that the run wrote back, or run the scene from its start",
         .file = (folder / "events.jsonl").string()});
    return result;
  }
  Result<Recorder> recorder =
      Recorder::go_on({folder, checkpoint.file, nullptr, expected_time(checkpoint.file.scene)},
                      std::move(checkpoint.record), std::move(*log));
  for (Finding& f : recorder.findings) result.findings.push_back(std::move(f));
  if (!recorder) return result;
  result.value.emplace(RunOnItsWay{std::move(checkpoint.file), std::move(checkpoint.simulation),
                                   std::move(*recorder)});
  return result;
}

std::error_code copy_files(const fs::path& folder, const RunRecord& record, const fs::path& into) {
  std::error_code error = empty_run_folder(into);
  const auto copy = [&](const std::string& name) {
    if (!error) fs::copy_file(folder / name, into / name, error);
  };
  for (const PvdFrame& frame : record.frames) copy(frame.file);
  for (std::uint64_t k = 0; k < record.pictures; ++k) copy(picture_name(k));
  copy("events.jsonl");
  return error;
}

/// A scene with all that may change in mid-run as another has it.
SceneFile with_changes_of(SceneFile file, const Scene& other) {
  Scene& scene = file.scene;
  const FractureSettings before = scene.fracture;
  scene.gravity = other.gravity;
  scene.contact = other.contact;
  scene.impact = other.impact;
  scene.fracture = other.fracture;
  scene.fracture.crack = before.crack;
  scene.fracture.criterion = before.criterion;
  scene.ladder = other.ladder;
  scene.energy_ledger = other.energy_ledger;
  scene.duration = other.duration;
  return file;
}

}  // namespace

Result<RunOnItsWay> resume_run(const fs::path& folder, double until) {
  Result<Checkpoint> checkpoint = read_checkpoint(folder);
  if (!checkpoint) return without_value(std::move(checkpoint.findings));
  const double now = simulated_time(checkpoint->simulation);
  if (until > 0 && until <= now) {
    return Finding{
        .code = "over_already",
        .text = fmt::format("the run stands at {:.6g} s, not before {:.6g} s", now, until),
        .remedy = "give --until a later time, or --from a step to branch from",
        .file = folder.string()};
  }
  if (until > 0) {
    if (std::optional<Finding> refused = extend(checkpoint->file, until, folder)) return *refused;
    checkpoint->simulation.scene.duration = until;
  }
  const std::string log = log_of(folder, checkpoint->record.log_bytes);
  return go_on(folder, std::move(*checkpoint), log, {}, std::move(checkpoint.findings));
}

Result<RunOnItsWay> copy_run(const fs::path& folder, std::uint64_t step, const fs::path& into) {
  Result<Checkpoint> checkpoint = read_checkpoint(folder, step);
  if (!checkpoint) return without_value(std::move(checkpoint.findings));
  if (const std::error_code error = copy_files(folder, checkpoint->record, into)) {
    return Finding{.code = "cannot_write",
                   .text = fmt::format("{} cannot be copied: {}", folder.string(), error.message()),
                   .remedy = "give another folder with -o; the run's own files must all be there",
                   .file = into.string()};
  }
  const std::string log = log_of(folder, checkpoint->record.log_bytes);
  return go_on(into, std::move(*checkpoint), log, {}, std::move(checkpoint.findings));
}

Result<RunOnItsWay> change_settings(const fs::path& folder, const SceneFile& changed) {
  Result<Checkpoint> checkpoint = read_checkpoint(folder);
  if (!checkpoint) return without_value(std::move(checkpoint.findings));
  const std::string before = scene_hash(checkpoint->file);
  if (scene_hash(with_changes_of(changed, checkpoint->file.scene)) != before) {
    return Finding{
        .code = "not_in_mid_run",
        .text = "the scene differs from the run's in what cannot change once it has begun",
        .remedy =
            "give the run's scene and its --set changes; besides them only gravity, contact, "
            "impact, ladder, duration, energy_ledger, output, topology and fracture (but "
            "crack and criterion) may change"};
  }
  const bool only_longer = [&] {
    SceneFile same = changed;
    same.scene.duration = checkpoint->file.scene.duration;
    return scene_hash(same) == before;
  }();
  checkpoint->file = changed;
  checkpoint->simulation.scene = changed.scene;
  checkpoint->simulation.state->cells.map.set_kernel(changed.scene.topology.kernel);
  const std::string log = log_of(folder, checkpoint->record.log_bytes);
  std::optional<std::uint64_t> branched_at;
  if (!only_longer) branched_at = steps_taken(checkpoint->simulation);
  return go_on(folder, std::move(*checkpoint), log, branched_at, std::move(checkpoint.findings));
}

}  // namespace sunder
