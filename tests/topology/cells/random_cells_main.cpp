// SPDX-License-Identifier: MIT
// Any number of random operations on cells: `sunder_random_cells OPERATIONS SEED`.
#include <fmt/format.h>

#include <cstdlib>

#include "tests/topology/cells/random_cells.hpp"

int main(int argc, char** argv) {
  if (argc != 3) return fmt::print("usage: {} OPERATIONS SEED\n", argv[0]), 2;
  const auto run = sunder::test::random_cells(std::strtoull(argv[1], nullptr, 10),
                                              std::strtoull(argv[2], nullptr, 10));
  fmt::print("inserted {}, refined {}, cut {}, splits {}, undone {}, redone {}; {} comparisons\n",
             run.inserted, run.refined, run.cut, run.splits, run.undone, run.redone,
             run.comparisons);
  if (run.failure.empty()) return 0;
  fmt::print("wrong: {}\n", run.failure);
  return 1;
}
