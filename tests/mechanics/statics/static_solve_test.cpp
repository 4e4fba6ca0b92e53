// SPDX-License-Identifier: MIT
// Static answers: CalculiX on the same mesh, the hanging bar, the locking of Kuhn's tetrahedra.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

#include <unistd.h>

#include "mechanics/element/energy.hpp"
#include "mechanics/statics/static_solve.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/outside.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A bar along x, held at its low end, with `force` (N, in all) spread evenly over the other end.
struct Cantilever {
  Body body;
  MechanicsState state;
  Loads loads;
  std::vector<VertexId> tip;
};

Cantilever cantilever(std::array<int, 3> cells, const Vec3& size, const Material& material,
                      const Vec3& force) {
  Cantilever bar{kuhn_block(cells, size), {}, {}, {}};
  bar.state = state_of(bar.body, material);
  bar.state.motions.push_back({});
  bar.loads.force.assign(bar.body.rest.size(), Vec3::Zero());
  for (std::size_t v = 0; v < bar.body.rest.size(); ++v) {
    const double x = bar.body.rest[v].x();
    if (x < -0.499 * size.x()) bar.state.vertices.support[v] = MotionId{0};
    if (x > 0.499 * size.x()) bar.tip.push_back(VertexId{v});
  }
  for (VertexId v : bar.tip) {
    bar.loads.force[v.index()] = force / static_cast<double>(bar.tip.size());
  }
  MechanicsScratch scratch;
  const ComponentId id{0};
  rebuild(bar.state, bar.body.corners, {&id, 1}, scratch);
  return bar;
}

double mean_tip(const Cantilever& bar, int axis) {
  double sum = 0;
  for (VertexId v : bar.tip) sum += bar.state.vertices.displacement[v.index()][axis];
  return sum / static_cast<double>(bar.tip.size());
}

/// World displacement x - x0 of every vertex.
std::vector<Vec3> world_displacement(const Cantilever& bar) {
  std::vector<Vec3> u;
  for (std::size_t v = 0; v < bar.body.rest.size(); ++v) {
    u.push_back(bar.state.vertices.position[v] - bar.body.rest[v]);
  }
  return u;
}

void write_calculix_input(const std::filesystem::path& file, const Cantilever& bar,
                          const Material& material) {
  std::ofstream out(file);
  out << std::setprecision(17) << "*NODE, NSET=ALL\n";
  for (std::size_t v = 0; v < bar.body.rest.size(); ++v) {
    const Vec3& x = bar.body.rest[v];
    out << v + 1 << ", " << x.x() << ", " << x.y() << ", " << x.z() << "\n";
  }
  out << "*ELEMENT, TYPE=C3D4, ELSET=EALL\n";
  for (std::size_t t = 0; t < bar.body.corners.size(); ++t) {
    out << t + 1;
    for (VertexId v : bar.body.corners[t]) out << ", " << v.value + 1;
    out << "\n";
  }
  out << "*MATERIAL, NAME=M\n*ELASTIC\n"
      << material.young_modulus << ", " << material.poisson_ratio
      << "\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*BOUNDARY\n";
  for (std::size_t v = 0; v < bar.body.rest.size(); ++v) {
    if (!bar.state.vertices.support[v].is_none()) out << v + 1 << ", 1, 3\n";
  }
  out << "*STEP\n*STATIC\n*CLOAD\n";
  for (VertexId v : bar.tip) {
    for (int axis = 0; axis < 3; ++axis) {
      out << v.value + 1 << ", " << axis + 1 << ", " << bar.loads.force[v.index()][axis] << "\n";
    }
  }
  out << "*NODE PRINT, NSET=ALL\nU\n*END STEP\n";
}

/// Displacements as CalculiX prints them; empty where it fails.
std::vector<Vec3> run_calculix(const Cantilever& bar, const Material& material) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("sunder_ccx_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  write_calculix_input(folder / "bar.inp", bar, material);
  const std::string command = "cd '" + folder.string() + "' && ccx bar > log 2>&1";
  std::vector<Vec3> u;
  if (std::system(command.c_str()) == 0) {
    std::ifstream in(folder / "bar.dat");
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      long node = 0;
      Vec3 value;
      if (words >> node >> value.x() >> value.y() >> value.z()) u.push_back(value);
    }
  }
  fs::remove_all(folder);
  return u;
}

}  // namespace

/// Pinned: CalculiX 2.20 on the cantilever's mesh, mean of the nine tip nodes, m.
constexpr double pinned_tip = -1.0153091e-4;

TEST_CASE("a cantilever bends as CalculiX's pinned figure says", "[mechanics][static]") {
  const Material material{.young_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800};
  Cantilever bar = cantilever({20, 2, 2}, Vec3(1, 0.1, 0.1), material, Vec3(0, 0, -1000));
  MechanicsScratch scratch;
  REQUIRE(solve_static(bar.state, scratch, bar.body.corners, bar.loads).empty());
  CHECK(mean_tip(bar, 2) == Approx(pinned_tip).epsilon(1e-5));
}

TEST_CASE("a cantilever bends as CalculiX's C3D4 says on the same mesh", "[mechanics][static]") {
  if (!has_program("ccx")) return;
  const Material material{.young_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800};
  Cantilever bar = cantilever({20, 2, 2}, Vec3(1, 0.1, 0.1), material, Vec3(0, 0, -1000));
  MechanicsScratch scratch;
  REQUIRE(solve_static(bar.state, scratch, bar.body.corners, bar.loads).empty());
  const std::vector<Vec3> theirs = run_calculix(bar, material);
  REQUIRE(theirs.size() == bar.body.rest.size());
  const std::vector<Vec3> ours = world_displacement(bar);
  double largest = 0, worst = 0, tip = 0;
  for (std::size_t v = 0; v < ours.size(); ++v) {
    largest = std::max(largest, theirs[v].norm());
    worst = std::max(worst, (theirs[v] - ours[v]).norm());
  }
  for (VertexId v : bar.tip) tip += theirs[v.index()].z() / static_cast<double>(bar.tip.size());
  INFO("CalculiX's tip " << std::setprecision(8) << tip);
  CHECK(worst < 1e-5 * largest);
  CHECK(tip == Approx(pinned_tip).epsilon(2e-6));
}

TEST_CASE("Kuhn's tetrahedra lock by the known ratios", "[mechanics][static]") {
  // E 2e11, nu 0.3, 1 x 0.1 x 0.1 m, 1 kN: Timoshenko's tip is 2.0156e-4 m. Layers and
  // ratios: those of CalculiX and of a prototype.
  const Material material{.young_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800};
  const auto [layers, ratio] =
      GENERATE(table<int, double>({{1, 0.219}, {2, 0.504}, {4, 0.787}, {6, 0.887}, {8, 0.930}}));
  Cantilever bar =
      cantilever({10 * layers, layers, layers}, Vec3(1, 0.1, 0.1), material, Vec3(0, 0, -1000));
  MechanicsScratch scratch;
  REQUIRE(solve_static(bar.state, scratch, bar.body.corners, bar.loads).empty());
  CHECK(-mean_tip(bar, 2) / 2.0156e-4 == Approx(ratio).margin(0.002));
}

TEST_CASE("a hanging bar stretches by rho g L^2 / 2 E and carries rho g L at the top",
          "[mechanics][static]") {
  const Material material{.young_modulus = 1e8, .poisson_ratio = 0, .density = 1000};
  const double g = 9.81, length = 1;
  const int cells = GENERATE(5, 20);
  Cantilever bar = cantilever({cells, 2, 2}, Vec3(length, 0.2, 0.2), material, Vec3::Zero());
  bar.loads = {.gravity = Vec3(g, 0, 0)};
  MechanicsScratch scratch;
  REQUIRE(solve_static(bar.state, scratch, bar.body.corners, bar.loads).empty());
  const double expected = material.density * g * length * length / (2 * material.young_modulus);
  CHECK(mean_tip(bar, 0) == Approx(expected).epsilon(3e-3));
  // The topmost elements carry the weight below their middles.
  double top = 0;
  for (const Mat3& sigma : bar.state.elements.stress) top = std::max(top, sigma(0, 0));
  CHECK(top == Approx(material.density * g * length * (1 - 0.5 / cells)).epsilon(0.06));
  // Work of a load applied slowly: twice the strain energy is the load times its way.
  double work = 0;
  for (std::size_t v = 0; v < bar.body.rest.size(); ++v) {
    work += bar.state.vertices.mass[v] * g * bar.state.vertices.displacement[v].x();
  }
  CHECK(2 * strain_energy(bar.state) == Approx(work).epsilon(1e-10));
}

TEST_CASE("a settled dynamic run is the static answer", "[mechanics][static][supports]") {
  const Material material{.young_modulus = 1e8, .poisson_ratio = 0.2, .density = 1000};
  Cantilever bar = cantilever({8, 2, 2}, Vec3(1, 0.2, 0.2), material, Vec3::Zero());
  bar.loads = {.gravity = Vec3(0, 0, -9.81)};
  MechanicsState at_rest = bar.state;
  MechanicsScratch scratch;
  REQUIRE(solve_static(at_rest, scratch, bar.body.corners, bar.loads).empty());
  const Integrator integrator = GENERATE(Integrator::floating_frame, Integrator::implicit_euler);
  const IntegratorSettings settings{
      .time_step = 0.05, .integrator = integrator, .damping = {.stiffness_factor = 0.01}};
  REQUIRE(run(bar.state, bar.body, settings, 400, bar.loads).outcome == StepOutcome::fine);
  double worst = 0, largest = 0;
  for (std::size_t v = 0; v < bar.body.rest.size(); ++v) {
    worst = std::max(worst, (bar.state.vertices.position[v] - at_rest.vertices.position[v]).norm());
    largest = std::max(largest, at_rest.vertices.displacement[v].norm());
  }
  CHECK(worst < 1e-8 * largest);
}

TEST_CASE("bodies without enough support have no equilibrium, and are told so",
          "[mechanics][static]") {
  Body body = kuhn_block({2, 1, 1}, Vec3(2, 1, 1));
  MechanicsState state = state_of(body, {});
  MechanicsScratch scratch;
  const ComponentId id{0};
  state.motions.push_back({});
  const auto codes = [&](const Loads& loads) {
    rebuild(state, body.corners, {&id, 1}, scratch);
    std::vector<std::string> all;
    for (const Finding& f : solve_static(state, scratch, body.corners, loads)) {
      all.push_back(f.code);
    }
    return all;
  };
  CHECK(codes({}) == std::vector<std::string>{"not_supported"});
  // Rows 0, 4, 8 lie on one edge along x.
  for (std::size_t v : {0, 4, 8}) state.vertices.support[v] = MotionId{0};
  CHECK(codes({}) == std::vector<std::string>{"not_supported"});
  state.vertices.support[3] = MotionId{0};
  CHECK(codes({}).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(codes({.gravity = Vec3(0, 0, nan)}) == std::vector<std::string>{"not_a_number"});
}

TEST_CASE("each tetrahedron has its own material", "[mechanics][static]") {
  // Two rods end to end under one pull: the same stress, strains as 1 : E1 / E2.
  const std::vector<Material> materials = {
      {.young_modulus = 1e8, .poisson_ratio = 0, .density = 1000},
      {.young_modulus = 4e8, .poisson_ratio = 0, .density = 3000}};
  const Body body = kuhn_block({8, 2, 2}, Vec3(2, 0.2, 0.2));
  std::vector<MaterialId> of_tetrahedron;
  for (const Corners& corners : body.corners) {
    double x = 0;
    for (VertexId v : corners) x += 0.25 * body.rest[v.index()].x();
    of_tetrahedron.push_back(MaterialId{x < 0 ? 0u : 1u});
  }
  MechanicsState state = *make_state({body.rest, body.corners, of_tetrahedron, {}, materials});
  CHECK(state.components[0].mass == Approx(0.04 * (1000 + 3000)).epsilon(1e-12));
  CHECK(state.components[0].rest_centre.x() == Approx(0.25).epsilon(1e-12));
  state.motions = {{}, {}};
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (body.rest[v].x() < -0.99) state.vertices.support[v] = MotionId{0};
    if (body.rest[v].x() > 0.99) state.vertices.support[v] = MotionId{1};
  }
  MechanicsScratch scratch;
  const ComponentId id{0};
  rebuild(state, body.corners, {&id, 1}, scratch);
  const double pull = 1e-3;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (state.vertices.support[v] == MotionId{1}) state.vertices.displacement[v].x() += pull;
  }
  REQUIRE(solve_static(state, scratch, body.corners, {}).empty());
  const double expected = pull / (1 / 1e8 + 1 / 4e8);
  for (const Mat3& sigma : state.elements.stress) {
    CHECK((sigma - Vec3(expected, 0, 0) * Vec3::UnitX().transpose()).norm() < 1e-9 * expected);
  }
}

TEST_CASE("the turn of an element is the angle of its displacement gradient",
          "[mechanics][validity]") {
  const Body body = kuhn_block({2, 2, 2}, Vec3(1, 1, 1));
  MechanicsState state = state_of(body, {});
  const Vec3 theta(1e-3, -2e-3, 5e-4);
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    state.vertices.displacement[v] = theta.cross(body.rest[v]);
  }
  MechanicsScratch scratch;
  measure_elements(state, scratch, body.corners);
  CHECK(state.components[0].largest_turn == Approx(theta.norm()).epsilon(1e-12));
  // A linear rotation is no strain: rounding of 30 GPa times the turn.
  for (const Mat3& sigma : state.elements.stress) CHECK(sigma.norm() < 1e-13 * 30e9);
}
