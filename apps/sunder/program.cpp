// SPDX-License-Identifier: MIT
// Parsing, version, exit codes.
#include "apps/sunder/program.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <sunder/version.hpp>

namespace sunder {
namespace {

int parse_and_run(int argc, char** argv, const AddCommands& add_commands) {
  CLI::App program{"Breaks solid bodies of tetrahedra on an exact 3-map."};
  program.set_version_flag("--version", "sunder " SUNDER_VERSION);
  program.require_subcommand(1);
  program.footer("sunder COMMAND --help tells each command's options, units and exit codes.");
  ExitCode exit_code = ExitCode::fine;
  add_commands(program, exit_code);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 has its own numbers for mistakes; ours is one.
    return program.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  }
  return static_cast<int>(exit_code);
}

}  // namespace

int run_program(int argc, char** argv, const AddCommands& add_commands) {
  try {
    return parse_and_run(argc, argv, add_commands);
  } catch (const std::exception& error) {
    fmt::print(stderr, "sunder: {}\n", error.what());
    return static_cast<int>(ExitCode::failed);
  }
}

}  // namespace sunder
