// SPDX-License-Identifier: MIT
// The program: its subcommands, and how mistakes on the command line end.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <sunder/version.hpp>

#include "apps/sunder/chart/chart.hpp"
#include "apps/sunder/mesh/check.hpp"
#include "apps/sunder/mesh/convert.hpp"
#include "apps/sunder/exit_code.hpp"
#include "apps/sunder/fragments/fragments.hpp"
#include "apps/sunder/static/modes.hpp"
#include "apps/sunder/run/run.hpp"
#include "apps/sunder/mesh/split.hpp"
#include "apps/sunder/static/static.hpp"
#include "apps/sunder/suite/suite.hpp"
#ifdef SUNDER_BENCH
#include "apps/bench/bench_command.hpp"
#endif

namespace {

int run_program(int argc, char** argv) {
  CLI::App program{"Breaks solid bodies of tetrahedra on an exact 3-map."};
  program.set_version_flag("--version", "sunder " SUNDER_VERSION);
  program.require_subcommand(1);
  program.footer("sunder COMMAND --help tells each command's options, units and exit codes.");
  sunder::ExitCode exit_code = sunder::ExitCode::fine;
  sunder::add_run_command(program, exit_code);
  sunder::add_static_command(program, exit_code);
  sunder::add_modes_command(program, exit_code);
  sunder::add_fragments_command(program, exit_code);
  sunder::add_check_command(program, exit_code);
  sunder::add_convert_command(program, exit_code);
  sunder::add_split_command(program, exit_code);
  sunder::add_suite_command(program, exit_code);
#ifdef SUNDER_BENCH
  sunder::add_bench_command(program, exit_code);
#endif
  sunder::add_chart_command(program, exit_code);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 has its own numbers for mistakes; ours is one.
    return program.exit(error) == 0 ? 0 : static_cast<int>(sunder::ExitCode::usage);
  }
  return static_cast<int>(exit_code);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "sunder: {}\n", error.what());
    return static_cast<int>(sunder::ExitCode::failed);
  }
}
