// SPDX-License-Identifier: MIT
// The program: its commands, and those that a second program, sunder-bench, holds.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string_view>

#include "apps/sunder/demo/demo.hpp"
#include "apps/sunder/export/export.hpp"
#include "apps/sunder/fragments/fragments.hpp"
#include "apps/sunder/mesh/check.hpp"
#include "apps/sunder/mesh/convert.hpp"
#include "apps/sunder/mesh/cut.hpp"
#include "apps/sunder/mesh/refine.hpp"
#include "apps/sunder/mesh/split.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/run/run.hpp"
#include "apps/sunder/shell/shell_files.hpp"
#include "apps/sunder/static/modes.hpp"
#include "apps/sunder/static/static.hpp"
#if defined(SUNDER_HAS_RENDERER)
#include "apps/sunder/render/render.hpp"
#endif
#if defined(SUNDER_HAS_VIEW)
#include "apps/sunder/view/view.hpp"
#endif

namespace {

struct BenchCommand {
  std::string_view name, purpose;
};

/// Commands of sunder-bench, a program of its own so that simulations are built without it.
constexpr BenchCommand bench_commands[] = {
    {"suite", "Judge topology kernels by bodies whose answers are known"},
    {"bench", "Measure the program on this machine"},
    {"chart", "Chart the error of a scene's runs over their computing time"}};

/// Where sunder-bench stands when it was built: beside this program.
std::filesystem::path bench_program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "sunder-bench";
}

void add_commands(CLI::App& program, sunder::ExitCode& exit_code) {
  sunder::add_demo_command(program, exit_code);
  sunder::add_run_command(program, exit_code);
  sunder::add_static_command(program, exit_code);
  sunder::add_export_command(program, exit_code);
#if defined(SUNDER_HAS_RENDERER)
  sunder::add_render_command(program, exit_code);
#endif
#if defined(SUNDER_HAS_VIEW)
  sunder::add_view_command(program, exit_code);
#endif
  sunder::add_modes_command(program, exit_code);
  sunder::add_fragments_command(program, exit_code);
  sunder::add_check_command(program, exit_code);
  sunder::add_convert_command(program, exit_code);
  sunder::add_split_command(program, exit_code);
  sunder::add_cut_command(program, exit_code);
  sunder::add_refine_command(program, exit_code);
  sunder::add_shell_commands(program, exit_code);
  if (!std::filesystem::exists(bench_program())) return;
  for (const auto& [name, purpose] : bench_commands) {
    program.add_subcommand(std::string(name), std::string(purpose));
  }
}

/// Becomes sunder-bench; comes back only where it is not there.
int become_bench(char** argv) {
  const std::string bench = bench_program();
  execv(bench.c_str(), argv);
  fmt::print(stderr,
             "sunder: {} is a command of {}, which cannot be started.\n"
             "  Build it beside this program: cmake --build --preset release --target "
             "sunder-bench\n",
             argv[1], bench);
  return static_cast<int>(sunder::ExitCode::usage);
}

}  // namespace

int main(int argc, char** argv) {
  for (const auto& [name, purpose] : bench_commands) {
    if (argc > 1 && name == argv[1]) return become_bench(argv);
  }
  return sunder::run_program(argc, argv, add_commands);
}
