// SPDX-License-Identifier: MIT
// Faces tied and released in random order: two maps, compared with union-find and each other.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>
#include <random>

#include "fracture/ties/release_ties.hpp"
#include "mechanics/rebuild.hpp"
#include "topology/base/union_find.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

/// Tetrahedra that hang together by the faces of a whole body that are not free, each by the lowest
/// of its part.
std::vector<std::uint32_t> parts_of(const DenseMap& whole, const std::vector<char>& is_free) {
  UnionFind parts(whole.tetrahedra());
  for (std::size_t f = 0; f < 4 * whole.tetrahedra(); ++f) {
    const HalfFaceId across = whole.neighbour(HalfFaceId{f});
    if (across.is_none() || is_free[f]) continue;
    parts.join(static_cast<std::uint32_t>(f / 4),
               static_cast<std::uint32_t>(tetrahedron_of(across).index()));
  }
  std::vector<std::uint32_t> roots;
  for (std::uint32_t t = 0; t < whole.tetrahedra(); ++t) roots.push_back(parts.root(t));
  return roots;
}

void check_labels(const Cells& cells, const DenseMap& whole, const std::vector<char>& is_free) {
  const std::vector<std::uint32_t> expected = parts_of(whole, is_free);
  const auto& seen = cells.labels.of_tetrahedron;
  for (std::size_t t = 0; t < expected.size(); ++t) {
    for (std::size_t p = 0; p < 4; ++p) {
      const VertexId fine = cells.map.corners(TetId{t})[p];
      REQUIRE(cells.labels.of_vertex[fine.index()] == seen[t]);
    }
    REQUIRE(seen[t] == seen[expected[t]]);
  }
  std::map<ComponentId, std::uint32_t> root_of;
  for (std::size_t t = 0; t < expected.size(); ++t) {
    REQUIRE(root_of.try_emplace(seen[t], expected[t]).first->second == expected[t]);
  }
}

/// Ties one face of the map; false where it is not sewn.
bool tie(Cells& cells, ContactMemory& contact, HalfFaceId face) {
  const FaceSplit split = split_face(cells.map, face);
  if (!split.did) return false;
  for (int i = 0; i < split.vertex_count; ++i) append_copy(cells, split.split_vertices[i].old_row);
  Tie made{.face = split.face, .opposite = split.opposite};
  // Spent at the first look: a drawn tie is taken out of the list until its turn comes.
  for (TieCorner& corner : made.corners) corner = {1, 1, 2, 1};
  contact.ties.push_back(made);
  return true;
}

}  // namespace

TEST_CASE("ties released in random order part what union-find parts", "[ties]") {
  // SUNDER_TIES=100000 for long runs.
  const char* wanted = std::getenv("SUNDER_TIES");
  const std::size_t most = wanted ? std::strtoull(wanted, nullptr, 10) : 2000;
  std::mt19937 random(11);
  std::size_t released = 0;
  for (int body = 0; released < most; ++body) {
    const int n = 1 + body % 3;
    auto map = build_map(suite::kuhn_box({n + 1, n, 2}, 1));
    REQUIRE(map);
    std::vector<Vec3> rest;
    for (std::size_t v = 0; v < map->vertices(); ++v)
      rest.emplace_back(map->point(VertexId{v}).data());
    const std::vector<Material> materials{Material{}};
    const std::vector<Corners> corners(map->corners().begin(), map->corners().end());
    auto mechanics =
        make_state({.rest_positions = rest, .corners = corners, .materials = materials});
    REQUIRE(mechanics);
    Cells cells = make_cells(std::move(*map), *mechanics);
    const DenseMap whole = cells.map.dense();
    cells.pieces = Pieces{whole, cells.labels};
    std::vector<char> is_free(4 * cells.map.tetrahedra(), 0);
    std::vector<Tie> live;
    ComponentScratch scratch;
    std::size_t faces = 0;
    for (const auto& row : cells.map.neighbours()) {
      for (const HalfFaceId across : row) faces += !across.is_none();
    }
    for (std::size_t gone = 0; gone < faces / 2;) {
      ContactMemory contact;
      const HalfFaceId face{random() % (4 * cells.map.tetrahedra())};
      if (random() % 2 == 0 && tie(cells, contact, face)) {
        live.push_back(contact.ties.back());
        continue;
      }
      if (live.empty()) continue;
      const std::size_t count = std::min<std::size_t>(live.size(), 1 + random() % 4);
      contact.ties.clear();
      for (std::size_t k = 0; k < count; ++k) {
        std::swap(live[random() % live.size()], live.back());
        contact.ties.push_back(live.back());
        live.pop_back();
        is_free[contact.ties.back().face.index()] = 1;
        is_free[contact.ties.back().opposite.index()] = 1;
      }
      const auto detection = static_cast<Detection>(random() % 4);
      const TieRelease release = release_ties(cells, contact, detection, scratch);
      REQUIRE(release.faces.size() == count);
      REQUIRE(contact.ties.empty());
      REQUIRE(contact.partners.size() == count);
      gone += count;
      released += count;
      check_labels(cells, whole, is_free);
    }
    CHECK(cells.pieces->labels.size.size() == cells.map.tetrahedra());
    CHECK(check(cells.map).empty());
    CHECK(cells.pieces->map.vertices() == cells.map.vertices());
  }
}
