// SPDX-License-Identifier: MIT
// Pieces as hosts see them: masses, motion, inertia, surfaces, births.
#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <string>

#include "apps/output/fragment.hpp"
#include "apps/output/frame.hpp"
#include "apps/output/tables.hpp"
#include "apps/scene/scene_json.hpp"
#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/shipped.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("fragments share mass and surface, and were parted by the faces that split",
          "[output][fragments]") {
  auto file = read_scene(std::string(SUNDER_SCENES "/charts/monolith.json"));
  REQUIRE(file);
  file->scene.bodies[0].material.tensile_strength = 1e6;
  file->scene.fracture.crack = CrackMode::paper;
  Simulation sim = std::move(*build_simulation(file->scene));
  const Fragment whole = fragments(sim).at(0);
  CHECK(whole.crack_area == 0);
  CHECK(whole.parent.is_none());
  double split = 0;
  for (int i = 0; i < 240; ++i) {
    for (const FanEvent& fan : advance(sim).fracture.fans) {
      for (const FaceSplit& face : fan.faces) {
        std::array<Vec3, 3> p;
        for (int k = 0; k < 3; ++k)
          p[k] = Vec3(sim.state->cells.map.point(face.vertices[k]).data());
        split += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
      }
    }
  }
  const auto pieces = fragments(sim);
  REQUIRE(pieces.size() > 1);
  double mass = 0, surface = 0, cracks = 0;
  for (const Fragment& f : pieces) {
    mass += f.mass;
    surface += f.surface;
    cracks += f.crack_area;
    CHECK(f.crack_projected == f.crack_area);  // no crack knows its plane
    if (!f.parent.is_none()) CHECK(f.parent < f.id);
  }
  CHECK(mass == Approx(whole.mass).epsilon(1e-12));
  CHECK(surface - cracks == Approx(whole.surface).epsilon(1e-12));
  CHECK(cracks == Approx(2 * split).epsilon(1e-12));
}

TEST_CASE(
    "pieces that are not there, and a simulation that was moved from, are refused in every build",
    "[output][fragments]") {
  Simulation sim = shipped("charts/monolith");
  CHECK_NOTHROW(fragment(sim, ComponentId{0}));
  for (const ComponentId id : {ComponentId{1}, ComponentId{4000000000u}, ComponentId::none()}) {
    CHECK_THROWS_AS(fragment(sim, id), Misuse);
    CHECK_THROWS_AS(fragment_surface(sim, id), Misuse);
  }
  CHECK_THROWS_AS(body_of(sim, TetId::none()), Misuse);
  const Simulation other = std::move(sim);
  CHECK_NOTHROW(fragments(other));
  CHECK_THROWS_AS(advance(sim), Misuse);
  CHECK_THROWS_AS(fragments(sim), Misuse);
  CHECK_THROWS_AS(fragment(sim, ComponentId{0}), Misuse);
  CHECK_THROWS_AS(steps_taken(sim), Misuse);
  CHECK_THROWS_AS(simulated_time(sim), Misuse);
  CHECK_THROWS_AS(body_of(sim, TetId{0}), Misuse);
  CHECK_THROWS_AS(saved_state(sim), Misuse);
  CHECK_THROWS_AS(write_frame("never.vtu", sim), Misuse);
}

TEST_CASE("crack faces count on their crack's plane where they know it", "[output][fragments]") {
  auto file = read_scene(std::string(SUNDER_SCENES "/charts/monolith.json"));
  REQUIRE(file);
  file->scene.fracture.crack = CrackMode::object;
  Simulation sim = std::move(*build_simulation(file->scene));
  for (int i = 0; i < 240; ++i) advance(sim);
  double raw = 0, projected = 0;
  for (const Fragment& f : fragments(sim)) {
    CHECK(f.crack_projected <= f.crack_area * (1 + 1e-12));
    raw += f.crack_area;
    projected += f.crack_projected;
  }
  REQUIRE(raw > 0);
  CHECK(projected > 0.5 * raw);
  CHECK(projected < 0.9 * raw);
}

TEST_CASE("fragments of an intact body have the solid's mass, volume and inertia",
          "[output][fragments]") {
  const Simulation simulation = shipped("charts/monolith");
  const std::vector<Fragment> pieces = fragments(simulation);
  REQUIRE(pieces.size() == 1);
  const Fragment& slab = pieces[0];
  // A box of 1 x 0.3 x 2 m with 2400 kg/m^3. The sums are over 413 tetrahedra: 1e-12 is ample.
  CHECK(slab.volume == Approx(0.6).epsilon(1e-12));
  CHECK(slab.mass == Approx(1440).epsilon(1e-12));
  CHECK(slab.tetrahedra == simulation.state->cells.map.tetrahedra());
  // The mass centre is that of lumped vertices; for a linear field it is the solid's.
  CHECK((slab.center - Vec3(0, 0, 1)).norm() < 1e-12);
  CHECK(slab.inertia(0, 0) == Approx(1440 * (0.09 + 4) / 12).epsilon(1e-12));
  CHECK(slab.inertia(1, 1) == Approx(1440 * (1.0 + 4) / 12).epsilon(1e-12));
  CHECK(slab.inertia(2, 2) == Approx(1440 * (1.0 + 0.09) / 12).epsilon(1e-12));
  const std::string csv = fragments_csv(pieces);
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 2);
  const std::string header = csv.substr(0, csv.find('\r'));
  const std::string row = csv.substr(csv.find('\n') + 1);
  CHECK(std::count(header.begin(), header.end(), ',') == std::count(row.begin(), row.end(), ','));
}

TEST_CASE("a step reports the pieces that came off in it, and they know when and from what",
          "[output][fragments]") {
  Simulation sim = shipped("charts/monolith");
  std::size_t pieces = fragments(sim).size(), born = 0;
  while (simulated_time(sim) < 0.06) {
    const StepReport report = advance(sim);
    CHECK(steps_taken(sim) == report.step);
    CHECK(simulated_time(sim) == report.time);
    for (const ComponentId id : report.new_components) {
      const Fragment f = fragment(sim, id);
      CHECK(f.birth_step == report.step);
      CHECK(f.parent < id);
      CHECK(f.tetrahedra > 0);
    }
    pieces += report.new_components.size();
    born += report.new_components.size();
    CHECK(fragments(sim).size() == pieces);
  }
  CHECK(born > 3);
  CHECK(fragments(sim).front().birth_step == 0);
}

TEST_CASE("a piece's surface is closed, outward, and has the piece's areas and volume",
          "[output][fragments]") {
  Simulation sim = shipped("charts/monolith");
  const FragmentSurface start = fragment_surface(sim, ComponentId{0});
  for (std::size_t i = 0; i < start.vertex.size(); ++i) {
    CHECK((start.drawn_position[i] - start.position[i]).norm() < 1e-12);
  }
  while (simulated_time(sim) < 0.06) advance(sim);
  for (const Fragment& f : fragments(sim)) {
    const FragmentSurface s = fragment_surface(sim, f.id);
    REQUIRE(s.is_crack.size() == s.triangles.size());
    double volume = 0, area = 0, cracks = 0;
    Vec3 sum = Vec3::Zero();  // of area vectors: zero for a closed surface
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
      std::array<Vec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = s.rest_position[s.triangles[t][k]];
      const Vec3 face = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]);
      sum += face;
      area += face.norm();
      if (s.is_crack[t]) cracks += face.norm();
      volume += face.dot(p[0]) / 3;
    }
    CHECK(sum.norm() < 1e-12 * area);
    CHECK(area == Approx(f.surface).epsilon(1e-12));
    CHECK(cracks == Approx(f.crack_area).epsilon(1e-12));
    CHECK(volume == Approx(f.volume).epsilon(1e-9));
    CHECK((f.lumped_inertia - f.inertia).eigenvalues().real().minCoeff() > 0);
  }
}
