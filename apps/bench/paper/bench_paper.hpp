// SPDX-License-Identifier: MIT
// `sunder bench paper`: tables 1 to 4 and the claims of section 5, measured on our scenes.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder {

struct PaperBenchSettings {
  /// Folder of monolith.json, block.json and bunny.json.
  std::filesystem::path scenes;
  /// Some seconds: a few steps of each scene.
  bool quick = false;
  /// Times are medians over so many repeats of everything, at least 1.
  int runs = 1;
};

/// One number of one scene in one mode; `mode` is `theirs` for the paper's own numbers.
struct PaperFigure {
  std::string scene, mode, quantity;
  double value = 0;
};

struct PaperBench {
  std::string machine;
  int runs = 0;
  bool quick = false;
  std::vector<PaperFigure> figures;
  /// Notes on runs that ended early.
  std::vector<std::string> notes;
};

std::optional<double> figure_of(const PaperBench& bench, std::string_view scene,
                                std::string_view mode, std::string_view quantity);

/// Runs everything. Counts depend on the scenes alone, times on the machine. `progress` is called
/// with each run before its turn. Errors: those of reading and building the scenes.
Result<PaperBench> bench_paper(const PaperBenchSettings& settings,
                               const std::function<void(const std::string&)>& progress);

}  // namespace sunder
