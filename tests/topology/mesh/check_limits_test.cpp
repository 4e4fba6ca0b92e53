// SPDX-License-Identifier: MIT
// A check at its very limits: volumes as large as rounding allows, gaps as wide as the tolerance,
// points straight above corners and edges. All coordinates are such that nothing is rounded.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/built.hpp"
#include "topology/base/point_math.hpp"
#include "topology/mesh/crack.hpp"
#include "topology/mesh/survey.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();

using Four = std::array<Point, 4>;

std::size_t count_of(const std::vector<Finding>& findings, const std::string& code) {
  for (const Finding& f : findings) {
    if (f.code == code) return f.count;
  }
  return 0;
}

/// Tetrahedra with points of their own.
TetMesh apart(const std::vector<Four>& tetrahedra) {
  TetMesh mesh;
  for (const Four& t : tetrahedra) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), t.begin(), t.end());
    mesh.tetrahedra.push_back({first, first + 1, first + 2, first + 3});
  }
  return mesh;
}

/// A tetrahedron with its tip at `x`, all else above it (below, if `size` is negative): too small
/// for anything to be near to it but at the tip.
Four above(const Point& x, double size = 0x1p-4) {
  const auto by = [&](double u, double v) { return Point{x[0] + u, x[1] + v, x[2] + size}; };
  return {x, by(size, 0), by(0, size), by(-size, -size)};
}

/// Hanging and close points of a tetrahedron with a tip upon it.
std::array<std::size_t, 2> contact(const Four& t, const Point& tip, double size = 0x1p-4) {
  const auto findings = check_file_mesh(file_mesh_of(apart({t, above(tip, size)}))).findings;
  return {count_of(findings, "hanging_vertex"), count_of(findings, "close_points")};
}

using Counted = std::array<std::size_t, 2>;
constexpr Counted nothing = {0, 0}, hangs = {1, 0}, is_close = {0, 1};

}  // namespace

TEST_CASE("a volume as large as the limit of flatness is flat, whichever coordinate sets the limit",
          "[topology][findings]") {
  const auto is_flat = [](const Four& t) {
    return count_of(check_mesh(apart({t})), "flat_tetrahedron");
  };
  for (std::size_t bits = 0; bits < 24; ++bits) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      INFO("bits " << bits << ", axis " << axis);
      const double side = bits & 1 ? 1 : -1, leg = bits & 2 ? 1 : -1, up = bits & 4 ? 1 : -1;
      // The first corner is the farthest from the origin, or the nearest: 2 m and 1 m, legs of 1 m.
      const double first = bits < 8 ? 2 : 1, others = 3 - first;
      const auto leaf = [&](double height) {
        Four t{};
        t[0][axis] = side * first;
        for (std::size_t k = 1; k < 4; ++k) t[k][axis] = side * others;
        t[2][(axis + 1) % 3] = leg;
        t[3][(axis + 2) % 3] = up * height;
        return t;
      };
      // 18 roundings of 2 m.
      CHECK(is_flat(leaf(36 * eps)) == 1);
      CHECK(is_flat(leaf(37 * eps)) == 0);
    }
  }
  // Where all is nought, the limit is too.
  CHECK(is_flat(Four{}) == 1);
}

TEST_CASE("a point just as far from an edge, a face or a corner as the tolerance hangs or is close",
          "[topology][check][contact]") {
  const double least = contact_tolerance, more = contact_tolerance * (1 + 1e-9);
  const Four corner = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}};
  CHECK(contact(corner, {0.5, 0, least}) == hangs);
  CHECK(contact(corner, {0.5, 0, more}) == nothing);
  CHECK(contact(corner, {0, 0.5, least}) == hangs);
  CHECK(contact(corner, {0, 0, least}) == is_close);
  CHECK(contact(corner, {0, 0, more}) == nothing);
  const Four three_four_five = {{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, -4}}};
  CHECK(contact(three_four_five, {1, 1, 5 * least}) == hangs);
  CHECK(contact(three_four_five, {1, 1, 5 * more}) == nothing);
}

TEST_CASE("a point just as far from a tilted face as the tolerance hangs",
          "[topology][check][contact]") {
  // The plane 3 y + 4 z = 0, its first corner at the origin. Seen from there nothing is rounded,
  // though the other two corners' difference is.
  for (int ulps = -16; ulps <= 16; ++ulps) {
    const double tilt = ulps * 0x1p-53;
    for (const double width : {2.0, 4.0, 8.0, 16.0, 32.0}) {
      INFO("tilt " << tilt << ", width " << width);
      const Point far = {0, 4, -3}, wide = {width, 4 * tilt, -3 * tilt};
      // The order of the face against the first corner is 1 2 3.
      const Four t = {{{1, 1, 3}, {0, 0, 0}, far, wide}};
      const double longest = std::max(width, detail::length(detail::difference(wide, far)));
      for (const double along : {0.25, 1.0}) {
        // Four fifths of the distance by which it lies lower.
        const double lower = 1.25 * (contact_tolerance * longest);
        CHECK(contact(t, {along, 0, -lower}, -0x1p-4) == hangs);
        CHECK(contact(t, {along, 0, -lower * (1 + 1e-9)}, -0x1p-4) == nothing);
      }
    }
  }
}

TEST_CASE("what is straight above the end of an edge or the rim of a face does not lie inside",
          "[topology][check][contact]") {
  // Farther than a millionth of the short edges, nearer than that of the long ones.
  const Four needle = {{{0, 0, 0}, {1, 0, 0}, {1, 0.25, 0}, {1, 0, -0.25}}};
  std::array<int, 4> order = {0, 1, 2, 3};
  do {
    Four t;
    for (int i = 0; i < 4; ++i) t[i] = needle[order[i]];
    CHECK(contact(t, {0, 0, 5e-7}) == nothing);
    CHECK(contact(t, {1, 0.125, 5e-7}) == nothing);
    CHECK(contact(t, {0.5, 0, 5e-7}) == hangs);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("a tetrahedron has no contact with its own corners, thin as it may be",
          "[topology][check][contact]") {
  const Four thin = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 1e-7}}};
  CHECK(check_file_mesh(file_mesh_of(apart({thin}))).findings.empty());
}

TEST_CASE("two tetrahedra in one place have four faces there, three at one face have none",
          "[topology][check][contact]") {
  const Four t = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Finding f =
      finding(check_file_mesh(file_mesh_of(apart({t, t}))).findings, "coincident_faces");
  CHECK(f.count == 4);
  CHECK(f.ids == std::vector<std::int64_t>{4, 5, 6, 4, 5, 7, 4, 6, 7, 5, 6, 7});
  TetMesh overfull = two_tetrahedra();
  overfull.points.push_back({0.2, 0.2, -2});
  overfull.tetrahedra.push_back({1, 0, 2, 5});
  const auto findings = check_file_mesh(file_mesh_of(overfull)).findings;
  CHECK(count_of(findings, "overfull_face") == 1);
  CHECK(count_of(findings, "coincident_faces") == 0);
}

TEST_CASE("contact is what it is without tetrahedra of which a coordinate is no number",
          "[topology][check][contact]") {
  // A tip upon a face, one next to a corner, and two tetrahedra in one place.
  const Four t = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}};
  const Four other = {{{3, 0, 0}, {4, 0, 0}, {3, 1, 0}, {3, 0, 1}}};
  const TetMesh good = apart({t, above({0.25, 0.25, 0}), above({0, 1, 1e-8}), other, other});
  const auto of_contact = [](const TetMesh& mesh) {
    std::vector<std::pair<std::string, std::vector<std::uint32_t>>> places;
    for (const FindingPlaces& p : check_file_mesh(file_mesh_of(mesh), true).places) {
      if (p.code == "hanging_vertex" || p.code == "close_points" || p.code == "coincident_faces") {
        places.emplace_back(p.code, p.rows);
      }
    }
    return places;
  };
  const auto expected = of_contact(good);
  REQUIRE(expected.size() == 4);  // hanging vertices and the faces that they hang in
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    for (std::size_t i = 0; i < 12; ++i) {
      INFO("coordinate " << i << " is " << bad);
      TetMesh mesh = good;
      const auto first = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.insert(mesh.points.end(), {{7, 0, 0}, {8, 0, 0}, {7, 1, 0}, {7, 0, 1}});
      mesh.points[first + i / 3][i % 3] = bad;
      mesh.tetrahedra.insert(mesh.tetrahedra.begin(), {first, first + 1, first + 2, first + 3});
      CHECK(of_contact(mesh) == expected);
    }
  }
}

TEST_CASE("no places are kept of what hangs unless asked for", "[topology][check][contact]") {
  const Four t = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}};
  const FileMesh mesh = file_mesh_of(apart({t, above({0.25, 0.25, 0})}));
  CHECK(finding(check_file_mesh(mesh).findings, "hanging_vertex").count == 1);
  CHECK(check_file_mesh(mesh).places.empty());
  const auto places = check_file_mesh(mesh, true).places;
  const auto is_hanging = [](const FindingPlaces& p) { return p.code == "hanging_vertex"; };
  CHECK(std::ranges::count_if(places, is_hanging) == 2);  // the point, and the face
}

TEST_CASE("points not held against all faces are told from the lowest on",
          "[topology][check][contact]") {
  std::mt19937_64 random(66);
  std::vector<Four> heap(2000);
  for (Four& t : heap) {
    for (Point& p : t) p = {unit(random), unit(random), unit(random)};
  }
  const MeshCheck check = check_file_mesh(file_mesh_of(apart(heap)), true);
  const Finding f = finding(check.findings, "contact_unfinished");
  CHECK(f.count > Finding::max_ids);
  CHECK(std::ranges::is_sorted(f.ids));
  for (const FindingPlaces& p : check.places) {
    if (p.code == "contact_unfinished") CHECK(std::ranges::is_sorted(p.rows));
  }
}

TEST_CASE("findings about a mesh as a whole have no ids and no places", "[topology][findings]") {
  FileMesh mesh;
  mesh.tetrahedra.region = {1};
  for (const std::size_t points : {0, 1}) {
    mesh.points.resize(points);
    mesh.tetrahedra.region.assign(1, 1);
    const MeshCheck check = check_file_mesh(mesh, true);
    for (const char* code : {points == 0 ? "empty_mesh" : "no_tetrahedron", "column_length"}) {
      INFO(code);
      CHECK(finding(check.findings, code).ids.empty());
      CHECK(std::ranges::none_of(check.places, [&](const auto& p) { return p.code == code; }));
    }
  }
  // A column may be too long as well as too short; none, or one of every row, is no error.
  for (const std::size_t rows : {0, 1, 2, 3}) {
    INFO("rows " << rows);
    const std::size_t expected = rows == 1 || rows == 3 ? 1 : 0;
    TetMesh two = two_tetrahedra();
    two.region.assign(rows, 1);
    CHECK(count_of(check_mesh(two), "column_length") == expected);
    mesh = file_mesh_of(two_tetrahedra());
    mesh.tetrahedra.region.assign(rows, 1);
    CHECK(count_of(check_file_mesh(mesh).findings, "column_length") == expected);
  }
}

TEST_CASE("a finding says in words how many there are, and all the rest as it stands",
          "[topology][findings]") {
  TetMesh mesh = two_tetrahedra();
  mesh.tetrahedra.push_back({0, 1, 1, 4});
  CHECK(finding(check_mesh(mesh), "repeated_vertex").text ==
        "1 tetrahedron names one point more than once");
  mesh.tetrahedra.insert(mesh.tetrahedra.end(), 11, {2, 3, 4, 4});
  CHECK(finding(check_mesh(mesh), "repeated_vertex").text ==
        "12 tetrahedra name one point more than once");
  CHECK(finding(check_mesh({}), "empty_mesh").text == "the mesh has no points and no tetrahedra");
}

TEST_CASE("errors come first, and a finding names the first sixteen of its rows, or all places",
          "[topology][findings]") {
  TetMesh mesh = two_tetrahedra();
  for (int i = 0; i < 20; ++i) mesh.points.push_back({2.0 + i, 0, 0});  // unused: a warning
  mesh.tetrahedra.insert(mesh.tetrahedra.end(), 30, {2, 3, 4, 4});
  for (const bool keeps_places : {false, true}) {
    const Survey survey = survey_mesh(mesh, Severity::warning, keeps_places);
    REQUIRE(codes(survey.findings) == std::vector<std::string>{"repeated_vertex", "unused_point"});
    CHECK(survey.findings[0].ids.size() == Finding::max_ids);
    CHECK(survey.findings[1].ids.size() == Finding::max_ids);
    REQUIRE(survey.places.size() == (keeps_places ? 2 : 0));
    if (keeps_places) CHECK(survey.places[0].rows.size() == 30);
  }
}

// 18 GB and half a minute: run by hand, with `sunder_topology_tests "[.too_large]"`.
TEST_CASE("a mesh of more tetrahedra than can be numbered is told, and nothing else is asked of it",
          "[.too_large]") {
  {
    TetMesh mesh;
    mesh.points = two_tetrahedra().points;
    mesh.tetrahedra.assign(most_tetrahedra + 1, {0, 1, 1, 9});
    CHECK(codes(check_mesh(mesh)) == std::vector<std::string>{"too_large"});
    FileMesh file;
    file.points = mesh.points;
    file.tetrahedra.corners = std::move(mesh.tetrahedra);
    const MeshCheck check = check_file_mesh(file);
    CHECK(codes(check.findings) == std::vector<std::string>{"too_large"});
    CHECK_FALSE(check.quality);
  }
  FileMesh file;
  file.tetrahedra.corners.assign(std::size_t{1} << 30, {});
  const auto links = face_links(file);
  CHECK(codes(links.findings) == std::vector<std::string>{"too_many_tetrahedra"});
}
