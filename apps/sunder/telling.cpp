// SPDX-License-Identifier: MIT
// Messages on standard error and their colours.
#include "apps/sunder/telling.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {

CLI::Option* add_quiet_flag(CLI::App& command, Telling& telling) {
  return command.add_flag("--quiet", telling.quiet, "Print errors only");
}

void add_verbose_flag(CLI::App& command, Telling& telling) {
  CLI::Option* verbose = command.add_flag(
      "--verbose", telling.verbose, "Report each stage of the work and its time on standard error");
  if (CLI::Option* quiet = command.get_option_no_throw("--quiet")) verbose->excludes(quiet);
}

void add_telling_flags(CLI::App& command, Telling& telling) {
  add_quiet_flag(command, telling);
  add_verbose_flag(command, telling);
}

void tell_beside(const std::vector<Finding>& findings, const Telling& telling) {
  std::vector<Finding> told;
  for (const Finding& f : findings) {
    if (!telling.quiet || f.severity == Severity::error) told.push_back(f);
  }
  // Plain but for the colours, which are ours.
  write_text(stderr, finding_lines(told, shows_colours(STDERR_FILENO)));
}

void tell(const std::vector<Finding>& findings, const Telling& telling) {
  tell_beside(findings, telling);
  if (!telling.json || !has_error(findings)) return;
  print_json(nlohmann::ordered_json{{"findings", findings_json(findings)}});
}

void remark(std::string_view words, const Telling& telling) {
  if (!telling.quiet) print(stderr, "{}", words);
}

Stages::Stages(const Telling& telling) : shown_(telling.verbose), last_(Clock::now()) {}

void Stages::done(std::string_view what) {
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - last_).count();
  print(stderr, "{:9.3f} s  {}\n", seconds, plain_line(what));
  last_ = now;
}

bool is_terminal(int descriptor) {
  const char* const kind = std::getenv("TERM");
  const std::string_view name = kind == nullptr ? "" : kind;
  return !name.empty() && name != "dumb" && isatty(descriptor) == 1;
}

bool shows_colours(int descriptor) {
  const char* const none = std::getenv("NO_COLOR");
  return is_terminal(descriptor) && (none == nullptr || *none == '\0');
}

}  // namespace sunder
