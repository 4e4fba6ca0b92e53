// SPDX-License-Identifier: MIT
// All contacts that press or stick at once, against dense algebra and plain sweeps.
#include "mechanics/contact/solver/contact_subspace.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "mechanics/contact/solver/contact_solve.hpp"
#include "tests/mechanics/contact/solver/contact_problem.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// The energy of impulses, J times the step: 1/2 f . A f + b . f, with the contacts' own
/// compliance, less the energy of pushes. Sweeps and the subspace both minimise it.
struct Energy {
  Eigen::MatrixXd response;
  Eigen::VectorXd without;

  explicit Energy(const RowProblem& problem) : response(dense_response(problem)) {
    without.resize(response.rows());
    for (std::size_t k = 0; k < problem.rows.size(); ++k) {
      const Constraint& row = problem.rows[k];
      const auto at = static_cast<Eigen::Index>(3 * k);
      const Vec3 n = row.normal;
      without.segment<3>(at) = row.contact().gap * n + row.slip - n * n.dot(row.slip);
      response.block<3, 3>(at, at) += row.compliance * n * n.transpose();
    }
  }

  double of(const RowProblem& problem) const {
    const Eigen::VectorXd f = impulses_of(problem);
    double energy = 0.5 * f.dot(response * f) + without.dot(f);
    for (std::size_t k = 0; k < problem.rows.size(); ++k) {
      const Constraint& row = problem.rows[k];
      if (!(row.contact().push > 0)) continue;
      const double most = problem.responses[k].push_most;
      const double pushed = std::min(row.normal.dot(row.impulse), most);
      energy -= row.contact().push * pushed - 0.5 * row.contact().push / most * pushed * pushed;
    }
    return energy;
  }
};

/// Needs: `problem.responses` with the disks that friction is to keep to.
void check_bounds(const RowProblem& problem) {
  for (std::size_t k = 0; k < problem.rows.size(); ++k) {
    const Constraint& row = problem.rows[k];
    const double pressed = row.normal.dot(row.impulse);
    // A normal part put back together from its row is off by a rounding.
    const double rounding = 1e-14 * row.impulse.norm();
    CHECK(pressed >= row.contact().least - rounding);
    CHECK(pressed <= row.contact().most + rounding);
    CHECK((row.impulse - pressed * row.normal).norm() <=
          problem.responses[k].disk * (1 + 1e-12) + rounding);
  }
}

/// The bodies move as the impulses say.
void check_motion(const RowProblem& problem) {
  RowProblem anew = problem;
  set_to_rest(anew.bodies);
  for (const Constraint& row : problem.rows) add_impulse(row, anew.bodies, row.impulse);
  const Eigen::VectorXd moved = displacements_of(anew);
  CHECK((displacements_of(problem) - moved).norm() <= 1e-11 * moved.norm());
}

/// Pushes, bounds and compliances of every kind among plain rows.
RowProblem mixed_rows(unsigned seed, double ratio) {
  RowProblem problem = random_rows(seed, 16, ratio);
  for (std::size_t k = 0; k < problem.rows.size(); ++k) {
    Constraint& row = problem.rows[k];
    if (k % 4 == 1) row.contact().push = 1e-3;
    if (k % 4 == 2) row.compliance = 1e-3 * problem.step;
    if (k % 8 == 3) row.contact().most = 0.3;
    if (k % 8 == 7) row.contact().friction = 0;
  }
  return problem;
}

/// Two free bodies, one on top of the other, that meet at 5 x 5 points and each deform there a
/// little by themselves, `ratio` times stiffer than they are free; tilted, so that some bear more.
RowProblem two_blocks(double ratio, double friction) {
  RowProblem problem;
  std::mt19937 random(1);
  std::vector<Vec3> arms;
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      Constraint row;
      row.contact().gap = -1e-3 * (1 + 0.2 * i + 0.1 * j);
      row.slip = {1e-5, -2e-5, 0};
      row.contact().friction = friction;
      row.side_count = 2;
      for (std::uint32_t s = 0; s < 2; ++s) {
        RowSide& side = row.sides[s];
        side.body = s;
        side.weight = s == 0 ? 1 : -1;
        const Vec3 arm(0.25 * i, 0.25 * j, s == 0 ? -0.5 : 0.5);
        side.arm = side.weight * arm;
        side.rest_arm = side.arm;
        side.slot = static_cast<std::uint32_t>(problem.rows.size());
      }
      problem.rows.push_back(row);
    }
  }
  for (std::uint32_t b = 0; b < 2; ++b) {
    RespondingBody body;
    body.inverse_mass = b == 0 ? 1 : 0.5;
    body.inverse_inertia = 6 * body.inverse_mass * Mat3::Identity();
    const auto size = static_cast<Eigen::Index>(3 * problem.rows.size());
    body.elastic = problem.step * body.inverse_mass / ratio * Eigen::MatrixXd::Identity(size, size);
    problem.bodies.push_back(body);
  }
  return problem;
}

/// Twenty problems each of bodies as stiff as free, and ever stiffer.
template <class Visit>
void with_mixed_rows(Visit visit) {
  const double ratio = GENERATE(1.0, 1e4, 1e6);
  const unsigned seed = GENERATE(range(1u, 21u));
  INFO("ratio " << ratio << " seed " << seed);
  RowProblem problem = mixed_rows(seed, ratio);
  prepare_rows(problem);
  visit(problem, GENERATE(false, true));
}

}  // namespace

TEST_CASE("bodies move as the impulses say where a contact presses by next to nothing",
          "[mechanics][contact][solve]") {
  for (unsigned seed = 1; seed < 21; ++seed) {
    RowProblem problem = mixed_rows(seed, 1e4);
    prepare_rows(problem);
    for (int k = 0; k < 3; ++k) plain_sweep(problem);
    // Squares of these are below the least number.
    for (std::size_t k = 0; k < problem.rows.size(); k += 3) {
      Constraint& row = problem.rows[k];
      const Vec3 back = 1e-175 * row.normal - row.impulse;
      row.impulse += back;
      add_impulse(row, problem.bodies, back);
      problem.responses[k].disk = 1e-176;
    }
    INFO("seed " << seed);
    solve_subspace(problem.solve(), 24, seed % 2 == 0);
    check_motion(problem);
    check_bounds(problem);
  }
}

TEST_CASE("the subspace never raises the energy and keeps bounds and disks",
          "[mechanics][contact][solve]") {
  with_mixed_rows([](RowProblem& problem, bool again) {
    const Energy energy(problem);
    for (int round = 0; round < 6; ++round) {
      for (int k = 0; k < 3; ++k) plain_sweep(problem);
      const double before = energy.of(problem);
      const int products = solve_subspace(problem.solve(), 24, again);
      CHECK(products <= 24);
      INFO("round " << round);
      CHECK(energy.of(problem) <= before + 1e-12 * std::abs(before));
      check_bounds(problem);
      check_motion(problem);
      set_disks(problem);
      plain_sweep(problem);  // friction is inside the new disks again
    }
  });
}

TEST_CASE("friction that a smaller disk forbids is taken from the body too",
          "[mechanics][contact][solve]") {
  RowProblem problem;
  problem.bodies.resize(1);
  problem.bodies[0].inverse_mass = 1;
  problem.rows.resize(1);
  Constraint& row = problem.rows[0];
  row.contact().gap = -0.01;
  row.slip = {-0.02, 0, 0};
  row.side_count = 1;
  prepare_rows(problem);
  problem.responses[0].disk = 10;
  plain_sweep(problem);
  REQUIRE((row.impulse - Vec3(2, 0, 1)).norm() < 1e-12);
  problem.responses[0].disk = 0.4;
  const bool again = GENERATE(false, true);
  solve_subspace(problem.solve(), 24, again);
  CHECK((problem.bodies[0].motion.velocity - row.impulse).norm() < 1e-12);
}

TEST_CASE("impulses and motions agree also after disks have shrunk",
          "[mechanics][contact][solve]") {
  with_mixed_rows([](RowProblem& problem, bool again) {
    for (int round = 0; round < 6; ++round) {
      for (int k = 0; k < 3; ++k) plain_sweep(problem);
      set_disks(problem);
      solve_subspace(problem.solve(), 24, again);
      INFO("round " << round);
      check_bounds(problem);
      check_motion(problem);
    }
  });
}

TEST_CASE("with everything free the subspace is the dense solve", "[mechanics][contact][solve]") {
  const double ratio = GENERATE(1.0, 1e4, 1e6);
  const unsigned seed = GENERATE(1u, 2u, 3u, 4u);
  const bool again = GENERATE(false, true);
  INFO("ratio " << ratio << " seed " << seed);
  RowProblem problem = random_rows(seed, 8, ratio);
  for (Constraint& row : problem.rows) {
    row.contact().least = -std::numeric_limits<double>::infinity();
    row.compliance = 1e-2 * problem.step;
  }
  prepare_rows(problem);
  for (RowResponse& response : problem.responses) response.disk = 1e12;
  const Energy energy(problem);
  // Each call goes on where the last one ended.
  for (int k = 0; k < 8; ++k) solve_subspace(problem.solve(), 400, again);
  const Eigen::VectorXd dense = -energy.response.ldlt().solve(energy.without);
  const Eigen::VectorXd left = energy.response * impulses_of(problem) + energy.without;
  CHECK(left.norm() <= 1e-10 * energy.without.norm());
  const Eigen::VectorXd off = impulses_of(problem) - dense;
  CHECK(off.dot(energy.response * off) <= 1e-14 * dense.dot(energy.response * dense));
}

TEST_CASE("nothing that is free: nothing changes", "[mechanics][contact][solve]") {
  RowProblem problem = random_rows(5, 6, 1e4);
  prepare_rows(problem);
  solve_subspace(problem.solve(), 24, true);
  CHECK(impulses_of(problem).isZero(0));
  CHECK(displacements_of(problem).isZero(0));
}

TEST_CASE("stiff bodies converge where plain sweeps do not", "[mechanics][contact][solve]") {
  const double friction = GENERATE(0.0, 0.5);
  INFO("friction " << friction);
  RowProblem quick = two_blocks(1e4, friction), plain = quick;
  const double tolerance = 1e-9;
  const SolveOutcome outcome =
      solve_contacts(quick.rows, quick.bodies, {quick.step, tolerance, 200});
  CHECK(outcome.converged);
  CHECK(outcome.iterations <= 200);
  // With the disks that the solve ended with.
  for (const Constraint& row : quick.rows) {
    quick.responses.push_back(response_of(row, quick.bodies, quick.step));
  }
  check_bounds(quick);
  check_motion(quick);
  prepare_rows(plain);
  for (int k = 0; k < 200; ++k) {
    if (k % 8 == 0) set_disks(plain);
    plain_sweep(plain);
  }
  // By how far gaps are from where they should be, with the impulses as they are.
  const auto worst_gap = [](const RowProblem& problem) {
    double worst = 0;
    for (const Constraint& row : problem.rows) {
      const double pressed = row.normal.dot(row.impulse);
      const double gap = row.contact().gap +
                         row.normal.dot(relative_displacement(row, problem.bodies, problem.step));
      worst = std::max(worst, pressed > 0 ? std::abs(gap) : -gap);
    }
    return worst;
  };
  INFO("solved " << worst_gap(quick) << " swept " << worst_gap(plain));
  CHECK(worst_gap(quick) <= 10 * tolerance);
  CHECK(worst_gap(plain) >= 100 * worst_gap(quick));
}
