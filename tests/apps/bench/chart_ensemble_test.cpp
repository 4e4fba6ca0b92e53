// SPDX-License-Identifier: MIT
// Runs with negligible differences: the moved quantities, by how much, and the spread of values.
#include "apps/bench/chart/chart_ensemble.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "apps/bench/chart/chart.hpp"
#include "apps/bench/chart/chart_report.hpp"
#include "tests/support/program.hpp"

using namespace sunder;
using nlohmann::json;

namespace {

/// A cube thrown at the floor, of which it breaks in part within a few steps.
std::string thrown_cube(const test::Workplace& here) {
  const json text = {{"bodies",
                      {{{"mesh", test::sample_mesh("cube.msh")},
                        {"material", {{"young_modulus", 1e8}, {"tensile_strength", 1e4}}},
                        {"translation", {0, 0, 0.42}},
                        {"rotation", {{"axis", {1, 2, 3}}, {"angle", 20}}},
                        {"velocity", {0, 0, -20}}}}},
                     {"obstacles", {{{"plane", {{"normal", {0, 0, 1}}}}}}},
                     {"time_step", 1e-3},
                     {"fracture", {{"crack", "paper"}}},
                     {"duration", 0.008}};
  return here.write("scene.json", text.dump());
}

/// The chart of one setting.
Chart chart_of(ChartArguments arguments) {
  arguments.methods = {"floating_frame"};
  arguments.steps = {1e-3};
  arguments.windows = {"on"};
  arguments.levels = 0;
  arguments.exact = "1";
  Result<Chart> chart = make_chart(arguments, [](const std::string&) {});
  for (const Finding& f : chart.findings) UNSCOPED_INFO(f.text);
  REQUIRE(chart);
  REQUIRE(chart->points.size() == 1);
  return *chart;
}

Chart chart_of(const std::string& scene, const std::string& quantity, std::size_t members) {
  ChartArguments arguments;
  arguments.scene = scene;
  arguments.quantity = quantity;
  arguments.members = members;
  return chart_of(std::move(arguments));
}

}  // namespace

TEST_CASE("a scene moved by nothing differs by nothing that counts, but differs", "[run][chart]") {
  Scene scene;
  scene.bodies.resize(2);
  scene.bodies[0].strength.painted = {1e6, 2e6};
  scene.bodies[0].material.toughness = 1e5;
  Scene same = scene, first = scene, again = scene, second = scene;
  move_by_nothing(same, 0);
  move_by_nothing(first, 1);
  move_by_nothing(again, 1);
  move_by_nothing(second, 2);
  for (std::size_t b = 0; b < 2; ++b) {
    const BodySettings &was = scene.bodies[b], &is = first.bodies[b];
    CHECK(same.bodies[b].translation == was.translation);
    CHECK(same.bodies[b].material.tensile_strength == was.material.tensile_strength);
    CHECK(again.bodies[b].translation == is.translation);
    CHECK(second.bodies[b].translation != is.translation);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      CHECK(is.translation[axis] != 0);
      CHECK(std::abs(is.translation[axis]) <= 1e-12);
      CHECK(is.velocity[axis] != 0);
      CHECK(std::abs(is.velocity[axis]) <= 1e-12);
    }
    const double factor = is.material.tensile_strength / was.material.tensile_strength;
    CHECK(factor != 1);
    CHECK(std::abs(factor - 1) <= 1e-6);
    for (std::size_t k = 0; k < was.strength.painted.size(); ++k) {
      CHECK(is.strength.painted[k] == Approx(was.strength.painted[k] * factor).epsilon(1e-14));
    }
  }
  CHECK(*first.bodies[0].material.toughness != 1e5);
}

TEST_CASE("a band is the mean, the ends and the deviation of values", "[run][chart]") {
  const std::vector<Vec3> values = {{1, 0, 5}, {2, 0, 5}, {6, 0, 5}};
  const ChartBand band = band_of(values);
  CHECK((band.mean - Vec3(3, 0, 5)).norm() < 1e-14);
  CHECK(band.low == Vec3(1, 0, 5));
  CHECK(band.high == Vec3(6, 0, 5));
  CHECK(band.deviation == Approx(std::sqrt(7.0)));  // (4 + 1 + 9) / 2
  const std::vector<Vec3> one = {{0.1, 0.2, 0.3}};
  CHECK(band_of(one).mean == one[0]);
  CHECK(band_of(one).deviation == 0);
}

TEST_CASE("an ensemble's first run is that of the scene, and its mean that of its runs",
          "[run][chart]") {
  const test::Workplace here;
  const std::string scene = thrown_cube(here);
  const Chart alone = chart_of(scene, "pieces", 1), three = chart_of(scene, "pieces", 3);
  const ChartOutcome& outcome = three.points[0].outcome;
  REQUIRE(outcome.values.size() == 3);
  CHECK(outcome.values[0] == alone.points[0].outcome.value);
  CHECK(outcome.values[0][0] > 1);
  CHECK(outcome.value[0] ==
        Approx((outcome.values[0] + outcome.values[1] + outcome.values[2])[0] / 3));
  // One piece of 42 of the 48 equal tetrahedra is left; all others have less than eight.
  const double debris = chart_of(scene, "debris", 1).points[0].outcome.value[0];
  CHECK(chart_of(scene, "largest_piece", 1).points[0].outcome.value[0] == Approx(42. / 48));
  CHECK(debris == Approx(6. / 48));
  CHECK(chart_csv(three).find("value,deviation,low,high,error") != std::string::npos);
  CHECK(chart_script(three).find("yerrorbars") != std::string::npos);
  CHECK(chart_script(alone).find("yerrorbars") == std::string::npos);
  CHECK(chart_json(three)["points"][0]["runs_moved_by_nothing"] == 3);
}

TEST_CASE("meshes that are an ensemble run once each, none of them moved", "[run][chart]") {
  const test::Workplace here;
  ChartArguments arguments;
  arguments.scene = thrown_cube(here);
  arguments.quantity = "pieces";
  const auto on = [&](const std::vector<std::string>& meshes, bool over_meshes) {
    arguments.meshes = meshes;
    arguments.over_meshes = over_meshes;
    return chart_of(arguments);
  };
  const std::string cube = test::sample_mesh("cube.msh"), bar = test::sample_mesh("bar.msh");
  const Chart both = on({cube, bar}, true);
  const Chart of_cube = on({cube}, false), of_bar = on({bar}, false);
  CHECK(both.members == 2);
  REQUIRE(both.tetrahedra.size() == 1);
  CHECK(both.tetrahedra[0] == (of_cube.tetrahedra[0] + of_bar.tetrahedra[0]) / 2);
  const ChartOutcome& outcome = both.points[0].outcome;
  REQUIRE(outcome.values.size() == 2);
  CHECK(outcome.values[0] == of_cube.points[0].outcome.value);
  CHECK(outcome.values[1] == of_bar.points[0].outcome.value);
  CHECK(outcome.values[0] != outcome.values[1]);
  CHECK(outcome.value[0] == Approx((outcome.values[0] + outcome.values[1])[0] / 2));
  CHECK(chart_json(both)["points"][0]["meshes"] == 2);
}

TEST_CASE("a position moved by nothing ends a nothing away", "[run][chart]") {
  const test::Workplace here;
  const json flight = {{"bodies", {{{"mesh", test::sample_mesh("cube.msh")}, {"spin", {1, 2, 3}}}}},
                       {"fracture", {{"mode", "off"}}},
                       {"duration", 0.01}};
  ChartRunner runner;
  runner.scene = here.write("flight.json", flight.dump());
  runner.refinements = {0};
  const ChartOutcome outcome = run_ensemble(runner, 4, {}, 0, false);
  REQUIRE(outcome.end == ChartEnd::fine);
  REQUIRE(outcome.values.size() == 4);
  const ChartBand band = band_of(outcome.values);
  CHECK(band.deviation > 0);
  CHECK(band.deviation < 1e-11);
}

TEST_CASE("an ensemble in which nothing broke has no value", "[run][chart]") {
  const test::Workplace here;
  ChartRunner runner;
  runner.scene = thrown_cube(here);
  runner.refinements = {0};
  runner.probe.quantity = Quantity::first_fan_time;
  const ChartOutcome outcome =
      run_ensemble(runner, 2, std::vector<std::string>{"fracture.mode=off"}, 0, false);
  CHECK(outcome.end == ChartEnd::nothing_broke);
  CHECK(outcome.values.empty());
}

TEST_CASE("the scenes of the ensembles are read and built", "[run][chart]") {
  const auto name = GENERATE("ball", "pane");
  INFO(name);
  ChartRunner runner;
  runner.scene = std::filesystem::path(SUNDER_SCENES) / "ensembles" / (std::string(name) + ".json");
  runner.refinements = {0};
  const Result<Simulation> sim = chart_simulation(runner, {}, 0);
  for (const Finding& f : sim.findings) UNSCOPED_INFO(f.text);
  REQUIRE(sim);
  CHECK(sim->state->mechanics.components.size() == 1);
}
