// SPDX-License-Identifier: MIT
// Ties in the contact solver: projections against a search, solutions against their conditions.
#include "mechanics/contact/solver/tie_row.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "mechanics/contact/solver/contact_solve.hpp"

using namespace sunder;

namespace {

Vec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

/// How far an impulse is beyond the strength of a tie, in units of that strength.
double outside(const Constraint& row, const Vec3& impulse) {
  const double pull = std::max(0.0, -row.normal.dot(impulse));
  const Vec3 shear = impulse - row.normal.dot(impulse) * row.normal;
  const CohesiveBond& bond = row.bond();
  return std::sqrt(pull * pull + shear.squaredNorm() / bond.sliding_stiffness) / bond.most - 1;
}

Constraint some_tie(std::mt19937& random) {
  Constraint row;
  row.normal = random_vector(random).normalized();
  CohesiveBond bond;
  bond.most = std::abs(random_vector(random).x()) + 0.1;
  bond.sliding_stiffness = std::exp(0.5 * random_vector(random).x());
  row.law = bond;
  return row;
}

/// One elastic body with a slot for each side of every row, at random.
RespondingBody some_body(std::mt19937& random, std::size_t slots) {
  RespondingBody body;
  const auto size = static_cast<Eigen::Index>(3 * slots);
  Eigen::MatrixXd half(size, size);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) half(i, j) = normal(random);
  }
  body.elastic = half * half.transpose() / static_cast<double>(size);
  body.elastic.diagonal().array() += 0.2;
  return body;
}

}  // namespace

TEST_CASE("what a tie keeps is what it bears, and nothing that it bears is nearer", "[ties]") {
  std::mt19937 random(4);
  const auto distance = [](const Constraint& row, const Vec3& a, const Vec3& b) {
    const double along = row.normal.dot(a - b);
    return along * along + ((a - b).squaredNorm() - along * along) / row.bond().sliding_stiffness;
  };
  for (int i = 0; i < 200; ++i) {
    const Constraint row = some_tie(random);
    const Vec3 impulse = 3 * random_vector(random);
    const Vec3 kept = bond_kept(row, impulse);
    REQUIRE(outside(row, kept) < 1e-12);
    if (outside(row, impulse) < 0) REQUIRE(kept == impulse);
    for (int k = 0; k < 100; ++k) {
      const Vec3 other = kept + std::pow(0.1, k % 4) * random_vector(random);
      if (outside(row, other) > 0) continue;
      REQUIRE(distance(row, impulse, kept) <= distance(row, impulse, other) * (1 + 1e-12));
    }
  }
}

TEST_CASE("the way of a tie ends at its bound or where pull turns to pressure", "[ties]") {
  std::mt19937 random(5);
  for (int i = 0; i < 500; ++i) {
    Constraint row = some_tie(random);
    row.compliance = i % 2;
    row.impulse = 0.9 * bond_kept(row, random_vector(random));
    const Vec3 change = random_vector(random);
    const double way = bond_way(row, change);
    REQUIRE(way >= 0);
    REQUIRE(way <= 1);
    REQUIRE(outside(row, row.impulse + way * change) < 1e-9);
    const double before = row.normal.dot(row.impulse);
    const double after = row.normal.dot(row.impulse + way * change);
    if (row.compliance > 0) REQUIRE(before * after >= -1e-12);
    if (way == 1) continue;
    const bool turns = row.compliance > 0 && std::abs(after) < 1e-6;
    REQUIRE((turns || outside(row, row.impulse + (way + 1e-6) * change) > -1e-5));
  }
}

TEST_CASE("solved ties obey their law: stick, give along the secant, or pull all they can",
          "[ties]") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const std::size_t count = 1 + trial % 12;
    std::vector<RespondingBody> bodies = {some_body(random, count)};
    std::vector<Constraint> rows;
    for (std::uint32_t k = 0; k < count; ++k) {
      Constraint row = some_tie(random);
      row.compliance = k % 3 == 0 ? 0 : u(random);
      row.slip = random_vector(random);
      row.sides[0] = {.body = 0, .slot = k, .weight = 0};
      row.side_count = 1;
      rows.push_back(row);
    }
    const SolveOutcome outcome = solve_contacts(rows, bodies, {1, 1e-12, 20000});
    REQUIRE(outcome.converged);
    for (const Constraint& row : rows) {
      REQUIRE(outside(row, row.impulse) < 1e-12);
      const Vec3 opening = row.slip + relative_displacement(row, bodies, 1);
      const Vec3 left = opening + bond_give(row) * row.impulse;
      if (outside(row, row.impulse) < -1e-9) {
        // Short of its bound: no opening but that of the secant.
        CHECK(left.norm() < 1e-9);
        continue;
      }
      // At its bound: the rest of the opening goes against the impulse, as the law's direction.
      const double along = row.normal.dot(left);
      const Vec3 across = left - along * row.normal;
      const double pull = -row.normal.dot(row.impulse);
      const Vec3 shear = row.impulse + pull * row.normal;
      if (pull > 1e-9) {
        CHECK(along >= -1e-9);
        CHECK((across * pull + shear / row.bond().sliding_stiffness * along).norm() < 1e-7);
      } else {
        CHECK(std::abs(along) < 1e-9);
      }
      CHECK(across.dot(shear) <= 1e-9);
    }
  }
}
