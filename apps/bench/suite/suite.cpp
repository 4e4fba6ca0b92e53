// SPDX-License-Identifier: MIT
// `sunder suite`: the command line, the kernels, the run over fixtures, and the export.
#include "apps/bench/suite/suite.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>

#include "apps/bench/suite/suite_random.hpp"
#include "apps/bench/suite/suite_report.hpp"
#include "apps/scene/words.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/io/output_file.hpp"
#include "topology/suite/fixtures/fixture_json_write.hpp"
#include "topology/suite/judge/judge.hpp"

namespace sunder {
namespace {

constexpr const char* footer = R"(
Every fixture is a body, operations on it (face splits, glues, fans, planes, shatters) and what must
come out. Each kernel runs it; each answer is compared with union-find and with the fixture.
Kernels that come with Sunder: sunder (its own, answered by CGAL's darts), dense (its rows alone),
nested (rows as the coarser of the two nested maps of tied cracks), cgal (CGAL's map with its managed unsew), twin (union-find). --kernel
takes one of these names, or a shell command of a program that speaks the protocol of docs/suite.md
on stdin and stdout; where given, only those are judged.
FILTER is a part of a fixture's name, or a pattern with * ? [ ] for the whole of it.
Without --fixtures the folder is meshes/suite in the current directory, else that of the source tree
the program was built from.

Table: result of each kernel (same; known: a difference that the fixture explains; DIFFERS), number
of single comparisons, and the time inside all kernels, microseconds. Of a mismatch: the first wrong
number and the smallest sequence of steps found that shows one.

With --random no fixture is run: bodies of a dozen families (and those of --mesh) are torn apart at
random, fan by fan, with faces, planes, breaks by labels and glues in between, and every answer is
compared with union-find and the laws. The table lists, for each family, the fans with at least one
face, those by labels beside, the faces split, the vertices that came apart, the oracle's alarms,
how many of them separated a component (true %), separations it missed, and mismatches. The run
ends at its first mismatch; what is left of it after shrinking is printed as a fixture file.

Exit codes: 0 no mismatch, 1 mismatches, 2 usage (also a FILTER that no fixture has, or a command
that is no kernel), 3 fixtures or meshes unreadable or invalid, 4 an exported file not written.

Examples:
  sunder suite
  sunder suite figure
  sunder suite '09-*' --kernel sunder --json
  sunder suite --kernel 'python3 tests/topology/suite/adapters/minimal.py'
  sunder suite --random 10000 --seed 7 --mesh meshes/bunny.msh
)";

struct SuiteArguments {
  std::string filter;
  std::filesystem::path fixtures;
  std::vector<std::string> kernels;
  std::filesystem::path output;
  bool json = false;
  RandomArguments random;
};

/// What makes the kernel that --kernel names; for a command it throws `KernelLost` when that is
/// none.
std::function<suite::JudgedKernel()> maker_of(const std::string& name) {
  if (name == "sunder") return suite::volume_map_kernel;
  if (name == "dense") return suite::dense_map_kernel;
  if (name == "nested") return suite::nested_kernel;
  if (name == "cgal") return suite::cgal_kernel;
  if (name == "twin") return suite::twin_kernel;
  return [name] { return suite::process_kernel(name); };
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

SuiteRow judge_fixture(const suite::Fixture& fixture, std::vector<suite::JudgedKernel>& kernels) {
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
  for (suite::JudgedKernel& kernel : kernels) {
    row.verdicts.push_back(suite::judge(fixture, truth, kernel));
    row.steps_in_words.push_back(in_words(truth, row.verdicts.back()));
  }
  return row;
}

/// Judges the fixtures, printing rows as they come.
ExitCode judge_all(const std::vector<suite::Fixture>& fixtures,
                   std::vector<suite::JudgedKernel> kernels, bool as_json) {
  SuiteTable table;
  for (const suite::JudgedKernel& kernel : kernels) table.kernels.push_back(kernel.name);
  for (const suite::Fixture& f : fixtures) {
    table.name_width = std::max(table.name_width, f.name.size());
  }
  std::vector<SuiteRow> rows;
  bool wrong = false;
  if (!as_json) fmt::print("{}", suite_heading(table));
  for (const suite::Fixture& fixture : fixtures) {
    rows.push_back(judge_fixture(fixture, kernels));
    for (const suite::Verdict& v : rows.back().verdicts) wrong = wrong || is_wrong(v);
    if (!as_json) fmt::print("{}{}", suite_line(table, rows.back()), suite_details(rows.back()));
    std::fflush(stdout);
  }
  if (as_json) {
    fmt::print("{}\n", suite_json(table, rows).dump(2));
  } else {
    fmt::print("{}", suite_totals(table, rows));
  }
  return wrong ? ExitCode::problems : ExitCode::fine;
}

std::string exported_name(const suite::Fixture& fixture) {
  std::string name = fixture.name;
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

/// Writes the fixture FAMILY/CASE as FAMILY.CASE.msh and FAMILY.CASE.json.
std::vector<Finding> export_fixture(const suite::Fixture& fixture,
                                    const std::filesystem::path& folder) {
  const std::string path = (folder / exported_name(fixture)).string();
  const std::string text = suite::fixture_json(fixture, suite::truth_of(fixture));
  std::vector<Finding> findings;
  if (const auto failure = write_file(path + ".json", text)) findings.push_back(*failure);
  for (Finding& f : write_mesh(path + ".msh", fixture.body)) {
    findings.push_back(std::move(f));
  }
  return findings;
}

ExitCode export_all(const std::vector<suite::Fixture>& fixtures,
                    const std::filesystem::path& folder) {
  std::error_code ignored;  // files that cannot be written say so themselves
  std::filesystem::create_directories(folder, ignored);
  for (const suite::Fixture& fixture : fixtures) {
    const std::vector<Finding> findings = export_fixture(fixture, folder);
    fmt::print(stderr, "{}", finding_lines(findings));
    if (has_error(findings)) return ExitCode::not_written;
    fmt::print("{}\n", (folder / exported_name(fixture)).string());
  }
  return ExitCode::fine;
}

ExitCode run_random(const SuiteArguments& arguments) {
  std::vector<std::function<suite::JudgedKernel()>> kernels;
  for (const std::string& name : arguments.kernels) kernels.push_back(maker_of(name));
  if (kernels.empty()) kernels.emplace_back(suite::volume_map_kernel);
  return run_random_suite(arguments.random, kernels, arguments.json);
}

ExitCode run_suite(const SuiteArguments& arguments) {
  if (arguments.random.fans > 0) return run_random(arguments);
  const std::filesystem::path folder = fixture_folder(arguments);
  Result<std::vector<suite::Fixture>> fixtures = suite::read_fixture_folder(folder);
  fmt::print(stderr, "{}", finding_lines(fixtures.findings));
  if (!fixtures) return ExitCode::bad_input;
  std::erase_if(*fixtures, [&arguments](const suite::Fixture& f) {
    return !passes(arguments.filter, f.name);
  });
  if (fixtures->empty()) {
    fmt::print(stderr, "sunder suite: no fixture of {} is called like '{}'\n", folder.string(),
               arguments.filter);
    return ExitCode::usage;
  }
  if (!arguments.output.empty()) return export_all(*fixtures, arguments.output);
  std::vector<suite::JudgedKernel> kernels;
  const std::vector<std::string> all = {"sunder", "dense", "nested", "cgal", "twin"};
  try {
    for (const std::string& name : arguments.kernels.empty() ? all : arguments.kernels) {
      kernels.push_back(maker_of(name)());
    }
  } catch (const suite::KernelLost& lost) {
    fmt::print(stderr, "sunder suite: {}\n", lost.what());
    return ExitCode::usage;
  }
  return judge_all(*fixtures, std::move(kernels), arguments.json);
}

}  // namespace

void add_suite_command(CLI::App& program, ExitCode& exit_code) {
  const auto arguments = std::make_shared<SuiteArguments>();
  CLI::App* command =
      program.add_subcommand("suite", "Judge topology kernels by bodies whose answers are known");
  CLI::Option* const filter =
      command->add_option("FILTER", arguments->filter, "Part of the names of the fixtures to run");
  CLI::Option* const fixtures =
      command->add_option("--fixtures", arguments->fixtures, "Folder of fixture files")
          ->type_name("DIR");
  command
      ->add_option("--kernel", arguments->kernels, "sunder, dense, nested, cgal, twin, or a shell command")
      ->type_name("KERNEL")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  CLI::Option* const output =
      command
          ->add_option(
              "--export", arguments->output,
              "Judge nothing; write each fixture as MSH and JSON with every step and answer")
          ->type_name("DIR");
  command->add_flag("--json", arguments->json, "Print JSON instead of a table")->excludes(output);
  add_random_options(*command, {filter, fixtures, output}, arguments->random);
  command->footer(footer);
  command->callback([=, &exit_code] { exit_code = run_suite(*arguments); });
}

}  // namespace sunder
