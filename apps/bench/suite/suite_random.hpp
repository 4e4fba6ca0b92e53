// SPDX-License-Identifier: MIT
// The part of `sunder suite` that tears random bodies apart instead of running fixtures.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/sunder/exit_code.hpp"
#include "apps/sunder/telling.hpp"
#include "topology/suite/kernels/judged_kernel.hpp"

namespace sunder {

struct RandomArguments {
  /// 0: no random run.
  std::size_t fans = 0;
  std::uint64_t seed = 1;
  std::vector<std::filesystem::path> meshes;
  /// Whether progress is shown.
  Telling telling;
};

/// Adds --random, --seed, --mesh and --quiet. `others`: options that mean nothing to a random run.
void add_random_options(CLI::App& command, const std::vector<CLI::Option*>& others,
                        RandomArguments& arguments);

/// Runs the fans on every kernel (made by these), prints a table of each or one JSON.
/// problems: a mismatch; bad_input: a mesh that cannot be read or built.
ExitCode run_random_suite(const RandomArguments& arguments,
                          const std::vector<std::function<suite::JudgedKernel()>>& kernels,
                          bool json);

}  // namespace sunder
