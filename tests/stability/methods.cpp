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
  };
  return all;
}

}  // namespace sunder::stability
