// SPDX-License-Identifier: MIT
// What the programs share: parsing a command line with its commands, and how mistakes end.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "apps/sunder/exit_code.hpp"
#include "apps/sunder/telling.hpp"

namespace sunder {

/// Adds commands to a program; parsing runs one of them, which sets the exit code.
using AddCommands = std::function<void(CLI::App& program, ExitCode& exit_code)>;

/// Runs the command that the arguments name, and gives what the program ends with: mistakes on the
/// command line are told and end with `usage`, exceptions with `failed`.
int run_program(int argc, char** argv, const AddCommands& add_commands);

/// Adds `--confined` to a command that reads a scene: its files must lie in its own folder.
void add_confined_flag(CLI::App& command, SceneReach& reach);

/// The options of a command, those of its groups among them.
std::vector<const CLI::Option*> all_options(const CLI::App& command);

}  // namespace sunder
