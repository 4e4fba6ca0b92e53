// SPDX-License-Identifier: MIT
// One run of a chart: a scene with changes, stepped to its end, measured and timed.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/bench/chart/chart_measure.hpp"

namespace sunder {

/// How a run ended.
enum class ChartEnd {
  fine,
  nothing_broke,  ///< the quantity is that of a crack, and there was none
  failed,         ///< diverged, or a position is not a number
  over_limit,     ///< took longer than allowed
  skipped,        ///< a longer step of the same series took longer than allowed
  refused,        ///< the scene's reader or builder has errors
};
std::string_view word_of(ChartEnd end);

struct ChartOutcome {
  ChartEnd end = ChartEnd::fine;
  /// Why it is not fine; empty where it is.
  std::string reason;
  Vec3 value = Vec3::Zero();
  /// Of an ensemble, the values of all its runs, with `value` as their mean; else empty.
  std::vector<Vec3> values;
  /// Of the same quantity when the run began.
  Vec3 at_start = Vec3::Zero();
  /// Errors are divided by this where `value` is the reference.
  double scale = 1;
  /// ms of mechanics, fracture and rebuilding over simulated ms: the median of `runs` runs, each
  /// less the share of the time in which other programs had the processor.
  double cost = 0;
  std::size_t runs = 0, tetrahedra = 0, steps = 0, sub_steps = 0, fans = 0;
  /// Steps in which iterations were given up and the factor took over.
  std::size_t given_up = 0;
  /// s of wall, of the first run.
  double wall = 0;
};

/// The inputs that all runs of a chart have in common.
struct ChartRunner {
  std::filesystem::path scene;
  /// Changes that come before a setting's own.
  std::vector<std::string> changes;
  Probe probe;
  /// s of wall a run may take.
  double limit = 20;
  /// How often each body's mesh is refined after it was read, and which file stands for the first
  /// body's; row = mesh.
  std::vector<std::size_t> refinements;
  std::vector<std::string> mesh_files;
  /// Which of an ensemble it is (chart_ensemble.hpp); 0: the scene as it is.
  std::size_t member = 0;
  /// Members are the scene on one of `mesh_files` each (row = member), and not moved.
  bool over_meshes = false;
};

/// The scene with `changes` after the runner's own, on mesh `mesh`, ready to run. Errors: those of
/// `read_scene` and `build_simulation`.
Result<Simulation> chart_simulation(const ChartRunner& runner, std::span<const std::string> changes,
                                    std::size_t mesh);

/// One run to the scene's end. With `timed`, it is repeated (without measuring) until 0.2 s of
/// computing are together, a hundred times at most. The measure's own time does not count.
ChartOutcome run_chart(const ChartRunner& runner, std::span<const std::string> changes,
                       std::size_t mesh, bool timed);

}  // namespace sunder
