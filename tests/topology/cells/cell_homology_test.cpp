// SPDX-License-Identifier: MIT
// A short run of the checks that `sunder_cell_homology` makes at length.
#include "tests/topology/cells/cell_homology.hpp"

#include <catch2/catch.hpp>

using namespace sunder;
using namespace sunder::test;

namespace {

/// Whether Regina is installed.
bool has_regina() {
#ifdef SUNDER_PYTHON
  return std::system(SUNDER_PYTHON " -c 'import regina' 2> /dev/null") == 0;
#else
  return false;
#endif
}

}  // namespace

TEST_CASE("dividing cells keeps homology, say GUDHI and Regina", "[topology][cells][gudhi]") {
  std::optional<suite::JudgedKernel> regina;
#ifdef SUNDER_PYTHON
  if (has_regina()) {
    regina =
        suite::process_kernel("exec " SUNDER_PYTHON " " SUNDER_ADAPTERS "/regina_adapter.py 20");
  }
#endif
  const bool asked = regina.has_value();
  HomologyWatch watch({.gudhi = 30, .regina = 20}, std::move(regina));
  const auto run =
      random_cells(300, 20261124, [&](const CellMoment& moment) { return watch(moment); });
  INFO(run.failure);
  CHECK(run.failure.empty());
  CHECK(watch.report().kept_by_gudhi > 25);
  if (asked) CHECK(watch.report().kept_by_regina > 10);
}

TEST_CASE("the watch sees a body that came apart", "[topology][cells][gudhi]") {
  HomologyWatch watch({}, std::nullopt);
  suite::GlueTwin body = suite::glue_twin({{0, 1, 2, 3}, {1, 0, 2, 4}}, 5);
  Counts counts;
  counts.betti = {1, 0, 0};
  CHECK(watch({CellMoment::After::beginning, body, counts}).empty());
  CHECK(watch({CellMoment::After::division, body, counts}).empty());
  suite::unglue(body, HalfFaceId{3U});
  CHECK(watch({CellMoment::After::split, body, counts}) ==
        "the map against ours: Betti numbers 1 0 0 0 instead of 2 0 0 0");
  counts.betti.reset();
  const auto whole = suite::glue_twin({{0, 1, 2, 3}, {1, 0, 2, 4}}, 5);
  CHECK(watch({CellMoment::After::division, whole, counts}) ==
        "a division has changed homology over Z");
}
