// SPDX-License-Identifier: MIT
// The program: its own commands and those of a second program, sunder-bench.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/sunder/break/break_command.hpp"
#include "apps/sunder/demo/demo.hpp"
#include "apps/sunder/export/export.hpp"
#include "apps/sunder/fragments/fragments.hpp"
#include "apps/sunder/materials/materials.hpp"
#include "apps/sunder/mesh/check.hpp"
#include "apps/sunder/mesh/convert.hpp"
#include "apps/sunder/mesh/cut.hpp"
#include "apps/sunder/mesh/refine.hpp"
#include "apps/sunder/mesh/split.hpp"
#include "apps/sunder/process/run_process.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/run/run.hpp"
#include "apps/sunder/shell/shell_files.hpp"
#include "apps/sunder/static/modes.hpp"
#include "apps/sunder/static/static.hpp"
#include "topology/io/files/printing.hpp"
#if defined(SUNDER_HAS_RENDERER)
#include "apps/sunder/render/render.hpp"
#endif
#if defined(SUNDER_HAS_VIEW)
#include "apps/sunder/view/view.hpp"
#endif

namespace {

using AddCommand = void (*)(CLI::App& program, sunder::ExitCode& exit_code);

/// A command that this build may lack, and the command that builds it.
struct OptionalCommand {
  const char *name, *purpose, *remedy;
};

constexpr const char* build_bench =
    "./bootstrap all, or: cmake --build --preset release --target sunder-bench";

/// Commands of sunder-bench, a program of its own so that simulations are built without it.
constexpr OptionalCommand bench_commands[] = {
    {"suite", "Judge topology kernels by bodies with known answers", build_bench},
    {"bench", "Measure the program on this machine", build_bench},
    {"chart", "Chart the error of a scene's runs over their computing time", build_bench}};

#if !defined(SUNDER_HAS_RENDERER)
constexpr OptionalCommand render_command = {
    "render", "Draw pictures of a finished run",
    "cmake --preset release -DSUNDER_BUILD_RENDERER=ON && cmake --build --preset release"};
#endif
#if !defined(SUNDER_HAS_VIEW)
constexpr OptionalCommand view_command = {
    "view", "Show a scene in the browser and run it there",
    "cmake --preset release -DSUNDER_BUILD_VIEW=ON && cmake --build --preset release"};
#endif

/// The path of sunder-bench: in the folder of this program.
std::filesystem::path bench_program() {
  return sunder::own_program().parent_path() / "sunder-bench";
}

/// Reports a command that is not built.
int refuse(const OptionalCommand& command) {
  sunder::print(stderr, "sunder: {} is not built here [not_built]\n  Build it: {}\n", command.name,
                command.remedy);
  return static_cast<int>(sunder::ExitCode::usage);
}

/// Lists a command of another program, or of another build: `main` or a message answers for it.
void list(CLI::App& program, const OptionalCommand& command, bool is_built) {
  const std::string purpose = command.purpose;
  program.add_subcommand(command.name, is_built ? purpose : purpose + " (not built)");
}

[[maybe_unused]] void list_unbuilt(CLI::App& program, sunder::ExitCode& exit_code,
                                   const OptionalCommand& command) {
  list(program, command, false);
  program.get_subcommand(command.name)->prefix_command()->callback([&command, &exit_code] {
    exit_code = static_cast<sunder::ExitCode>(refuse(command));
  });
}

void add_view(CLI::App& program, sunder::ExitCode& exit_code) {
#if defined(SUNDER_HAS_VIEW)
  sunder::add_view_command(program, exit_code);
#else
  list_unbuilt(program, exit_code, view_command);
#endif
}

void add_render(CLI::App& program, sunder::ExitCode& exit_code) {
#if defined(SUNDER_HAS_RENDERER)
  sunder::add_render_command(program, exit_code);
#else
  list_unbuilt(program, exit_code, render_command);
#endif
}

void list_bench(CLI::App& program, sunder::ExitCode&) {
  const bool is_built = std::filesystem::exists(bench_program());
  for (const OptionalCommand& command : bench_commands) list(program, command, is_built);
}

/// Commands under one heading of the help.
struct Group {
  const char* name;
  std::vector<AddCommand> commands;
};

void add_commands(CLI::App& program, sunder::ExitCode& exit_code) {
  const Group groups[] = {
      {"Simulate",
       {sunder::add_demo_command, sunder::add_break_command, sunder::add_run_command,
        sunder::add_static_command, sunder::add_modes_command, sunder::add_materials_command}},
      {"Look", {add_view, add_render, sunder::add_export_command, sunder::add_fragments_command}},
      {"Meshes",
       {sunder::add_check_command, sunder::add_convert_command, sunder::add_split_command,
        sunder::add_cut_command, sunder::add_refine_command}},
      {"Kernels and measurements", {list_bench}},
      {"Shell", {sunder::add_shell_commands}}};
  for (const Group& group : groups) {
    const std::size_t before = program.get_subcommands({}).size();
    for (const AddCommand add : group.commands) add(program, exit_code);
    const std::vector<CLI::App*> all = program.get_subcommands({});
    for (std::size_t i = before; i < all.size(); ++i) all[i]->group(group.name);
  }
}

/// Becomes sunder-bench with these words; returns only where it cannot be started.
int become_bench(const OptionalCommand& command, std::vector<std::string> words) {
  std::string bench = bench_program();
  std::vector<char*> arguments = {bench.data()};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(bench.c_str(), arguments.data());
  return refuse(command);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words = sunder::command_words(argc, argv);
  for (const OptionalCommand& command : bench_commands) {
    if (!words.empty() && words[0] == command.name) return become_bench(command, words);
  }
  return sunder::run_program(words, add_commands);
}
