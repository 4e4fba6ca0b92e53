// SPDX-License-Identifier: MIT
// The law of contacts alone: kept impulses against a search, and ways to bounds.
#include "mechanics/contact/solver/contact_law.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/mechanics/contact/solver/contact_problem.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A contact at random; every second one has a push, every third one a bound above.
Constraint some_contact(std::mt19937& random, int i) {
  Constraint row;
  row.normal = random_vector(random).normalized();
  row.compliance = 0.1 * (i % 5);
  if (i % 2 == 0) row.contact().push = 0.2;
  if (i % 3 == 0) row.contact().most = 0.8;
  return row;
}

RowResponse some_response(std::mt19937& random) {
  RowResponse response;
  response.normal_response = random_number(random, 0.5, 2);
  response.push_most = random_number(random, 0.2, 0.6);
  response.disk = random_number(random, 0, 1);
  return response;
}

/// How far an impulse is out of the bounds of a contact as it is, N s.
double outside(const Constraint& row, const RowResponse& response, const Vec3& impulse) {
  const auto [least, most] = contact_bounds(row, response);
  const double pressed = row.normal.dot(impulse);
  const double friction = (impulse - pressed * row.normal).norm();
  return std::max({least - pressed, pressed - most, friction - response.disk});
}

}  // namespace

TEST_CASE("a contact keeps the nearest impulse inside its bounds", "[mechanics][contact][solve]") {
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    Constraint row = some_contact(random, i);
    const RowResponse response = some_response(random);
    row.impulse = random_vector(random);
    const Vec3 impulse = 2 * random_vector(random);
    const Vec3 kept = contact_kept(row, response, impulse);
    REQUIRE(outside(row, response, kept) < 1e-12);
    if (outside(row, response, impulse) < 0) REQUIRE((kept - impulse).norm() < 1e-12);
    for (int k = 0; k < 100; ++k) {
      const Vec3 other = kept + std::pow(0.1, k % 4) * random_vector(random);
      if (outside(row, response, other) > 0) continue;
      REQUIRE((impulse - kept).norm() <= (impulse - other).norm() * (1 + 1e-12));
    }
  }
}

TEST_CASE("the way of a contact ends at its bounds", "[mechanics][contact][solve]") {
  std::mt19937 random(5);
  for (int i = 0; i < 500; ++i) {
    Constraint row = some_contact(random, i);
    const RowResponse response = some_response(random);
    row.impulse = random_vector(random);
    row.impulse = 0.9 * contact_kept(row, response, row.impulse);
    if (outside(row, response, row.impulse) > 0) continue;
    const Vec3 change = random_vector(random);
    const auto [normal, friction] = contact_way(row, response, change);
    const double way = std::min(normal, friction);
    REQUIRE(way >= 0);
    REQUIRE(std::max(normal, friction) <= 1);
    REQUIRE(outside(row, response, row.impulse + way * change) < 1e-9);
    if (way == 1) continue;
    CHECK(outside(row, response, row.impulse + (way + 1e-6) * change) > 0);
  }
}

TEST_CASE("a push lifts a contact by ever less until it is at its most",
          "[mechanics][contact][solve]") {
  Constraint row;
  row.contact().push = 0.2;
  RowResponse response;
  response.normal_response = 2;
  response.push_most = 0.5;
  CHECK(contact_pushes(row, response));
  CHECK(contact_give(row, response) == 0.4);
  CHECK(contact_bounds(row, response) == std::array{0.0, 0.5});
  // The gap and the push's own give take it together.
  const double wanted = contact_wanted(row, response, 0, 0);
  CHECK(wanted == Approx(0.2 / 2.4));
  CHECK(2 * wanted == Approx(0.2 - 0.4 * wanted));
  // Deeper than the push reaches: pressure alone.
  CHECK(contact_wanted(row, response, 0, -4) == 2);
  row.impulse = {0, 0, 0.6};
  CHECK_FALSE(contact_pushes(row, response));
  CHECK(contact_give(row, response) == 0);
  CHECK(contact_bounds(row, response)[0] == 0.5);
}
