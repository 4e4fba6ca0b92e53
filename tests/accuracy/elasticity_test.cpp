// SPDX-License-Identifier: MIT
// Cases 3, 4, 8, 9, 10 and 13 of the reference list: static answers against closed forms.
#include <catch2/catch.hpp>

#include "mechanics/statics/static_solve.hpp"
#include "tests/support/accuracy_bodies.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

const Material glass{.young_modulus = 7e10, .poisson_ratio = 0.3, .density = 2500};

/// A wide step for bodies of about 1 m of `glass`: a hundred times L/c.
constexpr double wide_step = 0.02;

/// Holds the vertices with x at the low end of a body along x.
MechanicsState clamped(const Body& body, const Material& material) {
  MechanicsState state = test::state_of(body, material);
  state.motions.push_back({});
  double low = 0;
  for (const Vec3& x : body.rest) low = std::min(low, x.x());
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (body.rest[v].x() < low + 1e-9) state.vertices.support[v] = MotionId{0};
  }
  MechanicsScratch scratch;
  const ComponentId id{0};
  rebuild(state, body.corners, {&id, 1}, scratch);
  return state;
}

struct LameAnswer {
  double displacement, stress;  ///< over the closed form, means over the inner surface
};

/// A hollow sphere, a = 1, b = 2, under the inner pressure 1 MPa.
LameAnswer hollow_sphere(int levels, int layers) {
  std::vector<Vec3> unit;
  const Sheet sheet = sphere_sheet(levels, unit);
  std::vector<std::vector<Vec3>> shells;
  for (int l = 0; l <= layers; ++l) {
    shells.push_back(unit);
    for (Vec3& x : shells.back()) x *= std::pow(2.0, double(l) / layers);
  }
  const Body body = extruded(sheet, shells);
  MechanicsState state = test::state_of(body, glass);
  Loads loads;
  press(loads.force, body, state, 1e6, [](const Vec3& x) { return x.norm() < 1 + 1e-9; });
  settle(state, body, wide_step, loads);
  const std::vector<Mat3> stress = node_stress(state, body);
  LameAnswer answer{0, 0};
  for (std::size_t v = 0; v < unit.size(); ++v) {
    const Vec3 across = unit[v].unitOrthogonal();
    answer.displacement += state.vertices.displacement[v].dot(unit[v]);
    answer.stress += 0.5 * (along(stress[v], across) + along(stress[v], unit[v].cross(across)));
  }
  // u(a) = p a / (2 E) ((1 + nu) b^3 + 2 (1 - 2 nu) a^3) / (b^3 - a^3), 5/7 p across.
  const double nu = glass.poisson_ratio;
  const double u = 1e6 / (2 * glass.young_modulus) * ((1 + nu) * 8 + 2 * (1 - 2 * nu)) / 7;
  const double n = static_cast<double>(unit.size());
  return {answer.displacement / n / u, answer.stress / n / (1e6 * 5 / 7)};
}

/// A thin ring, a = 1, b = 2, free ends (plane stress), inner pressure 1 MPa.
LameAnswer hollow_cylinder(std::size_t around, std::size_t rings) {
  std::vector<Vec3> points;
  for (std::size_t r = 0; r <= rings; ++r) {
    for (std::size_t k = 0; k < around; ++k) {
      const double angle = 2 * pi * double(k) / double(around);
      points.push_back(std::pow(2.0, double(r) / double(rings)) *
                       Vec3(std::cos(angle), std::sin(angle), 0));
    }
  }
  const Body body = plate(ring_sheet(around, rings), points, 2 * pi / double(around), 1);
  MechanicsState state = test::state_of(body, glass);
  Loads loads;
  const auto inner = [](const Vec3& x) { return std::hypot(x.x(), x.y()) < 1 + 1e-9; };
  press(loads.force, body, state, 1e6, inner);
  settle(state, body, wide_step, loads);
  const std::vector<Mat3> stress = node_stress(state, body);
  LameAnswer answer{0, 0};
  double count = 0;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (!inner(body.rest[v])) continue;
    const Vec3 out = Vec3(body.rest[v].x(), body.rest[v].y(), 0).normalized();
    answer.displacement += state.vertices.displacement[v].dot(out);
    answer.stress += along(stress[v], Vec3::UnitZ().cross(out));
    ++count;
  }
  const double nu = glass.poisson_ratio;
  const double u = 1e6 / glass.young_modulus * ((1 - nu) + (1 + nu) * 4) / 3;
  return {answer.displacement / count / u, answer.stress / count / (1e6 * 5 / 3)};
}

/// Largest node stress at the hole of a wide plate under tension 1, hole over width 0.1.
double kirsch(std::size_t around, std::size_t rings) {
  std::vector<Vec3> points;
  for (std::size_t r = 0; r <= rings; ++r) {
    const double share = double(r) / double(rings);
    for (std::size_t k = 0; k < around; ++k) {
      const double angle = 2 * pi * double(k) / double(around);
      const Vec3 out(std::cos(angle), std::sin(angle), 0);
      const Vec3 corner = 5 * out / out.cwiseAbs().maxCoeff();
      // Half-width 5, radius 0.5; geometric towards the hole.
      const double s = (std::pow(10.0, share) - 1) / 9;
      points.push_back((1 - s) * 0.5 * out + s * corner);
    }
  }
  const Body body = plate(ring_sheet(around, rings), points, pi / double(around), 1);
  MechanicsState state = test::state_of(body, glass);
  Loads loads;
  press(loads.force, body, state, -1e6, [](const Vec3& x) { return x.x() > 5 - 1e-9; });
  press(loads.force, body, state, -1e6, [](const Vec3& x) { return x.x() < -5 + 1e-9; });
  settle(state, body, 10 * wide_step, loads);
  const std::vector<Mat3> stress = node_stress(state, body);
  double largest = 0;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (std::hypot(body.rest[v].x(), body.rest[v].y()) > 0.5 + 1e-9) continue;
    largest = std::max(largest, stress[v](0, 0) / 1e6);
  }
  return largest;
}

/// Twist a length in the middle half of a square bar over T / (0.1406 G a^4).
double torsion(int layers) {
  const double a = 0.1, length = 0.4, torque = 100;
  const Body body = test::kuhn_block({4 * layers, layers, layers}, Vec3(length, a, a));
  MechanicsState state = clamped(body, glass);
  Loads loads;
  loads.force.assign(body.rest.size(), Vec3::Zero());
  double moment = 0;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    const Vec3& x = body.rest[v];
    if (x.x() < 0.5 * length - 1e-9) continue;
    loads.force[v] = state.vertices.mass[v] * Vec3(0, -x.z(), x.y());
    moment += x.cross(loads.force[v]).x();
  }
  for (Vec3& f : loads.force) f *= torque / moment;
  MechanicsScratch scratch;
  REQUIRE(solve_static(state, scratch, body.corners, loads).empty());
  const auto turn_at = [&](double x) {
    double sum = 0, weight = 0;
    for (std::size_t v = 0; v < body.rest.size(); ++v) {
      if (std::abs(body.rest[v].x() - x) > 1e-9) continue;
      const Vec3 arm(0, body.rest[v].y(), body.rest[v].z());
      sum += arm.cross(state.vertices.displacement[v]).x();
      weight += arm.squaredNorm();
    }
    return sum / weight;
  };
  const double rate = (turn_at(length / 4) - turn_at(-length / 4)) / (length / 2);
  return rate / (torque / (0.1406 * lame(glass).mu * std::pow(a, 4)));
}

}  // namespace

TEST_CASE("case 3: the node stress at the top of a hanging bar lacks half a layer",
          "[accuracy][case3]") {
  const Material material{.young_modulus = 1e8, .poisson_ratio = 0, .density = 1000};
  const auto [layers, share] =
      GENERATE(table<int, double>({{5, 0.912}, {10, 0.965}, {20, 0.986}, {40, 0.994}}));
  const Body body = test::kuhn_block({layers, 2, 2}, Vec3(1, 0.2, 0.2));
  MechanicsState state = clamped(body, material);
  MechanicsScratch scratch;
  REQUIRE(solve_static(state, scratch, body.corners, {.gravity = Vec3(9.81, 0, 0)}).empty());
  const std::vector<Mat3> stress = node_stress(state, body);
  double top = 0, count = 0;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (body.rest[v].x() > -0.5 + 1e-9) continue;
    top += stress[v](0, 0) / (material.density * 9.81);
    ++count;
  }
  INFO("layers " << layers << ", share " << top / count);
  // Elements carry the weight below their middles, so half a layer is missing, 1 - 0.5 / n, up to a
  // shift by the cells' side diagonals; the list's figures are of other cells.
  CHECK(top / count == Approx(1 - 0.5 / layers).margin(0.15 / layers));
  CHECK(top / count == Approx(share).margin(0.2 / layers));
}

TEST_CASE("case 8: hollow sphere and cylinder under inner pressure converge to Lame",
          "[accuracy][case8]") {
  const LameAnswer coarse = hollow_sphere(2, 4), fine = hollow_sphere(3, 8);
  INFO("sphere u " << coarse.displacement << " " << fine.displacement << ", stress "
                   << coarse.stress << " " << fine.stress);
  // Halved cells: displacement errors fall by 4, node stress at a surface by 2; with a margin.
  CHECK(1 - fine.displacement < 0.35 * (1 - coarse.displacement));
  CHECK(1 - fine.stress < 0.65 * (1 - coarse.stress));
  CHECK(fine.displacement == Approx(1).margin(0.03));
  CHECK(fine.stress == Approx(1).margin(0.10));

  const LameAnswer wide = hollow_cylinder(32, 4), narrow = hollow_cylinder(64, 8);
  INFO("cylinder u " << wide.displacement << " " << narrow.displacement << ", stress "
                     << wide.stress << " " << narrow.stress);
  CHECK(1 - narrow.displacement < 0.35 * (1 - wide.displacement));
  CHECK(1 - narrow.stress < 0.65 * (1 - wide.stress));
  CHECK(narrow.displacement == Approx(1).margin(0.02));
  CHECK(narrow.stress == Approx(1).margin(0.10));
}

TEST_CASE("case 9: a hole raises the stress in a wide plate threefold", "[accuracy][case9]") {
  const double coarse = kirsch(32, 8), fine = kirsch(64, 16);
  INFO("coarse " << coarse << ", fine " << fine);
  // 3.03 of the gross tension for a hole of a tenth of the width (Howland).
  // The list's mesher got 2.77, 2.99 and 3.06 at 947, 2 027 and 4 449 tetrahedra of a quarter.
  CHECK(std::abs(3.03 - fine) < 0.65 * std::abs(3.03 - coarse));
  CHECK(fine == Approx(3.03).epsilon(0.02));
}

TEST_CASE("case 10: a square bar twists by T / (0.1406 G a^4)", "[accuracy][case10]") {
  const double two = torsion(2), four = torsion(4), eight = torsion(8);
  INFO("2, 4, 8 layers: " << two << " " << four << " " << eight);
  CHECK(two < four);
  CHECK(four < eight);
  CHECK(eight < 1.005);
  // The stiffness (an energy) errs with the square of the cell, from above: extrapolated, only the
  // next order is left, (1 / 4 - 1 / 3.9) of an error of 0.1.
  CHECK((4 / eight - 1 / four) / 3 == Approx(1).margin(0.01));
}

TEST_CASE("case 13: a disc pressed along a diameter is pulled apart at its middle",
          "[accuracy][case13]") {
  const double radius = 0.5, height = 0.05, force = 1000;
  const Body body = disc(48, 12, radius, height);
  MechanicsState state = test::state_of(body, glass);
  Loads loads;
  loads.force.assign(body.rest.size(), Vec3::Zero());
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    const Vec3& x = body.rest[v];
    if (std::abs(x.x()) < 1e-9 && std::abs(x.y()) > radius - 1e-9) {
      loads.force[v] = Vec3(0, x.y() > 0 ? -force / 2 : force / 2, 0);  // two layers of vertices
    }
  }
  settle(state, body, wide_step, loads);
  const std::vector<Mat3> stress = node_stress(state, body);
  const double unit = 2 * force / (pi * 2 * radius * height);
  const Mat3& middle = stress.back();
  INFO("across " << middle(0, 0) / unit << ", along " << middle(1, 1) / unit);
  // 2 P / (pi D t) across and three times as much compression along (Hondros); a mean over cells of
  // h = R / 12, within which the stress changes by about 3 (h / R)^2 = 0.02.
  CHECK(middle(0, 0) / unit == Approx(1).margin(0.02));
  CHECK(middle(1, 1) / unit == Approx(-3).margin(0.06));
}

TEST_CASE("case 13: a bar on end supports carries 3 rho g L^2 / (4 h) below its middle",
          "[accuracy][case13]") {
  // Node averages lie low at surfaces, and few layers lock: shares of the outer-fibre stress in
  // bending as docs/lab/bending.md gives them, 0.70 with four and 0.87 with eight layers.
  const auto [layers, share] = GENERATE(table<int, double>({{4, 0.70}, {8, 0.87}}));
  const double height = 0.1, length = 0.8, g = 9.81;
  const Material material{.young_modulus = 3e10, .poisson_ratio = 0, .density = 2400};
  const Body body = test::kuhn_block({8 * layers, 2, layers}, Vec3(length, 0.05, height));
  MechanicsState state = test::state_of(body, material);
  // Free, with the supports' push on the two lower edges in balance with the weight.
  Loads loads;
  double weight = 0;
  for (double m : state.vertices.mass) {
    loads.force.emplace_back(0, 0, -m * g);
    weight += m * g;
  }
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    const Vec3& x = body.rest[v];
    if (std::abs(x.x()) < length / 2 - 1e-9 || x.z() > -height / 2 + 1e-9) continue;
    // Three vertices per edge.
    loads.force[v].z() += weight / 6;
  }
  settle(state, body, wide_step, loads);
  const std::vector<Mat3> stress = node_stress(state, body);
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    const Vec3& x = body.rest[v];
    if (std::abs(x.x()) > 1e-9 || x.z() > -height / 2 + 1e-9) continue;
    sum += stress[v](0, 0);
    ++count;
  }
  const double expected = 3 * material.density * g * length * length / (4 * height);
  INFO(layers << " layers: " << sum / count / expected);
  CHECK(sum / count / expected == Approx(share).margin(0.05));
}
