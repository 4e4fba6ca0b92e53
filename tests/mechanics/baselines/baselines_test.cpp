// SPDX-License-Identifier: MIT
// Baselines: implicit Euler by Broyden and Newton, corotational elements; the quantities that each
// keeps and loses.
#include <catch2/catch.hpp>

#include <cmath>

#include "mechanics/baselines/verlet.hpp"
#include "mechanics/element/corotational_force.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/frame/rotation.hpp"
#include "tests/support/frequency.hpp"
#include "tests/support/second_order.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// An integrator with its model and solver, by name.
struct Method {
  const char* name;
  IntegratorSettings settings;
};

std::vector<Method> euler_methods() {
  return {{"implicit_euler", {.integrator = Integrator::implicit_euler}},
          {"broyden", {.integrator = Integrator::broyden}},
          {"broyden, factor",
           {.integrator = Integrator::broyden, .broyden_start = BroydenStart::factor}},
          {"newton_cg", {.integrator = Integrator::newton_cg}},
          {"reassembled",
           {.integrator = Integrator::implicit_euler, .model = ElasticModel::corotational}},
          {"prefactored",
           {.integrator = Integrator::implicit_euler,
            .model = ElasticModel::corotational,
            .corotational_solve = CorotationalSolve::prefactored}},
          {"broyden, corotational",
           {.integrator = Integrator::broyden,
            .model = ElasticModel::corotational,
            .broyden_start = BroydenStart::factor}},
          {"newton_cg, corotational",
           {.integrator = Integrator::newton_cg, .model = ElasticModel::corotational}}};
}

std::vector<Method> all_methods() {
  std::vector<Method> methods = euler_methods();
  methods.push_back({"sub_stepped", {.integrator = Integrator::sub_stepped}});
  methods.push_back({"sub_stepped, corotational",
                     {.integrator = Integrator::sub_stepped, .model = ElasticModel::corotational}});
  methods.push_back({"modal", {.integrator = Integrator::modal}});
  methods.push_back({"floating_frame", {}});
  return methods;
}

IntegratorSettings at_step(IntegratorSettings settings, double h) {
  settings.time_step = h;
  return settings;
}

/// Largest distance between the vertices of two states, m.
double farthest(const MechanicsState& a, const MechanicsState& b) {
  double worst = 0;
  for (std::size_t v = 0; v < a.vertices.size(); ++v) {
    worst = std::max(worst, (a.vertices.position[v] - b.vertices.position[v]).norm());
  }
  return worst;
}

/// A body of `E` with a smooth deformation, at rest.
MechanicsState deformed_body(const Body& body, double E, double amount, int order = 1) {
  std::mt19937 random(5);
  MechanicsState state = state_of_order(order, body, {.young_modulus = E});
  place(state, ComponentId{0}, {.orientation = random_rotation(random)});
  deform(state, amount, random);
  return state;
}

}  // namespace

TEST_CASE("free fall is the parabola, with exact momentum, whatever the iterations",
          "[mechanics][baselines]") {
  const Body body = kuhn_block({3, 2, 2}, Vec3(0.3, 0.2, 0.2));
  const Vec3 g(0.3, 0, -9.81), v0(1, -2, 0.5);
  const int order = GENERATE(1, 2);
  for (const Method& method : all_methods()) {
    for (const double tolerance : {1e-1, 1e-8}) {
      INFO(method.name << ", tolerance " << tolerance << ", order " << order);
      std::mt19937 random(3);
      MechanicsState state = state_of_order(order, body, {.young_modulus = 1e6});
      place(state, ComponentId{0}, {.velocity = v0});
      deform(state, 1e-3, random);
      const Vec3 start = state.components[0].centre;
      IntegratorSettings settings = at_step(method.settings, 2e-4);
      settings.tolerance = tolerance;
      const int steps = 200;
      REQUIRE(run(state, body, settings, steps, {.gravity = g}).outcome == StepOutcome::fine);
      const double t = steps * settings.time_step, M = state.components[0].mass;
      CHECK((state.components[0].centre - start - t * v0 - 0.5 * t * t * g).norm() < 1e-12);
      CHECK((momentum(state.vertices) - M * (v0 + t * g)).norm() < 1e-12 * M);
    }
  }
}

TEST_CASE("broyden, Newton and the linearised step of implicit Euler agree on a body at rest",
          "[mechanics][baselines]") {
  const Body body = kuhn_block({6, 2, 2}, Vec3(0.6, 0.2, 0.2));
  const double E = GENERATE(1e6, 3e10);
  const double h = E > 1e9 ? 1e-3 : 1e-4;
  const double size = 1e-6;
  const int order = GENERATE(1, 2);
  const MechanicsState start = deformed_body(body, E, size, order);
  MechanicsState linear = start;
  const auto step = [&](MechanicsState& state, IntegratorSettings settings) {
    settings.tolerance = 1e-8;
    return run(state, body, at_step(settings, h), 1);
  };
  step(linear, {.integrator = Integrator::implicit_euler});
  for (const Method& method : euler_methods()) {
    if (std::string(method.name) == "broyden" && E > 1e9) continue;  // far beyond its wall
    MechanicsState state = start;
    const StepStatus status = step(state, method.settings);
    INFO(method.name << ": " << status.solve.iterations << " iterations, E " << E << ", order "
                     << order);
    CHECK(status.solve.not_converged == 0);
    // The difference is of second order in the displacement, plus the tolerance.
    CHECK(farthest(state, linear) < 1e-4 * size * 0.3);
  }
}

TEST_CASE("implicit Euler damps a ringing bar as its closed form says, by every solver",
          "[mechanics][baselines][vibration]") {
  // Amplitude by 1 / sqrt(1 + (w h)^2) a step: 0.14 are left of ten periods at 100 steps each, and
  // 0.154 at the last extreme but one.
  const Material material{.young_modulus = 7e10, .poisson_ratio = 0, .density = 2500};
  const Body body = kuhn_block({20, 1, 1}, Vec3(1, 0.05, 0.05));
  const double f = 2642.7;
  const int per_period = 100, periods = 10;
  const double h = 1 / (f * per_period);
  const double turn = 2 * pi / per_period;
  const double left = std::pow(1 + turn * turn, -0.5 * per_period * periods);
  REQUIRE(left == Approx(0.14).epsilon(0.02));
  const double half_before = left * std::pow(1 + turn * turn, 0.25 * per_period);
  for (const Method& method : euler_methods()) {
    INFO(method.name);
    MechanicsState state = state_of(body, material);
    for (Vec3& x : state.vertices.position) x.x() += 1e-6 * std::sin(pi * x.x());
    reframe(state, ComponentId{0});
    const double start = axial_amplitude(state);
    double peak = 0;
    int step = 0;
    const StepStatus status =
        run(state, body, at_step(method.settings, h), per_period * periods, {}, [&] {
          if (++step > per_period * periods - per_period / 2) {
            peak = std::max(peak, std::abs(axial_amplitude(state)));
          }
        });
    REQUIRE(status.outcome == StepOutcome::fine);
    CHECK(peak / start == Approx(half_before).epsilon(0.01));
  }
}

TEST_CASE(
    "broyden from the mass matrix meets its wall below three explicit steps, the factor "
    "takes over",
    "[mechanics][baselines]") {
  const Body body = kuhn_block({8, 4, 4}, Vec3(1, 0.5, 0.5));
  const int order = GENERATE(1, 2);
  const MechanicsState start = deformed_body(body, 3e10, 1e-6, order);
  const double h_critical = 2 / highest_frequency(start, body);
  CHECK(explicit_step_bound(start) < h_critical);
  const auto iterate = [&](double steps, BroydenStart from) {
    MechanicsState state = start;
    IntegratorSettings settings{.integrator = Integrator::broyden, .broyden_start = from};
    const StepStatus status = run(state, body, at_step(settings, steps * h_critical), 1);
    CHECK(status.outcome == StepOutcome::fine);
    return status.solve;
  };
  // Of 6 426 tetrahedra: 12 iterations at 0.5, 34 at 1, 74 at 1.3, 349 at 1.6. Explicit steps would
  // need one evaluation each.
  const SolveReport half = iterate(0.5, BroydenStart::mass);
  const SolveReport more = iterate(1.3, BroydenStart::mass);
  INFO(half.iterations << ", " << more.iterations);
  CHECK(half.not_converged == 0);
  CHECK(half.iterations < 20);
  CHECK(more.not_converged == 0);
  CHECK(more.iterations > 3 * half.iterations);
  for (const double steps : {2.7, 6.7, 135.0}) {
    CHECK(iterate(steps, BroydenStart::mass).not_converged == 1);
  }
  for (const double steps : {1.3, 6.7, 135.0, 2000.0}) {
    const SolveReport factored = iterate(steps, BroydenStart::factor);
    CHECK(factored.not_converged == 0);
    CHECK(factored.iterations <= 5);
  }
}

TEST_CASE("a held body under its weight ends a long step where linearised implicit Euler does",
          "[mechanics][baselines][supports]") {
  const Body body = kuhn_block({6, 2, 2}, Vec3(0.6, 0.2, 0.2));
  const int order = GENERATE(1, 2);
  MechanicsState start = state_of_order(order, body, {.young_modulus = 3e10, .poisson_ratio = 0.2});
  hold_below(start, body, -0.29);
  const Loads loads{.gravity = Vec3(0, 0, -9.81)};
  MechanicsState linear = start;
  const IntegratorSettings euler{.integrator = Integrator::implicit_euler};
  run(linear, body, at_step(euler, 1e-2), 3, loads);
  const double way = farthest(linear, start);
  REQUIRE(way > 0);
  for (const EulerFrame frame : {EulerFrame::current, EulerFrame::predicted}) {
    MechanicsState state = start;
    IntegratorSettings settings = euler;
    settings.model = ElasticModel::corotational;
    settings.euler_frame = frame;
    run(state, body, at_step(settings, 1e-2), 3, loads);
    CHECK(farthest(state, linear) < 2e-2 * way);
  }
}

TEST_CASE("prefactored and reassembled corotation agree in the limit of small steps",
          "[mechanics][baselines][corotational]") {
  // A soft cantilever that bends by a third of its length under its weight.
  const Body body = kuhn_block({8, 2, 2}, Vec3(0.8, 0.2, 0.2));
  const int order = GENERATE(1, 2);
  MechanicsState start = state_of_order(order, body, {.young_modulus = 1e6, .density = 1000});
  hold_below(start, body, -0.39);
  std::uint32_t given_up = 0;
  const auto at_end = [&](CorotationalSolve solve, double h) {
    MechanicsState state = start;
    IntegratorSettings settings{.integrator = Integrator::implicit_euler,
                                .model = ElasticModel::corotational,
                                .corotational_solve = solve};
    settings.euler_frame = EulerFrame::predicted;
    MechanicsScratch own;
    const Loads loads{.gravity = Vec3(0, 0, -9.81)};
    const IntegratorSettings stepped = at_step(settings, h);
    for (int i = 0; i < static_cast<int>(std::lround(0.2 / h)); ++i) {
      const StepStatus status = advance(state, own, {body.corners, loads, stepped});
      REQUIRE(status.outcome == StepOutcome::fine);
      given_up += status.solve.not_converged;
    }
    return state;
  };
  const auto difference = [&](double h) {
    return farthest(at_end(CorotationalSolve::prefactored, h),
                    at_end(CorotationalSolve::reassembled, h));
  };
  const double coarse = difference(2e-3), fine = difference(2.5e-4);
  INFO(coarse << " m, " << fine << " m, given up " << given_up);
  CHECK(at_end(CorotationalSolve::reassembled, 2e-3).vertices.position.back().z() < -0.03);
  CHECK(given_up == 0);
  CHECK(coarse < 1e-2);
  CHECK(fine < 0.25 * coarse);
}

TEST_CASE("where iterations are given up the factor's step is taken and said to be",
          "[mechanics][baselines][failure]") {
  const Body body = kuhn_block({4, 2, 2}, Vec3(0.4, 0.2, 0.2));
  const int order = GENERATE(1, 2);
  const MechanicsState start = deformed_body(body, 3e10, 1e-6, order);
  for (Method method : euler_methods()) {
    if (method.settings.integrator == Integrator::implicit_euler) continue;
    INFO(method.name);
    method.settings.max_iterations = 1;
    method.settings.tolerance = 1e-12;
    MechanicsState state = start, expected = start;
    const StepStatus status = run(state, body, at_step(method.settings, 1e-3), 1);
    CHECK(status.outcome == StepOutcome::fine);
    IntegratorSettings linear = at_step({}, 1e-3);
    linear.integrator = Integrator::implicit_euler;
    linear.model = method.settings.model;
    run(expected, body, linear, 1);
    if (status.solve.not_converged == 1) CHECK(farthest(state, expected) == 0);
    CHECK(
        (status.solve.not_converged == 1 || method.settings.broyden_start == BroydenStart::factor));
  }
}

TEST_CASE("corotational forces are the gradient of their energy for any turn and strain",
          "[mechanics][baselines][corotational]") {
  std::mt19937 random(11);
  INFO("seed 11");
  const Body body = shaken(kuhn_block({2, 2, 1}, Vec3(1, 1, 0.5)), 0.08, random);
  const int order = GENERATE(1, 2);
  MechanicsState state = state_of_order(order, body, {.young_modulus = 1e3, .poisson_ratio = 0.3});
  place(state, ComponentId{0}, {.orientation = random_rotation(random)});
  deform(state, 0.2, random);
  const Component& component = state.components[0];
  const auto density = [&](const Mat3& F) {
    const Mat3 R = extract_rotation(F, Eigen::Quaterniond::Identity()).toRotationMatrix();
    const Mat3 strain = R.transpose() * F - Mat3::Identity();
    return 0.5 * corotational_stress(R, F, lame(state.materials[0])).cwiseProduct(strain).sum();
  };
  // Of order 2 at four points, L = 0.585, 0.138 three times (Zienkiewicz and Taylor, table of rules
  // for tetrahedra), by derivatives of the shape functions written out.
  const auto energy = [&](const std::vector<Vec3>& x) {
    double sum = 0;
    for (std::size_t t = 0; t < state.elements.size(); ++t) {
      const ShapeGradient& G = state.elements.shape_gradient[t];
      const double V = state.elements.rest_volume[t];
      const ElementNodes nodes = nodes_of(state.elements, body.corners, TetId{t});
      if (order == 1) sum += V * density(deformation_gradient(G, at_corners(x, body.corners[t])));
      for (int q = 0; order == 2 && q < 4; ++q) {
        const double far = (5 - std::sqrt(5.0)) / 20;
        Eigen::Vector4d L = Eigen::Vector4d::Constant(far);
        L[q] = 1 - 3 * far;
        Mat3 F = Mat3::Zero();
        for (int a = 0; a < 4; ++a) {
          F += (4 * L[a] - 1) * x[nodes.row[std::size_t(a)].index()] * G.col(a).transpose();
        }
        for (std::size_t e = 0; e < 6; ++e) {
          const int i = edge_ends[e][0], j = edge_ends[e][1];
          const Vec3 gradient = 4 * (L[i] * G.col(j) + L[j] * G.col(i));
          F += x[nodes.row[4 + e].index()] * gradient.transpose();
        }
        sum += 0.25 * V * density(F);
      }
    }
    return sum;
  };
  std::vector<Vec3> x = state.vertices.position, force(x.size());
  corotational_forces(force, {state, body.corners, x}, component);
  double scale = 0;
  Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
  for (std::size_t v = 0; v < x.size(); ++v) {
    scale += force[v].norm();
    sum += force[v];
    torque += x[v].cross(force[v]);
  }
  CHECK(sum.norm() < 1e-13 * scale);
  CHECK(torque.norm() < 1e-9 * scale);
  const double step = 1e-6;
  for (std::size_t v : {std::size_t{0}, std::size_t{5}, x.size() / 2, x.size() - 1}) {
    for (int c = 0; c < 3; ++c) {
      const double middle = x[v][c];
      x[v][c] = middle + step;
      const double above = energy(x);
      x[v][c] = middle - step;
      const double below = energy(x);
      x[v][c] = middle;
      CHECK(force[v][c] == Approx(-(above - below) / (2 * step)).margin(1e-7 * scale));
    }
  }
}

TEST_CASE("corotational elements feel nothing of any rigid motion and linear strain exactly",
          "[mechanics][baselines][corotational]") {
  std::mt19937 random(12);
  INFO("seed 12");
  const Body body = shaken(kuhn_block({3, 2, 2}, Vec3(1, 0.6, 0.6)), 0.03, random);
  const int order = GENERATE(1, 2);
  MechanicsState state = state_of_order(order, body, {.young_modulus = 1e9});
  const std::vector<Vec3> rest = state.vertices.rest_position;
  const double scale = 1e9;  // E times an area of 1 m^2
  for (int k = 0; k < 20; ++k) {
    const Mat3 R = random_rotation(random).toRotationMatrix();
    const Vec3 shift = 10 * random_vector(random);
    Mat3 S = Mat3::Identity();  // a stretch: sigma is that of S - I in every element
    for (int c = 0; c < 9; ++c) S(c / 3, c % 3) += 0.05 * random_vector(random).x();
    S = (0.5 * (S + S.transpose())).eval();
    const bool rigid = k % 2 == 0;
    std::vector<Vec3> x, force(rest.size());
    for (const Vec3& X : rest) x.push_back(R * (rigid ? X : Vec3(S * X)) + shift);
    corotational_forces(force, {state, body.corners, x}, state.components[0]);
    double worst = 0;
    if (rigid) {
      for (const Vec3& f : force) worst = std::max(worst, f.norm());
      CHECK(worst < 1e-12 * scale);
      continue;
    }
    // Patch test: inside, the forces of a constant stress cancel.
    state.vertices.position = x;
    reframe(state, ComponentId{0});
    MechanicsScratch scratch;
    measure_elements(state, scratch, body.corners, {.model = ElasticModel::corotational});
    const Mat3 expected = stress_of(S - Mat3::Identity(), lame(state.materials[0]));
    for (const Mat3& sigma : state.elements.stress) {
      worst = std::max(worst, (sigma - expected).norm());
    }
    CHECK(worst < 1e-9 * expected.norm());
  }
}

TEST_CASE("a slender bent bar: corotational elements see the strain of bending, one frame does not",
          "[mechanics][baselines][corotational]") {
  // Exact bending of a bar L/t = 40 to a surface strain of 1e-3: a circle of radius t / (2 eps).
  const double L = 4, t = 0.1, strain = 1e-3, radius = t / (2 * strain);
  const Body body = kuhn_block({160, 4, 4}, Vec3(L, t, t));
  const Material material{.young_modulus = 1e9, .poisson_ratio = 0};
  MechanicsState state = state_of(body, material);
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    const Vec3& X = body.rest[v];
    const double angle = X.x() / radius;
    state.vertices.position[v] = Vec3((radius + X.z()) * std::sin(angle), X.y(),
                                      (radius + X.z()) * std::cos(angle) - radius);
  }
  reframe(state, ComponentId{0});
  // An element has the axial strain of its one edge along the bar, which runs at a height z.
  const auto height = [&](const Corners& corners) {
    for (VertexId a : corners) {
      for (VertexId b : corners) {
        const Vec3 edge = body.rest[b.index()] - body.rest[a.index()];
        if (edge.x() > 0 && edge.tail<2>().norm() < 1e-9) return body.rest[a.index()].z();
      }
    }
    return std::nan("");
  };
  const auto error = [&](ElasticModel model) {
    MechanicsScratch scratch;
    measure_elements(state, scratch, body.corners, {.model = model});
    double worst = 0;
    for (std::size_t e = 0; e < state.elements.size(); ++e) {
      const double measured = state.elements.stress[e](0, 0) / material.young_modulus;
      worst = std::max(worst, std::abs(measured - height(body.corners[e]) / radius));
    }
    return worst / strain;
  };
  CHECK(error(ElasticModel::corotational) < 0.06);
  // theta^2 / 2 at the ends with theta = L / (2 radius): eps (L/t)^2 / 2 of the surface's strain.
  CHECK(error(ElasticModel::rigid_reference) == Approx(0.8).epsilon(0.1));
}

TEST_CASE("one layer of order 2 sees the strain of a slender bent bar with frames of its own",
          "[mechanics][baselines][corotational]") {
  // As above, L/t = 40; cells twice as long as thick turn by 2e-3 x 2 along themselves.
  const double L = 4, t = 0.1, strain = 1e-3, radius = t / (2 * strain);
  const Body body = kuhn_block({20, 1, 1}, Vec3(L, t, t));
  const Material material{.young_modulus = 1e9, .poisson_ratio = 0};
  MechanicsState state = state_of_order(2, body, material);
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    const Vec3& X = state.vertices.rest_position[v];
    const double angle = X.x() / radius;
    state.vertices.position[v] = Vec3((radius + X.z()) * std::sin(angle), X.y(),
                                      (radius + X.z()) * std::cos(angle) - radius);
  }
  reframe(state, ComponentId{0});
  const auto error = [&](ElasticModel model) {
    MechanicsScratch scratch;
    measure_elements(state, scratch, body.corners, {.model = model});
    double worst = 0;
    for (std::size_t e = 0; e < body.corners.size(); ++e) {
      for (std::size_t c = 0; c < 4; ++c) {
        const double measured = state.elements.corner_stress[e][c](0, 0) / material.young_modulus;
        worst = std::max(worst,
                         std::abs(measured - body.rest[body.corners[e][c].index()].z() / radius));
      }
    }
    return worst / strain;
  };
  CHECK(error(ElasticModel::corotational) < 0.01);
  CHECK(error(ElasticModel::rigid_reference) == Approx(0.8).epsilon(0.1));
}
