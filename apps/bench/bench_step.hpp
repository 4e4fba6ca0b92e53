// SPDX-License-Identifier: MIT
// `sunder bench step`: the cost of a step without contact and cracks, in parts, and its factor.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

struct StepBenchSettings {
  /// A body of 49 152 tetrahedra too.
  bool large = false;
  /// Bodies in place of our own.
  std::vector<std::filesystem::path> meshes;
  /// Times are medians over this many steps, at least 1; those of factors over a fifth of it.
  int runs = 50;
};

/// One time. Modulus and step are those it was taken with.
struct StepFigure {
  std::string body;
  std::size_t tetrahedra = 0;
  double young_modulus = 0;  ///< Pa
  double time_step = 0;      ///< s
  std::string quantity;      ///< row of `step_quantities()`
  double value = 0;          ///< ms; tetrahedra and doubles are counts
};

struct StepQuantity {
  std::string name;  ///< as in CSV and JSON
  std::string unit;
  std::string text;  ///< as in the table
};

/// In the order of the table.
std::vector<StepQuantity> step_quantities();

struct StepBench {
  std::string machine;
  int runs = 0;
  std::vector<StepFigure> figures;
};

/// Numbers of vertices that are split in the cracks measured.
inline constexpr std::array<std::size_t, 4> crack_sizes = {1, 3, 10, 30};

/// Measures everything. `progress` is called with each body before its turn. Errors: those of
/// reading and building the bodies.
Result<StepBench> bench_step(const StepBenchSettings& settings,
                             const std::function<void(const std::string&)>& progress);

/// Parts of a step and of a factor a body; then whole steps over modulus and step, with the largest
/// over the least.
std::string step_table(const StepBench& bench);
/// body,tetrahedra,young_modulus,time_step,quantity,unit,value below two lines of comment.
std::string step_csv(const StepBench& bench);
/// {machine, runs, figures: [{body, ...}]} as text.
std::string step_json(const StepBench& bench);

}  // namespace sunder
