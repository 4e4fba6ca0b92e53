// SPDX-License-Identifier: MIT
// `sunder materials`: the materials that have a name.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "apps/sunder/exit_code.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// The error unknown_name of a name that no material has, with the nearest one.
Finding unknown_material(const std::string& name);

/// Adds `materials [NAME] [--json]`. `exit_code` is set when the command runs.
void add_materials_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder
