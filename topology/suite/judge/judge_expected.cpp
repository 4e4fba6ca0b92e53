// SPDX-License-Identifier: MIT
// Expectations of one moment and of one operation.
#include "topology/suite/judge/judge_expected.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "topology/suite/fixtures/steps.hpp"
#include "topology/suite/homology/homology.hpp"

namespace sunder::suite {
namespace {

/// Homology over Z of bodies up to this size is had wherever the fixture says anything of it.
constexpr std::size_t integers_up_to = 400;

using Tally = std::map<std::array<int, 2>, std::size_t>;

void compare_tallies(Checks& checks, const Tally& expected, const Tally& answered) {
  Tally keys = expected;
  keys.insert(answered.begin(), answered.end());
  const auto number = [](const Tally& tally, const std::array<int, 2>& key) {
    const auto found = tally.find(key);
    return found == tally.end() ? 0 : found->second;
  };
  for (const auto& [key, ignored] : keys) {
    compare(checks, fmt::format("splits of kind ({}, {})", key[0], key[1]), number(expected, key),
            number(answered, key));
  }
}

void compare_each(Checks& checks, const std::vector<SplitAnswer>& expected,
                  const std::vector<TrueStep>& steps, const GlueTwin& twin) {
  compare(checks, "faces of the operation", expected.size(), steps.size());
  for (std::size_t i = 0; i < std::min(steps.size(), expected.size()); ++i) {
    const auto points = points_of(twin, steps[i].step.a);
    compare(checks, fmt::format("{}", fmt::join(points, " ")), expected[i], steps[i].split);
  }
}

}  // namespace

void check_counts(Checks& checks, const Expected& expected, const CellCounts& counts) {
  if (expected.counts) compare(checks, *expected.counts, counts);
  const auto& chi = expected.euler_characteristic;
  if (!chi || same(checks, *chi, euler_characteristic(counts))) return;
  differ(checks, "Euler characteristic", std::to_string(*chi),
         std::to_string(euler_characteristic(counts)));
}

std::optional<IntegerHomology> check_homology(Checks& checks, const Expected& expected,
                                              const GlueTwin& twin) {
  if (expected.orientable) {
    const bool is = is_orientable(twin);
    if (!same(checks, *expected.orientable, is)) {
      differ(checks, "orientable", is ? "no" : "yes", is ? "yes" : "no");
    }
  }
  std::optional<IntegerHomology> homology;
  if (expected.betti_mod.empty() && !expected.homology) return homology;
  const OrbitComplex complex = orbit_complex(twin);
  for (const auto& [prime, betti] : expected.betti_mod) {
    compare(checks, fmt::format("over GF({})", prime), betti, betti_numbers(complex, prime));
  }
  const bool small = twin.tetrahedra.size() <= integers_up_to;
  if (small || expected.homology) homology = integer_homology(complex);
  if (expected.homology) compare(checks, *expected.homology, *homology);
  return homology;
}

void check_splits(Checks& checks, const Expected& expected, const std::vector<TrueStep>& steps,
                  const GlueTwin& twin) {
  Tally tally;
  std::size_t predicted = 0, separations = 0;
  for (const TrueStep& s : steps) {
    if (!s.split.did) continue;
    ++tally[{static_cast<int>(s.split.vertices.size()), static_cast<int>(s.split.edges.size())}];
    predicted += oracle_says_new(s.split) ? 1 : 0;
    separations += s.split.separated ? 1 : 0;
  }
  if (expected.splits) compare_each(checks, *expected.splits, steps, twin);
  if (expected.tally) compare_tallies(checks, *expected.tally, tally);
  if (expected.predicted) {
    compare(checks, "faces at which the oracle says yes", *expected.predicted, predicted);
  }
  if (expected.separations) compare(checks, "separations", *expected.separations, separations);
}

}  // namespace sunder::suite
