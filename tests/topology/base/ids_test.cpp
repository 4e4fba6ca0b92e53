// SPDX-License-Identifier: MIT
#include "topology/base/ids.hpp"

#include <catch2/catch.hpp>
#include <type_traits>
#include <unordered_set>

using namespace sunder;

TEST_CASE("ids of different cells do not mix, and none is above all rows", "[kernel][ids]") {
  STATIC_REQUIRE(!std::is_convertible_v<VertexId, TetId>);
  STATIC_REQUIRE(!std::is_convertible_v<std::size_t, VertexId>);
  CHECK(VertexId{}.is_none());
  CHECK_FALSE(VertexId{0}.is_none());
  CHECK(VertexId{4000000000u} < VertexId::none());
}

TEST_CASE("half-faces and corners know their tetrahedron and their place", "[kernel][ids]") {
  for (int place = 0; place < 4; ++place) {
    CHECK(tetrahedron_of(half_face(TetId{7}, place)) == TetId{7});
    CHECK(place_of(half_face(TetId{7}, place)) == place);
    CHECK(tetrahedron_of(corner(TetId{7}, place)) == TetId{7});
    CHECK(place_of(corner(TetId{7}, place)) == place);
  }
}

TEST_CASE("ids are keys: each once, and not all in one bucket", "[kernel][ids]") {
  std::unordered_set<VertexId> ids;
  for (std::uint32_t i = 0; i < 100; ++i) ids.insert(VertexId{i % 50});
  CHECK(ids.size() == 50);
  CHECK(std::hash<VertexId>{}(VertexId{7}) != std::hash<VertexId>{}(VertexId{8}));
}
