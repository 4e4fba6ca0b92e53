// SPDX-License-Identifier: MIT
#include "mechanics/integrators/coefficients.hpp"

#include <catch2/catch.hpp>

using namespace sunder;

TEST_CASE("generalised-alpha is of second order and unconditionally stable for every rho",
          "[mechanics][coefficients]") {
  const double rho = GENERATE(0.0, 0.25, 0.5, 1.0);
  const GeneralisedAlpha g = generalised_alpha(rho);
  CHECK(g.gamma == Approx(0.5 - g.alpha_m + g.alpha_f));
  CHECK(g.alpha_m <= g.alpha_f);
  CHECK(g.alpha_f <= 0.5);
  CHECK(g.beta >= Approx(0.25 + 0.5 * (g.alpha_f - g.alpha_m)));
}

TEST_CASE("rho_infinity is the user's in short steps and nothing in long ones",
          "[mechanics][coefficients]") {
  CHECK(followed_rho(0.5, 1e-6, 1e-3) == 0.5);
  CHECK(followed_rho(0.5, 1, 1e-3) == 0);
  double last = 0.5;
  for (double h = 1e-5; h < 1e-2; h *= 1.5) {
    const double rho = followed_rho(0.5, h, 1e-3);
    CHECK(rho <= last);
    last = rho;
  }
}

TEST_CASE("the matrix of each integrator is that of its scheme", "[mechanics][coefficients]") {
  IntegratorSettings settings;
  settings.time_step = 0.01;
  settings.damping = {2, 3};
  settings.integrator = Integrator::implicit_euler;
  CHECK(system_matrix(settings).mass == Approx(1 + 0.01 * 2));
  CHECK(system_matrix(settings).stiffness == Approx(0.01 * 3 + 1e-4));
  settings.integrator = Integrator::verlet;
  CHECK(system_matrix(settings) == SystemMatrix{1, 0});
  settings.integrator = Integrator::floating_frame;
  settings.damping = {};
  settings.rho_infinity = 1;  // the trapezoidal rule
  const SystemMatrix trapezoidal = system_matrix(settings);
  CHECK(trapezoidal.stiffness / trapezoidal.mass == Approx(0.25e-4));
}
