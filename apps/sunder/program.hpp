// SPDX-License-Identifier: MIT
// Shared by the programs: parsing a command line with its commands, and reporting its mistakes.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "apps/sunder/exit_code.hpp"
#include "apps/sunder/telling.hpp"

namespace sunder {

/// Adds commands to a program. Parsing runs one of them, which sets the exit code.
using AddCommands = std::function<void(CLI::App& program, ExitCode& exit_code)>;

/// The words of a command line without the program's name; `help COMMAND` and `--help COMMAND` as
/// `COMMAND --help`.
std::vector<std::string> command_words(int argc, char** argv);

/// Runs the command that the words name and returns the program's exit code. Mistakes on the
/// command line are reported with the nearest name and end with `usage`, exceptions with `failed`.
int run_program(const std::vector<std::string>& words, const AddCommands& add_commands);

/// The word that starts this program from a shell: `sunder` where PATH leads to it, else its path.
std::string program_word();

/// Adds `--confined` to a command that reads a scene: its files must lie in its own folder.
void add_confined_flag(CLI::App& command, SceneReach& reach);

/// The options of a command, those of its groups among them.
std::vector<const CLI::Option*> all_options(const CLI::App& command);

}  // namespace sunder
