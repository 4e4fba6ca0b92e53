// SPDX-License-Identifier: MIT
// Ends taken together by body against every end by itself, and the effect of impulses of rows.
#include "mechanics/contact/solver/contact_rows.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/mechanics/contact/solver/contact_problem.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

constexpr std::uint32_t vertices = 7;

/// `count` ends on different vertices of a body, their weights `sum` in all.
void add_ends(Constraint& row, std::mt19937& random, const RowProblem& problem, std::uint32_t body,
              std::uint32_t count, double sum) {
  const bool deforms = problem.bodies[body].elastic.size() > 0;
  const std::uint32_t first = row.end_count, slot = static_cast<std::uint32_t>(random() % vertices);
  double total = 0;
  for (std::uint32_t e = 0; e < count; ++e) {
    ContactEnd& end = row.ends[row.end_count++];
    end.body = body;
    end.weight = random_number(random, 0.2, 1);
    total += end.weight;
    end.arm = random_vector(random);
    if (!deforms) continue;
    end.slot = (slot + e) % vertices;
    end.rest_arm = random_vector(random);
  }
  for (std::uint32_t e = first; e < row.end_count; ++e) row.ends[e].weight *= sum / total;
}

/// Bodies 0 and 1 deform, 2 is rigid. Rows have one to four ends a body; some act on one body from
/// both sides, some on one body only, and some at the same ends as the row before.
RowProblem rows_with_ends(unsigned seed) {
  std::mt19937 random(seed);
  RowProblem problem;
  for (int b = 0; b < 2; ++b) {
    std::vector<Vec3> arms;
    for (std::uint32_t v = 0; v < vertices; ++v) arms.push_back(random_vector(random));
    const std::vector<double> weights(vertices, 1.0);
    problem.bodies.push_back(random_elastic_body(random, arms, weights, 10, problem.step));
  }
  problem.bodies.push_back(random_rigid_body(random));
  for (int k = 0; k < 30; ++k) {
    Constraint row;
    if (k % 5 == 4) {
      row = problem.rows.back();
    } else {
      const std::uint32_t a = static_cast<std::uint32_t>(random() % 3);
      const std::uint32_t first = 1 + static_cast<std::uint32_t>(random() % 4);
      add_ends(row, random, problem, a, first, 1);
      const std::uint32_t second = 1 + static_cast<std::uint32_t>(random() % (5 - first));
      if (k % 5 < 2) {
        add_ends(row, random, problem, (a + 1 + static_cast<std::uint32_t>(k % 2)) % 3, second, -1);
      } else if (k % 5 == 2) {
        add_ends(row, random, problem, a, second, -1);
      }
    }
    row.normal = random_vector(random).normalized();
    problem.rows.push_back(row);
  }
  return problem;
}

/// The slow twin of an impulse: every end by itself.
void add_to_ends(const Constraint& row, std::span<RespondingBody> bodies, const Vec3& impulse) {
  for (std::uint32_t e = 0; e < row.end_count; ++e) {
    const ContactEnd& end = row.ends[e];
    RespondingBody& body = bodies[end.body];
    const Vec3 share = end.weight * impulse;
    body.motion.velocity += body.inverse_mass * share;
    body.motion.spin += body.inverse_inertia * end.arm.cross(share);
    if (end.slot == ContactEnd::no_slot) continue;
    const Vec3 own = body.turn.transpose() * share;
    body.motion.displacement += body.elastic.middleCols<3>(3 * end.slot) * own;
    body.motion.impulse += own;
    body.motion.moment += end.rest_arm.cross(own);
  }
}

Vec3 displacement_of_ends(const Constraint& row, std::span<const RespondingBody> bodies,
                          double step) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t e = 0; e < row.end_count; ++e) {
    const ContactEnd& end = row.ends[e];
    const RespondingBody& body = bodies[end.body];
    Vec3 moved = step * (body.motion.velocity + body.motion.spin.cross(end.arm));
    if (end.slot != ContactEnd::no_slot) {
      const Vec3 rigid = body.rigid_mass * body.motion.impulse +
                         (body.rigid_inertia * body.motion.moment).cross(end.rest_arm);
      moved += body.turn * (body.motion.displacement.segment<3>(3 * end.slot) - rigid);
    }
    sum += end.weight * moved;
  }
  return sum;
}

}  // namespace

TEST_CASE("ends taken together move as every end by itself", "[mechanics][contact][rows]") {
  const unsigned seed = GENERATE(range(1u, 21u));
  INFO("seed " << seed);
  RowProblem merged = rows_with_ends(seed), twin = merged;
  merge_ends(merged.rows, merged.bodies);
  set_to_rest(merged.bodies);
  set_to_rest(twin.bodies);
  std::mt19937 random(seed);
  for (int k = 0; k < 50; ++k) {
    const std::size_t row = random() % merged.rows.size();
    const Vec3 impulse = random_vector(random);
    add_impulse(merged.rows[row], merged.bodies, impulse);
    add_to_ends(twin.rows[row], twin.bodies, impulse);
  }
  double largest = 0, worst = 0;
  for (std::size_t k = 0; k < merged.rows.size(); ++k) {
    const Vec3 slow = displacement_of_ends(twin.rows[k], twin.bodies, twin.step);
    const Vec3 quick = relative_displacement(merged.rows[k], merged.bodies, merged.step);
    largest = std::max(largest, slow.norm());
    worst = std::max(worst, (quick - slow).norm());
  }
  REQUIRE(largest > 0);
  CHECK(worst <= 1e-12 * largest);
}

TEST_CASE("a row has one side for each of its bodies, and rows of the same ends share a slot",
          "[mechanics][contact][rows]") {
  RowProblem problem = rows_with_ends(3);
  merge_ends(problem.rows, problem.bodies);
  for (std::size_t k = 0; k < problem.rows.size(); ++k) {
    const Constraint& row = problem.rows[k];
    const bool two_bodies = row.ends[0].body != row.ends[row.end_count - 1].body;
    CHECK(row.side_count == (two_bodies ? 2 : 1));
    for (std::uint32_t s = 0; s < row.side_count; ++s) {
      const RowSide& side = row.sides[s];
      const bool deforms = problem.bodies[side.body].elastic.size() > 0;
      CHECK((side.slot != ContactEnd::no_slot) == deforms);
      if (deforms) CHECK(3 * side.slot + 3 <= problem.bodies[side.body].elastic.rows());
      if (k % 5 == 4) CHECK(side.slot == problem.rows[k - 1].sides[s].slot);
    }
    // Both sides of one body: it is not moved as a whole.
    if (k % 5 == 2) CHECK(std::abs(row.sides[0].weight) < 1e-15);
  }
}

TEST_CASE("many impulses at once are those one by one", "[mechanics][contact][rows]") {
  const unsigned seed = GENERATE(1u, 2u, 3u, 4u);
  INFO("seed " << seed);
  RowProblem together = rows_with_ends(seed);
  merge_ends(together.rows, together.bodies);
  set_to_rest(together.bodies);
  RowProblem single = together;
  std::mt19937 random(seed);
  std::vector<Vec3> impulses;
  for (std::size_t k = 0; k < together.rows.size(); ++k) {
    impulses.push_back(k % 7 == 3 ? Vec3(Vec3::Zero()) : random_vector(random));
  }
  // The second time on top of the first impulses.
  for (int twice = 0; twice < 2; ++twice) {
    add_impulses(together.rows, together.bodies, impulses);
    for (std::size_t k = 0; k < single.rows.size(); ++k) {
      add_impulse(single.rows[k], single.bodies, impulses[k]);
    }
  }
  const Eigen::VectorXd one_by_one = displacements_of(single);
  CHECK((displacements_of(together) - one_by_one).norm() <= 1e-13 * one_by_one.norm());
}

TEST_CASE("a row's own response is what a unit impulse moves", "[mechanics][contact][rows]") {
  const unsigned seed = GENERATE(1u, 2u, 3u);
  INFO("seed " << seed);
  RowProblem problem = rows_with_ends(seed);
  merge_ends(problem.rows, problem.bodies);
  for (const Constraint& row : problem.rows) {
    const RowResponse own = own_response(row, problem.bodies, problem.step);
    Mat3 moved, rigid;
    for (int i = 0; i < 3; ++i) {
      set_to_rest(problem.bodies);
      add_impulse(row, problem.bodies, Vec3::Unit(i));
      moved.col(i) = relative_displacement(row, problem.bodies, problem.step);
      rigid.col(i).setZero();
      for (std::uint32_t s = 0; s < row.side_count; ++s) {
        const BodyMotion& got = problem.bodies[row.sides[s].body].motion;
        rigid.col(i) +=
            problem.step * (row.sides[s].weight * got.velocity + got.spin.cross(row.sides[s].arm));
      }
    }
    CHECK((own.response - moved).norm() <= 1e-13 * moved.norm());
    CHECK((own.give - (moved - rigid)).norm() <= 1e-13 * moved.norm());
    CHECK((own.response - own.response.transpose()).norm() <= 1e-13 * moved.norm());
  }
}
