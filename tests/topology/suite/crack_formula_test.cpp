// SPDX-License-Identifier: MIT
// Breaks of labelled cracks: the union over them against breaks one by one, and kernels that lie
// about their fans or remember an order.
#include "topology/suite/judge/crack_formula.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>

#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/fixtures/steps.hpp"
#include "topology/suite/judge/judge.hpp"
#include "topology/suite/random/random_run_labels.hpp"

using namespace sunder;
using namespace sunder::suite;

namespace {

GlueTwin broken(GlueTwin now, const TetMesh& body, std::span<const BreakPoint> breaks) {
  for (const BreakPoint& b : breaks) {
    for (const Step& step : steps_of(b, now, now, body)) {
      CHECK(b.sides[step.a.tetrahedron] == CrackSide::positive);
      unglue(now, half_face_of(now, step.a));
    }
  }
  return now;
}

/// The middle of a box broken by a plane of cubes, then its neighbour on the way to the side.
Fixture two_breaks() {
  Fixture fixture{.name = "two-breaks", .body = kuhn_box({2, 2, 2})};
  CrackSides sides;
  for (std::size_t t = 0; t < 48; ++t) {
    sides.push_back(t / 6 % 2 == 0 ? CrackSide::positive : CrackSide::negative);
  }
  fixture.cracks = {sides};
  fixture.operations = {{BreakPoint{13, sides}, {}}, {BreakPoint{4, sides}, {}}};
  return fixture;
}

Mismatch mismatch_of(const Fixture& fixture, JudgedKernel kernel) {
  const Verdict verdict = judge(fixture, kernel);
  REQUIRE(verdict.mismatch);
  return *verdict.mismatch;
}

}  // namespace

TEST_CASE("breaks in any order leave what the union over them says", "[suite][cracks]") {
  std::size_t cut = 0;
  for (const NamedMesh& shape : all_shapes()) {
    const TetMesh& body = shape.mesh;
    const GlueTwin intact = glue_twin(body.tetrahedra, body.points.size());
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      INFO(shape.name << ", seed " << seed);
      std::mt19937_64 random(seed);
      std::vector<BreakPoint> breaks = any_breaks(body, intact, random);
      const std::set<HalfFaceId> faces = crack_faces(intact, breaks);
      const GlueTwin expected = without_faces(intact, faces);
      cut += faces.size();
      for (int order = 0; order < 4; ++order) {
        const GlueTwin now = broken(intact, body, breaks);
        REQUIRE(now.glued == expected.glued);
        REQUIRE(corner_classes(now) == corner_classes(expected));
        std::shuffle(breaks.begin(), breaks.end(), random);
      }
    }
  }
  CHECK(cut > 1000);
}

TEST_CASE("tetrahedra without a label are on no side", "[suite][cracks]") {
  const TetMesh body = two_tetrahedra();
  const GlueTwin intact = glue_twin(body.tetrahedra, body.points.size());
  using enum CrackSide;
  for (const CrackSide a : {none, negative, positive}) {
    for (const CrackSide b : {none, negative, positive}) {
      const BreakPoint at{0, {a, b}};
      const bool differ = a != b && a != none && b != none;
      CHECK(crack_faces(intact, std::span(&at, 1)).size() == (differ ? 1 : 0));
      CHECK(steps_of(at, intact, intact, body).size() == (differ ? 1 : 0));
    }
  }
}

TEST_CASE("a right kernel passes breaks forwards and backwards", "[suite][cracks]") {
  const Fixture fixture = two_breaks();
  const Truth truth = truth_of(fixture);
  CHECK_FALSE(truth.checks.first);
  REQUIRE(truth.backwards.size() == 2);
  CHECK(truth.operations[0].steps.size() == 6);
  CHECK(truth.backwards[1].after == truth.operations[1].after);
  for (JudgedKernel kernel : {twin_kernel(), volume_map_kernel(), nested_kernel(), cgal_kernel()}) {
    INFO(kernel.name);
    CHECK_FALSE(judge(fixture, kernel).mismatch);
  }
}

TEST_CASE("wrong fans by labels are caught, and answers that depend on the order",
          "[suite][cracks]") {
  const Fixture fixture = two_breaks();
  JudgedKernel lying = volume_map_kernel();
  lying.crack_fan = [right = lying.crack_fan](std::uint32_t point, const CrackSides& sides) {
    std::vector<FaceSide> faces = right(point, sides);
    if (faces.size() < 6) faces.pop_back();
    return faces;
  };
  const Mismatch fan = mismatch_of(fixture, lying);
  CHECK(fan.what == "fan at point 4");
  CHECK(fan.operation == 2);
  CHECK(fan.expected.find("from tetrahedron") != std::string::npos);

  // Counts an edge too many when the last of all faces is one at the point that should go first.
  JudgedKernel ordered = twin_kernel();
  const auto splits = std::make_shared<std::size_t>(0);
  const auto last = std::make_shared<FaceSide>();
  ordered.load = [right = ordered.load, splits](const TetMesh& mesh) {
    *splits = 0;
    return right(mesh);
  };
  ordered.split = [right = ordered.split, splits, last](FaceSide side) {
    ++*splits;
    *last = side;
    return right(side);
  };
  const Truth truth = truth_of(fixture);
  const std::size_t all = truth.operations[0].steps.size() + truth.operations[1].steps.size();
  ordered.counts = [&, right = ordered.counts, splits, last] {
    CellCounts counts = right();
    const bool first_is_last =
        std::ranges::count(points_of(truth.intact, *last), std::uint32_t{13}) > 0;
    counts.edges += *splits == all && first_is_last ? 1 : 0;
    return counts;
  };
  const Mismatch order = mismatch_of(fixture, ordered);
  CHECK(order.what == "edges (breaks in reverse order)");
  CHECK(order.step == all);
  CHECK(order.steps.size() == all);
}
