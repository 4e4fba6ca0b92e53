// SPDX-License-Identifier: MIT
// The random differential test as a command: a table, and exit code 1 on any mismatch.
#include <CLI/CLI.hpp>

#include <cstdio>

#include "tests/topology/random_splits.hpp"

int main(int argc, char** argv) {
  sunder::test::RandomSplitOptions options;
  CLI::App app(
      "Splits random faces of many bodies; holds every split against the laws, against "
      "union-find and against a full walk.");
  app.add_option("--splits", options.splits, "splits over all bodies")->capture_default_str();
  app.add_option("--seed", options.seed, "seed of the random faces")->capture_default_str();
  app.add_option("--full-every", options.full_every, "count from nothing after so many")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--largest", options.largest, "leave out bodies of more tetrahedra")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::printf("seed %llu\n", static_cast<unsigned long long>(options.seed));
  std::printf("%-24s %6s %7s %9s %7s %7s %6s %6s %6s %5s\n", "body", "tets", "splits", "vertices",
              "edges", "alarms", "parted", "missed", "counts", "wrong");
  std::size_t wrong = 0, splits = 0;
  for (const auto& r : sunder::test::run_random_splits(options)) {
    std::printf("%-24s %6zu %7zu %9zu %7zu %7zu %6zu %6zu %6zu %5zu\n", r.name.c_str(),
                r.tetrahedra, r.splits, r.vertices_split, r.edges_split, r.alarms, r.separations,
                r.missed, r.full_counts, r.mismatches.size());
    for (const std::string& m : r.mismatches) std::printf("  %s\n", m.c_str());
    wrong += r.mismatches.size();
    splits += r.splits;
  }
  std::printf("%zu splits, %zu mismatches\n", splits, wrong);
  return wrong == 0 ? 0 : 1;
}
