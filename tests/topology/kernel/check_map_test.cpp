// SPDX-License-Identifier: MIT
// Every rule that `check` holds a map against, broken alone: its words, how often, where.
#include "tests/support/built.hpp"
#include "topology/kernel/dart_map.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

struct Rows {
  MapRows map;
  std::vector<TetId> begins;
};

Rows rows_of(const TetMesh& mesh) {
  const VolumeMap map = built(mesh);
  const auto begins = map.dense().incident_tetrahedra();
  return {map.dense().rows(), {begins.begin(), begins.end()}};
}

std::vector<Finding> checked(const Rows& rows) { return check(VolumeMap(rows.map, rows.begins)); }

using Ids = std::vector<std::int64_t>;

void require_only(const std::vector<Finding>& findings, const std::string& rule, const Ids& ids) {
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].code == "map_damaged");
  CHECK(findings[0].severity == Severity::error);
  CHECK(findings[0].remedy.starts_with("report this"));
  CHECK(findings[0].text == rule);
  CHECK(findings[0].count == ids.size());
  CHECK(findings[0].ids ==
        Ids(ids.begin(), ids.begin() + std::min<std::ptrdiff_t>(16, std::ssize(ids))));
}

void require_among(const std::vector<Finding>& findings, const std::string& rule, const Ids& ids) {
  for (const Finding& f : findings) {
    if (f.text == rule) return require_only({f}, rule, ids);
  }
  FAIL("nobody says: " << rule);
}

HalfFaceId& across(Rows& rows, HalfFaceId f) {
  return rows.map.neighbours[f.index() / 4][f.index() % 4];
}
std::int64_t id(HalfFaceId f) { return f.value; }

Ids sorted(Ids ids) {
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace

TEST_CASE("rows that break one rule of a map are told by it, before any dart is made",
          "[topology][volume_map]") {
  Rows rows = rows_of(kuhn_box({2, 1, 1}));
  REQUIRE(checked(rows).empty());
  const std::size_t vertices = rows.begins.size(), tetrahedra = rows.map.corners.size();

  SECTION("a row of a corner") {
    for (const std::size_t row : {vertices, vertices + 5}) {
      rows.map.corners[5][3] = VertexId{row};
      require_among(checked(rows), "rows of corners are in range", {5});
    }
  }
  SECTION("two corners on one point") {
    rows.map.point_of_vertex[rows.map.corners[3][0].index()] =
        rows.map.point_of_vertex[rows.map.corners[3][2].index()];
    Ids both;
    for (std::size_t t = 0; t < tetrahedra; ++t) {
      const auto& c = rows.map.corners[t];
      if (std::ranges::count(c, rows.map.corners[3][0]) +
              std::ranges::count(c, rows.map.corners[3][2]) ==
          2) {
        both.push_back(static_cast<std::int64_t>(t));
      }
    }
    require_only(checked(rows), "the corners of a tetrahedron have different points", both);
  }
  const VolumeMap whole = built(kuhn_box({2, 1, 1}));
  const HalfFaceId f = interior_faces(whole).front(), g = whole.neighbour(f);
  SECTION("a neighbour that is none of them") {
    for (const std::size_t row : {4 * tetrahedra, 4 * tetrahedra + 7}) {
      across(rows, f) = HalfFaceId{row};
      require_among(checked(rows), "neighbours are in range", {id(f)});
    }
    for (int p = 0; p < 4; ++p) across(rows, half_face(TetId{4}, p)) = HalfFaceId{4 * tetrahedra};
    across(rows, f) = g;
    require_among(checked(rows), "neighbours are in range", {16, 17, 18, 19});
  }
  SECTION("a neighbour that knows of none") {
    across(rows, g) = HalfFaceId::none();
    require_only(checked(rows), "neighbours name each other", {id(f)});
    const HalfFaceId last = interior_faces(whole).back(), of_last = whole.neighbour(last);
    across(rows, g) = f;
    across(rows, of_last) = HalfFaceId{0};
    for (const Finding& told : checked(rows)) {
      if (told.text == "neighbours name each other")
        CHECK(std::ranges::count(told.ids, id(last)) == 1);
    }
    require_among(checked(rows), "neighbours name each other", sorted({id(last), id(of_last)}));
  }
  SECTION("two faces of one tetrahedron changed for each other") {
    HalfFaceId other;
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId h = half_face(tetrahedron_of(f), p);
      if (h != f && !whole.neighbour(h).is_none()) other = h;
    }
    REQUIRE_FALSE(other.is_none());
    const HalfFaceId k = whole.neighbour(other);
    across(rows, f) = k, across(rows, k) = f;
    across(rows, other) = g, across(rows, g) = other;
    require_only(checked(rows), "the rows of a face are the same on both sides",
                 sorted({id(f), id(g), id(other), id(k)}));
  }
  SECTION("a face taken for one beside it, whose opposite corner it has") {
    HalfFaceId beside;
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId h = half_face(tetrahedron_of(g), p);
      if (whole.neighbour(h).is_none()) beside = h;
    }
    REQUIRE_FALSE(beside.is_none());
    across(rows, f) = beside, across(rows, beside) = f;
    across(rows, g) = HalfFaceId::none();
    require_only(checked(rows), "the rows of a face are the same on both sides",
                 sorted({id(f), id(beside)}));
  }
  SECTION("a vertex that begins nowhere, or where it is not") {
    rows.begins[2] = rows.begins[5] = TetId::none();
    require_only(checked(rows), "only retired rows have no tetrahedron", {2, 5});
    for (const std::size_t v : {2, 5}) {
      std::size_t t = 0;
      while (place_of_vertex(rows.map.corners[t], VertexId{v}) < 4) ++t;
      rows.begins[v] = TetId{t};
    }
    require_only(checked(rows), "the incident tetrahedron has the vertex", {2, 5});
  }
  SECTION("corners that have the row of a node") {
    rows.map.first_node_point = 10;  // of twelve
    require_only(checked(rows), "no corner has the row of a node", {10, 11});
  }
}

TEST_CASE("a row of two orbits and a retired last row are damage", "[topology][volume_map]") {
  Rows rows = rows_of(two_tetrahedra_sharing_a_vertex());
  const std::size_t last = rows.begins.size() - 1;
  VertexId first;
  for (VertexId& v : rows.map.corners[1]) {
    if (v.index() != last) continue;
    for (const VertexId u : rows.map.corners[0]) {
      if (rows.map.point_of_vertex[u.index()] == rows.map.point_of_vertex[last]) v = first = u;
    }
  }
  REQUIRE_FALSE(first.is_none());
  // One row for both: nobody has the last row any more, and it says that it begins.
  std::vector<Finding> findings = checked(rows);
  CHECK(findings.size() == 2);
  require_among(findings, "each row is one vertex orbit", {first.value});
  require_among(findings, "only retired rows have no tetrahedron",
                {static_cast<std::int64_t>(last)});
  rows.begins[last] = TetId::none();
  findings = checked(rows);
  CHECK(findings.size() == 2);
  require_among(findings, "each row is one vertex orbit", {first.value});
  require_among(findings, "the last row is not a retired one",
                {static_cast<std::int64_t>(last) + 1});
}

TEST_CASE("a body without tetrahedra has nothing to break", "[topology][volume_map]") {
  CHECK(check(VolumeMap(MapRows{})).empty());
}

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
    require_among(check(map), "as many tetrahedra as rows", {0});
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
      // Attributes have as many darts as before: what differs is seen from the dart that is asked.
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
