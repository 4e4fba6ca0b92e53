// SPDX-License-Identifier: MIT
// Homology through random operations on cells, by GUDHI and Regina:
// `sunder_cell_homology OPERATIONS SEED [GUDHI_LIMIT REGINA_LIMIT]`, limits in tetrahedra (0:
// never).
#include <fmt/format.h>

#include <cstdlib>

#include "tests/topology/cells/cell_homology.hpp"

int main(int argc, char** argv) {
  using namespace sunder;
  if (argc != 3 && argc != 5) {
    return fmt::print("usage: {} OPERATIONS SEED [GUDHI_LIMIT REGINA_LIMIT]\n", argv[0]), 2;
  }
  test::OutsideLimits limits;
  if (argc == 5) {
    limits = {std::strtoull(argv[3], nullptr, 10), std::strtoull(argv[4], nullptr, 10)};
  }
  std::optional<suite::JudgedKernel> regina;
#ifdef SUNDER_PYTHON
  if (limits.regina > 0) {
    regina = suite::process_kernel(fmt::format(
        "exec " SUNDER_PYTHON " " SUNDER_ADAPTERS "/regina_adapter.py {}", limits.regina));
  }
#endif
  test::HomologyWatch watch(limits, std::move(regina));
  const auto run =
      test::random_cells(std::strtoull(argv[1], nullptr, 10), std::strtoull(argv[2], nullptr, 10),
                         [&](const test::CellMoment& moment) { return watch(moment); });
  const test::OutsideReport& r = watch.report();
  fmt::print(
      "inserted {}, refined {}, cut {}, splits {}, undone {}, redone {}\n"
      "{} moments, {} by GUDHI, {} by Regina; divisions that kept homology: {} by GUDHI, {} by "
      "Regina\n",
      run.inserted, run.refined, run.cut, run.splits, run.undone, run.redone, r.moments, r.by_gudhi,
      r.by_regina, r.kept_by_gudhi, r.kept_by_regina);
  if (run.failure.empty()) return 0;
  fmt::print("wrong: {}\n", run.failure);
  return 1;
}
