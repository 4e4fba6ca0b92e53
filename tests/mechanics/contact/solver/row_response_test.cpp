// SPDX-License-Identifier: MIT
// Responses of rows against unit impulses and an eigenvalue solver.
#include "mechanics/contact/solver/row_response.hpp"

#include <catch2/catch.hpp>

#include "mechanics/contact/solver/contact_solve.hpp"
#include "mechanics/contact/solver/tie_row.hpp"
#include "tests/mechanics/contact/solver/contact_problem.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("responses of contacts are those of unit impulses", "[mechanics][contact][rows]") {
  const unsigned seed = GENERATE(1u, 2u, 3u);
  INFO("seed " << seed);
  RowProblem problem = random_rows(seed, 12, 1e2);
  for (Constraint& row : problem.rows) {
    row.contact().push = 1e-3;
    row.compliance = 1e-3;
  }
  prepare_rows(problem);
  const Eigen::MatrixXd dense = dense_response(problem);
  for (std::size_t k = 0; k < problem.rows.size(); ++k) {
    const RowResponse quick = response_of(problem.rows[k], problem.bodies, problem.step);
    const RowResponse& slow = problem.responses[k];
    const auto at = static_cast<Eigen::Index>(3 * k);
    CHECK((quick.response - dense.block<3, 3>(at, at)).norm() <= 1e-12 * quick.response.norm());
    CHECK(quick.give == slow.give);
    CHECK(quick.normal_response == Approx(slow.normal_response).epsilon(1e-12));
    CHECK(quick.tangential_response == Approx(slow.tangential_response).epsilon(1e-12));
    CHECK(quick.push_most == Approx(slow.push_most).epsilon(1e-12));
  }
}

TEST_CASE("a bond has responses of its own only", "[mechanics][contact][rows]") {
  RowProblem problem = random_rows(4, 1, 1e2);
  problem.rows[0].law = CohesiveBond{.most = 1};
  const RowResponse response = response_of(problem.rows[0], problem.bodies, problem.step);
  CHECK(response.response.norm() > 0);
  CHECK(response.normal_response == 0);
  CHECK(response.disk == 0);
  // A solve leaves the step of its sweeps in the bond, for `measure_tie`.
  CHECK(problem.rows[0].bond().response == 0);
  solve_contacts(problem.rows, problem.bodies, {problem.step, 1e-9, 10});
  CHECK(problem.rows[0].bond().response == bond_response(problem.rows[0], response.response));
}

TEST_CASE("a solve begins with the disks that the last one ended with",
          "[mechanics][contact][rows]") {
  RowProblem problem = random_rows(5, 8, 1e2);
  const SolveOutcome outcome =
      solve_contacts(problem.rows, problem.bodies, {problem.step, 1e-12, 5000});
  REQUIRE(outcome.converged);
  double largest = 0;
  for (const Constraint& row : problem.rows) {
    const double pressed = std::max(0.0, row.normal.dot(row.impulse));
    CHECK(row.contact().disk == Approx(row.contact().friction * pressed).margin(1e-6));
    CHECK(response_of(row, problem.bodies, problem.step).disk == row.contact().disk);
    largest = std::max(largest, row.contact().disk);
  }
  CHECK(largest > 1e-3);
}
