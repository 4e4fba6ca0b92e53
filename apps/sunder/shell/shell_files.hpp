// SPDX-License-Identifier: MIT
// Completions for shells and a page for `man`, made of the program's own command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// A script that completes commands, options and their words in bash, zsh or fish. `shell`: one of
/// these names.
std::string completion_script(const CLI::App& program, const std::string& shell);

/// The manual page of a command (roff, section 1), or of the program where `command` is empty.
/// Needs: a command of the program.
std::string manual_page(const CLI::App& program, const std::string& command);

/// Adds the subcommands `completion` and `man`.
void add_shell_commands(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder
