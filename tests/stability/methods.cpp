// SPDX-License-Identifier: MIT
// The methods of the stability matrix.
#include "tests/stability/cell.hpp"

namespace sunder::stability {

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"floating frame", {}},
      {"floating frame, rho .5", {.rho_infinity = 0.5}},
      {"implicit Euler", {.integrator = Integrator::implicit_euler}},
      {"implicit Euler, predicted",
       {.integrator = Integrator::implicit_euler, .euler_frame = EulerFrame::predicted}},
      {"verlet", {.integrator = Integrator::verlet}, true, false},
      {"sub-stepped", {.integrator = Integrator::sub_stepped}, true, false},
      {"modal", {.integrator = Integrator::modal}, true},
      {"Broyden", {.integrator = Integrator::broyden}},
      {"Broyden, factor",
       {.integrator = Integrator::broyden, .broyden_start = BroydenStart::factor}},
      {"Newton with CG", {.integrator = Integrator::newton_cg}},
      {"corotational",
       {.integrator = Integrator::implicit_euler, .model = ElasticModel::corotational}},
      {"corotational, prefactored",
       {.integrator = Integrator::implicit_euler,
        .model = ElasticModel::corotational,
        .corotational_solve = CorotationalSolve::prefactored}},
      {"floating, tetrahedra projected", {.isolated = IsolatedTetrahedra::projection}},
      {"floating, tetrahedra by qr", {.isolated = IsolatedTetrahedra::qr}},
  };
  return all;
}

std::vector<Method> contact_methods() {
  std::vector<Method> all = methods();
  all.push_back({.name = "penalty", .springs = {.turn = 0.5}});
  all.push_back({.name = "penalty, damped", .springs = {0.5, 0.2, 0.5}});
  all.push_back({.name = "penalty, step too long", .springs = {.turn = 6}});
  return all;
}

std::vector<Method> of_second_order(std::vector<Method> some) {
  std::erase_if(some, [](const Method& method) {
    return method.settings.isolated != IsolatedTetrahedra::rigid || method.springs.turn != 0;
  });
  for (Method& method : some) method.order = 2;
  return some;
}

}  // namespace sunder::stability
