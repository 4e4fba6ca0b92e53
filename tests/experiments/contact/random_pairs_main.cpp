// SPDX-License-Identifier: MIT
// `random_pairs [--pairs N] [--first SEED]`: how many random pairs of solids pass each other.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include "tests/experiments/contact/random_pairs.hpp"

using namespace sunder::test;

namespace {

constexpr const char* usage = R"(usage: random_pairs [--pairs N] [--first SEED] [--verbose]
Throws random pairs of solids at each other: chips, cubes, bars, plates and balls, size ratios of 1
to 1000, 0.01 to 1000 m/s, up to 1 rad of spin per step, steps of 10 us to 30 ms, rigid or elastic.
An independent judge looks for passes between and within steps. --verbose prints each pair that
passed or ends deeper than 2 % of its mean edge.
Exit codes: 0 none passed, 1 some did, 2 usage.
)";

struct Tally {
  int pairs = 0, met = 0, passed = 0, deep = 0;
  double deepest = 0;
};

/// At the end of a step.
bool is_deep(const RandomPair& pair) { return pair.deepest > 0.02; }

void add(Tally& tally, const RandomPair& pair) {
  ++tally.pairs;
  tally.met += pair.met;
  tally.passed += pair.passed;
  tally.deep += is_deep(pair);
  tally.deepest = std::max(tally.deepest, pair.deepest);
}

}  // namespace

int main(int argc, char** argv) {
  long pairs = 1000, first = 1;
  bool verbose = false;
  for (int k = 1; k < argc; ++k) {
    const std::string_view word = argv[k];
    if (word == "--verbose") {
      verbose = true;
    } else if (word == "--pairs" && k + 1 < argc) {
      pairs = std::atol(argv[++k]);
    } else if (word == "--first" && k + 1 < argc) {
      first = std::atol(argv[++k]);
    } else {
      std::fputs(usage, stderr);
      return 2;
    }
  }
  if (pairs < 1 || first < 0) {
    std::fputs(usage, stderr);
    return 2;
  }
  std::map<std::string, Tally> by_kind;
  Tally all;
  for (long seed = first; seed < first + pairs; ++seed) {
    const RandomPair pair = run_random_pair(static_cast<std::uint64_t>(seed));
    add(by_kind[pair.kinds], pair);
    add(all, pair);
    if (verbose && (pair.passed || is_deep(pair))) {
      std::printf(
          "%ld: %s%s, ratio %.3g, %.3g m/s, %.3g rad, %.3g s: %s%s, deepest %.3g, last %.3g\n",
          seed, pair.is_elastic ? "elastic " : "", pair.kinds.c_str(), pair.ratio, pair.speed,
          pair.turn, pair.time_step, pair.met ? "met" : "missed", pair.passed ? ", PASSED" : "",
          pair.deepest, pair.last);
    }
  }
  std::printf("%-16s %7s %7s %7s %9s %9s\n", "pair", "pairs", "met", "passed", "deep", "deepest");
  const auto print = [](const char* name, const Tally& t) {
    std::printf("%-16s %7d %7d %7d %9d %9.3g\n", name, t.pairs, t.met, t.passed, t.deep, t.deepest);
  };
  for (const auto& [name, tally] : by_kind) print(name.c_str(), tally);
  print("all", all);
  std::puts("deep: more than 2 % of the mean edge at the end of a step; deepest: in mean edges");
  return all.passed > 0;
}
