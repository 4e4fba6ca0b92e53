// SPDX-License-Identifier: MIT
// Surfaces of pieces, and vertices that meet them: against a slow search in time.
#include "mechanics/contact/shapes/piece_surface.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "mechanics/contact/detection/contact_pieces.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Chips that fly through each other, as if nothing met.
struct Flight {
  SeveralBodies all;
  MechanicsState state;
  std::vector<Vec3> end;
  std::vector<PredictedFrame> frames;
  std::vector<std::array<HalfFaceId, 4>> neighbours;

  StepPaths paths() const {
    return {state, all.body.corners, end, frames, {}, {}, 1e-3, {}, neighbours};
  }
  std::array<Vec3, 4> at(std::size_t t, double part) const {
    std::array<Vec3, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = paths().at(all.body.corners[t][i], part);
    return x;
  }
  /// How far inside the tetrahedron, as the least share of a corner.
  double depth(VertexId v, std::size_t t, double part) const {
    return std::ranges::min(barycentric(at(t, part), paths().at(v, part)));
  }
};

Flight flight_of(std::mt19937& random) {
  std::vector<Body> chips;
  for (int k = 0; k < 2; ++k) {
    Body chip = single_tetrahedron(1);
    const Eigen::Quaterniond turn = random_rotation(random);
    const Vec3 place = random_vector(random);
    for (Vec3& x : chip.rest) x = turn * (x + 0.2 * random_vector(random)) + place;
    chips.push_back(chip);
  }
  Flight flight{together(chips), {}, {}, {}, {}};
  flight.state = state_of(flight.all, material_of(1e9));
  const std::array<Vec3, 2> way = {0.4 * random_vector(random), 0.4 * random_vector(random)};
  for (std::size_t v = 0; v < flight.all.body.rest.size(); ++v) {
    flight.end.push_back(flight.all.body.rest[v] + way[v / 4] + 0.05 * random_vector(random));
  }
  flight.frames.resize(2);
  flight.neighbours = neighbours_of(flight.all.body.corners);
  return flight;
}

Vec3 outward_normal(const std::array<Vec3, 4>& x, std::size_t place) {
  const auto& c = outward_face[place];
  return (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).normalized();
}

}  // namespace

TEST_CASE("the surface of a block joins what its faces join, and nothing inside",
          "[mechanics][contact]") {
  const Body block = kuhn_block({3, 3, 3}, {1, 1, 1});
  PieceSurface surface;
  update_surface(surface, {}, block.corners, neighbours_of(block.corners), block.rest.size());
  for (std::size_t v = 0; v < block.rest.size(); ++v) {
    const bool inside = block.rest[v].cwiseAbs().maxCoeff() < 0.4;
    CHECK(surface.ring_of(VertexId{v}).empty() == inside);
    for (VertexId end : surface.ring_of(VertexId{v})) {
      // Along one of the sides of the block.
      const Vec3 a = block.rest[v].cwiseAbs(), b = block.rest[end.index()].cwiseAbs();
      CHECK((a.array() > 0.49 && b.array() > 0.49).any());
    }
  }
  // Each tetrahedron by itself: every vertex sees all others of its own.
  std::vector<std::array<HalfFaceId, 4>> alone(block.corners.size());
  update_surface(surface, {}, block.corners, alone, block.rest.size());
  for (const Corners& c : block.corners) {
    for (VertexId a : c) {
      for (VertexId b : c) {
        if (a != b) CHECK(std::ranges::binary_search(surface.ring_of(a), b));
      }
    }
  }
}

TEST_CASE("a vertex that enters a piece meets the face through which it does",
          "[mechanics][contact]") {
  const unsigned seed = 11;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  int entered = 0, same = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    const Flight flight = flight_of(random);
    DetectScratch scratch;
    measure_balls(scratch, flight.paths(), 1);
    update_surface(scratch.surface, flight.state.elements, flight.all.body.corners,
                   flight.neighbours, 8);
    find_between_pieces(scratch, flight.paths(), {}, true);
    for (std::size_t i = 0; i < 8; ++i) {
      const VertexId v{i};
      const std::size_t t = i < 4 ? 1 : 0;
      if (flight.depth(v, t, 0) > -0.02) continue;
      constexpr int parts = 500;
      int first = 1;
      while (first <= parts && flight.depth(v, t, double(first) / parts) < 0) ++first;
      if (first > parts) continue;
      // The face through which: where the share of its corner was the last to be negative.
      const double before = double(first - 1) / parts;
      const auto shares = barycentric(flight.at(t, before), flight.paths().at(v, before));
      const auto lowest = std::ranges::min_element(shares);
      const auto place = static_cast<std::size_t>(lowest - shares.begin());
      // Not at an edge, nor in front of several faces; and it stays behind the face to the end.
      if (std::ranges::count_if(shares, [](double w) { return w < 0.02; }) != 1) continue;
      const auto start = flight.at(t, 0), end = flight.at(t, 1);
      if (barycentric(start, flight.paths().at(v, 0))[place] > -0.02) continue;
      if (barycentric(end, flight.paths().at(v, 1))[place] < 0.02) continue;
      ++entered;
      const auto found = std::ranges::find(scratch.found, v, &ContactPoint::vertex);
      REQUIRE(found != scratch.found.end());
      CHECK(found->tetrahedron == TetId{t});
      const auto gap_of = [&](std::size_t which) {
        const Vec3 behind = flight.paths().at(v, 1) - end[outward_face[which][0]];
        return outward_normal(end, which).dot(behind);
      };
      const double gap = scratch.found_gap[static_cast<std::size_t>(found - scratch.found.begin())];
      CHECK(gap == Approx(gap_of(found->place)).margin(1e-12));
      // Another one where it crosses two, and ends deeper behind that.
      if (found->place != place) continue;
      ++same;
      CHECK((found->normal - outward_normal(flight.at(t, before), place)).norm() < 0.05);
    }
  }
  CHECK(entered > 300);
  CHECK(same > 0.95 * entered);
}
