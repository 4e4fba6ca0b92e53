// SPDX-License-Identifier: MIT
// The law of a corner: tractions, means and energies against sums over many small openings.
#include "mechanics/ties/tie_law.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace sunder;
using Catch::Detail::Approx;

namespace {

TieCorner some_corner(std::mt19937& random) {
  std::uniform_real_distribution<double> u(0.1, 1);
  TieCorner corner{.area = 1e-4 * u(random), .strength = 3e6 * u(random)};
  corner.opening_end = 2 * 33 * u(random) / corner.strength;
  return corner;
}

}  // namespace

TEST_CASE("a corner opened to its end has taken its area times G_c", "[ties]") {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    TieCorner corner = some_corner(random);
    const double energy = 0.5 * corner.strength * corner.opening_end;
    for (const double beyond : {1.0, 1.5, 100.0}) {
      CHECK(dissipated_energy(corner, beyond * corner.opening_end) ==
            Approx(corner.area * energy).epsilon(1e-14));
    }
    CHECK(traction_at(corner, 0) == corner.strength);
    CHECK(traction_at(corner, corner.opening_end) == 0);
    corner.opened = corner.opening_end;
    CHECK(corner.is_spent());
    CHECK(secant_stiffness(corner) == 0);
  }
}

TEST_CASE("the mean traction takes the energy that small openings take", "[ties]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(0, 1.5);
  for (int i = 0; i < 100; ++i) {
    TieCorner corner = some_corner(random);
    corner.opened = 0.6 * u(random) * corner.opening_end;
    const double to = corner.opened + u(random) * corner.opening_end;
    constexpr int parts = 20000;
    double work = 0;
    for (int k = 0; k < parts; ++k) {
      const double at = corner.opened + (k + 0.5) / parts * (to - corner.opened);
      work += corner.area * traction_at(corner, at) * (to - corner.opened) / parts;
    }
    const double whole = corner.area * corner.strength * corner.opening_end;
    CHECK(std::abs(corner.area * mean_traction(corner, to) * (to - corner.opened) - work) <
          1e-8 * whole);
    // What was stored before and is stored after, and what is lost for good, is that work.
    const double before = stored_energy(corner, corner.opened) +
                          dissipated_energy(corner, corner.opened);
    TieCorner later = corner;
    later.opened = to;
    const double after = stored_energy(later, to) + dissipated_energy(later, to);
    CHECK(std::abs(after - before - work) < 1e-8 * whole);
  }
}

TEST_CASE("unloading goes to the origin and meets the line where it left it", "[ties]") {
  std::mt19937 random(3);
  TieCorner corner = some_corner(random);
  CHECK(std::isinf(secant_stiffness(corner)));
  CHECK(stored_energy(corner, 0) == 0);
  corner.opened = 0.3 * corner.opening_end;
  CHECK(secant_stiffness(corner) * corner.opened ==
        Approx(corner.area * traction_at(corner, corner.opened)).epsilon(1e-14));
  CHECK(mean_traction(corner, 0.1 * corner.opening_end) == traction_at(corner, corner.opened));
  CHECK(mean_traction(corner, corner.opened) == traction_at(corner, corner.opened));
}

TEST_CASE("openings and tractions count by what pulls, not by what presses", "[ties]") {
  const Vec3 n = Vec3(1, 2, 2) / 3, t = n.unitOrthogonal();
  CHECK(effective_opening(2 * n, n) == Approx(2));
  CHECK(effective_opening(-2 * n, n) == Approx(0).margin(1e-12));
  CHECK(effective_opening(-2 * n + 3 * t, n) == Approx(3 * std::sqrt(shear_weight)));
  CHECK(effective_opening(3 * n + 4 * t, n) == Approx(std::hypot(3, 4 * std::sqrt(shear_weight))));
  CHECK(effective_traction(3 * n + 4 * t, n) == Approx(std::hypot(3, 4 / std::sqrt(shear_weight))));
  CHECK(effective_traction(-3 * n, n) == Approx(0).margin(1e-12));
}
