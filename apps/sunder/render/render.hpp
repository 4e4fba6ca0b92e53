// SPDX-License-Identifier: MIT
// `sunder render`: pictures of a finished run from any camera.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds `render RESULT PICTURE.png`. `exit_code` is set when the command runs.
void add_render_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder
