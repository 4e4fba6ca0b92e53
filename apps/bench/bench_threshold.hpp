// SPDX-License-Identifier: MIT
// `sunder bench threshold`: the cost of the test of one unbroken vertex in each of its ways.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder {

struct ThresholdBenchSettings {
  /// Folder of monolith.json, block.json and bunny.json.
  std::filesystem::path scenes;
  /// Times are medians over so many passes, at least 1.
  int runs = 25;
  std::uint64_t seed = 1;  ///< of the random tensors
};

/// One way to test on the tensors of one source, all below their thresholds.
struct ThresholdFigure {
  std::string source;
  std::size_t tensors = 0;
  double let_through = 0;  ///< share of the tensors that Gershgorin's bound lets through
  std::string test;        ///< as in scenes (`fracture.test`)
  double ns = 0;           ///< a tensor
};

struct ThresholdBench {
  std::string machine;
  int runs = 0;
  std::uint64_t seed = 0;
  std::vector<ThresholdFigure> figures;
};

/// Runs the beginnings of the scenes for their node stresses and tests those below their thresholds
/// again and again; then 10^5 random tensors. `progress` is called with each source before its
/// turn. Errors: those of reading and building the scenes.
Result<ThresholdBench> bench_threshold(const ThresholdBenchSettings& settings,
                                       const std::function<void(const std::string&)>& progress);

std::string threshold_table(const ThresholdBench& bench);
/// A line a figure below two lines of comment.
std::string threshold_csv(const ThresholdBench& bench);
/// {machine, runs, seed, figures: [{source, ...}]} as text.
std::string threshold_json(const ThresholdBench& bench);

}  // namespace sunder
