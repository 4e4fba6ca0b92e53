// SPDX-License-Identifier: MIT
// `sunder suite`: the command line, the kernels, and the run over fixtures.
#include "apps/bench/suite/suite.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>

#include "apps/bench/suite/suite_export.hpp"
#include "apps/bench/suite/suite_junit.hpp"
#include "apps/bench/suite/suite_random.hpp"
#include "apps/bench/suite/suite_report.hpp"
#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/telling.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/suite/judge/judge.hpp"

namespace sunder {
namespace {

constexpr const char* suite_footer = R"(
Every fixture is a body, operations on it (face splits, glues, fans, planes, shatters) and the
expected results. Each kernel runs it, and each answer is compared with union-find and with the
fixture. Kernels that come with Sunder:
  sunder   its own, answered by CGAL's darts
  dense    its rows alone
  nested   rows as the coarser of the two nested maps of tied cracks
  cgal     CGAL's map with its managed unsew
  twin     union-find
--kernel takes one of these names, or a shell command of a program with the protocol of
docs/reference/suite.md on stdin and stdout. It takes one kernel and may be repeated. Only the
kernels given are judged.
FILTER is a part of a fixture's name, or a pattern with * ? [ ] for the whole of it.
Without --fixtures the folder is meshes/suite in the current directory, else that of the source tree
the program was built from.

A program may take --timeout seconds for its hello, and 1 + T / 10 000 times as long for an answer
about T tetrahedra. A program without an answer, or with a malformed one, is killed: the fixture is a
mismatch, and the next fixture starts the program again. After three fixtures without an answer it
is not started any more.

The table has the result of each kernel, the number of single comparisons, and the time inside all
kernels in microseconds. A result is `same`, `DIFFERS`, or `known` for a difference that the fixture
explains. Below a mismatch the program prints the first wrong number and the smallest sequence of
steps with one. --junit writes the same as JUnit XML, a testsuite per kernel: failure is a wrong
answer, error a kernel lost, skipped a known difference.

--export judges nothing. It packs an archive that needs nothing of Sunder. The archive holds the
fixtures with every step and answer, a judge in plain Python, a kernel to start from, and a page of
instructions.

With --random no fixture is run. Bodies of a dozen families, and those of --mesh, are torn apart at
random: by fans, faces, planes, breaks by labels and glues. Every answer is compared with union-find
and the laws. The table lists per family the fans with a face, the fans by labels, the faces split
and the vertices that came apart. Next to these are the oracle's alarms, the share of them that
separated a component (true %), the separations that it missed, and the mismatches. The run ends at
its first mismatch, which is shrunk and printed as a fixture file.

Exit codes: 0 no mismatch, 1 mismatches, 2 usage (also a FILTER that no fixture has, or a command
that is no kernel), 3 fixtures or meshes unreadable or invalid, 4 a file not written.

Examples:
  sunder suite
  sunder suite figure
  sunder suite --kernel sunder --json '09-*'
  sunder suite --kernel 'python3 tests/topology/suite/adapters/minimal.py'
  sunder suite --kernel ./my_adapter --timeout 2 --fail-fast --junit suite.xml
  sunder suite --export sunder-suite.tar.gz
  sunder suite --random 10000 --seed 7 --mesh meshes/bunny.msh
)";

struct SuiteArguments {
  std::string filter;
  std::filesystem::path fixtures;
  std::vector<std::string> kernels;
  double timeout = suite::default_answer_seconds;
  bool fail_fast = false;
  std::filesystem::path junit, archive;
  bool json = false;
  RandomArguments random;
};

/// The maker of the kernel that --kernel names. The maker for a command throws `KernelLost` when
/// the command is no kernel.
std::function<suite::JudgedKernel()> maker_of(const std::string& name, double timeout) {
  if (name == "sunder") return suite::volume_map_kernel;
  if (name == "dense") return suite::dense_map_kernel;
  if (name == "nested") return suite::nested_kernel;
  if (name == "cgal") return suite::cgal_kernel;
  if (name == "twin") return suite::twin_kernel;
  return [name, timeout] { return suite::process_kernel(name, timeout); };
}

std::filesystem::path fixture_folder(const SuiteArguments& arguments) {
  if (!arguments.fixtures.empty()) return arguments.fixtures;
  const std::filesystem::path here = "meshes/suite";
  return std::filesystem::is_directory(here) ? here : SUNDER_SOURCE_DIR / here;
}

bool passes(const std::string& filter, const std::string& name) {
  if (filter.find_first_of("*?[") == std::string::npos) {
    return name.find(filter) != std::string::npos;
  }
  return fnmatch(filter.c_str(), name.c_str(), 0) == 0;
}

std::vector<std::string> in_words(const suite::Truth& truth, const suite::Verdict& verdict) {
  std::vector<std::string> words;
  if (!verdict.mismatch) return words;
  for (const suite::Step& step : verdict.mismatch->steps) {
    words.push_back(suite::text_of(truth.intact, step));
  }
  return words;
}

/// A kernel on trial.
struct Defendant {
  suite::JudgedKernel kernel;
  /// Fixtures in a row, up to the last one, in which it gave no answer in its time.
  std::size_t silent = 0;
};

/// After so many it is asked no more: every fixture would take its whole time.
constexpr std::size_t most_silent = 3;

suite::Verdict judge_or_give_up(const suite::Fixture& fixture, const suite::Truth& truth,
                                Defendant& defendant) {
  if (defendant.silent < most_silent) {
    suite::Verdict verdict = suite::judge(fixture, truth, defendant.kernel);
    defendant.silent = verdict.silent ? defendant.silent + 1 : 0;
    return verdict;
  }
  const std::string why =
      fmt::format("not asked: it gave none in {} fixtures one after the other", most_silent);
  return {
      .fixture = fixture.name,
      .kernel = defendant.kernel.name,
      .mismatch = suite::Mismatch{.what = "the kernel", .expected = "an answer", .answered = why},
      .lost = true,
      .silent = true};
}

SuiteRow judge_fixture(const suite::Fixture& fixture, std::vector<Defendant>& defendants) {
  SuiteRow row{.fixture = fixture.name,
               .tetrahedra = fixture.body.tetrahedra.size(),
               .operations = fixture.operations.size()};
  const auto start = std::chrono::steady_clock::now();
  const suite::Truth truth = suite::truth_of(fixture);
  const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
  row.truth_us = time.count();
  row.truth_checks = truth.checks.made;
  for (const suite::TrueOperation& operation : truth.operations) {
    row.steps += operation.steps.size();
  }
  for (Defendant& defendant : defendants) {
    row.verdicts.push_back(judge_or_give_up(fixture, truth, defendant));
    row.steps_in_words.push_back(in_words(truth, row.verdicts.back()));
  }
  return row;
}

/// Judges the fixtures, up to the first with a mismatch where that is enough; prints rows as they
/// come, and writes the JUnit file.
ExitCode judge_all(const std::vector<suite::Fixture>& fixtures, std::vector<Defendant> defendants,
                   const SuiteArguments& arguments) {
  SuiteTable table{.fixtures = fixtures.size(), .started = std::chrono::system_clock::now()};
  for (const Defendant& d : defendants) table.kernels.push_back(d.kernel.name);
  for (const suite::Fixture& f : fixtures) {
    table.name_width = std::max(table.name_width, f.name.size());
  }
  std::vector<SuiteRow> rows;
  bool wrong = false;
  if (!arguments.json) print("{}", suite_heading(table));
  for (const suite::Fixture& fixture : fixtures) {
    rows.push_back(judge_fixture(fixture, defendants));
    const SuiteRow& row = rows.back();
    if (!arguments.json) print("{}{}", suite_line(table, row), suite_details(row));
    std::fflush(stdout);
    wrong = wrong || any_wrong(row);
    if (wrong && arguments.fail_fast) break;
  }
  if (arguments.json) {
    print_json(suite_json(table, rows));
  } else {
    print_text(stdout, suite_totals(table, rows));
  }
  if (!arguments.junit.empty()) {
    if (const auto failure = write_file(arguments.junit, suite_junit(table, rows))) {
      tell({*failure}, {});
      return ExitCode::not_written;
    }
  }
  return wrong ? ExitCode::problems : ExitCode::fine;
}

ExitCode run_random(const SuiteArguments& arguments) {
  std::vector<std::function<suite::JudgedKernel()>> kernels;
  for (const std::string& name : arguments.kernels)
    kernels.push_back(maker_of(name, arguments.timeout));
  if (kernels.empty()) kernels.emplace_back(suite::volume_map_kernel);
  return run_random_suite(arguments.random, kernels, arguments.json);
}

ExitCode run_suite(const SuiteArguments& arguments) {
  if (arguments.random.fans > 0) return run_random(arguments);
  const std::filesystem::path folder = fixture_folder(arguments);
  Result<std::vector<suite::Fixture>> fixtures = suite::read_fixture_folder(folder);
  tell(fixtures.findings, {});
  if (!fixtures) return ExitCode::bad_input;
  std::erase_if(*fixtures, [&arguments](const suite::Fixture& f) {
    return !passes(arguments.filter, f.name);
  });
  if (fixtures->empty()) {
    print(stderr, "sunder suite: no fixture of {} is called like '{}'\n", folder.string(),
          arguments.filter);
    return ExitCode::usage;
  }
  if (!arguments.archive.empty()) return export_suite(*fixtures, arguments.archive);
  std::vector<Defendant> defendants;
  const std::vector<std::string> all = {"sunder", "dense", "nested", "cgal", "twin"};
  try {
    for (const std::string& name : arguments.kernels.empty() ? all : arguments.kernels) {
      defendants.push_back({maker_of(name, arguments.timeout)()});
    }
  } catch (const suite::KernelLost& lost) {
    print(stderr, "sunder suite: {}\n", lost.what());
    return ExitCode::usage;
  }
  return judge_all(*fixtures, std::move(defendants), arguments);
}

std::string check_timeout(const std::string& text) {
  double seconds = 0;
  constexpr double day = 86400;
  const bool number = CLI::detail::lexical_cast(text, seconds);
  return number && seconds > 0 && seconds <= day ? "" : "seconds above 0, a day at most";
}

std::string check_archive_name(const std::string& name) {
  return name.ends_with(".tar.gz") ? "" : "the archive's name has to end in .tar.gz";
}

}  // namespace

void add_suite_command(CLI::App& program, ExitCode& exit_code) {
  const auto arguments = std::make_shared<SuiteArguments>();
  CLI::App* command =
      program.add_subcommand("suite", "Judge topology kernels by bodies with known answers");
  CLI::Option* const filter =
      command->add_option("FILTER", arguments->filter, "Run the fixtures with this in their name");
  CLI::Option* const fixtures =
      command->add_option("--fixtures", arguments->fixtures, "Folder of fixture files")
          ->type_name("DIR");
  CLI::Option* const kernel =
      command
          ->add_option("--kernel", arguments->kernels,
                       "sunder, dense, nested, cgal, twin, or a shell command; may be repeated")
          ->type_name("KERNEL")
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  CLI::Option* const timeout =
      command
          ->add_option("--timeout", arguments->timeout,
                       "Seconds a program may take for an answer about a small body")
          ->type_name("SECONDS")
          ->capture_default_str()
          ->check(CLI::Validator(check_timeout, "", "timeout"));
  CLI::Option* const fail_fast = command->add_flag("--fail-fast", arguments->fail_fast,
                                                   "End after the first fixture with a mismatch");
  CLI::Option* const junit =
      command->add_option("--junit", arguments->junit, "Write the results as JUnit XML, too")
          ->type_name("FILE");
  CLI::Option* const archive =
      command
          ->add_option("--export", arguments->archive,
                       "Judge nothing; write the fixtures with every step and answer, and a judge "
                       "that needs nothing but Python, as one archive")
          ->type_name("FILE.tar.gz")
          ->check(CLI::Validator(check_archive_name, "", "archive"));
  CLI::Option* const json =
      command->add_flag("--json", arguments->json, "Print JSON instead of a table");
  for (CLI::Option* const other : {kernel, timeout, fail_fast, junit, json})
    archive->excludes(other);
  add_random_options(*command, {filter, fixtures, fail_fast, junit, archive}, arguments->random);
  command->footer(suite_footer);
  command->callback([=, &exit_code] { exit_code = run_suite(*arguments); });
}

}  // namespace sunder
