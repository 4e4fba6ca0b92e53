// SPDX-License-Identifier: MIT
// The law of a corner: tractions, means and energies against sums over many small openings.
#include "mechanics/ties/tie_law.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

using namespace sunder;
using Catch::Detail::Approx;

namespace {

TieCorner some_corner(std::mt19937& random) {
  std::uniform_real_distribution<double> u(0.1, 1);
  TieCorner corner{.area = 1e-4 * u(random), .strength = 3e6 * u(random)};
  corner.opening_end = 2 * 33 * u(random) / corner.strength;
  return corner;
}

/// The energies of a corner of the plane x = 0 on a path of (opening, sliding), by many small
/// steps.
struct Path {
  double work = 0, dissipated = 0, stored = 0, opened = 0;
  double least_dissipation = 0;  ///< J, in any small step
};

Path path_of(TieCorner corner, const std::vector<std::array<double, 2>>& points,
             const ShearLaw& shear) {
  constexpr int parts = 4000;
  const Vec3 n = Vec3::UnitX();
  Path path;
  Vec3 before = Vec3::Zero();
  for (std::size_t leg = 1; leg < points.size(); ++leg) {
    for (int k = 1; k <= parts; ++k) {
      const double share = static_cast<double>(k) / parts;
      const auto along = [&](std::size_t axis) {
        return (1 - share) * points[leg - 1][axis] + share * points[leg][axis];
      };
      const Vec3 now(along(0), along(1), 0), middle = 0.5 * (before + now);
      // The traction half way, as the law states it: T = (<delta_n> n + beta^2 / kappa delta_t) s.
      const double delta = effective_opening(middle, n, shear);
      const double most = std::max(corner.opened, delta);
      if (most > 0) {
        const double s = corner.strength * std::max(0.0, 1 - most / corner.opening_end) / most;
        const Vec3 traction(s * std::max(0.0, middle.x()),
                            s * shear.weight / shear.energy_ratio * middle.y(), 0);
        path.work += corner.area * traction.dot(now - before);
      }
      const double mode = mode_ratio(middle, n, shear);
      const double taken = dissipated_energy(corner, corner.opened, mode);
      const double end = effective_opening(now, n, shear);
      corner.opened = std::max(corner.opened, end);
      const double takes = dissipated_energy(corner, corner.opened, mode) - taken;
      path.dissipated += takes;
      path.least_dissipation = std::min(path.least_dissipation, takes);
      path.stored = stored_energy(corner, end, mode_ratio(now, n, shear));
      before = now;
    }
  }
  path.opened = std::min(corner.opened, corner.opening_end);
  return path;
}

}  // namespace

TEST_CASE("a corner opened to its end has taken its area times G_c", "[ties]") {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    TieCorner corner = some_corner(random);
    const double energy = 0.5 * corner.strength * corner.opening_end;
    for (const double beyond : {1.0, 1.5, 100.0}) {
      CHECK(dissipated_energy(corner, beyond * corner.opening_end, 1) ==
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
    // The change of stored energy, and the energy lost for good, make up that work.
    const double before =
        stored_energy(corner, corner.opened, 1) + dissipated_energy(corner, corner.opened, 1);
    TieCorner later = corner;
    later.opened = to;
    const double after = stored_energy(later, to, 1) + dissipated_energy(later, to, 1);
    CHECK(std::abs(after - before - work) < 1e-8 * whole);
  }
}

TEST_CASE("unloading goes to the origin and meets the line where it left it", "[ties]") {
  std::mt19937 random(3);
  TieCorner corner = some_corner(random);
  CHECK(std::isinf(secant_stiffness(corner)));
  CHECK(stored_energy(corner, 0, 1) == 0);
  corner.opened = 0.3 * corner.opening_end;
  CHECK(secant_stiffness(corner) * corner.opened ==
        Approx(corner.area * traction_at(corner, corner.opened)).epsilon(1e-14));
  CHECK(mean_traction(corner, 0.1 * corner.opening_end) == traction_at(corner, corner.opened));
  CHECK(mean_traction(corner, corner.opened) == traction_at(corner, corner.opened));
}

TEST_CASE("openings and tractions count by what pulls, not by what presses", "[ties]") {
  const Vec3 n = Vec3(1, 2, 2) / 3, t = n.unitOrthogonal();
  for (const ShearLaw& shear : {ShearLaw{}, ShearLaw{2, 1}, ShearLaw{0.5, 3}, ShearLaw{4, 0.25}}) {
    const double beta = std::sqrt(shear.weight), kappa = shear.energy_ratio;
    CHECK(effective_opening(2 * n, n, shear) == Approx(2));
    CHECK(effective_opening(-2 * n, n, shear) == Approx(0).margin(1e-12));
    CHECK(effective_opening(-2 * n + 3 * t, n, shear) == Approx(3 * beta / kappa));
    CHECK(effective_opening(3 * n + 4 * t, n, shear) == Approx(std::hypot(3, 4 * beta / kappa)));
    CHECK(effective_traction(3 * n + 4 * t, n, shear) == Approx(std::hypot(3, 4 / beta)));
    CHECK(effective_traction(-3 * n, n, shear) == Approx(0).margin(1e-12));
    CHECK(mode_ratio(2 * n, n, shear) == Approx(1));
    CHECK(mode_ratio(Vec3::Zero(), n, shear) == 1);
    CHECK(mode_ratio(3 * t, n, shear) == Approx(kappa));
    CHECK(mode_ratio(3 * t - n, n, shear) == Approx(kappa));
    // A traction has the mode of the opening that makes it.
    const Vec3 opening = 0.3 * n + 0.7 * t;
    const Vec3 traction = 0.3 * n + sliding_stiffness(shear) * 0.7 * t;
    CHECK(mode_ratio_of_traction(5 * traction, n, shear) == Approx(mode_ratio(opening, n, shear)));
  }
}

TEST_CASE("opened a corner takes G_c, slid kappa G_c, however it gets there in one mode",
          "[ties]") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0.2, 3);
  for (int i = 0; i < 20; ++i) {
    const ShearLaw shear{u(random), u(random)};
    const TieCorner corner = some_corner(random);
    const double whole = corner.area * 0.5 * corner.strength * corner.opening_end;
    const double kappa = shear.energy_ratio, beta = std::sqrt(shear.weight);
    const double slid = kappa / beta * corner.opening_end;  // m, where it bears nothing any more
    CHECK(path_of(corner, {{0, 0}, {corner.opening_end, 0}}, shear).work == Approx(whole));
    CHECK(path_of(corner, {{0, 0}, {0, slid}}, shear).work == Approx(kappa * whole));
    // There and back and on, and pressed meanwhile.
    const std::vector<std::array<double, 2>> back = {
        {0, 0}, {0, 0.4 * slid}, {0, -0.2 * slid}, {-corner.opening_end, 0}, {0, slid}};
    CHECK(path_of(corner, back, shear).work == Approx(kappa * whole).epsilon(1e-3));
    // Along one direction the energy is that of its mode.
    const double mode = mode_ratio({1, 1, 0}, Vec3::UnitX(), shear);
    CHECK(path_of(corner,
                  {{0, 0}, {5 * slid + 5 * corner.opening_end, 5 * slid + 5 * corner.opening_end}},
                  shear)
              .work == Approx(mode * whole).epsilon(1e-3));
  }
}

TEST_CASE("no path creates energy, and what it takes is what the law says", "[ties]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0.2, 3), place(-0.6, 0.9);
  for (int i = 0; i < 60; ++i) {
    const ShearLaw shear{u(random), u(random)};
    const TieCorner corner = some_corner(random);
    const double whole = corner.area * 0.5 * corner.strength * corner.opening_end;
    std::vector<std::array<double, 2>> path = {{0, 0}};
    for (int k = 0; k < 6; ++k) {
      path.push_back({place(random) * corner.opening_end, place(random) * corner.opening_end});
    }
    const Path seen = path_of(corner, path, shear);
    CHECK(std::abs(seen.work - seen.dissipated - seen.stored) < 2e-3 * whole);
    CHECK(seen.least_dissipation >= -1e-12 * whole);
    const double least = std::min(1.0, shear.energy_ratio),
                 most = std::max(1.0, shear.energy_ratio);
    CHECK(seen.dissipated <= most * whole * (1 + 1e-9));
    CHECK(seen.dissipated >= least * whole * seen.opened / corner.opening_end * (1 - 1e-9));
    // Back to where it began: all stored energy is given back, and the rest was dissipated.
    path.push_back({0, 0});
    const Path closed = path_of(corner, path, shear);
    CHECK(closed.stored == Approx(0).margin(1e-12 * whole));
    CHECK(closed.work > -2e-3 * whole);
  }
}
