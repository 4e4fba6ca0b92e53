// SPDX-License-Identifier: MIT
// The one-dimensional cohesive program against closed forms; its input.
#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "tests/experiments/cases/ring_burst.hpp"
#include "tests/experiments/cases/spall.hpp"
#include "tests/experiments/chain/chain.hpp"
#include "tests/experiments/chain/loads.hpp"

using namespace sunder::chain;
using sunder::accuracy::RingBurst;
using sunder::accuracy::zhou_fragments;

namespace {

const double pi = std::acos(-1.0);

double sum_of(const ChainEnergy& e) {
  return e.kinetic + e.strain + e.stored + e.dissipated + e.contact + e.damped;
}

/// Two bars with ends that are pulled apart at `speed`.
Chain two_bars(double speed) {
  Chain chain({.length = 0.01, .strength = {1e9, 3e6, 1e9}});
  chain.set_along(0, 0, -speed);
  chain.set_along(2, 0, speed);
  return chain;
}

}  // namespace

TEST_CASE("chain: a node that parts takes its fracture energy", "[accuracy][chain]") {
  Chain chain = two_bars(4);
  chain.step();
  const double before = chain.energy().kinetic + chain.energy().strain;
  while (chain.broken().empty() && chain.time() < 1e-3) chain.step();
  REQUIRE(chain.broken() == std::vector<std::size_t>{1});
  for (int i = 0; i < 100; ++i) chain.step();
  const ChainEnergy e = chain.energy();
  CHECK(e.dissipated == Approx(33).epsilon(1e-14));
  CHECK(e.stored == 0);
  CHECK(before - e.kinetic - e.strain == Approx(33 + e.contact).epsilon(1e-11));
  CHECK(e.contact >= 0);
}

TEST_CASE("chain: a node that is pulled too weakly holds, and no energy is made",
          "[accuracy][chain]") {
  // 24 J/m^2 of motion in all, less than the 33 that would part it: it opens, unloads, loads again.
  Chain chain = two_bars(2);
  double largest_share = 0;
  for (int i = 0; i < 20000; ++i) {
    chain.step();
    largest_share =
        std::max(largest_share, chain.tie(1).largest / chain.critical_opening(chain.tie(1)));
    REQUIRE(chain.tie(1).opening <= chain.tie(1).largest);
    REQUIRE(chain.right(1).along - chain.left(1).along >= -1e-18);
    REQUIRE(sum_of(chain.energy()) == Approx(chain.energy().before).epsilon(1e-11));
  }
  CHECK(chain.broken().empty());
  CHECK(largest_share > 0.1);
  CHECK(chain.energy().stored >= 0);
}

TEST_CASE("chain: what viscosity takes is in the ledger", "[accuracy][chain]") {
  Chain chain({.viscosity = 0.4, .strength = std::vector<double>(51, 3e6)});
  for (std::size_t k = 0; k < 51; ++k) chain.set_along(k, 0, k < 25 ? -0.6 : 0.6);
  for (int i = 0; i < 3000; ++i) chain.step();
  const ChainEnergy e = chain.energy();
  CHECK(!chain.broken().empty());
  CHECK(e.damped > 0.01 * e.before);
  CHECK(sum_of(e) == Approx(e.before).epsilon(1e-11));
}

TEST_CASE("chain: a free bar swings as masses and springs do", "[accuracy][chain]") {
  const std::size_t bars = 20;
  Chain chain({.step = 0.5, .strength = std::vector<double>(bars + 1, 1e9)});
  // Lowest mode cos(pi x / L), w = 2 c / l sin(pi l / (2 L)); sin(w' h / 2) = w h / 2 in time.
  const double h = chain.time_step();
  const double half = 0.5 * std::sin(pi / (2 * double(bars)));  // w h / 2
  const double phase = 2 * std::asin(half);                     // w' h
  for (std::size_t k = 0; k <= bars; ++k) {
    const double u = 1e-6 * std::cos(pi * double(k) / double(bars));
    chain.set_along(k, u, u * (1 - std::cos(phase)) / h);
  }
  for (int i = 1; i <= 1000; ++i) {
    chain.step();
    REQUIRE(chain.left(0).along == Approx(1e-6 * std::cos(phase * i)).margin(1e-16));
  }
  CHECK(std::abs(chain.momentum()) < 1e-12 * 2400 * 1e-2);
}

TEST_CASE("chain: a ring that does not break breathes at c / R", "[accuracy][chain]") {
  Chain ring({.shape = Shape::ring, .step = 0.05, .strength = std::vector<double>(60, 1e9)});
  for (std::size_t k = 0; k < ring.nodes(); ++k) ring.set_outwards(k, 0, 1.5);
  const double w = std::sqrt(30e9 / 2400);
  while (ring.time() < 3 * pi / (2 * w)) {
    ring.step();
    // The speeds given are those of half a step earlier.
    const double expected = 1.5 / w * std::sin(w * (ring.time() - ring.time_step() / 2));
    REQUIRE(ring.right(7).outwards == Approx(expected).margin(1.5 / w * 0.003));
  }
}

TEST_CASE("chain: a spall keeps momentum and energy, and its layers do not grow in number",
          "[accuracy][chain][case13]") {
  const sunder::accuracy::Spall spall{.front_length = 0.05, .fracture_energy = 3};
  for (const int cells : {300, 600}) {
    const auto o = run_spall_on_chain(spall, cells);
    INFO(cells << " cells, " << o.thickness.size() << " layers");
    CHECK(o.momentum == Approx(1).epsilon(1e-12));
    CHECK(o.residual < 1e-12);
    REQUIRE(!o.thickness.empty());
    CHECK(o.thickness.front() == Approx(0.117).margin(0.01));  // (l - r) xi / (2 s0)
    CHECK(std::abs(int(o.thickness.size()) - 3) <= 1);
  }
}

TEST_CASE("chain: rings have nearly Zhou's number of fragments, and as many on twice the cells",
          "[accuracy][chain][case13]") {
  double few = 0, many = 0;
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u, 5u}) {
    const RingBurst ring{.rate = 1.5, .spread = 0.5, .seed = seed, .fracture_energy = 33};
    const auto coarse = run_ring_on_chain(ring, 400), fine = run_ring_on_chain(ring, 800);
    CHECK(fine.residual < 1e-10);
    few += double(coarse.fragments) / 5;
    many += double(fine.fragments) / 5;
  }
  INFO(few << " and " << many);
  CHECK(many == Approx(few).epsilon(0.05));
  CHECK(many == Approx(zhou_fragments({.rate = 1.5, .fracture_energy = 33})).epsilon(0.2));
}

TEST_CASE("chain: strengths are the same function of place on every mesh", "[accuracy][chain]") {
  const RingStrengths strengths{.places = 50};
  const std::vector<double> coarse = strengths_of(strengths, 50),
                            fine = strengths_of(strengths, 200);
  for (std::size_t k = 0; k < 50; ++k) {
    CHECK(fine[4 * k] == coarse[k]);
    CHECK(fine[4 * k + 1] == Approx(0.75 * coarse[k] + 0.25 * coarse[(k + 1) % 50]));
    CHECK((coarse[k] >= 3e6 && coarse[k] < 12e6));
  }
}

TEST_CASE("chain: a pulse is the slope of its integral", "[accuracy][chain]") {
  const Pulse pulse{.front = 0.9, .ramp = 0.05, .length = 0.4, .peak = 4e6};
  CHECK(pulse.integral(0) == Approx(4e6 * 0.4 / 2));
  CHECK(pulse.integral(0.9) == 0);
  CHECK(pulse.stress(0.85) == Approx(4e6));
  for (const double x : {0.45, 0.6, 0.8, 0.87, 0.89}) {
    const double slope = (pulse.integral(x - 1e-6) - pulse.integral(x + 1e-6)) / 2e-6;
    CHECK(slope == Approx(pulse.stress(x)).epsilon(1e-6));
  }
}

TEST_CASE("chain: sizes by Zhou and by Glenn and Chudnovsky", "[accuracy][chain]") {
  // By hand: s0 = 0.11 m; e = 0.46669 and, four times as fast, 1.86676.
  CHECK(zhou_size({}) == Approx(0.1335).epsilon(1e-3));
  CHECK(zhou_size({.rate = 6}) == Approx(0.0633).epsilon(2e-3));
  // As the rate goes to nothing Glenn's size goes to 2 s0, Zhou's to 4.5 s0.
  CHECK(glenn_size({.rate = 1e-6}) == Approx(0.22).epsilon(1e-3));
  CHECK(zhou_size({.rate = 1e-6}) == Approx(0.495).epsilon(1e-2));
}

TEST_CASE("chain: settings without sense are refused", "[accuracy][chain]") {
  CHECK_THROWS_AS(Chain({.strength = {1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(Chain({.step = 1, .strength = {1, 1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(Chain({.fracture_energy = 0, .strength = {1, 1, 1}}), std::invalid_argument);
}
