// SPDX-License-Identifier: MIT
#include "topology/base/owned.hpp"

#include <catch2/catch.hpp>
#include <type_traits>

using sunder::Owned;

TEST_CASE("what is owned is const where its owner is", "[kernel][owned]") {
  Owned<int> owner(std::make_unique<int>(3));
  *owner = 4;
  const Owned<int>& seen = owner;
  CHECK(*seen == 4);
  CHECK(owner.operator->() == &*owner);
  CHECK(seen.operator->() == &*seen);
  STATIC_REQUIRE(std::is_same_v<decltype(*seen), const int&>);
  STATIC_REQUIRE(std::is_same_v<decltype(seen.operator->()), const int*>);
}

TEST_CASE("an owner that was moved from, or never filled, says so in every build",
          "[kernel][owned]") {
  Owned<int> empty;
  CHECK_THROWS_AS(*empty, sunder::Misuse);
  Owned<int> owner(std::make_unique<int>(3));
  const Owned<int> other = std::move(owner);
  CHECK_THROWS_AS(*owner, sunder::Misuse);
  CHECK_THROWS_AS(owner.operator->(), sunder::Misuse);
  CHECK(*other == 3);
}

TEST_CASE("owners move and do not copy", "[kernel][owned]") {
  STATIC_REQUIRE(std::is_nothrow_move_constructible_v<Owned<int>>);
  STATIC_REQUIRE(!std::is_copy_constructible_v<Owned<int>>);
}
