// SPDX-License-Identifier: MIT
// `sunder bench methods`: the cost of a step by every integrator and model, side by side.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder {

struct MethodBenchSettings {
  /// Times are medians over this many steps, at least 1, fewer where one takes long.
  int runs = 20;
};

/// One method on one body.
struct MethodFigure {
  std::string method;
  std::string body;
  std::size_t tetrahedra = 0;
  double young_modulus = 0;  ///< Pa
  double time_step = 0;      ///< s
  double ms = 0;             ///< a step
  double ratio = 0;          ///< to floating_frame, same body, modulus and step
  std::uint64_t iterations = 0;
  std::uint64_t force_evaluations = 0;
  bool given_up = false;  ///< iterations were, and the factor took the step
};

struct MethodBench {
  std::string machine;
  int runs = 0;
  std::vector<MethodFigure> figures;
};

/// Measures everything. `progress` is called with each body before its turn. Errors: those of
/// building it.
Result<MethodBench> bench_methods(const MethodBenchSettings& settings,
                                  const std::function<void(const std::string&)>& progress);

std::string methods_table(const MethodBench& bench);
/// A line a figure below two lines of comment.
std::string methods_csv(const MethodBench& bench);
/// {machine, runs, figures: [{method, ...}]} as text.
std::string methods_json(const MethodBench& bench);

}  // namespace sunder
