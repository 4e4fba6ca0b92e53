// SPDX-License-Identifier: MIT
// sunder-bench: the commands `sunder suite`, `sunder bench` and `sunder chart`, which sunder
// starts.
#include "apps/bench/bench_command.hpp"
#include "apps/bench/chart/chart.hpp"
#include "apps/bench/suite/suite.hpp"
#include "apps/sunder/program.hpp"

int main(int argc, char** argv) {
  const auto add_commands = [](CLI::App& program, sunder::ExitCode& exit_code) {
    sunder::add_suite_command(program, exit_code);
    sunder::add_bench_command(program, exit_code);
    sunder::add_chart_command(program, exit_code);
  };
  return sunder::run_program(sunder::command_words(argc, argv), add_commands);
}
