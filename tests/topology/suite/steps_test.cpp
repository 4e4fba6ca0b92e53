// SPDX-License-Identifier: MIT
// Operations as steps: the suite's own fans and sections next to the library's, orders, shrinking.
#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

#include "topology/kernel/fan.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/fixtures/steps.hpp"
#include "topology/suite/judge/judge_truth.hpp"
#include "topology/suite/judge/shrink.hpp"

using namespace sunder;
using namespace sunder::suite;

namespace {

/// The library's faces in the file's numbers. Needs: no tetrahedron was re-oriented.
std::vector<Step> steps_of_faces(const GlueTwin& twin, const std::vector<HalfFaceId>& faces) {
  std::vector<Step> steps;
  for (const HalfFaceId f : faces) steps.push_back({Step::Kind::split, side_of(twin, f), {}});
  return steps;
}

Point some_normal(std::mt19937_64& random, bool on_a_grid) {
  if (!on_a_grid) return {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
  const auto whole = [&random] { return static_cast<double>(below(random, 5)) - 2; };
  return {whole(), whole(), 2 * whole() + 1};
}

}  // namespace

TEST_CASE("fans and sections are the library's, computed anew", "[suite][steps]") {
  const std::uint64_t seed = 20261121;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  // Whole coordinates and normals put many centres exactly on the plane.
  for (const bool on_a_grid : {true, false}) {
    TetMesh body = kuhn_box({3, 3, 3}, on_a_grid ? 1.0 : 0.1);
    if (!on_a_grid) body = jittered(std::move(body), 0.02, 3);
    const Result<VolumeMap> map = build_map(body);
    REQUIRE(map);
    REQUIRE(map->reoriented().empty());
    const GlueTwin twin = glue_twin(body.tetrahedra, body.points.size());
    for (int i = 0; i < 300; ++i) {
      const auto point = static_cast<std::uint32_t>(below(random, body.points.size()));
      const Point normal = some_normal(random, on_a_grid);
      const auto fan = fan_faces(*map, VertexId{point}, normal);
      REQUIRE(fan);
      CHECK(steps_of(SplitFan{point, normal}, twin, twin, body) == steps_of_faces(twin, *fan));
      const double offset =
          on_a_grid ? static_cast<double>(below(random, 13)) / 4 : 0.4 * unit(random);
      const auto section = plane_faces(*map, {normal, offset});
      REQUIRE(section);
      CHECK(steps_of(SplitPlane{{normal, offset}}, twin, twin, body) ==
            steps_of_faces(twin, *section));
    }
  }
}

TEST_CASE("a shatter takes every face once in its order, and leaves out what is split",
          "[suite][steps]") {
  const TetMesh body = kuhn_box({2, 1, 1});
  const GlueTwin intact = glue_twin(body.tetrahedra, body.points.size());
  GlueTwin now = intact;
  const auto steps = [&](Shatter shatter) { return steps_of(shatter, intact, now, body); };
  const std::vector<Step> rising = steps({Shatter::Order::rising, 0});
  CHECK(rising.size() == 14);
  CHECK(std::is_sorted(rising.begin(), rising.end(), [&](const Step& a, const Step& b) {
    return half_face_of(intact, a.a) < half_face_of(intact, b.a);
  }));
  std::vector<Step> falling = steps({Shatter::Order::falling, 0});
  std::reverse(falling.begin(), falling.end());
  CHECK(falling == rising);
  const std::vector<Step> seeded = steps({Shatter::Order::seeded, 5});
  CHECK(std::is_permutation(seeded.begin(), seeded.end(), rising.begin(), rising.end()));
  CHECK(seeded != rising);
  CHECK(steps({Shatter::Order::seeded, 5}) == seeded);
  CHECK(steps({Shatter::Order::seeded, 6}) != seeded);
  unglue(now, half_face_of(now, seeded[3].a));
  std::vector<Step> rest = seeded;
  rest.erase(rest.begin() + 3);
  CHECK(steps({Shatter::Order::seeded, 5}) == rest);
}

TEST_CASE("an orbit parts into two where its last face splits", "[suite][steps]") {
  const TetMesh body = closed_fan(4);
  GlueTwin now = glue_twin(body.tetrahedra, body.points.size());
  CHECK(orbit_of(now, {2, 0}).size() == 4);
  unglue(now, half_face_of(now, {0, body.tetrahedra[0][2]}));
  CHECK(orbit_of(now, {2, 0}).size() == 4);
  unglue(now, half_face_of(now, {2, body.tetrahedra[2][2]}));
  CHECK(orbit_of(now, {2, 0}).size() == 2);
  CHECK(corner_of(now, VertexName{std::uint32_t{1}}) == CornerAt{0, 1});
}

TEST_CASE("what can be glued is a body", "[suite][steps]") {
  TetMesh body = two_tetrahedra();
  CHECK(is_body(body));
  body.tetrahedra.push_back({0, 1, 2, 9});
  CHECK_FALSE(is_body(body));  // no such point
  body.tetrahedra.back() = {0, 1, 3, 3};
  CHECK_FALSE(is_body(body));  // a point twice
  body.points.push_back({0, 0, 5});
  body.tetrahedra.back() = {0, 1, 2, 5};
  CHECK_FALSE(is_body(body));  // a third tetrahedron on a face
  CHECK_FALSE(is_body({}));
}

TEST_CASE("shrinking keeps only what a failure needs", "[suite][shrink]") {
  const TetMesh body = kuhn_box({4, 4, 4});
  const GlueTwin intact = glue_twin(body.tetrahedra, body.points.size());
  const std::vector<Step> all = steps_of(Shatter{Shatter::Order::seeded, 1}, intact, intact, body);
  // Fails when two faces, known by where they are, are split in this order.
  const auto center = [](const TetMesh& mesh, const Step& step) {
    Point c = {0, 0, 0};
    for (const std::uint32_t p : mesh.tetrahedra[step.a.tetrahedron]) {
      if (p == step.a.opposite) continue;
      for (std::size_t i = 0; i < 3; ++i) c[i] += mesh.points[p][i];
    }
    return c;
  };
  const Point first = center(body, all[20]), second = center(body, all[500]);
  std::size_t trials = 0;
  const Fails fails = [&](const TetMesh& mesh, std::span<const Step> steps) {
    ++trials;
    const auto is = [&](const Point& p) {
      return [&, p](const Step& step) { return center(mesh, step) == p; };
    };
    const auto a = std::find_if(steps.begin(), steps.end(), is(first));
    return std::find_if(a, steps.end(), is(second)) != steps.end();
  };
  REQUIRE(fails(body, all));

  const StepsOnBody small = shrink(body, all, fails);
  CHECK(small.steps.size() == 2);
  CHECK(small.body.tetrahedra.size() == 2);
  CHECK(small.body.points.size() <= 8);
  CHECK(fails(small.body, small.steps));

  const StepsOnBody fewer = shrink(body, all, fails, {.body = false});
  CHECK(fewer.steps == std::vector<Step>{all[20], all[500]});
  CHECK(fewer.body.tetrahedra == body.tetrahedra);

  trials = 0;
  const StepsOnBody unchanged = shrink(body, all, fails, {.work = 100});
  CHECK(trials == 0);
  CHECK(unchanged.steps == all);
}

TEST_CASE("glues go with the tetrahedra they name", "[suite][shrink]") {
  const TetMesh body = closed_fan(5);
  const FaceSide a{0, body.tetrahedra[0][2]};
  const GlueTwin intact = glue_twin(body.tetrahedra, body.points.size());
  const FaceSide b = side_of(intact, intact.glued[half_face_of(intact, a).index()]);
  const std::vector<Step> steps = {{Step::Kind::split, a, {}}, {Step::Kind::glue, a, b}};
  const Fails fails = [](const TetMesh& mesh, std::span<const Step> left) {
    for (const Step& s : left) {
      if (s.kind == Step::Kind::glue) {
        // Names stay those of the body that is left.
        CHECK(s.a.tetrahedron < mesh.tetrahedra.size());
        CHECK(s.b.tetrahedron < mesh.tetrahedra.size());
        return true;
      }
    }
    return false;
  };
  const StepsOnBody small = shrink(body, steps, fails);
  CHECK(small.steps.size() == 1);
  CHECK(small.body.tetrahedra.size() == 2);
  CHECK(small.body.points.size() == 5);
}
