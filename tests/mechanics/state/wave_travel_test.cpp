// SPDX-License-Identifier: MIT
#include "mechanics/state/wave_travel.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/bodies.hpp"

using namespace sunder;

TEST_CASE("waves travel through cells and components at the speed of the material",
          "[mechanics][wave_travel]") {
  const MechanicsState state = test::state_of(test::kuhn_block({2, 3, 4}, {1, 1, 2}), Material{});
  const Component& component = state.components.front();
  const double c = compression_wave_speed(Material{});
  CHECK(extent_travel(state, component) == Approx(2 * component.rest_radius / c));
  double smallest = INFINITY, largest = 0;
  for (const double volume : state.elements.rest_volume) {
    smallest = std::min(smallest, std::cbrt(6 * volume) / c);
    largest = std::max(largest, std::cbrt(6 * volume) / c);
  }
  CHECK(component.cell_travel >= smallest * (1 - 1e-12));
  CHECK(component.cell_travel <= largest * (1 + 1e-12));
  CHECK(component.cell_travel < extent_travel(state, component));
}
