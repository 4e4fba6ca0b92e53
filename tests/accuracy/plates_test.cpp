// SPDX-License-Identifier: MIT
// Plates of published cracks: their meshes, measurements of cracks, and a coarse run.
#include "tests/experiments/cases/plates.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "fracture/simulation/simulation_state.hpp"

using namespace sunder;
using namespace sunder::accuracy;

TEST_CASE("a plate's tetrahedra fill it, and its lines are edges", "[accuracy][plates]") {
  for (const PlateCells cells : {PlateCells::kuhn, PlateCells::cross, PlateCells::delaunay}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const PlateShape shape{.length = 0.1,
                             .height = 0.05,
                             .cell = 0.005,
                             .thickness = 0.004,
                             .layers = 2,
                             .cells = cells,
                             .seed = seed,
                             .lines = {{0, 0.05, 0.025}}};
      const TetMesh mesh = plate_mesh(shape);
      double volume = 0;
      std::set<double> on_line;
      for (const auto& t : mesh.tetrahedra) {
        const auto at = [&](std::size_t k) {
          return Vec3(mesh.points[t[k]][0], mesh.points[t[k]][1], mesh.points[t[k]][2]);
        };
        const double six = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0));
        REQUIRE(six > 0);
        volume += six / 6;
        // No tetrahedron lies on both sides of the line.
        bool above = false, below = false;
        for (std::size_t k = 0; k < 4; ++k) {
          if (at(k).x() > 0.05 + 1e-9) continue;
          above = above || at(k).y() > 0.025 + 1e-9;
          below = below || at(k).y() < 0.025 - 1e-9;
          if (std::abs(at(k).y() - 0.025) < 1e-12) on_line.insert(at(k).x());
        }
        REQUIRE_FALSE((above && below && at(0).x() < 0.05 && at(1).x() < 0.05 && at(2).x() < 0.05 &&
                       at(3).x() < 0.05));
      }
      CHECK(volume == Approx(0.1 * 0.05 * 0.008).epsilon(1e-12));
      CHECK(on_line.size() == 11);
    }
  }
}

TEST_CASE("no point lies in the circle of a Delaunay triangle", "[accuracy][plates]") {
  std::vector<std::array<double, 2>> points;
  for (int k = 0; k < 60; ++k) {
    points.push_back({std::fmod(0.618034 * k, 1), std::fmod(0.754878 * k, 1)});
  }
  const std::vector<Triangle> triangles = delaunay(points);
  CHECK(triangles.size() > 90);
  for (const Triangle& t : triangles) {
    for (const auto& p : points) {
      Eigen::Matrix3d m;
      for (int r = 0; r < 3; ++r) {
        const double x = points[t[std::size_t(r)]][0] - p[0];
        const double y = points[t[std::size_t(r)]][1] - p[1];
        m.row(r) << x, y, x * x + y * y;
      }
      CHECK(m.determinant() < 1e-12);
    }
  }
}

namespace {

CrackTrace released_at(double x, double y) { return {.x = x, .y = y, .released = true}; }

}  // namespace

TEST_CASE("tips, forks, angles and speeds are what they are by hand", "[accuracy][plates]") {
  PlateCase plate;
  plate.shape.cell = 0.001;
  plate.notch = {0, 0.05, 0.02};
  std::vector<CrackTrace> traces;
  for (int k = 0; k < 10; ++k) traces.push_back(released_at(0.0505 + 0.001 * k, 0.02));
  TipPlace tip = tip_of(traces, plate, 1e-6);
  CHECK(tip.reach == Approx(0.0095));
  CHECK(tip.branches == 1);
  CHECK(tip.fork == 0);
  for (int k = 1; k < 10; ++k) {
    for (const double side : {-1.0, 1.0}) {
      traces.push_back(released_at(0.0595 + 0.0008 * k, 0.02 + side * 0.0006 * k));
    }
  }
  traces.push_back(released_at(0.09, 0.03));  // hangs together with nothing
  traces.push_back({.x = 0.08, .y = 0.02});   // tied
  tip = tip_of(traces, plate, 2e-6);
  CHECK(tip.branches == 2);
  CHECK(tip.fork == Approx(0.013).margin(0.0021));
  CHECK(tip.reach == Approx(std::hypot(0.0095 + 0.0072, 0.0054)));
  CHECK(tip.tied == Approx(std::hypot(0.04, 0.01)));
  std::vector<CrackTrace> steep;
  for (int k = 1; k < 20; ++k) {
    const double turn = 110 * std::numbers::pi / 180;
    steep.push_back(
        released_at(0.05 + 0.001 * k * std::cos(turn), 0.02 + 0.001 * k * std::sin(turn)));
  }
  CHECK(crack_angle(steep, plate, 0, 1) == Approx(110));
  std::vector<TipPlace> history;
  for (int k = 0; k < 10; ++k) history.push_back({.time = 1e-6 * k, .reach = 1e-3 * k});
  for (const double speed : tip_speeds(history)) CHECK(speed == Approx(1000));
}

TEST_CASE("the branching plate's crack runs on along the middle below its limiting speed",
          "[accuracy][plates]") {
  const PlateCase plate = branching_plate({.cell = 0.005});
  auto built = build_simulation(plate.scene);
  REQUIRE(built);
  Simulation sim = std::move(*built);
  double residual = 0, moved = 0;
  while (simulated_time(sim) < 40e-6) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    residual += report.energy.residual;
    moved += report.energy.moved;
  }
  const TipPlace tip = tip_of(crack_traces(sim, plate), plate, simulated_time(sim));
  CHECK(tip.reach > 0.005);
  CHECK(tip.reach < 40e-6 * 1275);
  CHECK(std::abs(tip.y - 0.02) < 0.006);
  CHECK(std::abs(residual) < 1e-9 * moved);
}
