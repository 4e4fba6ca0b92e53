// SPDX-License-Identifier: MIT
// Parsing, version, exit codes.
#include "apps/sunder/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <span>
#include <sstream>
#include <sunder/version.hpp>
#include <system_error>

#include "apps/scene/scene_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/process/run_process.hpp"
#include "topology/base/limits.hpp"
#include "topology/base/split_text.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

/// Long names of a command's options, with their dashes.
std::vector<std::string> long_options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : all_options(command)) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

bool is_short_option(const CLI::App& command, char letter) {
  return std::ranges::any_of(all_options(command), [&](const CLI::Option* option) {
    return option->check_sname(std::string(1, letter));
  });
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (!command->get_name().empty())
      names.push_back(command->get_name());  // else a group of options
  }
  return names;
}

/// The message about a word that names no command or option; `where`: the command before it.
std::string misread(std::string_view kind, const std::string& word, const std::string& where,
                    const std::vector<std::string>& known) {
  const std::string nearest = nearest_word(word, known);
  std::string meant = nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
  if (nearest.empty() && where.empty() && file_exists(word)) {
    meant = fmt::format("; did you mean `sunder {} {}`?", word.ends_with(".json") ? "run" : "check",
                        word);
  }
  return fmt::format("sunder{0}: there is no {1} {2}{3}\n`sunder{0} --help` lists all\n", where,
                     kind, word, meant);
}

/// The message about the first word of a command line that is no command, or no option of its
/// command, with the nearest name; empty where there is no such word.
std::string misread_word(const CLI::App& program, std::span<const std::string> words) {
  const CLI::App* command = &program;
  std::string where;
  for (const std::string& word : words) {
    if (word == "--") return {};  // no options follow
    if (word.starts_with("--")) {
      const std::string name = word.substr(0, word.find('='));
      const std::vector<std::string> options = long_options_of(*command);
      if (std::ranges::find(options, name) == options.end()) {
        return misread("option", name, where, options);
      }
    } else if (word.size() > 2 && word.starts_with("-") && !is_short_option(*command, word[1]) &&
               !nearest_word(word, long_options_of(*command)).empty()) {
      return misread("option", word, where, long_options_of(*command));  // -png
    } else if (!word.starts_with("-")) {
      const std::vector<std::string> commands = command_names(*command);
      if (commands.empty()) continue;
      if (std::ranges::find(commands, word) == commands.end()) {
        return misread("command", word, where, commands);
      }
      command = command->get_subcommand(word);
      where += " " + word;
    }
  }
  return {};
}

/// A list takes one value per use of its option, so that a positional argument may follow. Options
/// with a fixed number of values keep that.
void take_one_value_per_use(CLI::App& command) {
  for (CLI::Option* const option : command.get_options()) {
    if (!option->get_positional()) option->allow_extra_args(false);
  }
  for (CLI::App* const part : command.get_subcommands({})) take_one_value_per_use(*part);
}

int parse_and_run(std::vector<std::string> words, const AddCommands& add_commands) {
  CLI::App program{"Break bodies of tetrahedra; an exact 3-map finds the pieces.", "sunder"};
  program.set_version_flag("--version", "sunder " SUNDER_VERSION);
  program.require_subcommand(1);
  program.footer(
      "`sunder COMMAND --help` lists the options, units and exit codes of a command. Every command "
      "ends with exit code 5 where memory runs out. \"error:\" and \"warning:\" are coloured on "
      "terminals, unless NO_COLOR is set or TERM is dumb. SUNDER_LIMITS=\"unpacked_bytes=1e8 "
      "steps=1e6\" lowers the limits of input (docs/howto/troubleshooting.md).");
  ExitCode exit_code = ExitCode::fine;
  if (const std::string fault = limits_fault(); !fault.empty()) {
    print(stderr, "sunder: SUNDER_LIMITS: {}\n", fault);
    return static_cast<int>(ExitCode::usage);
  }
  add_commands(program, exit_code);
  take_one_value_per_use(program);
  if (words.empty()) {
    print(stderr, "{}\n", program.help());
    return static_cast<int>(ExitCode::usage);
  }
  const auto refuse = [](const std::string& message) {
    print(stderr, "{}", message);
    return static_cast<int>(ExitCode::usage);
  };
  const std::vector<std::string> names = command_names(program);
  if (!words[0].starts_with("-") && std::ranges::find(names, words[0]) == names.end()) {
    return refuse(misread("command", words[0], "", names));  // with --help behind it too
  }
  try {
    program.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    // CLI11 has its own numbers for mistakes; ours is one.
    std::ostringstream out, err;
    program.exit(error, out, err);
    print_text(stdout, out.str());
    if (error.get_exit_code() == 0) return 0;  // help, version
    const std::string message = misread_word(program, words);
    if (!message.empty()) return refuse(message);
    print_text(stderr, err.str());
    return static_cast<int>(ExitCode::usage);
  }
  return static_cast<int>(exit_code);
}

/// Printed text may still wait in memory: a full device shows only now.
int with_all_printed(int exit_code) {
  errno = 0;
  if (!output_was_lost()) return exit_code;
  // A reader may close the pipe when it has enough (| head): that needs no message.
  if (errno == EPIPE) return static_cast<int>(ExitCode::not_written);
  print(stderr, "sunder: the result cannot be written to standard output{}{}\n",
        errno == 0 ? "" : ": ", errno == 0 ? "" : std::generic_category().message(errno));
  return static_cast<int>(ExitCode::not_written);
}

void tell_out_of_memory() {
  write_text(stderr,
             "sunder: memory ran out [out_of_memory]\n"
             "  take a coarser mesh or fewer bodies, or allow more memory (ulimit -v); no file is "
             "half written\n");
}

/// Without memory for escapes nothing of the exception is said but that there was one.
void tell_exception(const std::exception& error) noexcept {
  try {
    print(stderr, "sunder: {}\n", error.what());
  } catch (const std::exception&) {
    tell_out_of_memory();
  }
}

/// A standard stream that is closed stays unusable: the first file that is opened would take its
/// number, and messages would be written into it.
void keep_streams_apart() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // Reading fails from a file that is open for writing, and the other way round.
    const int file = open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    if (file >= 0 && file != stream) close(file);
  }
}

/// A pipe without a reader, and a limit on the size of files (ulimit -f), become errors of the
/// write that meets them. They are reported and clean up; the signals would end the program. A
/// handler, not SIG_IGN: programs started from here have the default action again.
void let_writes_fail() {
  struct sigaction action = {};
  action.sa_handler = [](int) {};
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGPIPE, SIGXFSZ}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_DFL) sigaction(signal, &action, nullptr);
  }
}

// Handlers of the language can reach nothing but a global.
std::atomic<bool> memory_ran_out = false;

/// Where memory runs out in a thread of its own, in a destructor (nlohmann's json allocates there)
/// or before `main`, nothing can be caught: the program ends here, with its message. Runs before
/// other initialisation; priorities up to 100 are the compiler's.
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
      "--confined",
      [&reach] {
        reach = SceneReach::own_folder;
        lower_limits(confined_limits);
      },
      "For scenes that you do not trust: read only files in the scene's folder and below, of at "
      "most 4 GiB, which unfold to at most 256 MiB where they are packed. A mesh key that leads "
      "elsewhere, by .., / or a link, or to standard input, is an error");
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

std::string program_word() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path own = own_program();
  if (own.empty()) return "sunder";
  const char* const path = std::getenv("PATH");
  for (const std::string_view folder : split_text(path == nullptr ? "" : path, ':')) {
    const fs::path found = fs::path(folder) / "sunder";
    if (!fs::exists(found, error)) continue;
    if (fs::equivalent(found, own, error)) return "sunder";
    break;  // the shell takes this one
  }
  const fs::path here = fs::proximate(own, error);
  return shell_word(error || here.string().starts_with("..") ? own.string() : here.string());
}

std::vector<std::string> command_words(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  const bool asks =
      !words.empty() && (words[0] == "help" || words[0] == "-h" || words[0] == "--help");
  if (!asks) return words;
  words[0] = "--help";
  if (words.size() > 1) std::rotate(words.begin(), words.begin() + 1, words.end());
  return words;
}

int run_program(const std::vector<std::string>& words, const AddCommands& add_commands) {
  keep_streams_apart();
  let_writes_fail();
  try {
    return with_all_printed(parse_and_run(words, add_commands));
  } catch (const std::bad_alloc&) {
    tell_out_of_memory();
    return static_cast<int>(ExitCode::failed);
  } catch (const std::system_error& error) {
    tell_exception(error);
    return static_cast<int>(ExitCode::not_written);
  } catch (const std::exception& error) {
    tell_exception(error);
    return static_cast<int>(ExitCode::failed);
  }
}

}  // namespace sunder
