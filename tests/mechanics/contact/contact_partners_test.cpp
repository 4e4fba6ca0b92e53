// SPDX-License-Identifier: MIT
// Crack faces against each other: gaps at birth, forgotten partners, one row for a plane.
#include "mechanics/contact/detection/contact_partners.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "mechanics/contact/detection/contact_overlaps.hpp"
#include "tests/mechanics/contact/cut_block.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A body cut in two, and the input of detection.
struct Parted {
  Body body;
  MechanicsState state;
  ContactMemory memory = {};
  DetectScratch scratch = {};
  MechanicsScratch mechanics = {};
  std::vector<Vec3> predicted = {};
  std::vector<PredictedFrame> frame = {};
  double reach = 0;

  StepPaths paths() {
    frame.resize(state.components.size());
    for (const Component& c : state.components) {
      frame[c.id.index()].orientation = c.orientation;
    }
    return {state, body.corners, predicted, frame, {}, {}, 1e-3};
  }

  /// Moves the upper part by `way`: in a step, or before it.
  void shift_upper(std::vector<Vec3>& places, const std::vector<bool>& upper, const Vec3& way) {
    std::vector<bool> moves(places.size(), false);
    for (std::size_t t = 0; t < body.corners.size(); ++t) {
      for (const VertexId v : body.corners[t]) {
        if (upper[t]) moves[v.index()] = true;
      }
    }
    for (std::size_t v = 0; v < places.size(); ++v) {
      if (moves[v]) places[v] += way;
    }
  }

  /// The contacts of partners when the upper side goes by `way` in the step.
  std::vector<ContactPoint> found(const std::vector<bool>& upper, const Vec3& way) {
    predicted = state.vertices.position;
    shift_upper(predicted, upper, way);
    scratch.found.clear();
    scratch.found_gap.clear();
    find_between_partners(scratch, memory, paths(), {});
    return scratch.found;
  }
};

Parted parted(Body body, const std::vector<bool>& upper, bool separate, double reach) {
  Parted p{body, state_of(body, material_of(1e9))};
  p.memory.partners = partners_between(body.corners, upper, reach);
  p.reach = reach;
  part(p.state, p.body, upper, separate, p.mechanics);
  return p;
}

/// Two tetrahedra on both sides of the triangle of vertices 0, 1, 2.
Body two_tetrahedra() {
  Body body;
  body.rest = {{0, 0, 0}, {1, 0.1, 0}, {0.2, 0.9, 0.1}, {0.3, 0.3, 0.8}, {0.4, 0.2, -0.7}};
  const auto v = [](std::size_t k) { return VertexId{k}; };
  body.corners = {{v(0), v(1), v(2), v(3)}, {v(1), v(0), v(2), v(4)}};
  return body;
}

const std::vector<bool> first_is_upper = {true, false};

/// Out of the lower tetrahedron, into the upper one.
Vec3 normal_between(const Parted& p) {
  const Body whole = two_tetrahedra();
  const Mat3 turn = p.state.components[0].orientation.toRotationMatrix();
  return turn * (whole.rest[1] - whole.rest[0]).cross(whole.rest[2] - whole.rest[0]).normalized();
}

/// A block cut at z = 0, then bent there: right of x = 0 the cut rises at `angle` (degrees).
Parted bent(double angle) {
  Body body = kuhn_block({4, 2, 2}, {0.8, 0.4, 0.4});
  const std::vector<bool> upper = above(body);
  for (Vec3& x : body.rest) x.z() += std::max(0.0, x.x()) * std::tan(angle * degree);
  return parted(body, upper, true, 0.01);
}

}  // namespace

TEST_CASE("tetrahedra with crack faces that face each other overlap by a hundredth of an edge",
          "[mechanics][contact][partners]") {
  Parted p = parted(two_tetrahedra(), first_is_upper, true, 0.05);
  const std::vector<std::array<HalfFaceId, 4>> neighbours(
      2, {HalfFaceId::none(), HalfFaceId::none(), HalfFaceId::none(), HalfFaceId::none()});
  const Vec3 normal = normal_between(p);
  for (const double depth : {0.005, 0.03}) {
    p.predicted = p.state.vertices.position;
    p.shift_upper(p.predicted, first_is_upper, -depth * normal);
    StepPaths paths = p.paths();
    paths.neighbours = neighbours;
    update_partners(p.memory, p.scratch, paths);
    find_contacts(p.scratch, p.memory, paths, {});
    find_overlaps(p.scratch, paths, {}, 0);
    CHECK(std::ranges::any_of(p.scratch.found, &ContactPoint::is_of_overlap) == (depth > 0.01));
  }
}

TEST_CASE("partners meet with a gap of exactly 0 as they are born, wherever the body is",
          "[mechanics][contact][partners]") {
  Parted p{two_tetrahedra(), state_of(two_tetrahedra(), material_of(1e9))};
  const int at = GENERATE(range(0, 6));
  INFO("place " << at);
  std::mt19937 random(static_cast<unsigned>(at));
  if (at > 0) {
    place(p.state, ComponentId{0},
          {.orientation = random_rotation(random), .translation = 10 * random_vector(random)});
  }
  p.memory.partners = partners_between(p.body.corners, first_is_upper, 0.05);
  REQUIRE(p.memory.partners.size() == 1);
  part(p.state, p.body, first_is_upper, at % 2 == 0, p.mechanics);
  REQUIRE(p.state.vertices.size() == 8);
  const Vec3 normal = normal_between(p);
  update_partners(p.memory, p.scratch, p.paths());
  CHECK(p.memory.partners.size() == 1);
  // A single tetrahedron turns rigid as it comes off: its places are rounded.
  const double rounding = at % 2 == 0 ? 1e-14 : 0;
  // At rest there is nothing to keep apart, and nothing that parts is kept together.
  p.found(first_is_upper, Vec3::Zero());
  for (const double gap : p.scratch.found_gap) CHECK(std::abs(gap) <= rounding);
  p.found(first_is_upper, 1e-3 * normal);
  for (const double gap : p.scratch.found_gap) CHECK(gap == Approx(1e-3).epsilon(1e-9));
  const std::vector<ContactPoint> contacts = p.found(first_is_upper, -1e-3 * normal);
  REQUIRE(contacts.size() == 3);
  for (const ContactPoint& c : contacts) {
    CHECK(std::abs(c.gap_start) <= rounding);
    // Lower rows are those of the lower tetrahedron here: its vertices kept theirs.
    CHECK((c.normal + normal).norm() < 1e-12);
    CHECK(c.tetrahedron == TetId{0});
    CHECK(tetrahedron_of(c.face) == TetId{1});
    CHECK(std::abs(c.weights[0] + c.weights[1] + c.weights[2] + c.weights[3] - 1) < 1e-12);
  }
  for (const double gap : p.scratch.found_gap) CHECK(gap == Approx(-1e-3).epsilon(1e-9));
}

TEST_CASE("both halves turned and shifted after the birth keep a gap of a rounding",
          "[mechanics][contact][partners]") {
  Parted p = parted(two_tetrahedra(), first_is_upper, true, 0.05);
  std::mt19937 random(3);
  const Placement away = {.orientation = random_rotation(random), .translation = {1, -2, 3}};
  place(p.state, ComponentId{0}, away);
  place(p.state, ComponentId{1}, away);
  const std::vector<ContactPoint> contacts = p.found(first_is_upper, -1e-3 * normal_between(p));
  REQUIRE(contacts.size() == 3);
  for (const ContactPoint& c : contacts) CHECK(std::abs(c.gap_start) < 1e-14);
}

TEST_CASE("a vertex faces the tetrahedra of the vertex that it was one with",
          "[mechanics][contact][partners]") {
  Body body = kuhn_block({2, 2, 2}, {0.2, 0.2, 0.2});
  const std::vector<bool> upper = above(body);
  Parted p = parted(body, upper, true, 0.01);
  p.predicted = p.state.vertices.position;
  update_partners(p.memory, p.scratch, p.paths());
  int facing = 0;
  for (std::size_t v = 0; v < p.state.vertices.size(); ++v) {
    for (std::size_t t = 0; t < p.body.corners.size(); ++t) {
      // The twin: some corner is at the same place and is another row of the cut.
      bool meets = false;
      for (const VertexId c : p.body.corners[t]) {
        meets = meets || (c.index() != v && p.state.vertices.rest_position[c.index()] ==
                                                p.state.vertices.rest_position[v]);
      }
      CHECK(faces(p.scratch, {TetId{t}, VertexId{v}}, p.paths()) == meets);
      facing += meets;
    }
  }
  CHECK(facing > 18);
  // Forgotten ones face no longer.
  p.memory.partners.clear();
  update_partners(p.memory, p.scratch, p.paths());
  CHECK(p.scratch.facing.empty());
  CHECK_FALSE(faces(p.scratch, {TetId{0}, p.body.corners.back()[0]}, p.paths()));
}

TEST_CASE("partners are forgotten when they have parted or slid by their reach",
          "[mechanics][contact][partners]") {
  const bool separate = GENERATE(true, false);
  const double reach = 0.05;
  const auto left_after = [&](const auto& move) {
    Parted p = parted(two_tetrahedra(), first_is_upper, separate, reach);
    move(p);
    p.predicted = p.state.vertices.position;
    update_partners(p.memory, p.scratch, p.paths());
    CHECK(p.scratch.facing.size() == 6 * p.memory.partners.size());
    return p.memory.partners.size();
  };
  const auto shifted = [&](double out, double along) {
    return left_after([&](Parted& p) {
      const Vec3 n = normal_between(p);
      const Vec3 way = out * reach * n + along * reach * n.unitOrthogonal();
      p.shift_upper(p.state.vertices.position, first_is_upper, way);
    });
  };
  const std::size_t gone = separate ? 0 : 1;
  INFO("separate " << separate);
  CHECK(shifted(0, 0) == 1);
  CHECK(shifted(1 - 1e-9, 0) == 1);
  CHECK(shifted(1 + 1e-9, 0) == gone);
  CHECK(shifted(0, 1 - 1e-9) == 1);
  CHECK(shifted(0, 1 + 1e-9) == gone);
  CHECK(shifted(0, -1 - 1e-9) == gone);
  CHECK(shifted(0.9, 0.9) == 1);
  CHECK(shifted(-5, 0) == 1);  // however deep
  CHECK(shifted(1.5, -1.5) == gone);
  // Open at two corners and closed at the third: they still face each other.
  CHECK(left_after([&](Parted& p) {
          const Vec3 n = normal_between(p);
          for (std::size_t k = 1; k < 3; ++k) {
            p.state.vertices.position[p.body.corners[0][k].index()] += 1.2 * reach * n;
          }
        }) == 1);
  // Together they may go anywhere.
  CHECK(left_after([&](Parted& p) {
          for (Vec3& x : p.state.vertices.position) x = Vec3(x.y(), -x.x(), x.z()) + Vec3(9, 9, 9);
        }) == 1);
}

TEST_CASE("partners of bodies that do not move in a step are left alone",
          "[mechanics][contact][partners]") {
  Parted p = parted(two_tetrahedra(), first_is_upper, true, 0.05);
  p.shift_upper(p.state.vertices.position, first_is_upper, normal_between(p));
  const std::vector<char> members = {1, 0};
  p.predicted = p.state.vertices.position;
  StepPaths paths = p.paths();
  paths.members.component = members;
  update_partners(p.memory, p.scratch, paths);
  CHECK(p.memory.partners.size() == 1);
  p.shift_upper(p.predicted, first_is_upper, -2 * normal_between(p));
  paths.predicted = p.predicted;
  find_between_partners(p.scratch, p.memory, paths, {});
  CHECK(p.scratch.found.empty());
}

TEST_CASE("faces of one plane make one row a pair of vertices, faces of two planes two",
          "[mechanics][contact][partners]") {
  // 5 x 3 vertices on the cut, three of them on the bend.
  const double angle = GENERATE(0.0, 5.0, 9.5, 10.5, 30.0, 80.0);
  INFO("angle " << angle);
  Parted p = bent(angle);
  REQUIRE(p.state.vertices.size() == 45 + 15);
  const std::vector<bool> upper = [&] {
    std::vector<bool> all;
    for (const ComponentId c : p.state.elements.component) all.push_back(c == ComponentId{1});
    return all;
  }();
  const std::vector<ContactPoint> contacts = p.found(upper, {0, 0, -1e-4});
  CHECK(contacts.size() == (angle < 10 ? 15 : 18));
  const Vec3 flat = Vec3::UnitZ();
  const Vec3 rising(-std::sin(angle * degree), 0, std::cos(angle * degree));
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ContactPoint& c = contacts[k];
    CHECK(c.gap_start == 0);
    const double x = p.state.vertices.rest_position[c.vertex.index()].x();
    const bool is_upper = p.state.vertices.component[c.vertex.index()] == ComponentId{1};
    const Vec3 n = is_upper ? c.normal : Vec3(-c.normal);
    if (x < -0.1) CHECK((n - flat).norm() < 1e-12);
    if (x > 0.1) CHECK((n - rising).norm() < 1e-12);
    if (std::abs(x) < 0.1) {
      const double a = std::min((n - flat).norm(), (n - rising).norm());
      if (angle > 10) CHECK(a < 1e-12);
      if (angle < 10) CHECK(n.dot(flat) >= std::cos(angle * degree) - 1e-12);
    }
    if (k == 0) continue;
    const ContactPoint& before = contacts[k - 1];
    CHECK(std::tuple(before.vertex, before.face) < std::tuple(c.vertex, c.face));
  }
}
