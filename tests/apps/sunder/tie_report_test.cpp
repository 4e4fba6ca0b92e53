// SPDX-License-Identifier: MIT
// Releases of a bar that is pulled in two: their lines in the log, and sums by crack.
#include "apps/sunder/run/report/tie_report.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/sunder/run/event_log.hpp"
#include "fracture/scene/cohesive_settings.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;
using Catch::Detail::Approx;
using nlohmann::ordered_json;

TEST_CASE("releases are told once, after the fans that tied them, and add up by crack", "[ties]") {
  constexpr double cell = 0.05, energy = 33;
  Scene scene;
  BodySettings bar{.name = "bar", .mesh = suite::kuhn_box({16, 8, 2}, cell)};
  bar.material.fracture_energy = energy;
  bar.held = {
      {.minimum = {-1, -1, -1}, .maximum = {1e-4, 9, 9}},
      {.minimum = {16 * cell - 1e-4, -1, -1}, .maximum = {9, 9, 9}, .velocity = {0.05, 0, 0}}};
  bar.cuts = {{.faces = CutPlane{.point = {8 * cell, 0, 0}, .normal = {1, 0, 0}},
               .box = RestBox{{-1, -1, -1}, {9, 2 * cell + 1e-4, 9}},
               .ball = {}}};
  scene.bodies.push_back(std::move(bar));
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = 1e-4;
  scene.fracture.crack = CrackMode::cohesive;
  Simulation sim = built(std::move(scene));

  TieStatistics statistics;
  std::uint64_t fans = 0, releases = 0;
  std::set<std::set<std::uint32_t>> tied;  // faces by their points
  std::size_t faces = 0, born = 0;
  double area = 0, taken = 0;
  while (simulated_time(sim) < 2.5e-3) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    const std::uint64_t fans_before = fans, releases_before = releases;
    std::pair<std::uint64_t, std::uint64_t> place;
    std::size_t created = 0;
    for (const ordered_json& line :
         events_of(report, fans_before, releases_before, sim.state->cells.map)) {
      CHECK(line["step"] == report.step);
      const std::pair<std::uint64_t, std::uint64_t> now{line["part"], line.contains("fan")};
      CHECK(now >= place);  // releases of a part come first
      place = now;
      created += line["new_components"].size();
      if (line.contains("fan")) {
        CHECK(line["fan"] == fans++);
        CHECK(line["new_components"].empty());
      } else {
        CHECK(line["release"] == releases++);
      }
      for (const ordered_json& face : line["faces"]) {
        const std::set<std::uint32_t> points(face["points"].begin(), face["points"].end());
        if (line.contains("fan")) {
          CHECK(tied.insert(points).second);
          continue;
        }
        CHECK(tied.erase(points) == 1);
        ++faces;
        area += face["projected_area"].get<double>();
        taken += face["energy"].get<double>();
      }
    }
    CHECK(created == report.new_components.size());
    born += created;
    note_ties(statistics, report);
  }
  CHECK(born == 1);
  CHECK(tied.size() == sim.state->contact.ties.size());
  const double section = 6 * cell * 2 * cell;
  CHECK(area == Approx(section).epsilon(0.01));
  CHECK(taken == Approx(energy * area).epsilon(1e-6));

  const ordered_json told = tie_report(statistics, sim);
  CHECK(told["releases"] == releases);
  CHECK(told["released_faces"] == faces);
  CHECK(told["tied_faces"] == tied.size());
  CHECK(told["released_projected_area"].get<double>() == Approx(area).epsilon(1e-12));
  CHECK(told["fracture_energy_of_released"].get<double>() == Approx(energy * area).epsilon(1e-12));
  CHECK(told["dissipated"].get<double>() == Approx(taken).epsilon(1e-6));
  double of_cracks = 0;
  std::size_t of_faces = 0;
  for (const ordered_json& crack : told["cracks"]) {
    of_cracks += crack["energy"].get<double>();
    of_faces += crack["released_faces"].get<std::size_t>();
  }
  CHECK(of_cracks == Approx(told["dissipated"].get<double>()).epsilon(1e-12));
  CHECK(of_faces == faces);
  REQUIRE(told["materials"].size() == 1);
  const ordered_json& material = told["materials"][0];
  CHECK(material["cell"].get<double>() == Approx(cell));
  CHECK(material["softening_length_over_cell"].get<double>() ==
        Approx(30e9 * energy / 9e12 / cell));
}
