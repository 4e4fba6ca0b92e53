// SPDX-License-Identifier: MIT
// Parsing, version, exit codes.
#include "apps/sunder/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <span>
#include <sunder/version.hpp>
#include <system_error>

#include "apps/scene/scene_text.hpp"
#include "apps/scene/words.hpp"

namespace sunder {
namespace {

/// Long names of a command's options, with their dashes.
std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : all_options(command)) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> commands_of(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// The command line's first word that is no command, or no option of its command, with the one that
/// was meant, if that can be told; empty where there is none.
std::string misread_word(const CLI::App& program, std::span<char* const> words) {
  const auto said = [](std::string_view what, const std::string& word, std::string_view where,
                       const std::vector<std::string>& known) {
    const std::string nearest = nearest_word(word, known);
    return fmt::format("sunder{0}: there is no {1} {2}{3}\n`sunder{0} --help` lists all\n", where,
                       what, word,
                       nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
  };
  const std::vector<std::string> commands = commands_of(program);
  const std::string first = words.empty() ? "" : words[0];
  if (first.empty() || first.starts_with("-")) return {};
  if (std::ranges::find(commands, first) == commands.end()) {
    return said("command", first, "", commands);
  }
  const std::vector<std::string> options = options_of(*program.get_subcommand(first));
  for (const std::string_view word : words.subspan(1)) {
    const std::string name(word.substr(0, word.find('=')));
    if (name == "--") return {};  // what follows are no options
    if (!name.starts_with("--") || std::ranges::find(options, name) != options.end()) continue;
    return said("option", name, " " + first, options);
  }
  return {};
}

int parse_and_run(int argc, char** argv, const AddCommands& add_commands) {
  CLI::App program{"Breaks solid bodies of tetrahedra on an exact 3-map.", "sunder"};
  program.set_version_flag("--version", "sunder " SUNDER_VERSION);
  program.require_subcommand(1);
  program.footer(
      "sunder COMMAND --help tells each command's options, units and exit codes; where memory runs "
      "out every command ends with 5. \"error:\" and \"warning:\" are coloured on terminals, unless "
      "NO_COLOR is set or TERM is dumb.");
  ExitCode exit_code = ExitCode::fine;
  add_commands(program, exit_code);
  if (argc == 1) {
    fmt::print(stderr, "{}\n", program.help());
    return static_cast<int>(ExitCode::usage);
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 has its own numbers for mistakes; ours is one.
    if (error.get_exit_code() == 0) return program.exit(error);  // help, version
    const std::string misread = misread_word(program, std::span(argv, argc).subspan(1));
    misread.empty() ? void(program.exit(error)) : fmt::print(stderr, "{}", misread);
    return static_cast<int>(ExitCode::usage);
  }
  return static_cast<int>(exit_code);
}

/// What was printed may still wait in memory: a full device shows only now.
int with_all_printed(int exit_code) {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::cout.good() && std::ferror(stdout) == 0) return exit_code;
  fmt::print(stderr, "sunder: the result cannot be written to standard output: {}\n",
             std::generic_category().message(errno));
  return static_cast<int>(ExitCode::not_written);
}

void tell_out_of_memory() {
  std::fputs(
      "sunder: memory ran out [out_of_memory]\n"
      "  take a coarser mesh or fewer bodies, or allow more memory (ulimit -v); no file is half "
      "written\n",
      stderr);
}

// Handlers of the language can reach nothing but a global.
std::atomic<bool> memory_ran_out = false;

/// Where memory runs out in a thread of its own, or in a destructor (nlohmann's json allocates
/// there), or before `main`, nothing can be caught: the program ends here, and says so all the same.
/// Runs before what else is initialised then: numbers up to 100 are the compiler's.
[[gnu::constructor(101)]] void tell_ends_without_memory() {
  std::set_new_handler([] {
    memory_ran_out = true;
    throw std::bad_alloc();
  });
  std::set_terminate([] {
    if (!memory_ran_out) std::abort();
    tell_out_of_memory();
    std::_Exit(static_cast<int>(ExitCode::failed));
  });
}

}  // namespace

void add_confined_flag(CLI::App& command, SceneReach& reach) {
  command.add_flag_callback(
      "--confined", [&reach] { reach = SceneReach::own_folder; },
      "Read only files in the scene's folder and below, for scenes that you do not trust: what a "
      "mesh key names elsewhere, by .., / or a link, is an error");
}

std::vector<const CLI::Option*> all_options(const CLI::App& command) {
  const auto own = command.get_options();
  std::vector<const CLI::Option*> all(own.begin(), own.end());
  for (const CLI::App* group : command.get_subcommands({})) {
    if (!group->get_name().empty()) continue;
    const auto more = all_options(*group);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

int run_program(int argc, char** argv, const AddCommands& add_commands) {
  try {
    return with_all_printed(parse_and_run(argc, argv, add_commands));
  } catch (const std::bad_alloc&) {
    tell_out_of_memory();
    return static_cast<int>(ExitCode::failed);
  } catch (const std::system_error& error) {
    fmt::print(stderr, "sunder: {}\n", error.what());
    return static_cast<int>(ExitCode::not_written);
  } catch (const std::exception& error) {
    fmt::print(stderr, "sunder: {}\n", error.what());
    return static_cast<int>(ExitCode::failed);
  }
}

}  // namespace sunder
