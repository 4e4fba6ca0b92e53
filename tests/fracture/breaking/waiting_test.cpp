// SPDX-License-Identifier: MIT
// Vertices over their threshold with an empty or refused fan: counted once, tested again when their
// stress changes.
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "tests/support/tension.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// Two tetrahedra under tension, of which only the two tips can break: each has a single
/// tetrahedron, so no plane parts anything.
struct TwoTips {
  Tension body = uniform_tension(two_tetrahedra(), Vec3::UnitZ(), 4e6);
  FractureScratch scratch;

  TwoTips() {
    for (std::size_t v = 0; v < 3; ++v) body.cells.strength[v] = 1e12;
  }
  FractureReport search() { return break_vertices({body.cells, body.state}, {}, scratch); }
  void set_stress(const Vec3& axis, double stress) {
    for (Mat3& s : body.state.elements.stress) s = stress * axis * axis.transpose();
  }
};

Vec3 turned(double degrees) {
  return Eigen::AngleAxisd(degrees * std::acos(-1.0) / 180, Vec3::UnitX()) * Vec3::UnitZ();
}

std::set<std::uint32_t> split_rows(const FractureReport& report) {
  std::set<std::uint32_t> rows;
  for (const FanEvent& fan : report.fans) {
    for (const FaceSplit& split : fan.faces) {
      for (int i = 0; i < split.vertex_count; ++i)
        rows.insert(split.split_vertices[i].old_row.value);
    }
  }
  return rows;
}

}  // namespace

TEST_CASE("a vertex with an empty fan is counted once and waits while its stress stays",
          "[fracture][waiting]") {
  TwoTips tips;
  FractureReport report = tips.search();
  CHECK(report.empty_fans == 2);
  CHECK(report.still_empty == 0);
  CHECK(report.tested == 5);
  for (const double stress : {4e6, 9e6, 3.1e6}) {  // larger or smaller, but over the threshold
    tips.set_stress(Vec3::UnitZ(), stress);
    report = tips.search();
    CHECK(report.empty_fans == 0);
    CHECK(report.still_empty == 2);
    CHECK(report.tested == 3);
    CHECK(report.reached == 0);
  }
}

TEST_CASE("a turn of its stress by half a degree has a waiting vertex tested again, less has not",
          "[fracture][waiting]") {
  TwoTips tips;
  tips.search();
  // |n n^T - m m^T| = sqrt(2) sin(angle): 0.01 at 0.405 degrees from where it began to wait.
  tips.set_stress(turned(0.39), 4e6);
  CHECK(tips.search().still_empty == 2);
  tips.set_stress(turned(-0.39), 4e6);
  CHECK(tips.search().still_empty == 2);
  tips.set_stress(turned(0.42), 4e6);
  CHECK(tips.search().empty_fans == 2);
  tips.set_stress(turned(0.8), 4e6);
  CHECK(tips.search().still_empty == 2);
}

TEST_CASE("a waiting vertex that falls below its threshold is counted again when it comes back",
          "[fracture][waiting]") {
  TwoTips tips;
  tips.search();
  tips.set_stress(Vec3::UnitZ(), 2.9e6);
  FractureReport report = tips.search();
  CHECK(report.still_empty == 0);
  CHECK(report.tested == 5);
  tips.set_stress(Vec3::UnitZ(), 4e6);
  CHECK(tips.search().empty_fans == 2);
}

TEST_CASE("a stress that is not a number is told of a waiting vertex too", "[fracture][waiting]") {
  TwoTips tips;
  tips.search();
  tips.set_stress(Vec3::UnitZ(), std::nan(""));
  CHECK(tips.search().not_a_number);
}

TEST_CASE("a waiting vertex that a neighbour's fan splits waits no longer", "[fracture][waiting]") {
  // Three tetrahedra round the edge 0-1: point 3 belongs to the first two.
  int freed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    Tension body = uniform_tension(open_fan(3), Vec3::UnitZ(), 4e6);
    for (Mat3& s : body.state.elements.stress) {
      for (int i = 0; i < 9; ++i) s(i) = 1e7 * (2 * unit(random) - 1);
      s = (s + s.transpose()).eval();
    }
    std::vector<double>& strength = body.cells.strength;
    strength.assign(body.cells.map.vertices(), 1e12);
    strength[3] = 1e5;
    FractureScratch scratch;
    const FractureReport first = break_vertices({body.cells, body.state}, {}, scratch);
    if (!first.fans.empty() || first.empty_fans == 0) continue;
    REQUIRE(body.cells.empty_fans.size() == 1);
    strength[0] = 1e5;
    const FractureReport report = break_vertices({body.cells, body.state}, {}, scratch);
    CHECK(report.still_empty == 1);
    if (!split_rows(report).contains(3)) continue;
    // It was tested again in the same call, and waits again where its fan is empty still.
    CHECK(body.cells.empty_fans.size() <= report.empty_fans);
    ++freed;
  }
  CHECK(freed > 5);
}

TEST_CASE("a refused fan is counted once while the stress stays", "[fracture][waiting]") {
  Tension body = uniform_tension(two_tetrahedra(), Vec3::UnitZ(), 4e6);
  for (Mat3& s : body.state.elements.stress) s = 4e6 * Mat3::Identity();
  FractureSettings settings;
  settings.max_pieces = 1;
  FractureScratch scratch;
  const FractureReport first = break_vertices({body.cells, body.state}, settings, scratch);
  CHECK(first.refused_fans == 3);
  CHECK(first.empty_fans == 2);
  CHECK(first.fans.empty());
  const FractureReport second = break_vertices({body.cells, body.state}, settings, scratch);
  CHECK(second.refused_fans == 0);
  CHECK(second.still_empty == 5);
  // Another direction: asked again.
  for (Mat3& s : body.state.elements.stress) s = Vec3(4e6, 3e6, 4e6).asDiagonal();
  CHECK(break_vertices({body.cells, body.state}, settings, scratch).refused_fans == 3);
}

TEST_CASE("the question whether anything breaks splits nothing, and leaves out vertices that wait",
          "[fracture][waiting]") {
  TwoTips tips;
  const auto asks = [&] {
    return any_breaks({tips.body.cells, tips.body.state}, {}, tips.scratch, {});
  };
  tips.set_stress(Vec3::UnitZ(), 2.9e6);
  CHECK_FALSE(asks());
  tips.set_stress(Vec3::UnitZ(), 4e6);
  CHECK(asks());
  CHECK(tips.search().empty_fans == 2);
  CHECK_FALSE(asks());
  CHECK(tips.search().still_empty == 2);
  tips.set_stress(turned(0.42), 4e6);
  CHECK(asks());
  CHECK_FALSE(any_breaks({tips.body.cells, tips.body.state}, {.mode = FractureMode::off},
                         tips.scratch, {}));
}

TEST_CASE("something breaks where the search for fractures reaches a threshold, and only there",
          "[fracture][waiting]") {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> strength(2.97e6, 4.5e6);
  int broken = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Tension body = uniform_tension(kuhn_box({2, 2, 2}), Vec3::UnitZ(), 3e6);
    for (double& xi : body.cells.strength) xi = strength(random);
    FractureScratch scratch;
    const bool asked = any_breaks({body.cells, body.state}, {}, scratch, {});
    const FractureReport report = break_vertices({body.cells, body.state}, {}, scratch);
    CHECK(asked == (report.reached > 0));
    broken += asked;
  }
  CHECK(broken > 0);
  CHECK(broken < 40);
}
