// SPDX-License-Identifier: MIT
// `sunder suite --random`: its options, meshes, progress and printed results.
#include "apps/bench/suite/suite_random.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/check.hpp"
#include "topology/suite/random/random_run.hpp"
#include "topology/suite/random/random_run_numbers.hpp"

namespace sunder {
namespace {

using nlohmann::ordered_json;
using suite::FamilyReport;
using Clock = std::chrono::steady_clock;

/// One kernel's run.
struct KernelRun {
  std::string kernel;
  suite::RandomReport report;
  double seconds = 0;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Fans done, on a terminal only.
class FanProgress {
 public:
  FanProgress(std::string kernel, std::size_t fans, bool quiet)
      : kernel_(std::move(kernel)), fans_(fans), terminal_(!quiet && is_terminal(STDERR_FILENO)) {}
  FanProgress(const FanProgress&) = delete;
  FanProgress& operator=(const FanProgress&) = delete;
  ~FanProgress() {
    if (terminal_) write_text(stderr, "\r\033[K");
  }

  void show(std::size_t done) {
    if (!terminal_ || seconds_since(last_) < 0.1) return;
    last_ = Clock::now();
    const double elapsed = seconds_since(start_);
    const double left = elapsed * static_cast<double>(fans_ - done) / static_cast<double>(done + 1);
    write_text(stderr, fmt::format("\r{}: {} of {}, {:.0f} s left\033[K", plain_line(kernel_), done,
                                   counted(fans_, "fan"), left));
    std::fflush(stderr);
  }

 private:
  std::string kernel_;
  std::size_t fans_;
  bool terminal_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// The meshes of the arguments; none when one cannot be read or built.
Result<std::vector<suite::NamedMesh>> read_meshes(const RandomArguments& arguments) {
  Result<std::vector<suite::NamedMesh>> meshes(std::vector<suite::NamedMesh>{});
  for (const std::filesystem::path& path : arguments.meshes) {
    Result<TetMesh> mesh = read_mesh(path);
    std::vector<Finding> findings = std::move(mesh.findings);
    if (mesh) {
      for (Finding& f : check_mesh(*mesh, Severity::warning)) findings.push_back(std::move(f));
      meshes.value->push_back({path.filename().string(), std::move(*mesh)});
    }
    for (Finding& f : findings) {
      f.file = path.string();
      if (f.severity == Severity::error) meshes.findings.push_back(std::move(f));
    }
  }
  if (!meshes.findings.empty()) meshes.value.reset();
  return meshes;
}

KernelRun run_kernel(const RandomArguments& arguments, const std::vector<suite::NamedMesh>& meshes,
                     const std::function<suite::JudgedKernel()>& make) {
  KernelRun run{.kernel = make().name, .report = {}};
  FanProgress progress(run.kernel, arguments.fans, arguments.telling.quiet);
  const Clock::time_point start = Clock::now();
  run.report = suite::run_random({.fans = arguments.fans,
                                  .seed = arguments.seed,
                                  .meshes = meshes,
                                  .progress = [&](std::size_t done) { progress.show(done); }},
                                 make);
  run.seconds = seconds_since(start);
  return run;
}

std::size_t failures_of(const KernelRun& run) {
  const auto& families = run.report.families;
  return static_cast<std::size_t>(
      std::count_if(families.begin(), families.end(),
                    [](const FamilyReport& f) { return f.failure.has_value(); }));
}

/// Part of the oracle's alarms that were true, in per cent; "-" where there was none.
std::string efficiency(const FamilyReport& family) {
  const auto& [alarms, separations] = std::pair(family.counts.alarms, family.counts.separations);
  if (alarms == 0) return "-";
  return fmt::format("{:.2f}",
                     100.0 * static_cast<double>(separations) / static_cast<double>(alarms));
}

constexpr const char* row_format =
    "{:<{}}{:>8}{:>10}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>7}{:>8}{:>8}{:>7}{:>6}\n";

void print_line(const FamilyReport& f, std::size_t width, std::size_t mismatches) {
  const std::string sizes = fmt::format("{}-{}", f.fewest, f.most);
  print(row_format, f.name, width, f.bodies, sizes, f.counts.fans, f.counts.labelled_fans,
        f.counts.faces, f.counts.vertices, f.counts.alarms, f.counts.separations, f.counts.missed,
        efficiency(f), f.counts.glues, f.checks.homologies, mismatches);
}

void print_table(const KernelRun& run) {
  std::size_t width = 0;
  for (const FamilyReport& f : run.report.families) width = std::max(width, f.name.size());
  print(row_format, "family", width, "bodies", "tets", "fans", "labelled", "faces", "vertices",
        "alarms", "parted", "missed", "true %", "glues", "homol.", "wrong");
  for (const FamilyReport& f : run.report.families) print_line(f, width, f.failure ? 1 : 0);
  print_line(suite::total_of(run.report), width, failures_of(run));
}

void print_failure(const FamilyReport& family) {
  const suite::RandomFailure& failure = *family.failure;
  const auto line = [](const suite::Mismatch& m) {
    return fmt::format("{}: expected {}, answered {}", m.what, m.expected, m.answered);
  };
  print("\n{}: after {} on {}: {}\n", family.name, counted(failure.found.steps.size(), "step"),
        counted_tetrahedra(failure.found.body.tetrahedra.size()), line(failure.first));
  if (failure.last) {
    print("Shrunk to {} on {}: {}\n", counted(failure.shrunk.steps.size(), "step"),
          counted_tetrahedra(failure.shrunk.body.tetrahedra.size()), line(*failure.last));
  } else {
    print("No answer to a step was wrong in a second run: nothing taken away.\n");
  }
  print("As a fixture:\n{}\n", failure.fixture);
}

/// How often each check ran. Checks with a cost in proportion to the body do not run every time.
void print_checks(const FamilyReport& total) {
  const suite::CheckCounts& c = total.checks;
  const suite::TearCounts& t = total.counts;
  const auto line = [](std::size_t times, std::string_view what) {
    print("{:>12}  {}\n", times, what);
  };
  print("\nChecks made\n");
  line(c.splits, "splits: vertices, edges, separation against union-find; laws of the answer");
  line(c.laws, "of them: all cells counted by the kernel against the running counts");
  line(c.betti_changes, "of them: change of the Betti numbers against the table of laws");
  line(c.glues, "glues");
  line(c.refusals, "splits and glues that had to be refused");
  line(c.fans, "faces of fans (empty ones too) against the suite's own geometry");
  line(c.sections, "sections of planes likewise");
  line(c.wholes, "whole bodies: counts, vertices and components against union-find");
  line(c.faults, "whole bodies: what the kernel finds wrong with itself");
  line(c.homologies, "whole bodies: homology over GF(2) and Z (every hundredth operation)");
  line(t.orders, "operations undone by gluing and done again in another order");
  line(t.all_orders, "of them: in all orders");
  line(t.labelled_fans, "labelled fans: faces split against the union over the breaks");
  line(t.fans_in_other_orders, "of them: broken again on a second kernel in another order");
  line(t.replays, "bodies cut again on a second kernel, all faces in another order");
  line(total.comparisons, "single comparisons");
}

void print_run(const RandomArguments& arguments, const KernelRun& run) {
  print("kernel {}, seed {}\n\n", run.kernel, arguments.seed);
  print_table(run);
  const FamilyReport total = suite::total_of(run.report);
  print_checks(total);
  for (const FamilyReport& f : run.report.families) {
    if (f.failure) print_failure(f);
  }
  print("\n{} and {} by labels, {}, {:.1f} minutes\n", counted(total.counts.fans, "fan"),
        total.counts.labelled_fans, counted(failures_of(run), "mismatch", "mismatches"),
        run.seconds / 60);
}

ordered_json mismatch_json(const suite::Mismatch& m) {
  return {{"what", m.what}, {"expected", m.expected}, {"answered", m.answered}};
}

ordered_json family_json(const FamilyReport& family) {
  ordered_json json{{"family", family.name},
                    {"bodies", family.bodies},
                    {"fewest_tetrahedra", family.fewest},
                    {"most_tetrahedra", family.most},
                    {"bodies_without_sheet_law", family.without_sheet_law},
                    {"comparisons", family.comparisons}};
  for (const auto& n : suite::tear_numbers) json["done"][n.name] = family.counts.*n.number;
  for (const auto& n : suite::check_numbers) json["checked"][n.name] = family.checks.*n.number;
  if (!family.failure) return json;
  const suite::RandomFailure& failure = *family.failure;
  json["failure"] = {{"first", mismatch_json(failure.first)},
                     {"steps", failure.found.steps.size()},
                     {"tetrahedra", failure.found.body.tetrahedra.size()},
                     {"repeats", failure.last.has_value()},
                     {"fixture", ordered_json::parse(failure.fixture)}};
  return json;
}

ordered_json run_json(const KernelRun& run) {
  ordered_json json{{"kernel", run.kernel}, {"seconds", run.seconds}};
  json["mismatches"] = failures_of(run);
  json["total"] = family_json(suite::total_of(run.report));
  json["families"] = ordered_json::array();
  for (const FamilyReport& f : run.report.families) json["families"].push_back(family_json(f));
  return json;
}

}  // namespace

void add_random_options(CLI::App& command, const std::vector<CLI::Option*>& others,
                        RandomArguments& arguments) {
  CLI::Option* const random =
      command
          .add_option("--random", arguments.fans,
                      "No fixtures: N fans at random on generated bodies; kernel sunder by default")
          ->type_name("N")
          ->check(CLI::PositiveNumber);
  for (CLI::Option* const other : others) random->excludes(other);
  command.add_option("--seed", arguments.seed, "Of --random: the same seed, the same run")
      ->type_name("S")
      ->needs(random)
      ->capture_default_str();
  command.add_option("--mesh", arguments.meshes, "Of --random: one more body; may be repeated")
      ->type_name("FILE")
      ->needs(random)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_quiet_flag(command, arguments.telling)->needs(random);
}

ExitCode run_random_suite(const RandomArguments& arguments,
                          const std::vector<std::function<suite::JudgedKernel()>>& kernels,
                          bool json) {
  const Result<std::vector<suite::NamedMesh>> meshes = read_meshes(arguments);
  if (!meshes) {
    tell_beside(meshes.findings, arguments.telling);
    return ExitCode::bad_input;
  }
  ordered_json answer{{"seed", arguments.seed}, {"runs", ordered_json::array()}};
  bool wrong = false;
  for (const auto& make : kernels) {
    const KernelRun run = run_kernel(arguments, *meshes, make);
    wrong = wrong || failures_of(run) > 0;
    json ? answer["runs"].push_back(run_json(run)) : print_run(arguments, run);
    std::fflush(stdout);
  }
  if (json) print_json(answer);
  return wrong ? ExitCode::problems : ExitCode::fine;
}

}  // namespace sunder
