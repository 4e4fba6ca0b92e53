// SPDX-License-Identifier: MIT
// A pressed, held ring against CalculiX on the same mesh: its own pressure, displacements,
// stresses.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "mechanics/statics/static_solve.hpp"
#include "tests/support/accuracy_bodies.hpp"
#include "tests/support/outside.hpp"

using namespace sunder;
using namespace sunder::accuracy;
namespace fs = std::filesystem;

namespace {

const Material steel{.young_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800};
constexpr double pressure = 1e6;

bool is_inner(const Vec3& x) { return std::hypot(x.x(), x.y()) < 1 + 1e-9; }
bool is_held(const Vec3& x) { return x.x() < -1.6; }

Body ring() {
  std::vector<Vec3> points;
  for (std::size_t r = 0; r <= 4; ++r) {
    for (std::size_t k = 0; k < 32; ++k) {
      const double angle = 2 * pi * double(k) / 32;
      points.push_back(std::pow(2.0, double(r) / 4) * Vec3(std::cos(angle), std::sin(angle), 0));
    }
  }
  return plate(ring_sheet(32, 4), points, 0.2, 1);
}

void write_input(const fs::path& file, const Body& body) {
  std::ofstream out(file);
  // ccx reads no number of more than twenty characters.
  out << std::setprecision(12) << "*NODE, NSET=ALL\n";
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    const Vec3& x = body.rest[v];
    out << v + 1 << ", " << x.x() << ", " << x.y() << ", " << x.z() << "\n";
  }
  out << "*ELEMENT, TYPE=C3D4, ELSET=EALL\n";
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    out << t + 1;
    for (VertexId v : body.corners[t]) out << ", " << v.value + 1;
    out << "\n";
  }
  out << "*MATERIAL, NAME=M\n*ELASTIC\n"
      << steel.young_modulus << ", " << steel.poisson_ratio
      << "\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*BOUNDARY\n";
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (is_held(body.rest[v])) out << v + 1 << ", 1, 3\n";
  }
  out << "*STEP\n*STATIC\n*DLOAD\n";
  // Faces of C3D4 are 1-2-3, 1-4-2, 2-4-3, 3-4-1: by the corner they lack.
  constexpr int face_without[] = {3, 4, 2, 1};
  for (const auto& [t, place] : boundary_faces(body, is_inner)) {
    out << t.value + 1 << ", P" << face_without[place] << ", " << pressure << "\n";
  }
  out << "*NODE PRINT, NSET=ALL\nU\n*EL PRINT, ELSET=EALL\nS\n*END STEP\n";
}

struct TheirAnswer {
  std::vector<Vec3> displacement;
  std::vector<Mat3> stress;
};

/// Lines of numbers: four of a node, eight of an element (number, point, XX YY ZZ XY XZ YZ).
TheirAnswer read_answer(const fs::path& file) {
  TheirAnswer answer;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::vector<double> n;
    for (double number; words >> number;) n.push_back(number);
    if (!words.eof()) continue;
    if (n.size() == 4) answer.displacement.emplace_back(n[1], n[2], n[3]);
    if (n.size() != 8) continue;
    Mat3 s;
    s << n[2], n[5], n[6], n[5], n[3], n[7], n[6], n[7], n[4];
    answer.stress.push_back(s);
  }
  return answer;
}

TheirAnswer run_calculix(const Body& body) {
  const fs::path folder = fs::temp_directory_path() / ("sunder_ring_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  write_input(folder / "ring.inp", body);
  TheirAnswer answer;
  if (std::system(("cd '" + folder.string() + "' && ccx ring > log 2>&1").c_str()) == 0) {
    answer = read_answer(folder / "ring.dat");
  }
  fs::remove_all(folder);
  return answer;
}

/// The ring in equilibrium under its pressure.
struct PressedRing {
  Body body = ring();
  MechanicsState state = test::state_of(body, steel);
  MechanicsScratch scratch;
  Loads loads;

  PressedRing() {
    state.motions.push_back({});
    for (std::size_t v = 0; v < body.rest.size(); ++v) {
      if (is_held(body.rest[v])) state.vertices.support[v] = MotionId{0};
    }
    const ComponentId id{0};
    rebuild(state, body.corners, {&id, 1}, scratch);
    press(loads.force, body, state, pressure, is_inner);
    REQUIRE(solve_static(state, scratch, body.corners, loads).empty());
  }
};

}  // namespace

TEST_CASE("a held ring under pressure is in equilibrium", "[accuracy][calculix]") {
  PressedRing pressed;
  auto& [body, state, scratch, loads] = pressed;
  double push = 0, missing = 0;
  const std::vector<Vec3> support = support_forces(scratch, state, body.corners, loads);
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    push = std::max(push, loads.force[v].norm());
    if (state.vertices.support[v].is_none()) missing = std::max(missing, support[v].norm());
  }
  CHECK(missing < 1e-8 * push);
}

TEST_CASE("a held ring under pressure deforms and is stressed as CalculiX says on the same mesh",
          "[accuracy][calculix]") {
  if (!test::has_program("ccx")) return;
  const PressedRing pressed;
  const Body& body = pressed.body;
  const MechanicsState& state = pressed.state;
  const TheirAnswer theirs = run_calculix(body);
  REQUIRE(theirs.displacement.size() == body.rest.size());
  REQUIRE(theirs.stress.size() == body.corners.size());
  double largest = 0, worst = 0, most = 0, off = 0;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    const Vec3 ours = state.vertices.position[v] - body.rest[v];
    largest = std::max(largest, ours.norm());
    worst = std::max(worst, (ours - theirs.displacement[v]).norm());
  }
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    most = std::max(most, state.elements.stress[t].norm());
    off = std::max(off, (state.elements.stress[t] - theirs.stress[t]).norm());
  }
  // Printed with seven digits.
  CHECK(worst < 2e-6 * largest);
  CHECK(off < 2e-6 * most);
}
