// SPDX-License-Identifier: MIT
// A simulation as Python holds it: with its scene's file, its history and the files of its run.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/history.hpp"
#include "apps/python/scene_input.hpp"
#include "apps/sunder/run/recorder.hpp"
#include "apps/sunder/run/saved/run_folder.hpp"
#include "fracture/simulation/simulation.hpp"

namespace sunder::python {

/// Stays where it was made, because the recorder refers to `file`.
struct Stepped {
  explicit Stepped(const SceneInput& input);
  /// Of a saved state, which has no output settings: it cannot be recorded.
  explicit Stepped(Simulation saved);
  Stepped(const Stepped&) = delete;
  Stepped& operator=(const Stepped&) = delete;

  std::optional<SceneFile> file;
  std::vector<Finding> findings;
  Simulation simulation;
  History history;
  std::vector<std::uint64_t> history_steps;  ///< ascending
  std::optional<FolderLock> lock;
  std::optional<Recorder> recorder;
  bool failed = false;
  bool acted = false;  ///< it is no longer that of its scene alone
  mutable std::atomic<bool> in_use = false;
  mutable std::atomic<int> views = 0;  ///< arrays over its columns that are alive
};

/// One step with everything that follows from it. Throws Refused where it fails; the simulation
/// must then not be stepped again.
StepReport step(Stepped& sim);

/// Begins and ends the files of a run, those of `sunder run`. Throws Refused.
void open_run(Stepped& sim, const std::filesystem::path& folder, bool may_replace);
std::vector<Finding> finish_run(Stepped& sim, RunEnd end);

/// history.csv up to now.
std::string history_text(const Stepped& sim);

/// Throws BufferError while arrays over the columns are alive, because a change could move these.
void refuse_where_viewed(const Stepped& sim);

/// Arrays of the present state: copies, and views that hold the simulation still.
void bind_rows(pybind11::class_<Stepped>& type);

}  // namespace sunder::python
