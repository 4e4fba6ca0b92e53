// SPDX-License-Identifier: MIT
// Families, their shares of the fans, and failures.
#include "topology/suite/random/random_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "topology/suite/fixtures/fixture_json_write.hpp"
#include "topology/suite/judge/judge.hpp"
#include "topology/suite/random/random_run_bodies.hpp"
#include "topology/suite/random/random_run_numbers.hpp"

namespace sunder::suite {
namespace {

/// Bodies without a face to split may come up; so many in a row end their family.
constexpr std::size_t most_idle_bodies = 1000;

/// As it is the first time, then now and then in disguise.
BodyFamily family_of(const NamedMesh& named) {
  return {named.name, 8, [mesh = named.mesh, first = true](std::mt19937_64& random) mutable {
            const bool plain = std::exchange(first, false) || below(random, 2) == 0;
            return plain ? mesh : disguised(mesh, random);
          }};
}

/// Tears one body until nothing of it is whole or the family has its fans.
template <class Report>
void tear_body(TearRun& run, Tear& tear, std::size_t fans, const Report& report) {
  try {
    judge_whole(tear.trial);
    while (!tear.trial.checks.first && tear.whole.size() > 0 && run.counts.fans < fans) {
      tear_once(run, tear);
      report();
    }
    judge_whole(tear.trial);
    judge_faults(tear.trial);
  } catch (const KernelLost& lost) {
    differ(tear.trial.checks, "the kernel", "an answer", lost.what());
  }
}

RandomFailure failure_of(Trial& trial, JudgedKernel& kernel, const std::string& source) {
  RandomFailure failure;
  failure.first = *trial.checks.first;
  failure.first.steps = trial.steps;
  failure.found = {std::move(trial.body), std::move(trial.steps)};
  const auto seen = [&kernel](const TetMesh& body, std::span<const Step> steps) {
    return first_mismatch(body, steps, kernel);
  };
  failure.shrunk = failure.found;
  failure.last = seen(failure.found.body, failure.found.steps);
  if (failure.last) {
    const Fails fails = [&seen](const TetMesh& body, std::span<const Step> steps) {
      return !body.tetrahedra.empty() && seen(body, steps).has_value();
    };
    // Some seconds for a kernel that talks through a pipe.
    const ShrinkLimits limits{.work = 2500000};
    failure.shrunk = shrink(failure.found.body, failure.found.steps, fails, limits);
    failure.last = seen(failure.shrunk.body, failure.shrunk.steps);
  }
  const Mismatch& shown = failure.last ? *failure.last : failure.first;
  const std::string shows =
      fmt::format("{}: {} was answered, not {}", shown.what, shown.answered, shown.expected);
  failure.fixture = fixture_json(failure.shrunk.body, failure.shrunk.steps,
                                 {.name = "random", .shows = shows, .source = source});
  return failure;
}

struct FamilyRun {
  const BodyFamily& family;
  std::size_t fans = 0;
  std::uint64_t seed = 0;
  /// Fans done by the families before.
  std::size_t done = 0;
};

/// The bodies of a family on `kernel`; `second` is there for replays and for shrinking.
FamilyReport run_family(const RandomOptions& options, const FamilyRun& mine,
                        const JudgedKernel& kernel, const JudgedKernel& second) {
  FamilyReport report;
  report.name = mine.family.name;
  TearRun run{.random = std::mt19937_64(mine.seed), .counts = {}, .second = second};
  for (std::size_t idle = 0; run.counts.fans < mine.fans && idle < most_idle_bodies; ++idle) {
    const std::size_t fans_before = run.counts.fans;
    Tear tear = begin_tear(begin_trial(mine.family.draw(run.random), kernel));
    const std::size_t tetrahedra = tear.trial.body.tetrahedra.size();
    report.fewest = report.bodies == 0 ? tetrahedra : std::min(report.fewest, tetrahedra);
    report.most = std::max(report.most, tetrahedra);
    report.without_sheet_law += tear.trial.sheets_tell_betti ? 0 : 1;
    ++report.bodies;
    tear_body(run, tear, mine.fans, [&] {
      if (options.progress) options.progress(mine.done + run.counts.fans);
    });
    add(report.checks, tear.trial.times, check_numbers);
    report.comparisons += tear.trial.checks.made;
    if (run.counts.fans > fans_before) idle = 0;
    if (!tear.trial.checks.first) continue;
    report.failure =
        failure_of(tear.trial, run.second,
                   fmt::format("random run, seed {}, family \"{}\"", options.seed, report.name));
    break;
  }
  report.counts = run.counts;
  return report;
}

}  // namespace

RandomReport run_random(const RandomOptions& options,
                        const std::function<JudgedKernel()>& fresh_kernel) {
  std::vector<BodyFamily> families = body_families(options.largest);
  for (const NamedMesh& mesh : options.meshes) families.push_back(family_of(mesh));
  std::size_t shares = 0, share = 0;
  for (const BodyFamily& family : families) shares += family.share;
  const JudgedKernel kernel = fresh_kernel(), second = fresh_kernel();
  RandomReport report;
  for (std::size_t i = 0; i < families.size(); ++i) {
    const std::size_t begin = options.fans * share / shares;
    share += families[i].share;
    // Families must not depend on each other's draws: each could be run alone.
    const FamilyRun mine{.family = families[i],
                         .fans = options.fans * share / shares - begin,
                         .seed = options.seed + 0x9e3779b97f4a7c15U * (i + 1),
                         .done = begin};
    report.families.push_back(run_family(options, mine, kernel, second));
    if (report.families.back().failure) break;
  }
  return report;
}

FamilyReport total_of(const RandomReport& report) {
  FamilyReport total;
  total.name = "all";
  for (const FamilyReport& family : report.families) {
    total.fewest = total.bodies == 0 ? family.fewest : std::min(total.fewest, family.fewest);
    total.most = std::max(total.most, family.most);
    total.bodies += family.bodies;
    total.comparisons += family.comparisons;
    total.without_sheet_law += family.without_sheet_law;
    add(total.counts, family.counts, tear_numbers);
    add(total.checks, family.checks, check_numbers);
  }
  return total;
}

}  // namespace sunder::suite
