// SPDX-License-Identifier: MIT
// Strengths of regions and vertices, Weibull's law, unbreakable parts, and cracks at the start.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "fracture/simulation/simulation_state.hpp"
#include "fracture/strength/draw_strength.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tension.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// A bar of 0.6 x 0.2 x 0.2 m, pulled at both ends.
Scene pulled_bar(TetMesh mesh) {
  Scene scene;
  scene.bodies.push_back({.name = "bar", .mesh = std::move(mesh)});
  scene.bodies[0].held = {
      {.minimum = {-0.02, -1, -1}, .maximum = {0.02, 1, 1}, .velocity = {-0.001, 0, 0}},
      {.minimum = {0.58, -1, -1}, .maximum = {0.62, 1, 1}, .velocity = {0.001, 0, 0}}};
  scene.gravity.acceleration.setZero();
  return scene;
}

TetMesh bar() { return jittered(kuhn_box({6, 2, 2}, 0.1), 0.01, 4); }

std::vector<std::string> error_codes(const Scene& scene) {
  std::vector<std::string> codes;
  for (const Finding& f : build_simulation(scene).findings) {
    if (f.severity == Severity::error) codes.push_back(f.code);
  }
  return codes;
}

/// Pa: the stress that a uniformly stressed mesh of the strength 1 Pa at 1 m^3 bears before its
/// first vertex reaches its strength.
double weakest(const TetMesh& mesh, const WeibullSettings& settings) {
  std::vector<double> volume(mesh.points.size(), 0);
  for (const auto& t : mesh.tetrahedra) {
    std::array<Vec3, 4> p;
    for (int a = 0; a < 4; ++a) p[a] = Vec3(mesh.points[t[a]].data());
    const double v = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6;
    for (const std::uint32_t a : t) volume[a] += v / 4;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < volume.size(); ++i) {
    if (volume[i] > 0) least = std::min(least, weibull_factor(settings, {0, i, volume[i]}));
  }
  return least;
}

/// Mean of `weakest` over 1 000 seeds.
double mean_strength(const TetMesh& mesh, double modulus) {
  double sum = 0;
  for (std::uint32_t seed = 0; seed < 1000; ++seed) {
    sum += weakest(mesh, {.modulus = modulus, .reference_volume = 1, .seed = seed});
  }
  return sum / 1000;
}

}  // namespace

TEST_CASE("1 000 Weibull bars of three sizes and two meshes have the mean of the closed form",
          "[fracture][strength]") {
  // Lengths in units of 0.1 m; the last two are one bar on two meshes.
  const std::vector<std::pair<TetMesh, double>> bars = {
      {kuhn_box({3, 1, 1}, 0.1), 0.003},
      {kuhn_box({6, 2, 2}, 0.1), 0.024},
      {kuhn_box({12, 4, 4}, 0.1), 0.192},
      {jittered(kuhn_box({6, 2, 2}, 0.2), 0.02, 4), 0.192}};
  for (const double m : {6.0, 12.0}) {
    for (const auto& [mesh, volume] : bars) {
      INFO("modulus " << m << ", " << volume << " m^3, " << mesh.tetrahedra.size()
                      << " tetrahedra");
      double closed = std::pow(volume, -1 / m) * std::tgamma(1 + 1 / m);
      CHECK(mean_strength(mesh, m) == Approx(closed).epsilon(0.02));
    }
  }
}

TEST_CASE("a strength drawn has the law's own value for its uniform number",
          "[fracture][strength]") {
  // The mean of the m-th power is that of -ln U, which is 1; a law over the seeds.
  double sum = 0;
  for (std::uint32_t seed = 0; seed < 20000; ++seed) {
    sum +=
        std::pow(weibull_factor({.modulus = 5, .reference_volume = 2, .seed = seed}, {1, 7, 2}), 5);
  }
  CHECK(sum / 20000 == Approx(1).epsilon(0.03));
  const WeibullSettings w{.modulus = 5, .reference_volume = 1, .seed = 3};
  const double whole = weibull_factor(w, {0, 0, 1}), eighth = weibull_factor(w, {0, 0, 0.125});
  CHECK(eighth / whole == Approx(std::pow(8, 0.2)).epsilon(1e-14));
  CHECK(weibull_factor(w, {0, 1, 1}) != whole);
  CHECK(weibull_factor(w, {1, 0, 1}) != whole);
}

TEST_CASE("a pulled bar breaks where the strength drawn is reached, and copies keep their flaw",
          "[fracture][strength]") {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    INFO("seed " << seed);
    Scene scene = pulled_bar(bar());
    scene.bodies[0].strength.weibull = WeibullSettings{.modulus = 3, .seed = seed};
    Simulation sim = built(std::move(scene));
    const std::vector<double> drawn = sim.state->cells.strength;
    bool broken = false;
    for (int i = 0; i < 200 && !broken; ++i) {
      const StepReport report = advance(sim);
      REQUIRE(report.status.outcome == StepOutcome::fine);
      for (const FanEvent& fan : report.fracture.fans) {
        broken = true;
        const double least = *std::ranges::min_element(drawn);
        CHECK(fan.strength >= least);
        CHECK(fan.stress >= fan.strength);
      }
    }
    REQUIRE(broken);
    const sunder::Cells& cells = sim.state->cells;
    for (std::size_t v = 0; v < cells.map.vertices(); ++v) {
      CHECK(cells.strength[v] == drawn[cells.map.point_of_vertex(VertexId{v})]);
    }
  }
}

TEST_CASE("a region has its own strength, a painted field that of each point",
          "[fracture][strength]") {
  Scene scene = pulled_bar(bar());
  TetMesh& mesh = scene.bodies[0].mesh;
  for (const auto& t : mesh.tetrahedra) {
    mesh.region.push_back(mesh.points[t[0]][0] + mesh.points[t[3]][0] < 0.6 ? 1 : 2);
  }
  mesh.region_name = {{1, "weak"}};
  scene.bodies[0].strength.regions = {{.region = {"weak"}, .tensile_strength = 1e6},
                                      {.region = {"2"}, .tensile_strength = 2e6}};
  const Simulation sim = built(scene);
  for (std::size_t v = 0; v < sim.state->cells.map.vertices(); ++v) {
    double least = 9e9;
    for (const TetId t : star(sim.state->cells.map, VertexId{v})) {
      least = std::min(least, mesh.region[t.index()] * 1e6);
    }
    CHECK(sim.state->cells.strength[v] == least);
  }
  scene.bodies[0].strength.painted.assign(mesh.points.size(), 5e6);
  scene.bodies[0].strength.painted[3] = 4e6;
  const Simulation painted = built(scene);
  for (std::size_t v = 0; v < painted.state->cells.map.vertices(); ++v) {
    const bool other = painted.state->cells.map.point_of_vertex(VertexId{v}) == 3;
    CHECK(painted.state->cells.strength[v] == (other ? 4e6 : 5e6));
  }
}

TEST_CASE("an unbreakable vertex never splits, whatever breaks beside it", "[fracture][strength]") {
  Scene scene = pulled_bar(bar());
  scene.bodies[0].material.tensile_strength = 1e6;
  scene.bodies[0].unbreakable = {{RestBox{{-1, -1, -1}, {0.32, 1, 1}}}};
  Simulation sim = built(scene);
  const std::size_t points = sim.state->cells.map.vertices();
  const std::vector<char> marked = sim.state->cells.unbreakable;
  std::size_t fans = 0;
  for (int i = 0; i < 100; ++i) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    fans += report.fracture.fans.size();
    for (const FanEvent& fan : report.fracture.fans) {
      CHECK_FALSE(marked[fan.point]);
      for (const FaceSplit& face : fan.faces) {
        for (const VertexId v : face.vertices) CHECK_FALSE(sim.state->cells.unbreakable[v.index()]);
      }
    }
  }
  CHECK(fans > 0);
  for (std::size_t v = points; v < sim.state->cells.map.vertices(); ++v) {
    CHECK_FALSE(marked[sim.state->cells.map.point_of_vertex(VertexId{v})]);
  }
}

namespace {

/// A block that shatters, under limits: masses of its pieces, kg, and the fans refused.
struct Shattered {
  std::vector<double> mass;
  std::vector<ComponentId> piece;  // of each tetrahedron
  std::size_t refused = 0;
  double lightest() const { return *std::ranges::min_element(mass); }
};
Shattered shatter(double smallest, std::uint32_t most) {
  test::Tension body =
      test::uniform_tension(jittered(kuhn_box({3, 3, 3}, 0.1), 0.01, 3), Vec3::UnitZ(), 4e6);
  FractureSettings settings;
  settings.smallest_piece = smallest;
  settings.max_pieces = most;
  FractureScratch scratch;
  const FractureReport report = break_vertices({body.cells, body.state}, settings, scratch);
  Shattered result{.mass = std::vector<double>(body.cells.labels.size.size(), 0),
                   .piece = body.cells.labels.of_tetrahedron,
                   .refused = report.refused_fans};
  for (std::size_t t = 0; t < result.piece.size(); ++t) {
    result.mass[result.piece[t].index()] += body.state.elements.mass[t];
  }
  return result;
}

}  // namespace

TEST_CASE("limits on pieces hold exactly, and refuse nothing else", "[fracture][limits]") {
  const Shattered free = shatter(0, 0);
  REQUIRE(free.mass.size() > 2);
  CHECK(free.refused == 0);
  // Limits that the free block keeps change nothing: pieces only get lighter while it breaks.
  const auto pieces = static_cast<std::uint32_t>(free.mass.size());
  const Shattered same = shatter(0.999 * free.lightest(), pieces);
  CHECK(same.refused == 0);
  CHECK(same.piece == free.piece);
  for (const std::uint32_t most : {1U, pieces - 1}) {
    INFO(most << " pieces at most");
    const Shattered few = shatter(0, most);
    CHECK(few.mass.size() <= most);
    CHECK(few.refused > 0);
  }
  for (const double times : {1.01, 1.5}) {
    INFO(times << " times the lightest");
    const Shattered heavy = shatter(times * free.lightest(), 0);
    CHECK(heavy.lightest() >= times * free.lightest());
    CHECK(heavy.refused > 0);
  }
}

TEST_CASE("a cut through the body leaves two pieces at rest, with crack faces",
          "[fracture][cuts]") {
  Scene scene = pulled_bar(bar());
  scene.bodies[0].held.clear();
  scene.bodies[0].cuts = {{.faces = CutPlane{{0.31, 0, 0}, {2, 0, 0}}}};
  Simulation sim = built(scene);
  CHECK(sim.state->cells.labels.size.size() == 2);
  std::size_t crack_faces = 0;
  for (std::size_t f = 0; f < 4 * sim.state->cells.map.tetrahedra(); ++f) {
    crack_faces += is_crack_face(sim.state->cells, HalfFaceId{f});
  }
  CHECK(crack_faces ==
        2 * plane_faces(*build_map(scene.bodies[0].mesh), CuttingPlane{{1, 0, 0}, 0.31})->size());
  for (int i = 0; i < 20; ++i) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    CHECK(report.fracture.fans.empty());
  }
  CHECK(kinetic_energy(sim.state->mechanics.vertices) < 1e-20);
}

TEST_CASE("a box keeps a cut to an edge crack, and toughness rules at its tip",
          "[fracture][cuts]") {
  Scene scene = pulled_bar(kuhn_box({6, 4, 4}, 0.1));
  scene.bodies[0].held.clear();
  scene.bodies[0].material.toughness = 1e6;
  scene.bodies[0].cuts = {
      {.faces = CutPlane{{0.3, 0, 0}, {1, 0, 0}}, .box = RestBox{{-1, -1, -1}, {1, 0.2001, 1}}}};
  const Simulation sim = built(scene);
  const sunder::Cells& cells = sim.state->cells;
  CHECK(cells.labels.size.size() == 1);
  double area = 0;
  for (std::size_t f = 0; f < 4 * cells.map.tetrahedra(); ++f) {
    if (!is_crack_face(cells, HalfFaceId{f})) continue;
    std::array<Vec3, 3> p;
    for (int k = 0; k < 3; ++k) {
      const int place = dart_order::face_corners[f % 4][k];
      p[k] = Vec3(cells.map.point(cells.map.corners(TetId{f / 4})[place]).data());
      CHECK(p[k].y() <= 0.2001);
      CHECK(cells.strength[cells.map.corners(TetId{f / 4})[place].index()] !=
            scene.bodies[0].material.tensile_strength);
    }
    area += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
  }
  CHECK(area > 0);
}

TEST_CASE("bad cuts and strengths are errors that say where", "[fracture][cuts][strength]") {
  using Codes = std::vector<std::string>;
  const auto with = [](auto change) {
    Scene scene = pulled_bar(bar());
    change(scene.bodies[0]);
    return error_codes(scene);
  };
  CHECK(with([](BodySettings& b) {
          b.cuts = {{.faces = CutPlane{{9, 0, 0}, {1, 0, 0}}}};
        }) == Codes{"nothing_cut"});
  CHECK(with([](BodySettings& b) {
          b.cuts = {{.faces = CutPlane{{0, 0, 0}, {0, 0, 0}}}};
        }) == Codes{"zero_direction"});
  CHECK(with([](BodySettings& b) {
          b.cuts = {{.faces = FaceList{"", {{0, 1, 999}}}}};
        }) == Codes{"not_interior"});
  CHECK(with([](BodySettings& b) { b.strength.regions = {{.region = {"steel"}}}; }) ==
        Codes{"unknown_region"});
  CHECK(with([](BodySettings& b) {
          b.strength.regions = {{.region = {"0"}}, {.region = {"0"}}};
        }) == Codes{"repeated_region"});
  CHECK(with([](BodySettings& b) { b.strength.weibull = WeibullSettings{.modulus = 0}; }) ==
        Codes{"out_of_range"});
  CHECK(with([](BodySettings& b) { b.strength.painted = {1e6}; }) == Codes{"painted_strength"});
  CHECK(with([](BodySettings& b) {
          b.unbreakable = {{RestBox{{5, 5, 5}, {6, 6, 6}}}};
        }) == Codes{"nothing_unbreakable"});
}
