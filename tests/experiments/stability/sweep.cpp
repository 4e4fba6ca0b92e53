// SPDX-License-Identifier: MIT
// Maps of the sweep.
#include "tests/experiments/stability/sweep.hpp"

#include "tests/stability/flight.hpp"
#include "tests/stability/matrix.hpp"

namespace sunder::stability {
namespace {

constexpr int steps = 100;
const std::vector<double> time_steps = {1e-6, 3e-6, 1e-5, 3e-5, 1e-4,
                                        3e-4, 1e-3, 3e-3, 1e-2, 1.0 / 30};

}  // namespace

std::vector<Map> maps() {
  return {
      {"stiffness",
       {1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12},
       time_steps,
       [](const Method& method, double E, double h) {
         return fly({.material = {.young_modulus = E}, .time_step = h, .steps = steps}, method);
       }},
      {"spin",
       {1, 5, 20, 50, 100, 200, 500},
       time_steps,
       [](const Method& method, double spin, double h) {
         return fly({.time_step = h,
                     .steps = steps,
                     .spin = Vec3(0, 0, spin),
                     .deformation = 0,
                     .weight = false},
                    method);
       }},
      {"poisson",
       {0, 0.2, 0.4, 0.45, 0.48, 0.49, 0.5},
       time_steps,
       [](const Method& method, double nu, double h) {
         return fly(
             {.material = {.poisson_ratio = nu}, .time_step = h, .steps = steps, .weight = false},
             method);
       }},
      {"sliver",
       {45, 10, 5, 2, 1, 0.3, 0.1},
       time_steps,
       [](const Method& method, double angle, double h) {
         return fly({.time_step = h, .steps = steps, .sliver_angle = angle, .weight = false},
                    method);
       }},
      {"mass",
       {1, 10, 1e2, 1e3, 1e4, 1e5, 1e6},
       time_steps,
       [](const Method& method, double ratio, double h) {
         return ball_on_block({.ratio = ratio, .time_step = h, .steps = steps}, method);
       }},
  };
}

std::vector<Method> mapped_methods() {
  std::vector<Method> some;
  for (const Method& method : methods()) {
    if (method.settings.isolated == IntegratorSettings{}.isolated) some.push_back(method);
  }
  return some;
}

}  // namespace sunder::stability
