// SPDX-License-Identifier: MIT
// Completion scripts and manual pages.
#include "apps/sunder/shell/shell_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <sunder/version.hpp>
#include <vector>

#include "apps/scene/scene_text.hpp"
#include "apps/sunder/program.hpp"
#include "topology/base/split_text.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

/// An option as shells complete it.
struct ShellOption {
  std::vector<std::string> names;  ///< with dashes
  std::string description;
  bool takes_value = false;
  std::vector<std::string> words;  ///< that it takes; empty: files
};

/// Of a type like `1|2:{1,2}` or `WHAT:{keep,drop}`, as the help has it; none of others.
std::vector<std::string> words_of(std::string_view type) {
  const std::size_t colon = type.find(':');
  std::vector<std::string_view> words = split_text(type.substr(0, colon), '|');
  if (words.size() < 2 && colon != type.npos && type.substr(colon).starts_with(":{")) {
    const std::string_view set = type.substr(colon + 2);
    words = split_text(set.substr(0, set.find('}')), ',');
  }
  if (words.size() < 2) return {};
  return {words.begin(), words.end()};
}

std::vector<ShellOption> options_of(const CLI::App& command) {
  std::vector<ShellOption> options;
  for (const CLI::Option* option : all_options(command)) {
    ShellOption found;
    for (const std::string& name : option->get_snames()) found.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) found.names.push_back("--" + name);
    if (found.names.empty()) continue;  // by its place
    found.description = option->get_description();
    found.takes_value = option->get_expected_max() > 0;
    if (found.takes_value) found.words = words_of(option->get_type_name());
    options.push_back(std::move(found));
  }
  return options;
}

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  const auto commands = program.get_subcommands({});
  return {commands.begin(), commands.end()};
}

/// Text in quotes, without the characters that end a shell's quotes.
std::string quoted(std::string text) {
  std::erase_if(text, [](char c) { return c == '\'' || c == '\\' || c == '[' || c == ']'; });
  std::ranges::replace(text, '\n', ' ');
  std::ranges::replace(text, ':', ';');  // zsh ends a description there
  return "'" + text + "'";
}

std::string bash_script(const CLI::App& program) {
  std::string cases, names;
  for (const CLI::App* command : commands_of(program)) {
    names += command->get_name() + " ";
    std::string options, values;
    for (const ShellOption& option : options_of(*command)) {
      options += fmt::format("{} ", fmt::join(option.names, " "));
      if (!option.words.empty()) {
        values +=
            fmt::format("        {}) COMPREPLY=($(compgen -W '{}' -- \"$word\")); return ;;\n",
                        fmt::join(option.names, "|"), fmt::join(option.words, " "));
      }
    }
    cases += fmt::format(
        "    {})\n      case $before in\n{}        *) ;;\n      esac\n      options='{}' ;;\n",
        command->get_name(), values, options);
  }
  return fmt::format(R"(# bash completion of sunder; read it with: source <(sunder completion bash)
_sunder() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} options=
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{}--help --version' -- "$word"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -o filenames -F _sunder sunder
)",
                     names, cases);
}

std::string zsh_script(const CLI::App& program) {
  std::string names, cases;
  for (const CLI::App* command : commands_of(program)) {
    names +=
        fmt::format("    {}\n", quoted(command->get_name() + "\x01" + command->get_description()));
    std::string options;
    for (const ShellOption& option : options_of(*command)) {
      for (const std::string& name : option.names) {
        const std::string description = quoted(option.description);
        options += fmt::format(
            " \\\n        '{}[{}]{}'", name, description.substr(1, description.size() - 2),
            !option.takes_value    ? ""
            : option.words.empty() ? ":value:_files"
                                   : fmt::format(":value:({})", fmt::join(option.words, " ")));
      }
    }
    cases += fmt::format("      {}) _arguments{} \\\n        '*:file:_files' ;;\n",
                         command->get_name(), options);
  }
  std::ranges::replace(names, '\x01', ':');
  return fmt::format(R"(#compdef sunder
# zsh completion of sunder; put it as _sunder into a folder of $fpath
_sunder() {{
  local -a commands
  commands=(
{})
  if (( CURRENT == 2 )); then
    _describe command commands
  else
    local command=$words[2]
    shift words
    (( CURRENT-- ))
    case $command in
{}    esac
  fi
}}
_sunder "$@"
)",
                     names, cases);
}

std::string fish_script(const CLI::App& program) {
  std::string text =
      "# fish completion of sunder; put it as sunder.fish into ~/.config/fish/completions\n";
  for (const CLI::App* command : commands_of(program)) {
    text += fmt::format("complete -c sunder -n __fish_use_subcommand -f -a {} -d {}\n",
                        command->get_name(), quoted(command->get_description()));
    for (const ShellOption& option : options_of(*command)) {
      text += fmt::format("complete -c sunder -n '__fish_seen_subcommand_from {}'",
                          command->get_name());
      for (const std::string& name : option.names) {
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      if (option.takes_value) text += " -r";
      if (!option.words.empty()) text += fmt::format(" -f -a '{}'", fmt::join(option.words, " "));
      text += " -d " + quoted(option.description) + "\n";
    }
  }
  return text;
}

/// Text as roff prints it: nothing in it is a request.
std::string roff(const std::string& text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    at_start = c == '\n';
  }
  return out;
}

std::string page_options(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : all_options(command)) {
    const bool is_placed = option->get_positional();
    const std::string value = option->get_expected_max() > 0 ? " " + option->get_type_name() : "";
    text += fmt::format(".TP\n.B {}\n{}\n", roff(option->get_name(is_placed, true) + value),
                        roff(option->get_description()));
  }
  return text;
}

}  // namespace

std::string completion_script(const CLI::App& program, const std::string& shell) {
  return shell == "bash"  ? bash_script(program)
         : shell == "zsh" ? zsh_script(program)
                          : fish_script(program);
}

std::string manual_page(const CLI::App& program, const std::string& command) {
  const CLI::App& app = command.empty() ? program : *program.get_subcommand(command);
  const std::string name = command.empty() ? "sunder" : "sunder-" + command;
  const std::string called = command.empty() ? "sunder COMMAND" : "sunder " + command;
  std::string page = fmt::format(
      ".TH {} 1 \"\" \"sunder {}\" \"Sunder\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B "
      "{}\n[OPTIONS]{}\n",
      roff(name), SUNDER_VERSION, roff(name), roff(app.get_description()), called,
      command.empty() ? "" : " ...");
  if (command.empty()) {
    page += ".SH COMMANDS\n";
    for (const CLI::App* one : commands_of(program)) {
      page += fmt::format(".TP\n.B {}\n{}\n", one->get_name(), roff(one->get_description()));
    }
  }
  page += ".SH OPTIONS\n" + page_options(app);
  page += ".SH DESCRIPTION\n.nf\n" + roff(app.get_footer()) + "\n.fi\n";
  return page;
}

void add_shell_commands(CLI::App& program, ExitCode& exit_code) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* completion =
      program.add_subcommand("completion", "Print the completion script of a shell");
  completion->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  completion->footer("\nsource <(sunder completion bash)");
  completion->callback([=, &program, &exit_code] {
    print("{}", completion_script(program, *shell));
    exit_code = ExitCode::fine;
  });
  const auto command = std::make_shared<std::string>();
  CLI::App* man = program.add_subcommand("man", "Print a manual page (roff)");
  man->add_option("COMMAND", *command, "Print the page of this command instead of the program's")
      ->check([&program](const std::string& name) {
        std::vector<std::string> names;
        for (const CLI::App* one : commands_of(program)) names.push_back(one->get_name());
        if (std::ranges::find(names, name) != names.end()) return std::string();
        const std::string nearest = nearest_word(name, names);
        return "there is no command " + name +
               (nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
      });
  man->footer("\nsunder man run | man -l -");
  man->callback([=, &program, &exit_code] {
    print("{}", manual_page(program, *command));
    exit_code = ExitCode::fine;
  });
}

}  // namespace sunder
