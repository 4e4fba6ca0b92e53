// SPDX-License-Identifier: MIT
// The figures of `sunder bench kernel` as table, CSV, JSON and picture.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/bench/bench_figures.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// One line a quantity, one column a body; "-" where a body has no such figure.
std::string bench_table(const KernelBench& bench);

/// body,tetrahedra,quantity,unit,value below two lines of comment (machine; runs and seed).
std::string bench_csv(const KernelBench& bench);

/// {machine, runs, seed, figures: [{body, tetrahedra, quantity, unit, value}]}.
nlohmann::ordered_json bench_json(const KernelBench& bench);

/// Draws times over the number of tetrahedra, both logarithmic, for the cubes: gnuplot, run as a
/// process of its own, draws; the PNG is written whole or not at all.
/// Errors: gnuplot_missing, gnuplot_failed, cannot_write.
std::optional<Finding> plot_bench(const KernelBench& bench, const std::filesystem::path& png);

}  // namespace sunder
