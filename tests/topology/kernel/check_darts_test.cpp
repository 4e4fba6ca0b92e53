// SPDX-License-Identifier: MIT
// Every rule of `check` about the darts of a map, broken alone: its words, how often,
// where.
#include <memory>

#include "tests/topology/kernel/map_damage.hpp"
#include "topology/kernel/dart_map.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// The darts of these rows take the place of the map's.
void replace_darts(const VolumeMap& map, const MapRows& rows) {
  auto& darts = const_cast<DartMap&>(map.darts());
  std::destroy_at(&darts);
  std::construct_at(&darts, rows);
}

}  // namespace

TEST_CASE("darts that break one rule of a map are told by it", "[topology][volume_map]") {
  VolumeMap map = built(kuhn_box({2, 1, 1}));
  auto& darts = const_cast<DartMap&>(map.darts());
  auto& complex = darts.complex();
  const HalfFaceId f = interior_faces(map).front(), g = map.neighbour(f);
  const auto of_face = [](HalfFaceId h) { return Ids{3 * id(h), 3 * id(h) + 1, 3 * id(h) + 2}; };
  Ids of_both = of_face(f);
  for (const std::int64_t d : of_face(g)) of_both.push_back(d);
  of_both = sorted(of_both);
  const auto dart = [&darts](std::int64_t d) {
    return darts.dart_at(TetId{static_cast<std::size_t>(d / 12)}, static_cast<int>(d % 12));
  };
  const VertexId v = map.vertex(DartId{31});
  Ids of_vertex;
  for (std::size_t d = 0; d < 12 * map.tetrahedra(); ++d) {
    if (map.vertex(DartId{d}) == v) of_vertex.push_back(static_cast<std::int64_t>(d));
  }

  SECTION("its row") {
    for (const std::size_t wrong : {std::size_t{0}, std::size_t{60}}) {
      complex.info(dart(31)) = DartId{wrong};
      require_only(check(map), "a dart carries its own row", {31});
    }
  }
  SECTION("the row of its vertex") {
    for (const std::size_t wrong : {v.index() - 1, v.index() + 1}) {
      complex.info<0>(dart(31)).row = VertexId{wrong};
      require_only(check(map), "row in the 0-attribute equals the corner's", of_vertex);
    }
  }
  SECTION("the point of its vertex") {
    for (const std::uint32_t wrong : {map.point_of_vertex(v) - 1, map.point_of_vertex(v) + 1}) {
      complex.info<0>(dart(31)).point = wrong;
      require_only(check(map), "the file's point in the 0-attribute equals the row's", {v.value});
    }
  }
  SECTION("the place of its vertex") {
    for (const double wrong : {-9.0, 9.0}) {
      complex.point(dart(31)) = DartComplex::Point(wrong, 0, 0);
      require_only(check(map), "the point of the 0-attribute equals the row's", {v.value});
    }
  }
  SECTION("the row of its tetrahedron, more often than places are kept") {
    complex.info<3>(dart(24)) = TetId{1};
    complex.info<3>(dart(36)) = TetId{4};
    Ids all;
    for (int d = 24; d < 48; ++d) all.push_back(d);
    require_only(check(map), "row in the 3-attribute equals the tetrahedron's", all);
  }
  SECTION("a face unsewn") {
    darts.unsew(f);
    require_only(check(map), "boundary of darts equals that of rows", of_both);
  }
  SECTION("a face sewn that is none in the rows") {
    std::vector<HalfFaceId> free;
    for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
      if (map.neighbour(HalfFaceId{i}).is_none()) free.emplace_back(i);
    }
    darts.sew(darts.dart_at(tetrahedron_of(free[0]), 3 * place_of(free[0])),
              darts.dart_at(tetrahedron_of(free[1]), 3 * place_of(free[1])));
    Ids both = of_face(free[0]);
    for (const std::int64_t d : of_face(free[1])) both.push_back(d);
    require_only(check(map), "boundary of darts equals that of rows", both);
  }
  SECTION("a face sewn with a turn") {
    const auto d = dart(3 * id(f)), e = darts.beta3(d);
    darts.unsew(f);
    darts.sew(d, darts.beta1(e));
    require_only(check(map), "beta3 equals the neighbour of the rows", of_both);
  }
  SECTION("a dart too many") {
    complex.create_dart(DartId{0});
    require_only(check(map), "12 darts a tetrahedron", {0});
  }
  SECTION("a dart too few") {
    // The third face of a tetrahedron gets two darts, which takes care that no link leads astray.
    const auto gone = dart(35), next = darts.beta1(gone), before = darts.beta0(gone);
    const auto beside = darts.beta2(gone), same_vertex = darts.beta2(before);
    complex.set_dart_of_attribute<0>(complex.attribute<0>(gone), same_vertex);
    complex.set_dart_of_attribute<3>(complex.attribute<3>(gone), next);
    complex.dart_link_beta<1>(before, next), complex.dart_link_beta<0>(next, before);
    complex.dart_link_beta<2>(beside, beside);
    if (!darts.is_free(gone)) complex.dart_link_beta<3>(darts.beta3(gone), darts.beta3(gone));
    complex.erase_dart(gone);
    require_among(check(map), "12 darts a tetrahedron", {0});
  }
  SECTION("rows of darts for vertices that are none, or none for one that is") {
    darts.fit_rows(map.vertices() + 1);
    require_only(check(map), "as many 0-attributes as rows", {0});
    complex.info(dart(31)) = DartId{0};  // nothing else is asked then
    require_only(check(map), "as many 0-attributes as rows", {0});
    complex.info(dart(31)) = DartId{31};
    map.append_node(Point{});
    darts.fit_rows(map.vertices() - 1);
    require_only(check(map), "as many 0-attributes as rows", {0});
  }
  SECTION("darts of a tetrahedron that is none") {
    MapRows rows = map.dense().rows();
    const TetId added{map.tetrahedra()};
    rows.corners.push_back(rows.corners[0]);
    rows.neighbours.emplace_back();
    CellChange change{rows.points.size(), map.vertices(), map.tetrahedra()};
    change.cells = {{added, rows.corners.back(), rows.neighbours.back()}};
    darts.apply(change, rows);
    require_only(check(map), "as many tetrahedra as rows", {0});
  }
  SECTION("no darts of one that is") {
    MapRows rows = map.dense().rows();
    rows.corners.pop_back();
    rows.neighbours.pop_back();
    for (auto& row : rows.neighbours) {
      for (HalfFaceId& h : row) {
        if (!h.is_none() && h.index() >= 4 * rows.corners.size()) h = HalfFaceId::none();
      }
    }
    replace_darts(map, rows);
    require_only(check(map), "as many tetrahedra as rows", {0});
  }
  SECTION("one attribute for two vertices, and for two tetrahedra") {
    const auto kept = complex.attribute<0>(dart(31));
    const auto gone = complex.attribute<0>(darts.beta1(dart(31)));
    const auto first = complex.attribute<3>(dart(0)), second = complex.attribute<3>(dart(12));
    for (std::int64_t d = 0; d < 12 * static_cast<std::int64_t>(map.tetrahedra()); ++d) {
      if (complex.attribute<0>(dart(d)) == gone) complex.set_dart_attribute<0>(dart(d), kept);
      if (complex.attribute<3>(dart(d)) == second) complex.set_dart_attribute<3>(dart(d), first);
    }
    complex.erase_attribute<0>(gone), complex.erase_attribute<3>(second);
    require_among(check(map), "one 0-attribute a row in use", {0});
    require_among(check(map), "one 3-attribute a tetrahedron", {0});
  }
  SECTION("attributes that nobody has") {
    CHECK(VertexInfo{}.point == 0);
    complex.create_attribute<0>();
    require_only(check(map), "one 0-attribute a row in use", {0});
    complex.create_attribute<3>();
    CHECK(check(map).size() == 2);
    require_among(check(map), "one 3-attribute a tetrahedron", {0});
  }
  SECTION("one dart of a vertex with the attribute of another") {
    const auto other = complex.attribute<0>(darts.beta1(dart(31)));
    complex.set_dart_attribute<0>(dart(31), other);
    const std::vector<Finding> findings = check(map);
    require_among(findings, "row in the 0-attribute equals the corner's", {31});
    require_among(findings, "each vertex orbit has one 0-attribute",
                  sorted({v.value, map.vertex(map.beta1(DartId{31})).value}));
  }
  SECTION("an attribute that names a dart of another vertex") {
    for (const auto wrong : {darts.beta1(dart(31)), darts.beta0(dart(31))}) {
      complex.set_dart_of_attribute<0>(complex.attribute<0>(dart(31)), wrong);
      require_only(check(map), "the dart of a 0-attribute has that attribute", {v.value});
    }
  }
  SECTION("one dart of a face across to another one of it") {
    const auto d = dart(3 * id(f)), e = darts.beta3(d), next = darts.beta1(e);
    const auto of_next = darts.beta3(next);
    complex.unlink_beta<3>(d), complex.unlink_beta<3>(next);
    complex.basic_link_beta_for_involution<3>(d, next);
    complex.basic_link_beta_for_involution<3>(e, of_next);
    Ids four = sorted(
        {darts.id(d).value, darts.id(e).value, darts.id(next).value, darts.id(of_next).value});
    const std::vector<Finding> findings = check(map);
    require_among(findings, "beta3 equals the neighbour of the rows", four);
    require_among(findings, "beta1 beta3 is an involution", of_both);
  }
}

TEST_CASE("a row that only the darts have in use is told, and one that they have not",
          "[topology][volume_map]") {
  // The corner of a tetrahedron has row 6 by rows and row 7, at the same point, by darts.
  MapRows rows;
  rows.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {3, 0, 0}, {2, 1, 0}};
  rows.point_of_vertex = {0, 1, 2, 3, 4, 5, 6, 6, 3};
  const auto row = [](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return std::array{VertexId{a}, VertexId{b}, VertexId{c}, VertexId{d}};
  };
  rows.corners = {row(0, 1, 2, 3), row(4, 5, 6, 8)};
  rows.neighbours.resize(2);
  std::vector<TetId> begins(9, TetId{1});
  std::fill_n(begins.begin(), 4, TetId{0});
  begins[7] = TetId::none();
  VolumeMap map(rows, begins);
  map.set_kernel(MapKernel::lcc);
  REQUIRE(check(map).empty());
  rows.corners[1][2] = VertexId{7};
  replace_darts(map, rows);
  require_among(check(map), "darts and rows agree on which rows are in use", {6, 7});
}

TEST_CASE("every link of a dart to a wrong one is told, by each rule that it breaks",
          "[topology][volume_map]") {
  const TetMesh mesh = kuhn_box({1, 1, 1});
  const VolumeMap whole = built(mesh);
  for (std::size_t k = 0; k < 12; ++k) {
    for (std::size_t wrong = 0; wrong < 24; ++wrong) {
      for (unsigned int which = 0; which < 4; ++which) {
        VolumeMap map = whole;
        auto& darts = const_cast<DartMap&>(map.darts());
        const auto at = [&](DartId d) {
          return darts.dart_at(TetId{d.index() / 12}, static_cast<int>(d.index() % 12));
        };
        const DartMap::Dart d = at(DartId{24 + k}), e = at(DartId{12 + wrong});
        const std::array links = {darts.beta0(d), darts.beta1(d), darts.beta2(d), darts.beta3(d)};
        if (links[which] == e) continue;
        if (which == 0) darts.complex().dart_link_beta<0>(d, e);
        if (which == 1) darts.complex().dart_link_beta<1>(d, e);
        if (which == 2) darts.complex().dart_link_beta<2>(d, e);
        if (which == 3) darts.complex().dart_link_beta<3>(d, e);
        INFO("beta" << which << " of " << k << " to " << wrong);
        std::array<Ids, 5> expected;
        for (std::size_t i = 0; i < 12 * map.tetrahedra(); ++i) {
          const DartId id{i};
          const DartMap::Dart dart = at(id);
          if (darts.beta0(dart) != at(map.beta0(id))) expected[0].push_back(id.value);
          if (darts.beta1(dart) != at(map.beta1(id))) expected[1].push_back(id.value);
          if (darts.beta2(dart) != at(map.beta2(id))) expected[2].push_back(id.value);
          if (darts.vertex(dart) != map.vertex(id)) expected[3].push_back(id.value);
          if (darts.is_free(dart) || map.is_free(id)) continue;
          const auto across = darts.beta3(dart);
          if (across == dart || darts.beta3(across) != dart) expected[4].push_back(id.value);
        }
        const std::vector<Finding> findings = check(map);
        REQUIRE_FALSE(findings.empty());
        const std::array rules = {"beta0 is the inverse of beta1", "beta1 is the next of the face",
                                  "beta2 crosses the edge",
                                  "row in the 0-attribute equals the corner's",
                                  "beta3 is an involution"};
        for (std::size_t i = 0; i < rules.size(); ++i) {
          const auto told = std::ranges::find(findings, rules[i], &Finding::text);
          CHECK((told == findings.end()) == expected[i].empty());
          if (told != findings.end()) require_only({*told}, rules[i], expected[i]);
        }
      }
    }
  }
}

TEST_CASE("of two vertices that changed a dart for one of the other, each is told",
          "[topology][volume_map]") {
  const VolumeMap whole = built(kuhn_box({2, 1, 1}));
  for (std::size_t v = 0; v < whole.vertices(); ++v) {
    for (std::size_t u = 0; u < v; ++u) {
      if (star(whole, VertexId{v}).size() == star(whole, VertexId{u}).size()) continue;
      VolumeMap map = whole;
      auto& darts = const_cast<DartMap&>(map.darts());
      // Attributes have as many darts as before: the difference is seen from the dart that is
      // asked.
      const auto asked = [&](std::size_t vertex) {
        const TetId t = map.incident_tetrahedron(VertexId{vertex});
        const int place = place_of_vertex(map.corners(t), VertexId{vertex});
        return darts.dart_at(t, dart_order::dart_from((place + 1) % 4, place));
      };
      const auto x = asked(v), y = asked(u);
      const auto of_x = darts.complex().attribute<0>(x), of_y = darts.complex().attribute<0>(y);
      darts.complex().set_dart_attribute<0>(x, of_y);
      darts.complex().set_dart_attribute<0>(y, of_x);
      require_among(check(map), "each vertex orbit has one 0-attribute",
                    {static_cast<std::int64_t>(u), static_cast<std::int64_t>(v)});
    }
  }
}
