// SPDX-License-Identifier: MIT
// Scenes with bodies of order 2: equilibria that are exact, bending, modes, cracks, refusals.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>

#include "fracture/simulation/simulation_state.hpp"
#include "fracture/simulation/statics/statics.hpp"
#include "tests/support/program.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/kernel/edges.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using nlohmann::json;

namespace {

constexpr double young = 1e9, density = 1000;

/// A bar along x of `cells`, 0.1 m each, of second order, held at x = 0 (nu = 0).
Scene held_bar(const std::array<int, 3>& cells) {
  Scene scene;
  BodySettings bar;
  bar.mesh = suite::kuhn_box(cells, 0.1);
  bar.order = 2;
  bar.material = {.young_modulus = young, .poisson_ratio = 0, .density = density};
  bar.held = {{.minimum = {-1, -1, -1}, .maximum = {1e-6, 9, 9}}};
  scene.bodies.push_back(std::move(bar));
  scene.gravity.acceleration.setZero();
  return scene;
}

BodyEquilibrium solved(const Scene& scene) {
  Result<Simulation> sim = build_statics(scene);
  REQUIRE(sim);
  Result<Equilibrium> answer = solve_scene(*sim);
  REQUIRE(answer);
  return answer->bodies[0];
}

/// A load on the upper side of a bar one cell high.
LoadBox on_top(double pressure) {
  return {.minimum = {-1, -1, 0.1 - 1e-6}, .maximum = {99, 9, 9}, .pressure = pressure};
}

/// A scene with one mesh file next to it.
json scene_json() {
  return {{"gravity", {{"acceleration", {0, 0, -9.81}}}},
          {"bodies",
           {{{"mesh", "bar.msh"},
             {"order", 2},
             {"material",
              {{"young_modulus", young},
               {"poisson_ratio", 0.2},
               {"density", density},
               {"tensile_strength", 3e6}}},
             {"held", {{{"minimum", {-1, -1, -1}}, {"maximum", {1e-6, 9, 9}}}}}}}}};
}

}  // namespace

TEST_CASE("a pulled bar of second order has the answer of the first, turned and moved",
          "[run][static][order]") {
  Scene scene = held_bar({8, 2, 2});
  scene.bodies[0].loads = {
      {.minimum = {0.8 - 1e-6, -1, -1}, .maximum = {9, 9, 9}, .pressure = -2e5}};
  scene.bodies[0].rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized());
  scene.bodies[0].translation = {3, -2, 1};
  const BodyEquilibrium bar = solved(scene);
  CHECK(bar.displacement.value == Approx(2e5 * 0.8 / young).epsilon(1e-10));
  CHECK(bar.principal_stress.value == Approx(2e5).epsilon(1e-10));
  CHECK(bar.strain_energy == Approx(0.5 * 2e5 * 0.04 * 2e5 * 0.8 / young).epsilon(1e-10));
  const Vec3 pulled = scene.bodies[0].rotation * Vec3(2e5 * 0.04, 0, 0);
  CHECK((bar.load - pulled).norm() < 1e-10 * pulled.norm());
  CHECK((bar.supports[0].force + pulled).norm() < 1e-10 * pulled.norm());
  CHECK(bar.residual < 1e-10 * pulled.norm());
  CHECK(bar.vertices == 9 * 3 * 3);
  CHECK(bar.nodes == 17 * 5 * 5);
}

TEST_CASE("a hanging bar of second order is exact: u is quadratic", "[run][static][order]") {
  Scene scene = held_bar({5, 1, 1});
  scene.gravity.acceleration = {10, 0, 0};
  const BodyEquilibrium bar = solved(scene);
  CHECK(bar.displacement.value == Approx(density * 10 * 0.25 / (2 * young)).epsilon(1e-10));
  CHECK(bar.principal_stress.value == Approx(density * 10 * 0.5).epsilon(1e-9));
  CHECK(bar.supports[0].force.x() == Approx(-density * 10 * 0.005).epsilon(1e-10));
}

TEST_CASE("one layer of second order bends as Timoshenko's beam, one of the first does not",
          "[run][static][order]") {
  Scene scene = held_bar({20, 1, 1});
  scene.bodies[0].loads = {on_top(100)};
  const double inertia = std::pow(0.1, 4) / 12, q = 100 * 0.1, shear = 5.0 / 6 * young / 2 * 0.01;
  const double theory = q * 16 / (8 * young * inertia) + q * 4 / (2 * shear);
  CHECK(solved(scene).displacement.value == Approx(theory).epsilon(0.01));
  // The outer fibre at the clamp: M h / 2 I. At the very edge both have more.
  CHECK(solved(scene).principal_stress.value > 0.97 * q * 2 * 0.05 / inertia);
  scene.bodies[0].order = 1;
  CHECK(solved(scene).displacement.value < 0.4 * theory);
}

TEST_CASE("the first tones of a cantilever of second order are those of beams",
          "[run][modes][order]") {
  Result<Simulation> sim = build_statics(held_bar({20, 1, 1}));
  REQUIRE(sim);
  const Result<std::vector<PieceModes>> modes = scene_modes(*sim, 4);
  REQUIRE(modes);
  const double c = std::sqrt(young / density) * 0.1 / std::sqrt(12.0) / (2 * std::numbers::pi * 4);
  const std::vector<double>& f = (*modes)[0].frequency;
  // Two planes of a square section; shear and turning take 0.3 per cent of the first, 2 of the
  // second.
  CHECK(f[0] == Approx(1.8751 * 1.8751 * c).epsilon(0.01));
  CHECK(f[1] == Approx(1.8751 * 1.8751 * c).epsilon(0.01));
  CHECK(f[2] == Approx(4.6941 * 4.6941 * c).epsilon(0.03));
}

TEST_CASE("edges that a crack parts have a node on each side", "[run][static][order]") {
  Scene scene = held_bar({4, 2, 2});
  scene.bodies[0].cuts = {
      {.faces = CutPlane{{0.2, 0, 0}, {1, 0, 0}}, .box = RestBox{{-1, -1, 0.1}, {1, 1, 1}}}};
  Result<Simulation> sim = build_statics(scene);
  REQUIRE(sim);
  const VolumeMap& map = sim->state->cells.map;
  const EdgeRows edges = edge_rows(map);
  CHECK(sim->state->mechanics.vertices.size() == map.vertices());
  std::size_t nodes = 0;
  for (std::size_t v = 0; v < map.vertices(); ++v) nodes += map.is_node(VertexId{v});
  CHECK(nodes == edges.first.size());
  // More edges than pairs of points: those on the crack, but for its front.
  std::set<std::pair<std::uint32_t, std::uint32_t>> points;
  for (const CellEdge& edge : edges.first) {
    const auto [i, j] = edge_ends[static_cast<std::size_t>(edge.place)];
    const auto& c = map.corners(edge.tetrahedron);
    points.insert(std::minmax(map.point_of_vertex(c[static_cast<std::size_t>(i)]),
                              map.point_of_vertex(c[static_cast<std::size_t>(j)])));
  }
  CHECK(edges.first.size() > points.size());
  scene.bodies[0].loads = {
      {.minimum = {0.4 - 1e-6, -1, -1}, .maximum = {9, 9, 9}, .pressure = -2e5}};
  const double open = solved(scene).displacement.value;
  scene.bodies[0].cuts.clear();
  CHECK(open > 1.2 * solved(scene).displacement.value);
}

TEST_CASE("a body of second order runs, and what needs the first order says so",
          "[run][static][order]") {
  Scene fit = held_bar({2, 1, 1});
  fit.fracture.node_stress = NodeStress::fit;
  const Result<Simulation> fitted = build_statics(fit);
  REQUIRE(!fitted);
  CHECK(fitted.findings.back().code == "fit_of_second_order");
  Scene rigid = held_bar({2, 1, 1});
  rigid.bodies[0].held.clear();
  rigid.bodies[0].rigid = true;
  const Result<Simulation> stiff = build_statics(rigid);
  REQUIRE(!stiff);
  CHECK(stiff.findings.front().code == "rigid_and_order");

  const test::Folder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  REQUIRE(write_mesh(path("bar.msh"), suite::kuhn_box({4, 1, 1}, 0.1)).empty());
  std::ofstream(path("scene.json")) << scene_json().dump(1);
  const test::Outcome run = test::run_program("run " + path("scene.json") + " -o " + path("out"));
  CHECK(run.exit_code == 0);
  const Result<FileMesh> frame = read_file_mesh(path("out/frames/frame_000000.vtu"));
  REQUIRE(frame);
  CHECK(rows_of(*frame, CellKind::tetrahedron10).size() == 4 * 6);
  const test::Outcome fan =
      test::run_program("static " + path("scene.json") + " --fan 1,1,0,0 --fans 0 --json");
  CHECK(fan.exit_code == 0);
  CHECK(fan.json()["fan"]["copies"] > 1);
  CHECK(fan.json()["fan"]["projected_area"] > 0);
  CHECK(!fan.json()["fans"].empty());
  // Row 27 of the simulation is the node of an edge, no point of the mesh.
  CHECK(test::run_program("static " + path("scene.json") + " --fan 27,1,0,0").exit_code == 2);
  const test::Outcome fine =
      test::run_program("static " + path("scene.json") + " --json -o " + path("bar.vtu"));
  CHECK(fine.exit_code == 0);
  CHECK(fine.json()["bodies"][0]["nodes"] == 9 * 3 * 3);
  const Result<FileMesh> written = read_file_mesh(path("bar.vtu"));
  REQUIRE(written);
  CHECK(rows_of(*written, CellKind::tetrahedron10).size() == 4 * 6);
  CHECK(written->points.size() == 9 * 3 * 3);
  // Nodes of edges lie where VTK has them: in the middle of 01, 12, 02, 03, 13, 23, but for the
  // bending.
  constexpr std::size_t ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  const auto cells = rows_of(*written, CellKind::tetrahedron10);
  for (std::size_t row = 0; row < cells.size(); ++row) {
    for (std::size_t e = 0; e < 6; ++e) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double middle = 0.5 * (written->points[cells[row][ends[e][0]]][axis] +
                                     written->points[cells[row][ends[e][1]]][axis]);
        CHECK(std::abs(written->points[cells[row][4 + e]][axis] - middle) < 1e-4);
      }
    }
  }
  CHECK(test::run_program("modes " + path("scene.json") + " -o " + path("modes.vtu")).exit_code ==
        0);
}

TEST_CASE("a mesh is made second-order and linear again, and a scene takes it straight, not curved",
          "[run][convert][order]") {
  const test::Folder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const TetMesh bar = suite::kuhn_box({4, 1, 1}, 0.1);
  REQUIRE(write_mesh(path("plain.msh"), bar).empty());
  REQUIRE(test::run_program("convert " + path("plain.msh") + " " + path("bar.msh") + " --order 2")
              .exit_code == 0);
  Result<FileMesh> raised = read_file_mesh(path("bar.msh"));
  REQUIRE(raised);
  CHECK(rows_of(*raised, CellKind::tetrahedron10).size() == 4 * 6);
  CHECK(raised->points.size() == 9 * 3 * 3);
  std::ofstream(path("scene.json")) << scene_json().dump(1);
  CHECK(test::run_program("static " + path("scene.json")).exit_code == 0);
  REQUIRE(test::run_program("convert " + path("bar.msh") + " " + path("back.msh") + " --order 1")
              .exit_code == 0);
  const Result<FileMesh> back = read_file_mesh(path("back.msh"));
  REQUIRE(back);
  CHECK(back->points.size() == bar.points.size());
  CHECK(back->tetrahedra.corners == bar.tetrahedra);

  // The middle of an edge is moved off it by a hundredth of the edge.
  raised->points[rows_of(*raised, CellKind::tetrahedron10)[0][4]][2] += 1e-3;
  REQUIRE(write_file_mesh(path("bar.msh"), *raised).empty());
  const test::Outcome curved = test::run_program("static " + path("scene.json"));
  CHECK(curved.exit_code == 3);
  CHECK(curved.err.find("curved_cells") != std::string::npos);
  CHECK(test::run_program("check " + path("bar.msh")).out.find("curved_cells") !=
        std::string::npos);
}
