// SPDX-License-Identifier: MIT
// The solver alone: complementarity, Coulomb's circle, bounds, and its report when it gives up.
#include "mechanics/contact/solver/contact_solve.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "mechanics/contact/solver/row_response.hpp"

using namespace sunder;

namespace {

constexpr double h = 1e-2;

struct Problem {
  std::vector<RespondingBody> bodies;
  std::vector<Constraint> rows;
};

/// Rows between random points of two rigid bodies and one elastic one.
Problem random_problem(unsigned seed, std::size_t rows) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  Problem problem;
  problem.bodies.resize(3);
  for (RespondingBody& body : problem.bodies) {
    body.inverse_mass = 1 + 0.5 * unit(random);
    body.inverse_inertia = Vec3(3, 4, 5).asDiagonal();
  }
  const auto size = static_cast<Eigen::Index>(3 * rows);
  const Eigen::MatrixXd any =
      Eigen::MatrixXd::NullaryExpr(size, size, [&] { return unit(random); });
  problem.bodies[2].elastic = h / static_cast<double>(rows) * any * any.transpose();
  for (std::size_t k = 0; k < rows; ++k) {
    Constraint row;
    row.normal = vector().normalized();
    row.contact().gap = 0.01 * unit(random);
    row.slip = 0.01 * vector();
    row.contact().friction = 0.4;
    row.side_count = 2;
    row.sides[0] = {static_cast<std::uint32_t>(k % 2), ContactEnd::no_slot, 1, vector(), {}};
    row.sides[1] = {2, static_cast<std::uint32_t>(k), -1, vector(), {}};
    problem.rows.push_back(row);
  }
  return problem;
}

/// Relative displacement that the accumulated changes of the bodies mean for a row.
Vec3 moved(const Problem& problem, const Constraint& row) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t e = 0; e < row.side_count; ++e) {
    const RowSide& side = row.sides[e];
    const BodyMotion& got = problem.bodies[side.body].motion;
    sum += h * (side.weight * got.velocity + got.spin.cross(side.arm));
    if (side.slot != ContactEnd::no_slot) sum += got.displacement.segment<3>(3 * side.slot);
  }
  return sum;
}

/// A body of 1 kg between two immovable planes that lean by `lean` (rad) away from it at the top;
/// both are in it, ask for the same push (m), and its weight moves it down by `fall` (m).
/// `ratio` > 0: it gives at each contact, by so much less than it is free.
Problem wedge(double lean, double friction, double push, double fall, double ratio) {
  Problem problem;
  problem.bodies.resize(1);
  problem.bodies[0].inverse_mass = 1;
  problem.bodies[0].inverse_inertia = Vec3(60, 60, 60).asDiagonal();
  for (const double side : {-1.0, 1.0}) {
    Constraint row;
    row.normal = {-side * std::cos(lean), 0, std::sin(lean)};
    row.contact().gap = -fall * std::sin(lean);
    row.slip = {0, 0, -fall};
    row.contact().push = push;
    row.contact().friction = friction;
    row.side_count = 1;
    row.sides[0].arm = {side * 0.1, 0, 0.02};
    if (ratio > 0) row.sides[0].slot = static_cast<std::uint32_t>(problem.rows.size());
    problem.rows.push_back(row);
  }
  if (ratio > 0) problem.bodies[0].elastic = h / ratio * Eigen::MatrixXd::Identity(6, 6);
  return problem;
}

}  // namespace

TEST_CASE("solved contacts are complementary and rub inside Coulomb's circle",
          "[mechanics][contact][solve]") {
  const unsigned seed = GENERATE(1u, 2u, 3u, 4u, 5u, 6u);
  INFO("seed " << seed);
  Problem problem = random_problem(seed, 12);
  const double tolerance = 1e-9;
  const SolveOutcome outcome = solve_contacts(problem.rows, problem.bodies, {h, tolerance, 5000});
  REQUIRE(outcome.converged);
  int pressed = 0, rubbing = 0;
  // A sweep's error is taken before the rows after it move the gap again: some times more is left.
  const double left = 100 * tolerance;
  for (const Constraint& row : problem.rows) {
    const Vec3 u = moved(problem, row);
    const double j = row.normal.dot(row.impulse);
    const double gap = row.contact().gap + row.normal.dot(u);
    CHECK(j >= 0);
    CHECK(gap > -left);
    if (j > 0) CHECK(std::abs(gap) < left);
    const Vec3 j_t = row.impulse - j * row.normal;
    const Vec3 total = row.slip + u;
    const Vec3 slip = total - row.normal.dot(total) * row.normal;
    CHECK(j_t.norm() <= row.contact().friction * j * (1 + 1e-12));
    if (j > 0 && j_t.norm() < 0.999 * row.contact().friction * j) CHECK(slip.norm() < left);
    if (j > 0 && slip.norm() > left) {
      ++rubbing;
      CHECK(j_t.normalized().dot(slip.normalized()) < -0.999);
    }
    pressed += j > 0;
  }
  CHECK(pressed > 2);
  CHECK(rubbing + pressed > 2);
}

TEST_CASE("a guess changes the way, not the answer", "[mechanics][contact][solve]") {
  Problem cold = random_problem(9, 8), warm = random_problem(9, 8);
  for (Constraint& row : cold.rows) row.contact().friction = 0;
  for (Constraint& row : warm.rows) row.contact().friction = 0;
  solve_contacts(cold.rows, cold.bodies, {h, 1e-12, 20000});
  for (std::size_t k = 0; k < warm.rows.size(); ++k) warm.rows[k].guess = cold.rows[k].impulse;
  const SolveOutcome outcome = solve_contacts(warm.rows, warm.bodies, {h, 1e-10, 20000});
  CHECK(outcome.iterations <= 2);
  for (std::size_t k = 0; k < warm.rows.size(); ++k) {
    CHECK((warm.rows[k].impulse - cold.rows[k].impulse).norm() < 1e-6);
  }
}

TEST_CASE("a solve that runs out of sweeps says so and keeps the bounds",
          "[mechanics][contact][solve]") {
  Problem problem = random_problem(3, 12);
  const SolveOutcome outcome = solve_contacts(problem.rows, problem.bodies, {h, 0, 3});
  CHECK_FALSE(outcome.converged);
  CHECK(outcome.iterations == 3);
  CHECK(outcome.residual > 0);
  for (const Constraint& row : problem.rows) CHECK(row.normal.dot(row.impulse) >= 0);
}

TEST_CASE("a row that can move nothing stays as it is", "[mechanics][contact][solve]") {
  std::vector<RespondingBody> bodies(1);
  std::vector<Constraint> rows(1);
  rows[0].contact().gap = -1;
  rows[0].side_count = 1;
  const SolveOutcome outcome = solve_contacts(rows, bodies, {h, 1e-9, 10});
  CHECK(outcome.converged);
  CHECK(rows[0].impulse == Vec3::Zero());
}

TEST_CASE("compliance lets a contact give way by the force over its stiffness",
          "[mechanics][contact][solve]") {
  std::vector<RespondingBody> bodies(1);
  bodies[0].inverse_mass = 0.5;
  std::vector<Constraint> rows(1);
  rows[0].contact().gap = -0.01;
  rows[0].side_count = 1;
  const double stiffness = 1e4;
  rows[0].compliance = 1 / (stiffness * h);
  solve_contacts(rows, bodies, {h, 1e-15, 100});
  const double force = rows[0].impulse.z() / h;
  const double depth = 0.01 - h * bodies[0].motion.velocity.z();
  CHECK(depth == Approx(force / stiffness).epsilon(1e-12));
}

TEST_CASE("what is too deep is pushed out at the speed that is asked",
          "[mechanics][contact][solve]") {
  std::vector<RespondingBody> bodies(2);
  bodies[0].inverse_mass = 0.5;
  bodies[1].inverse_mass = 3;
  std::vector<Constraint> rows(1);
  rows[0].contact().push = 1e-5;
  rows[0].contact().friction = 0.5;
  rows[0].side_count = 2;
  rows[0].sides[1].body = 1;
  rows[0].sides[1].weight = -1;
  // Falling into each other or resting: they end as far apart as is asked, to a hundredth of it.
  rows[0].contact().gap = GENERATE(0.0, -1e-6, -1e-5);
  const double gap = rows[0].contact().gap;
  const SolveOutcome outcome = solve_contacts(rows, bodies, {h, 1e-12, 100});
  CHECK(outcome.converged);
  const double apart = gap + h * (bodies[0].motion.velocity.z() - bodies[1].motion.velocity.z());
  CHECK(apart <= rows[0].contact().push);
  CHECK(apart == Approx(rows[0].contact().push).epsilon(0.021));
}

TEST_CASE("what is wedged is pressed within bounds and gains no energy, however many sweeps",
          "[mechanics][contact][solve]") {
  const double lean = GENERATE(0.0, 0.02, 0.1, 0.3);
  const double friction = GENERATE(0.0, 0.5, 1.0);
  const double fall = GENERATE(0.0, 1e-3);
  const double ratio = GENERATE(0.0, 1e2, 1e4);
  if (lean == 0 && friction == 0 && fall > 0) return;  // it falls: nothing holds it
  const double push = 1e-5;
  // The tolerance that a step would use.
  const double tolerance = 1e-5 * std::max(fall, push);
  std::vector<Vec3> few;
  for (const int sweeps : {400, 20000}) {
    INFO("lean " << lean << " friction " << friction << " fall " << fall << " sweeps " << sweeps
                 << " ratio " << ratio);
    Problem problem = wedge(lean, friction, push, fall, ratio);
    const SolveOutcome outcome =
        solve_contacts(problem.rows, problem.bodies, {h, tolerance, sweeps});
    INFO("residual " << outcome.residual << " after " << outcome.iterations);
    CHECK(outcome.converged);
    Problem anew = problem;
    set_to_rest(anew.bodies);
    for (const Constraint& row : problem.rows) add_impulse(row, anew.bodies, row.impulse);
    for (const Constraint& row : problem.rows) {
      CHECK((moved(problem, row) - moved(anew, row)).norm() <= 1e-12 * std::max(fall, push));
    }
    // The pushes at their most, and the impulse that holds a falling body without friction.
    double work = 0;
    for (const Constraint& row : problem.rows) {
      const double held = lean > 0 ? fall / h / std::sin(lean) : fall / h;
      const double most = response_of(row, problem.bodies, h).push_most;
      CHECK(row.impulse.norm() <= (1 + friction) * (most + held) * (1 + 1e-12));
      const Vec3 n = row.normal;
      const Vec3 without =
          (row.contact().gap - row.contact().push) * n + row.slip - n * n.dot(row.slip);
      work += row.impulse.dot(without + 0.5 * moved(problem, row));
    }
    CHECK(work <= 0);
    // Nothing is faster than it fell, or than pushes along both planes make it.
    const Vec3 velocity = problem.bodies[0].motion.velocity - Vec3(0, 0, fall / h);
    const double out = push / h / (lean > 0 ? std::sin(lean) : 1);
    CHECK(velocity.norm() <= std::max(fall / h, out) * (1 + 1e-9));
    if (sweeps == 400) {
      for (const Constraint& row : problem.rows) few.push_back(row.impulse);
    } else {
      for (std::size_t k = 0; k < few.size(); ++k) {
        CHECK((problem.rows[k].impulse - few[k]).norm() <= 1e-4 * few[k].norm());
      }
    }
  }
}
