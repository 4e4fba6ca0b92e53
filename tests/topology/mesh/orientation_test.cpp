// SPDX-License-Identifier: MIT
// Ties and long runs in a survey: which way a body is turned, which copy stays, in which order
// places are reported.
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <map>
#include <random>

#include "topology/mesh/survey.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using suite::below;

namespace {

using Corners = std::array<std::uint32_t, 4>;
using Rows = std::vector<std::uint32_t>;

std::size_t count(const Survey& survey, std::string_view code) {
  const auto found = std::ranges::find(survey.findings, code, &Finding::code);
  return found == survey.findings.end() ? 0 : found->count;
}

Rows places(const Survey& survey, std::string_view code) {
  const auto found = std::ranges::find(survey.places, code, &FindingPlaces::code);
  return found == survey.places.end() ? Rows{} : found->rows;
}

}  // namespace

TEST_CASE("where as many volumes say one thing as the other, the lowest with a volume decides",
          "[topology][findings]") {
  // A flat tetrahedron with two others on its faces, turned and numbered in every way; the walk
  // from the first comes to the one with point 5 before that with point 4.
  std::size_t ties = 0;
  for (int way = 0; way < 32; ++way) {
    INFO("way " << way);
    const auto bit = [way](int k) { return (way >> k & 1) != 0; };
    TetMesh mesh;
    mesh.points = {{0, 0, 0},
                   {1, 0, 0},
                   {0, 1, 0},
                   {1, 1, 0},
                   {0.25, 0.25, bit(0) ? 1.0 : -1.0},
                   {0.75, 0.75, bit(1) ? 1.0 : -1.0}};
    // As the flat one is numbered, except for the exchange below.
    std::array<Corners, 2> other = {{{0, 2, 1, 4}, {5, 2, 1, 3}}};
    std::array<int, 2> sign = {bit(0) ? -1 : 1, bit(1) ? -1 : 1};
    std::array<bool, 2> unlike = {bit(2), bit(3)};
    for (std::size_t i = 0; i < 2; ++i) {
      if (!unlike[i]) continue;
      std::swap(other[i][1], other[i][2]);
      sign[i] = -sign[i];
    }
    if (bit(4)) std::swap(other[0], other[1]), std::swap(sign[0], sign[1]);
    if (bit(4)) std::swap(unlike[0], unlike[1]);
    mesh.tetrahedra = {{0, 1, 2, 3}, other[0], other[1]};
    int right = 0;
    for (std::size_t i = 0; i < 2; ++i) right += unlike[i] ? -sign[i] : sign[i];
    const bool turn = right < 0 || (right == 0 && (sign[0] < 0) != unlike[0]);
    const Survey survey = survey_mesh(mesh, Severity::warning);
    REQUIRE(survey.components == 1);
    CHECK(survey.sign == std::vector<signed char>{0, static_cast<signed char>(sign[0]),
                                                  static_cast<signed char>(sign[1])});
    const std::array<bool, 3> flipped = {turn, unlike[0] != turn, unlike[1] != turn};
    std::size_t inverted = 0, folded = 0;
    for (std::size_t t = 0; t < 3; ++t) {
      CHECK((survey.flipped[t] != 0) == flipped[t]);
      inverted += flipped[t];
      folded += t > 0 && (sign[t - 1] < 0) != flipped[t];
    }
    CHECK(count(survey, "inverted_tetrahedron") == inverted);
    CHECK(count(survey, "folded_tetrahedron") == folded);
    ties += right == 0;
  }
  CHECK(ties == 16);
}

TEST_CASE("of dozens of copies in turn the first of each stays, and they are neighbours",
          "[topology][findings]") {
  std::mt19937_64 random(12);
  for (int trial = 0; trial < 30; ++trial) {
    INFO("trial " << trial);
    TetMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::map<std::uint32_t, std::uint32_t> first;
    for (std::uint32_t i = 0; i < 50; ++i) {
      const auto apex = static_cast<std::uint32_t>(3 + below(random, 2));
      Corners t = {0, 1, 2, apex};
      for (std::size_t k = 3; k > 0; --k) std::swap(t[k], t[below(random, k + 1)]);
      mesh.tetrahedra.push_back(t);
      first.emplace(apex, i);
    }
    REQUIRE(first.size() == 2);
    const Survey survey = survey_mesh(mesh, Severity::warning);
    CHECK(count(survey, "duplicate_tetrahedron") + count(survey, "mirrored_tetrahedron") == 48);
    CHECK(count(survey, "overfull_face") == 0);
    CHECK(survey.components == 1);
    for (std::uint32_t i = 0; i < 50; ++i) {
      CHECK((survey.usable[i] == 1) == (i == first[3] || i == first[4]));
    }
    const auto face = [&](std::uint32_t apex) {
      const Corners& t = mesh.tetrahedra[first[apex]];
      const auto place = static_cast<std::size_t>(std::ranges::find(t, apex) - t.begin());
      return HalfFaceId{4 * first[apex] + place};
    };
    CHECK(survey.neighbours[face(3).index() / 4][face(3).index() % 4] == face(4));
    CHECK(survey.neighbours[face(4).index() / 4][face(4).index() % 4] == face(3));
  }
}

TEST_CASE("a face of many tetrahedra has no neighbours, and tells as many as fit",
          "[topology][findings]") {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (std::uint32_t i = 0; i < 20; ++i) {
    mesh.points.push_back({0.1, 0.1, 1.0 + i});
    mesh.tetrahedra.push_back({0, 1, 2, 22 - i});
  }
  for (std::uint32_t i = 0; i < 20; ++i) mesh.points[3 + i][2] = 20.0 - i;
  const Survey survey = survey_mesh(mesh, Severity::warning);
  for (const auto& t : survey.neighbours) {
    CHECK(std::ranges::all_of(t, [](HalfFaceId f) { return f.is_none(); }));
  }
  const auto told = std::ranges::find(survey.findings, "overfull_face", &Finding::code);
  REQUIRE(told != survey.findings.end());
  CHECK(told->ids == std::vector<std::int64_t>{0, 1, 2, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
}

TEST_CASE("what cannot be used is no component, and both sides of a twist are told",
          "[topology][findings]") {
  TetMesh mesh = suite::two_tetrahedra();
  mesh.tetrahedra.push_back({0, 0, 1, 2});
  mesh.tetrahedra.push_back({0, 1, 2, 77});
  CHECK(survey_mesh(mesh, Severity::warning).components == 1);
  // Each tetrahedron that a face joins to one which it cannot be turned like.
  const TetMesh ring = suite::joined_ring(4, true);
  const Survey twisted = survey_mesh(ring, Severity::warning, true);
  const Rows told = places(twisted, "non_orientable");
  Rows expected;
  for (std::uint32_t t = 0; t < ring.tetrahedra.size(); ++t) {
    bool is_unlike = false;
    for (std::size_t p = 0; p < 4; ++p) {
      const HalfFaceId across = twisted.neighbours[t][p];
      if (across.is_none()) continue;
      const bool alike =
          (twisted.odd[t] >> p & 1) != (twisted.odd[across.index() / 4] >> across.index() % 4 & 1);
      is_unlike = is_unlike || alike != (twisted.flipped[t] == twisted.flipped[across.index() / 4]);
    }
    if (is_unlike) expected.push_back(t);
  }
  CHECK(expected.size() >= 2);
  Rows rising = told;
  std::ranges::sort(rising);
  CHECK(rising == expected);
}

TEST_CASE("places of points and edges are told in their order", "[topology][findings]") {
  // Two pairs of tetrahedra, each round an edge: the pair with the lower point has the higher too.
  TetMesh pinched;
  std::mt19937_64 random(2);
  for (int i = 0; i < 14; ++i) {
    pinched.points.push_back({suite::unit(random), suite::unit(random), suite::unit(random)});
  }
  pinched.tetrahedra = {{1, 2, 6, 7}, {1, 2, 8, 9}, {0, 5, 10, 11}, {0, 5, 12, 13}};
  CHECK(places(survey_mesh(pinched, Severity::warning, true), "pinched_edge") == Rows{0, 5, 1, 2});
  // Hundreds of points in a few places, and such as have no place.
  TetMesh mesh = suite::one_tetrahedron();
  Rows expected;
  std::map<Point, std::uint32_t> known;
  for (const Point& p : mesh.points) known.emplace(p, 0);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int twice = 0; twice < 2; ++twice) {
      Point p = {7, 8, 9};
      p[axis] = infinity;
      mesh.points.push_back(p);
    }
  }
  for (int i = 0; i < 300; ++i) {
    const auto row = static_cast<std::uint32_t>(mesh.points.size());
    const Point p = {3.0 - 1.0 * below(random, 2), 1.0 * below(random, 2), 2.0};
    if (!known.emplace(p, row).second) expected.push_back(row);
    mesh.points.push_back(p);
  }
  CHECK(places(survey_mesh(mesh, Severity::warning, true), "coincident_points") == expected);
}
