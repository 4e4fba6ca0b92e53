// SPDX-License-Identifier: MIT
// The judge finds overlaps that are known.
#include "tests/experiments/rubble/frame_judge.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include <Eigen/Geometry>

using namespace sunder;
using namespace sunder::test;

namespace {

void add(JudgedFrame& frame, const std::array<Vec3, 4>& corners, std::uint32_t piece) {
  const auto first = static_cast<std::uint32_t>(frame.points.size());
  frame.points.insert(frame.points.end(), corners.begin(), corners.end());
  frame.tetrahedra.push_back({first, first + 1, first + 2, first + 3});
  frame.piece.push_back(piece);
}

const std::array<Vec3, 4> corner_chip = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0),
                                         Vec3(0, 0, 1)};

std::array<Vec3, 4> moved(std::array<Vec3, 4> corners, const Vec3& way) {
  for (Vec3& c : corners) c += way;
  return corners;
}

}  // namespace

TEST_CASE("the judge finds the overlap of two chips, and none of a chip with itself", "[judge]") {
  JudgedFrame frame;
  add(frame, corner_chip, 0);
  // Its tip through the other's base.
  add(frame, moved(corner_chip, {0.1, 0.1, -0.97}), 1);
  add(frame, moved(corner_chip, {0.1, 0.1, -0.97}), 1);
  const Verdict v = judge_frame(frame, -5);
  const double edge = (3 + 3 * std::sqrt(2.0)) / 6;
  CHECK(v.overlaps.edge == Approx(edge));
  CHECK(v.overlaps.pairs == 2);
  CHECK(v.overlaps.deepest == Approx(0.03));
  CHECK(v.overlaps.mean == Approx(0.03));
  CHECK(v.below == 0);
  CHECK(v.pieces == 2);
}

TEST_CASE("faces that were one are no overlap, what is below the floor is counted", "[judge]") {
  JudgedFrame frame;
  add(frame, corner_chip, 0);
  std::array<Vec3, 4> under = corner_chip;
  under[3][2] = -1;  // shares the base, and stands on its head
  add(frame, under, 1);
  const Verdict v = judge_frame(frame, 0);
  CHECK(v.overlaps.pairs == 0);
  CHECK(v.below == 1);
  CHECK(v.lowest == Approx(1));
  CHECK(v.through == 1);
}

TEST_CASE("the judge's sweep misses no pair", "[judge]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vec = [&] { return Vec3(any(random), any(random), any(random)); };
  JudgedFrame frame;
  for (std::uint32_t k = 0; k < 300; ++k) {
    const Vec3 at = 2.5 * vec();
    const double size = k % 50 == 0 ? 3 : 0.5;
    add(frame, {at + size * vec(), at + size * vec(), at + size * vec(), at + size * vec()}, k / 2);
  }
  const std::vector<SeenPart> parts = parts_of(frame);
  const SeenOverlaps fast = see_overlaps(parts), slow = see_overlaps_slowly(parts);
  CHECK(slow.pairs > 200);
  CHECK(fast.pairs == slow.pairs);
  CHECK(fast.deepest == slow.deepest);
  CHECK(fast.where == slow.where);
  CHECK(fast.mean == Approx(slow.mean));
}

TEST_CASE("a spinning chip has the momenta of its lumped corners", "[judge]") {
  JudgedFrame frame;
  add(frame, corner_chip, 0);
  const Vec3 drift(1, 2, 3), spin(0.5, -1, 2);
  for (const Vec3& p : frame.points) frame.velocity.push_back(drift + spin.cross(p));
  const Verdict v = judge_frame(frame, -5);
  const Vec3 centre(0.25, 0.25, 0.25);
  CHECK((v.momentum - (drift + spin.cross(centre)) / 6).norm() < 1e-14);
  double kinetic = 0;
  for (const Vec3& u : frame.velocity) kinetic += u.squaredNorm() / 48;
  CHECK(v.kinetic == Approx(kinetic));
}
