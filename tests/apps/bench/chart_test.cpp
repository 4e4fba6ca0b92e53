// SPDX-License-Identifier: MIT
// The parts of charts: the front, finer meshes, the grid, the measures.
#include "apps/bench/chart/chart.hpp"

#include <unistd.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "apps/bench/chart/chart_mesh.hpp"
#include "apps/bench/chart/chart_pareto.hpp"
#include "apps/bench/chart/chart_report.hpp"
#include "topology/mesh/check.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

Eigen::Vector3d at(const TetMesh& mesh, std::uint32_t row) {
  const Point& p = mesh.points[row];
  return {p[0], p[1], p[2]};
}

double volume(const TetMesh& mesh, std::size_t t) {
  const auto [a, b, c, d] = mesh.tetrahedra[t];
  const Eigen::Vector3d o = at(mesh, a);
  return (at(mesh, b) - o).cross(at(mesh, c) - o).dot(at(mesh, d) - o) / 6;
}

/// A folder with a scene of the sample cube in it; gone at the end.
struct SceneFolder {
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("sunder_chart_test_" + std::to_string(getpid()));
  std::filesystem::path scene = folder / "scene.json";
  explicit SceneFolder(nlohmann::json more) {
    std::filesystem::create_directories(folder);
    nlohmann::json body = {{"mesh", SUNDER_MESHES "/cube.msh"}};
    if (more.contains("body")) body.update(more["body"]);
    more.erase("body");
    nlohmann::json json = {{"bodies", {body}}, {"time_step", 1e-3}, {"duration", 1e-2}};
    json.update(more);
    std::ofstream(scene) << json;
  }
  ~SceneFolder() { std::filesystem::remove_all(folder); }
};

/// The value of a quantity after the scene ran as it is.
ChartOutcome run(const SceneFolder& here, const Probe& probe,
                 const std::vector<std::string>& changes = {}) {
  ChartRunner runner;
  runner.scene = here.scene;
  runner.probe = probe;
  runner.refinements = {0};
  return run_chart(runner, changes, 0, false);
}

}  // namespace

TEST_CASE("nothing dominates the front, and all that is off it is dominated", "[run][chart]") {
  const auto seed = GENERATE(1u, 2u, 3u);
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 200; ++round) {
    // Few different numbers, so that ties are many.
    std::vector<CostError> points(random() % 12);
    for (CostError& p : points) {
      p = {static_cast<double>(random() % 6), static_cast<double>(random() % 6)};
    }
    const std::vector<std::size_t> front = pareto_front(points);
    const std::set<std::size_t> on(front.begin(), front.end());
    CHECK(on.size() == front.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool beaten = false, equal_before = false;
      for (std::size_t j = 0; j < points.size(); ++j) {
        beaten |= dominates(points[j], points[i]);
        equal_before |=
            j < i && points[j].cost == points[i].cost && points[j].error == points[i].error;
      }
      CHECK(on.contains(i) == (!beaten && !equal_before));
    }
    for (std::size_t k = 1; k < front.size(); ++k) {
      CHECK(points[front[k - 1]].cost < points[front[k]].cost);
      CHECK(points[front[k - 1]].error > points[front[k]].error);
    }
    const double asked = static_cast<double>(random() % 6);
    const auto best = cheapest_within(points, asked);
    for (const CostError& p : points) {
      if (p.error > asked) continue;
      REQUIRE(best);
      CHECK(points[*best].cost <= p.cost);
    }
    if (best) CHECK(points[*best].error <= asked);
  }
}

TEST_CASE("a finer mesh is the same body in eighths", "[run][chart]") {
  for (const auto& [name, coarse] : suite::all_shapes()) {
    INFO(name);
    const TetMesh fine = refined(coarse);
    REQUIRE(fine.tetrahedra.size() == 8 * coarse.tetrahedra.size());
    for (std::size_t p = 0; p < coarse.points.size(); ++p) {
      CHECK(fine.points[p] == coarse.points[p]);
    }
    for (std::size_t t = 0; t < fine.tetrahedra.size(); ++t) {
      CHECK(volume(fine, t) == Approx(volume(coarse, t / 8) / 8).margin(1e-15));
    }
  }
  // Conforming: the checks of meshes find nothing, and twice refined is refined.
  const TetMesh cube = suite::jittered(suite::kuhn_box({2, 1, 1}), 0.1, 5);
  CHECK_FALSE(has_error(check_mesh(refined(refined(cube)))));
  CHECK(refined(refined(cube)).tetrahedra.size() == 64 * cube.tetrahedra.size());
}

TEST_CASE("the grid crosses everything once, with whole steps from long to short", "[run][chart]") {
  ChartGrid grid;
  for (std::size_t m = 0; m < chart_methods().size(); ++m) grid.methods.push_back(m);
  grid.steps = {1e-3, 4e-3, 3e-4};
  grid.wall_shares = {0.9, 0.3};
  grid.windows = {0, 1};
  grid.variants = {"contact.max_iterations=10", "contact.max_iterations=40"};
  grid.bounds = {1e-5, 5e-6};
  grid.duration = 0.1;
  const std::vector<ChartSetting> all = chart_settings(grid);
  std::set<std::string> seen;
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::string text = std::to_string(all[k].mesh);
    for (const std::string& c : all[k].changes) text += " " + c;
    CHECK(seen.insert(text).second);
    const double steps = grid.duration / all[k].step;
    CHECK(std::abs(steps - std::round(steps)) < 1e-6);
    if (k > 0 && all[k].series == all[k - 1].series) CHECK(all[k].step < all[k - 1].step);
    const ChartMethod& method = chart_methods()[all[k].method];
    if (method.has_wall) CHECK(all[k].step <= 0.9 * grid.bounds[all[k].mesh]);
    if (!method.has_windows) CHECK_FALSE(all[k].has_window);
  }
  std::size_t expected = 0;
  for (const ChartMethod& m : chart_methods()) {
    expected += 4 * (m.has_windows ? 2 : 1) * (m.has_wall ? 2 : 3);
  }
  CHECK(all.size() == expected);
  CHECK(whole_step(1, 0.3) == 0.25);
  CHECK(whole_step(1, 0.25) == 0.25);
  CHECK(whole_step(1, 7) == 1);
}

TEST_CASE("measures of a free flight are those of mechanics", "[run][chart]") {
  // Turning about an axis of symmetry, without gravity: everything is known.
  const SceneFolder here({{"body", {{"velocity", {1, 2, 3}}, {"spin", {0, 0, 5}}}},
                          {"gravity", {{"acceleration", {0, 0, 0}}}},
                          {"fracture", {{"mode", "off"}}}});
  // Density 2400, 2 x 2 x 2 m; lumped at 27 vertices; middle at (1, 1, 1).
  const double mass = 8 * 2400;
  const Vec3 velocity(1, 2, 3);
  const ChartOutcome p = run(here, {Quantity::momentum, {}});
  CHECK((p.value - mass * velocity).norm() < 1e-9 * mass);
  const ChartOutcome e = run(here, {Quantity::energy, {}});
  CHECK(e.value[0] == Approx(e.at_start[0]).epsilon(1e-6));
  const ChartOutcome l = run(here, {Quantity::angular_momentum, {}});
  CHECK((l.value - l.at_start).norm() < 1e-9 * l.at_start.norm());
  const ChartOutcome middle = run(here, {Quantity::position, {1, 1, 1}});
  CHECK((middle.at_start - Vec3(1, 1, 1)).norm() < 1e-12);
  CHECK((middle.value - middle.at_start - 0.01 * velocity).norm() < 1e-6);
  CHECK(middle.scale == Approx(0.01 * velocity.norm()).epsilon(1e-4));
  // A point of no vertex: it turns with its tetrahedron.
  const ChartOutcome off = run(here, {Quantity::position, {1.5, 1, 1}});
  const Vec3 arm(0.5 * std::cos(0.05), 0.5 * std::sin(0.05), 0);
  CHECK((off.value - middle.value - arm).norm() < 2e-4);
  CHECK(run(here, {Quantity::largest_piece, {}}).value[0] == Approx(1).epsilon(1e-12));
  const ChartOutcome none = run(here, {Quantity::first_fan_time, {}});
  CHECK(none.end == ChartEnd::nothing_broke);
  CHECK(run(here, {Quantity::momentum, {}}, {"bodies.0.mesh=nowhere.msh"}).end ==
        ChartEnd::refused);
}

TEST_CASE("the stress of a pulled cube is its pressure, and its crack has a time and a place",
          "[run][chart]") {
  nlohmann::json load = {{"minimum", {0, 0, 2}}, {"maximum", {2, 2, 2}}, {"pressure", -1e5}};
  nlohmann::json other = {{"minimum", {0, 0, 0}}, {"maximum", {2, 2, 0}}, {"pressure", -1e5}};
  load["ramp_time"] = other["ramp_time"] = 0.1;
  const SceneFolder here({{"body",
                           {{"loads", {load, other}},
                            {"material", {{"poisson_ratio", 0}, {"tensile_strength", 5e4}}}}},
                          {"gravity", {{"acceleration", {0, 0, 0}}}},
                          {"duration", 0.1}});
  const std::vector<std::string> whole = {"fracture.mode=off"};
  CHECK(run(here, {Quantity::end_stress, {}}, whole).value[0] == Approx(1e5).epsilon(1e-2));
  CHECK(run(here, {Quantity::peak_stress, {}}, whole).value[0] == Approx(1e5).epsilon(2e-2));
  // Half the load at half the time, to a step.
  const ChartOutcome when = run(here, {Quantity::first_fan_time, {}});
  REQUIRE(when.end == ChartEnd::fine);
  CHECK(when.value[0] == Approx(0.05).margin(2.1e-3));
  CHECK(when.fans > 0);
  CHECK(run(here, {Quantity::fans, {}}).value[0] == static_cast<double>(when.fans));
  const ChartOutcome where = run(here, {Quantity::first_fan_place, {}});
  CHECK(where.value.minCoeff() >= 0);
  CHECK(where.value.maxCoeff() <= 2);
  CHECK(where.scale == Approx(std::sqrt(12)));
}

TEST_CASE("a chart's errors are against its reference, and its answer reads back as a scene",
          "[run][chart]") {
  const SceneFolder here(
      {{"body", {{"spin", {3, 1, 2}}, {"velocity", {0, 0, 2}}}}, {"fracture", {{"mode", "off"}}}});
  ChartArguments arguments;
  arguments.scene = here.scene;
  arguments.methods = {"floating_frame", "implicit_euler", "broyden, mass (paper)"};
  arguments.steps = {5e-3, 1e-3};
  arguments.levels = 1;
  std::size_t told = 0;
  const Result<Chart> chart = make_chart(arguments, [&](const std::string&) { ++told; });
  REQUIRE(chart);
  CHECK(chart->points.size() == 16);
  CHECK(told == 16 + 3);
  CHECK(chart->tetrahedra == std::vector<std::size_t>{48, 384});
  CHECK(chart->reference.own_error > 0);
  for (const ChartPoint& p : chart->points) {
    REQUIRE(p.outcome.end == ChartEnd::fine);
    const double distance = (p.outcome.value - chart->reference.value).norm();
    CHECK(p.error == Approx(distance / chart->reference.scale));
    CHECK(p.outcome.cost > 0);
    CHECK(p.lasting_error >= p.error);
    for (const ChartPoint& other : chart->points) {
      const ChartSetting& s = other.setting;
      if (s.series == p.setting.series && s.step <= p.setting.step) {
        CHECK(p.lasting_error >= other.error);
      }
    }
  }
  REQUIRE(chart->default_point);
  REQUIRE(chart->paper_point);
  CHECK(chart->points[*chart->default_point].setting.method == 0);
  CHECK(chart->points[*chart->paper_point].setting.method == paper_method());
  CHECK(counted_error(chart->reference, 0) == chart->reference.own_error);

  const nlohmann::ordered_json paste = setting_json(chart->points[*chart->paper_point].setting);
  CHECK(paste["integrator"]["method"] == "broyden");
  CHECK(paste["time_step"].get<double>() < 1e-3);
  CHECK(chart->points[*chart->paper_point].outcome.given_up == 0);
  const std::string csv = chart_csv(*chart);
  CHECK(std::ranges::count(csv, '\n') == 4 + 16);
  CHECK(chart_json(*chart)["points"].size() == 16);
}

TEST_CASE("runs that fail or take too long are rows with a reason", "[run][chart]") {
  const SceneFolder here({{"fracture", {{"mode", "off"}}},
                          {"body", {{"spin", {9, 1, 2}}}},
                          {"gravity", {{"acceleration", {0, 0, 0}}}}});
  ChartArguments arguments;
  arguments.scene = here.scene;
  arguments.methods = {"verlet"};
  arguments.exact = "start";
  arguments.quantity = "angular_momentum";
  arguments.levels = 0;
  arguments.settings = {"bodies.0.material.young_modulus=1e9", "duration=1"};
  Result<Chart> chart = make_chart(arguments, [](const std::string&) {});
  REQUIRE(chart);
  CHECK(chart->reference.own_error == 0);
  // Twice the bound of elements is beyond the true one.
  CHECK(chart->points.front().outcome.end == ChartEnd::failed);
  CHECK_FALSE(chart->points.front().outcome.reason.empty());
  CHECK(chart->points.back().outcome.end == ChartEnd::fine);
  CHECK(chart_csv(*chart).find("failed") != std::string::npos);

  arguments.limit = 1e-9;
  chart = make_chart(arguments, [](const std::string&) {});
  REQUIRE(chart);
  CHECK(chart->points[0].outcome.end == ChartEnd::over_limit);
  CHECK(chart->points[1].outcome.end == ChartEnd::skipped);
  CHECK(chart->front.empty());
  CHECK_FALSE(chart->cheapest);
}
