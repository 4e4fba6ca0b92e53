// SPDX-License-Identifier: MIT
// Rows of edges through splits and gluing, against a twin that joins edges across sewn faces.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "tests/support/built.hpp"
#include "topology/base/point_math.hpp"
#include "topology/base/union_find.hpp"
#include "topology/kernel/edge_nodes.hpp"
#include "topology/kernel/split_face.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// The two file points of an edge, sorted.
std::pair<std::uint32_t, std::uint32_t> ends_of(const VolumeMap& map, std::size_t t,
                                                std::size_t e) {
  const auto [i, j] = edge_ends[e];
  const auto point = [&](int k) {
    return map.point_of_vertex(map.corners(TetId{t})[static_cast<std::size_t>(k)]);
  };
  return std::minmax(point(i), point(j));
}

/// An orbit's number of each edge of each tetrahedron: edges of sewn faces are joined, nothing
/// walks.
std::vector<std::uint32_t> joined_edges(const VolumeMap& map) {
  UnionFind joined(6 * map.tetrahedra());
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    const HalfFaceId across = map.neighbour(HalfFaceId{f});
    if (across.is_none()) continue;
    for (std::size_t e = 0; e < 6; ++e) {
      const int place = place_of(HalfFaceId{f});
      if (edge_ends[e][0] == place || edge_ends[e][1] == place) continue;
      for (std::size_t other = 0; other < 6; ++other) {
        const std::size_t u = across.index() / 4;
        if (ends_of(map, f / 4, e) != ends_of(map, u, other)) continue;
        joined.join(static_cast<std::uint32_t>(6 * (f / 4) + e),
                    static_cast<std::uint32_t>(6 * u + other));
      }
    }
  }
  std::vector<std::uint32_t> orbit;
  for (std::uint32_t k = 0; k < 6 * map.tetrahedra(); ++k) orbit.push_back(joined.root(k));
  return orbit;
}

/// Whether rows and orbits name the same edges.
bool agree(const EdgeNodeRows& nodes, const VolumeMap& map) {
  const std::vector<std::uint32_t> orbit = joined_edges(map);
  std::map<VertexId, std::uint32_t> of_row;
  std::set<std::uint32_t> orbits;
  for (std::uint32_t k = 0; k < orbit.size(); ++k) {
    const auto [at, fresh] = of_row.try_emplace(nodes[k / 6][k % 6], orbit[k]);
    if (at->second != orbit[k]) return false;
    orbits.insert(orbit[k]);
  }
  return orbits.size() == of_row.size();
}

using Told = std::vector<std::pair<std::string, std::int64_t>>;

/// The findings that `check` has to give, in its order.
Told to_tell(const EdgeNodeRows& nodes, const VolumeMap& map) {
  const auto row_count = static_cast<std::int64_t>(nodes.size());
  if (nodes.size() != map.tetrahedra()) {
    return {{"there is not one row of edges a tetrahedron", row_count}};
  }
  Told told;
  const auto with_rows = [&](std::size_t t) { return nodes[t] != EdgeNodeRows::value_type{}; };
  for (std::size_t t = 0; t < nodes.size(); ++t) {
    const auto id = static_cast<std::int64_t>(t);
    if (!with_rows(t)) continue;
    if (std::ranges::count(nodes[t], VertexId::none()) > 0) {
      told.emplace_back("a tetrahedron has rows for some of its edges only", id);
      return told;
    }
    for (std::size_t e = 0; e < 6; ++e) {
      const VertexId row = nodes[t][e];
      if (row.index() >= map.vertices() || !map.is_node(row)) {
        told.emplace_back("the row of an edge is no node's", id);
        return told;
      }
      const auto [i, j] = ends_of(map, t, e);
      const Point middle = detail::middle(map.points()[i], map.points()[j]);
      if (map.point(row) != middle) {
        told.emplace_back("the row of an edge is not at its middle", id);
      }
    }
  }
  const std::vector<std::uint32_t> orbit = joined_edges(map);
  std::map<std::uint32_t, VertexId> first_row;
  for (std::uint32_t k = 0; k < orbit.size(); ++k) {
    first_row.try_emplace(orbit[k], nodes[k / 6][k % 6]);
  }
  std::map<VertexId, std::uint32_t> first_orbit;
  for (std::uint32_t k = 0; k < orbit.size(); ++k) {
    const VertexId row = nodes[k / 6][k % 6];
    if (!with_rows(k / 6)) continue;
    if (first_row.at(orbit[k]) != row) {
      told.emplace_back("tetrahedra round one edge have different rows for it", k / 6);
    }
    if (first_orbit.try_emplace(row, orbit[k]).first->second != orbit[k]) {
      told.emplace_back("two edges have one row", k / 6);
    }
  }
  return told;
}

/// Damages one row of an edge, or a tetrahedron's, or how many there are.
void damage(EdgeNodeRows& nodes, VolumeMap& map, std::mt19937& random) {
  const std::size_t t = random() % nodes.size(), e = random() % 6, u = random() % nodes.size();
  const VertexId row = nodes[t][e];
  switch (random() % 12) {
    case 0:
      nodes[t][e] = VertexId::none();
      break;
    case 1:
      nodes[t][e] = VertexId{random() % 2};  // a vertex
      break;
    case 2:
      nodes[t][e] = VertexId{map.vertices() + random() % 3};
      break;
    case 3:
      nodes[t] = EdgeNodeRows::value_type{};
      break;
    case 4:
      std::swap(nodes[t][e], nodes[u][random() % 6]);
      break;
    case 5:
      if (random() % 2 == 0)
        nodes.push_back(nodes[t]);
      else
        nodes.pop_back();
      break;
    case 6:
    case 7:
    case 8:
      // Another node at the same place, of this tetrahedron alone.
      if (row.index() < map.vertices() && map.is_node(row)) nodes[t][e] = map.append_node(row);
      break;
    default:
      // The row that another tetrahedron has for the edge between the same points.
      for (std::size_t other = 0; other < 6; ++other) {
        if (ends_of(map, u, other) == ends_of(map, t, e)) nodes[t][e] = nodes[u][other];
      }
  }
}

bool same_rows(const VolumeMap& a, const VolumeMap& b) {
  const MapRows &x = a.dense().rows(), &y = b.dense().rows();
  return x.corners == y.corners && x.neighbours == y.neighbours && x.points == y.points &&
         x.point_of_vertex == y.point_of_vertex && x.first_node_point == y.first_node_point;
}

std::vector<TetMesh> bodies() {
  return {two_tetrahedra(), closed_fan(5), octahedron_star(), kuhn_box({2, 2, 2}),
          side_by_side(kuhn_box({1, 1, 1}), closed_fan(3))};
}

}  // namespace

TEST_CASE("two tetrahedra that part have three edges each of their own", "[topology][edge_nodes]") {
  for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
    VolumeMap map = built(two_tetrahedra());
    map.set_kernel(kernel);
    EdgeNodeRows nodes;
    append_edge_nodes(nodes, map, TetId{0}, TetId{2});
    CHECK(map.vertices() == 5 + 9);
    CHECK(check(map).empty());
    const EdgeNodeRows before = nodes;
    const FaceSplit split = split_on(map, {0, 1, 2});
    const EdgeSplits edges = split_edge_nodes(nodes, map, split);
    CHECK(split.vertex_count == 3);
    REQUIRE(edges.count == 3);
    CHECK(map.vertices() == 8 + 12);
    const std::size_t kept = tetrahedron_of(split.face).index();
    CHECK(nodes[kept] == before[kept]);
    for (std::uint32_t i = 0; i < 3; ++i) {
      const VertexCopy& copy = edges.copies[i];
      CHECK(copy.new_row == VertexId{17 + i});
      CHECK(map.point(copy.new_row) == map.point(copy.old_row));
      CHECK(std::ranges::count(nodes[kept], copy.old_row) == 1);
      CHECK(std::ranges::count(nodes[1 - kept], copy.new_row) == 1);
      CHECK(std::ranges::count(nodes[1 - kept], copy.old_row) == 0);
    }
    CHECK(check(map).empty());
    CHECK(check(nodes, map).empty());
    // A face on the boundary has no other side with edges to look at.
    const FaceSplit refused = split_face(map, split.face);
    CHECK_FALSE(refused.did);
    CHECK(split_edge_nodes(nodes, map, refused).count == 0);
  }
}

TEST_CASE(
    "rows of edges follow bodies until all of their faces are apart, and back to the same bytes",
    "[topology][edge_nodes]") {
  std::mt19937 random(7);
  for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
    for (const TetMesh& mesh : bodies()) {
      VolumeMap map = built(mesh);
      map.set_kernel(kernel);
      EdgeNodeRows nodes;
      append_edge_nodes(nodes, map, TetId{0}, TetId{map.tetrahedra()});
      REQUIRE(agree(nodes, map));
      std::vector<HalfFaceId> faces = interior_faces(map);
      std::ranges::shuffle(faces, random);
      std::vector<std::pair<VolumeMap, EdgeNodeRows>> stages;
      std::vector<FaceSplit> splits;
      for (const HalfFaceId face : faces) {
        stages.emplace_back(map, nodes);
        const bool other_side = random() % 2 != 0;
        splits.push_back(split_face(map, other_side ? map.neighbour(face) : face));
        const EdgeSplits edges = split_edge_nodes(nodes, map, splits.back());
        REQUIRE(edges.count == edge_count(splits.back()));
        REQUIRE(agree(nodes, map));
        REQUIRE(check(nodes, map).empty());
        REQUIRE(check(map).empty());
      }
      // Apart altogether: four vertices and six edges per tetrahedron.
      CHECK(map.vertices() == 10 * map.tetrahedra());
      while (!splits.empty()) {
        join_edge_nodes(nodes, map, splits.back().face, splits.back().opposite);
        REQUIRE(glue_face(map, splits.back().face, splits.back().opposite).refusal ==
                GlueRefusal::none);
        REQUIRE(same_rows(map, stages.back().first));
        REQUIRE(nodes == stages.back().second);
        REQUIRE(check(map).empty());
        splits.pop_back();
        stages.pop_back();
      }
    }
  }
}

TEST_CASE("faces glued in another order than they were split leave edges whole, with fewer rows",
          "[topology][edge_nodes]") {
  std::mt19937 random(11);
  VolumeMap map = built(kuhn_box({2, 2, 1}));
  EdgeNodeRows nodes;
  append_edge_nodes(nodes, map, TetId{0}, TetId{map.tetrahedra()});
  std::vector<FaceSplit> splits;
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    const FaceSplit split = split_face(map, HalfFaceId{f});
    if (!split.did) continue;
    split_edge_nodes(nodes, map, split);
    splits.push_back(split);
  }
  std::ranges::shuffle(splits, random);
  for (const FaceSplit& split : splits) {
    join_edge_nodes(nodes, map, split.face, split.opposite);
    REQUIRE(glue_face(map, split.face, split.opposite).refusal == GlueRefusal::none);
    REQUIRE(agree(nodes, map));
    REQUIRE(check(nodes, map).empty());
    REQUIRE(check(map).empty());
  }
}

TEST_CASE("a body beside one of second order has no rows of edges", "[topology][edge_nodes]") {
  VolumeMap map = built(side_by_side(two_tetrahedra(), two_tetrahedra()));
  EdgeNodeRows nodes;
  append_edge_nodes(nodes, map, TetId{2}, TetId{4});
  CHECK(map.vertices() == 10 + 9);
  CHECK(nodes[0][0].is_none());
  const FaceSplit plain = split_on(map, {0, 1, 2});
  CHECK(plain.split_edges == 7);
  CHECK(split_edge_nodes(nodes, map, plain).count == 0);
  join_edge_nodes(nodes, map, plain.face, plain.opposite);
  CHECK(glue_face(map, plain.face, plain.opposite).refusal == GlueRefusal::none);
  CHECK(check(map).empty());
  CHECK(check(nodes, map).empty());
}

TEST_CASE("damaged rows of edges are told", "[topology][edge_nodes]") {
  VolumeMap map = built(closed_fan(4));
  EdgeNodeRows whole;
  append_edge_nodes(whole, map, TetId{0}, TetId{4});
  const auto text = [&](const EdgeNodeRows& nodes) {
    const std::vector<Finding> findings = check(nodes, map);
    REQUIRE(!findings.empty());
    CHECK(findings.front().code == "damaged_edge_rows");
    return findings.front().text;
  };
  CHECK(text({}) == "there is not one row of edges a tetrahedron");
  EdgeNodeRows nodes = whole;
  nodes[1][2] = VertexId::none();
  CHECK(text(nodes) == "a tetrahedron has rows for some of its edges only");
  nodes = whole;
  nodes[1][2] = VertexId{0};
  CHECK(text(nodes) == "the row of an edge is no node's");
  nodes = whole;
  nodes[1][2] = VertexId{map.vertices()};
  CHECK(text(nodes) == "the row of an edge is no node's");
  nodes = whole;
  std::swap(nodes[0][0], nodes[0][1]);
  CHECK(text(nodes) == "the row of an edge is not at its middle");
  // One row for two edges at the same place: the state after a split that the rows did not follow.
  VolumeMap two = built(two_tetrahedra());
  EdgeNodeRows rows;
  append_edge_nodes(rows, two, TetId{0}, TetId{2});
  split_on(two, {0, 1, 2});
  REQUIRE(check(rows, two).size() == 3);
  CHECK(check(rows, two).front().text == "two edges have one row");
  VolumeMap sewn = built(two_tetrahedra());
  EdgeNodeRows more;
  append_edge_nodes(more, sewn, TetId{0}, TetId{2});
  const auto shared = std::ranges::find_if(
      more[1], [&](VertexId row) { return std::ranges::count(more[0], row) == 1; });
  REQUIRE(shared != more[1].end());
  *shared = sewn.append_node(*shared);
  REQUIRE(check(more, sewn).size() == 1);
  CHECK(check(more, sewn).front().text == "tetrahedra round one edge have different rows for it");
}

TEST_CASE("damage of rows of edges is told tetrahedron by tetrahedron, as a twin tells it",
          "[topology][edge_nodes]") {
  std::mt19937 random(13);
  std::set<std::string> all;
  for (int round = 0; round < 400; ++round) {
    const std::vector<TetMesh> meshes = bodies();
    VolumeMap map = built(meshes[random() % meshes.size()]);
    map.set_kernel(MapKernel::dense);
    EdgeNodeRows nodes;
    append_edge_nodes(nodes, map, TetId{0}, TetId{map.tetrahedra()});
    for (std::size_t i = random() % 8; i > 0; --i) {
      const FaceSplit split = split_face(map, HalfFaceId{random() % (4 * map.tetrahedra())});
      // Edges that come apart without a row of their own leave one for two.
      if (random() % 4 != 0) split_edge_nodes(nodes, map, split);
    }
    for (std::size_t i = random() % 4; i > 0 && nodes.size() == map.tetrahedra(); --i) {
      damage(nodes, map, random);
    }
    Told told;
    for (const Finding& f : check(nodes, map)) told.emplace_back(f.text, f.ids.at(0));
    INFO("round " << round);
    REQUIRE(told == to_tell(nodes, map));
    for (const auto& [text, id] : told) all.insert(text);
  }
  CHECK(all.size() == 6);
}
