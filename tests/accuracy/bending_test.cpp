// SPDX-License-Identifier: MIT
// Three-point bending against 2 sigma_t b h^2 / (3 L), and its share in each node stress.
#include <catch2/catch.hpp>

#include "tests/experiments/cases/bending.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

const BendingAnswer& mode(const BendingTable& table, NodeStress mode) {
  return table.modes[static_cast<std::size_t>(mode)];
}

}  // namespace

TEST_CASE(
    "a bent beam breaks at the load of beam theory with the fitted stress: 3 per cent with 8 "
    "elements through its height, 10 with 4",
    "[accuracy][bending]") {
  const BendingTable coarse = bend_static(4), fine = bend_static(8);
  CHECK(mode(fine, NodeStress::fit).load == Approx(1).margin(0.03));
  CHECK(mode(coarse, NodeStress::fit).load == Approx(1).margin(0.1));
  // The average finds less at a surface, and breaks later.
  CHECK(mode(fine, NodeStress::volume).load == Approx(1.107).margin(0.005));
  CHECK(mode(coarse, NodeStress::volume).load == Approx(1.31).margin(0.01));
  for (const BendingTable& table : {coarse, fine}) {
    // One material: mass is volume.
    CHECK(mode(table, NodeStress::mass).load == Approx(mode(table, NodeStress::volume).load));
    for (const BendingAnswer& answer : table.modes) {
      CHECK(answer.away <= 1);
      CHECK(answer.angle <= 10);
      CHECK(answer.unfitted == 0);
    }
  }
}

TEST_CASE("node stress finds this much of the stress at a bent surface", "[accuracy][bending]") {
  const BendingTable two = bend_static(2), four = bend_static(4), eight = bend_static(8);
  CHECK(mode(two, NodeStress::volume).surface == Approx(0.399).margin(0.005));
  CHECK(mode(four, NodeStress::volume).surface == Approx(0.707).margin(0.005));
  CHECK(mode(eight, NodeStress::volume).surface == Approx(0.877).margin(0.005));
  CHECK(mode(two, NodeStress::fit).surface == Approx(0.687).margin(0.005));
  CHECK(mode(four, NodeStress::fit).surface == Approx(0.912).margin(0.005));
  CHECK(mode(eight, NodeStress::fit).surface == Approx(0.995).margin(0.005));
}

TEST_CASE("a slow load breaks a beam of 4 elements where and when its equilibrium says",
          "[accuracy][bending]") {
  const BendingRun run =
      bend_slowly({.fracture = {.node_stress = NodeStress::fit, .crack = CrackMode::paper}});
  CHECK(run.load == Approx(1).margin(0.1));
  CHECK(run.load == Approx(1.051).margin(0.005));
  CHECK(run.away <= 1);
  CHECK(run.angle <= 10);
  CHECK(run.quasi_static == run.steps);
}
