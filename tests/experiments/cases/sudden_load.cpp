// SPDX-License-Identifier: MIT
// Steps of a held bar under a sudden load, next to the static solution.
#include "tests/experiments/cases/sudden_load.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/statics/static_solve.hpp"
#include "mechanics/step.hpp"
#include "tests/support/bodies.hpp"

namespace sunder::accuracy {
namespace {

/// The bar held at x = -1/2.
MechanicsState held_bar(const test::Body& body) {
  Material material;
  MechanicsState state = test::state_of(body, material);
  state.motions.push_back({});
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    if (state.vertices.rest_position[v].x() < -0.499) state.vertices.support[v] = MotionId{0};
  }
  MechanicsScratch scratch;
  const ComponentId all[] = {ComponentId{0}};
  rebuild(state, body.corners, all, scratch);
  return state;
}

/// Largest difference of two columns over the largest entry of the first.
template <class Entry>
double error(const std::vector<Entry>& exact, const std::vector<Entry>& found) {
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    worst = std::max(worst, (found[i] - exact[i]).norm());
    largest = std::max(largest, exact[i].norm());
  }
  return worst / largest;
}

}  // namespace

std::vector<SuddenLoadStep> run_sudden_load(const SuddenLoad& load, int count) {
  const test::Body body = test::kuhn_block({10, 2, 2}, {1, 0.2, 0.2});
  const Vec3 along(9.81, 0, 0), across(0, 0, -9.81);
  const Loads gravity{load.across ? across : along};
  const Loads gravity_before{load.across ? along : across};

  MechanicsState still = held_bar(body);
  MechanicsScratch static_scratch, scratch;
  solve_static(still, static_scratch, body.corners, gravity);

  IntegratorSettings settings;
  settings.rho_infinity = load.rho_infinity;
  const double lowest = 3.516 * bar_wave_speed(Material{}) * 0.2 / std::sqrt(12.0);
  settings.time_step = load.frequency_times_step / lowest;
  MechanicsState state = held_bar(body);
  for (int k = 0; k < load.steps_before; ++k) {
    advance(state, scratch, {body.corners, gravity_before, settings});
  }
  std::vector<SuddenLoadStep> steps;
  for (int k = 0; k < count; ++k) {
    advance(state, scratch, {body.corners, gravity, settings});
    steps.push_back({error(still.vertices.displacement, state.vertices.displacement),
                     error(still.elements.stress, state.elements.stress)});
  }
  return steps;
}

}  // namespace sunder::accuracy
