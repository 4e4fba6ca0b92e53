// SPDX-License-Identifier: MIT
// `sunder chart`: the error of one quantity over the time to compute it, for every way of stepping.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/bench/chart/chart_grid.hpp"
#include "apps/bench/chart/chart_run.hpp"
#include "apps/sunder/exit_code.hpp"
#include "apps/sunder/telling.hpp"

namespace sunder {

/// The arguments of `sunder chart`.
struct ChartArguments : Telling {
  std::filesystem::path scene;
  std::string quantity = "position";
  /// Empty: out/chart_ and the scene file's name without its ending.
  std::filesystem::path folder;
  double within = 0.01;
  double limit = 20;
  /// Numbers, or "start"; empty: a converged run.
  std::string exact;
  std::string probe;
  std::vector<std::string> methods, variants, meshes, settings;
  std::vector<double> steps;
  /// "on" and "off"; empty: both.
  std::vector<std::string> windows;
  /// Refinements of the scene's meshes; -1: one where that leaves at most 20 000 tetrahedra.
  int levels = -1;
  /// Runs of each setting (chart_ensemble.hpp).
  std::size_t members = 1;
  /// `meshes` are these runs: then `members` does not count.
  bool over_meshes = false;
  bool quick = false;
};

/// The reference of all errors.
struct ChartReference {
  Vec3 value = Vec3::Zero();
  /// Differences are divided by this.
  double scale = 1;
  /// Error of the reference itself, as far as it is known: the largest difference to the runs
  /// next to it in step and in mesh, over `scale`; of an ensemble no less than the deviation of its
  /// mean. 0: given as exact.
  double own_error = 0;
  /// In words.
  std::string how;
};

struct ChartPoint {
  ChartSetting setting;
  ChartOutcome outcome;
  /// |value - reference| / scale; of a run that ended otherwise than fine not a number.
  double error = std::numeric_limits<double>::quiet_NaN();
  /// The largest error of this and of all shorter steps of its series: an error that a still
  /// shorter step would lose again was luck. Not finite where one of those failed.
  double lasting_error = std::numeric_limits<double>::quiet_NaN();
  bool on_front = false;
};

/// A whole chart.
struct Chart {
  std::string scene;
  Probe probe;
  /// s.
  double duration = 0;
  ChartReference reference;
  /// Of each mesh; of an ensemble over meshes their mean.
  std::vector<std::size_t> tetrahedra;
  /// Runs of each setting, moved by nothing or each on a mesh of its own.
  std::size_t members = 1;
  bool over_meshes = false;
  std::vector<ChartPoint> points;
  /// Rows of `points`, ascending in cost.
  std::vector<std::size_t> front;
  /// The schema's default setting at the scene's step, and the cheapest run of the paper's own
  /// method; none where not fine.
  std::optional<std::size_t> default_point, paper_point;
  double within = 0;
  /// The cheapest with a lasting error of at most `within`.
  std::optional<std::size_t> cheapest;
};

/// An error as it counts: not below the reference's own.
double counted_error(const ChartReference& reference, double error);

/// Runs everything. `told` is called before every run. Errors: unknown_quantity,
/// unknown_method, bad_setting, no_reference, and those of reading and building the scene.
Result<Chart> make_chart(const ChartArguments& arguments,
                         const std::function<void(const std::string&)>& told);

/// Adds the subcommand `chart` to the program; `exit_code` is set when it has run.
void add_chart_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder
