// SPDX-License-Identifier: MIT
// The solver alone: complementarity, Coulomb's circle, bounds, and what it says when it gives up.
#include "mechanics/contact/contact_solve.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace sunder;

namespace {

constexpr double h = 1e-2;

struct Problem {
  std::vector<RespondingBody> bodies;
  std::vector<ContactRow> rows;
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
    ContactRow row;
    row.normal = vector().normalized();
    row.gap = 0.01 * unit(random);
    row.slip = 0.01 * vector();
    row.friction = 0.4;
    row.end_count = 2;
    row.ends[0] = {static_cast<std::uint32_t>(k % 2), ContactEnd::rigid_slot, 1, vector(), {}};
    row.ends[1] = {2, static_cast<std::uint32_t>(k), -1, vector(), {}};
    problem.rows.push_back(row);
  }
  return problem;
}

/// Relative displacement that the accumulated changes of the bodies mean for a row.
Vec3 moved(const Problem& problem, const ContactRow& row) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t e = 0; e < row.end_count; ++e) {
    const ContactEnd& end = row.ends[e];
    const RespondingBody& body = problem.bodies[end.body];
    Vec3 u = h * (body.velocity + body.spin.cross(end.arm));
    if (end.slot != ContactEnd::rigid_slot) u += body.displacement.segment<3>(3 * end.slot);
    sum += end.weight * u;
  }
  return sum;
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
  for (const ContactRow& row : problem.rows) {
    const Vec3 u = moved(problem, row);
    const double j = row.normal.dot(row.impulse);
    const double gap = row.gap + row.normal.dot(u);
    CHECK(j >= 0);
    CHECK(gap > -left);
    if (j > 0) CHECK(std::abs(gap) < left);
    const Vec3 j_t = row.impulse - j * row.normal;
    const Vec3 total = row.slip + u;
    const Vec3 slip = total - row.normal.dot(total) * row.normal;
    CHECK(j_t.norm() <= row.friction * j * (1 + 1e-12));
    if (j > 0 && j_t.norm() < 0.999 * row.friction * j) CHECK(slip.norm() < left);
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
  for (ContactRow& row : cold.rows) row.friction = 0;
  for (ContactRow& row : warm.rows) row.friction = 0;
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
  for (const ContactRow& row : problem.rows) CHECK(row.normal.dot(row.impulse) >= 0);
}

TEST_CASE("a row that can move nothing stays as it is", "[mechanics][contact][solve]") {
  std::vector<RespondingBody> bodies(1);
  std::vector<ContactRow> rows(1);
  rows[0].gap = -1;
  rows[0].end_count = 1;
  const SolveOutcome outcome = solve_contacts(rows, bodies, {h, 1e-9, 10});
  CHECK(outcome.converged);
  CHECK(rows[0].impulse == Vec3::Zero());
}

TEST_CASE("compliance lets a contact give way by the force over its stiffness",
          "[mechanics][contact][solve]") {
  std::vector<RespondingBody> bodies(1);
  bodies[0].inverse_mass = 0.5;
  std::vector<ContactRow> rows(1);
  rows[0].gap = -0.01;
  rows[0].end_count = 1;
  const double stiffness = 1e4;
  rows[0].compliance = 1 / (stiffness * h);
  solve_contacts(rows, bodies, {h, 1e-15, 100});
  const double force = rows[0].impulse.z() / h;
  const double depth = 0.01 - h * bodies[0].velocity.z();
  CHECK(depth == Approx(force / stiffness).epsilon(1e-12));
}
