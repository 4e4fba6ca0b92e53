// SPDX-License-Identifier: MIT
// The first breaking step of a mirror-symmetric body is mirror-symmetric.
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <set>

#include "fracture/algorithms/choose_fan.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "tests/fracture/algorithms/mirror_bodies.hpp"
#include "tests/support/tension.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

enum class Field { tension, random, smooth, biaxial, hydrostatic };

/// Element stresses that the mirror maps to themselves, but for `noise` (relative), Pa.
void apply_field(Tension& tension, const MirrorBody& body, Field field, std::mt19937_64& random) {
  std::vector<Mat3>& stress = tension.state.elements.stress;
  const auto number = [&] { return 2 * suite::unit(random) - 1; };
  Mat3 mirror = Mat3::Identity();
  mirror(body.axis, body.axis) = -1;
  Mat3 base, slope;
  for (int i = 0; i < 9; ++i) base(i) = number(), slope(i) = number();
  for (std::size_t t = 0; t < stress.size(); ++t) {
    Vec3 centre = Vec3::Zero();
    for (const VertexId v : tension.cells.map.corners(TetId{t})) {
      centre += tension.state.vertices.rest_position[v.index()] / 4;
    }
    const Vec3 axis = Vec3::Unit((body.axis + 1) % 3), other = Vec3::Unit((body.axis + 2) % 3);
    Mat3 s = Mat3::Zero();
    switch (field) {
      case Field::tension:
        s = 4e6 * axis * axis.transpose();
        break;
      case Field::random:
        for (int i = 0; i < 9; ++i) s(i) = 5e6 * number();
        break;
      case Field::smooth:
        s = 4e6 * base + 2e6 * (3 * centre.dot(Vec3(1, 2, 3))) * slope;
        break;
      case Field::biaxial:
        s = 4e6 * (axis * axis.transpose() + other * other.transpose());
        break;
      case Field::hydrostatic:
        s = 4e6 * Mat3::Identity();
        break;
    }
    stress[t] = (s + s.transpose()) / 2;
  }
  for (std::size_t t = 0; t < stress.size(); ++t) {
    const std::size_t image = body.image_of_tetrahedron[t];
    if (image == t) stress[t] = (stress[t] + mirror * stress[t] * mirror) / 2;
    if (image > t) stress[image] = mirror * stress[t] * mirror;
  }
  for (Mat3& s : stress) {
    Mat3 noise;
    for (int i = 0; i < 9; ++i) noise(i) = number();
    s += 1e-9 * s.norm() * (noise + noise.transpose()) / 4;
  }
}

/// Gives the body nodes in the middles of its edges, and its corners stresses of their own that the
/// mirror maps to themselves: those of their tetrahedra, more or less by place.
void raise(Tension& tension, const MirrorBody& body) {
  VolumeMap& map = tension.cells.map;
  MechanicsState& m = tension.state;
  raise_order({tension.cells, m}, TetId{0}, TetId{map.tetrahedra()});
  m.elements.corner_stress.resize(map.tetrahedra());
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) {
      Vec3 x = m.vertices.rest_position[map.corners(TetId{t})[k].index()];
      x[body.axis] = std::abs(x[body.axis] - body.offset);
      const double factor = 1 + 0.3 * std::cos(Vec3(3, 4, 5).dot(x));
      m.elements.corner_stress[t][k] = factor * m.elements.stress[t];
    }
  }
}

using FaceKey = std::array<std::uint32_t, 3>;

/// Points of the faces that fans split.
std::set<FaceKey> split_faces(const VolumeMap& map, std::span<const FanEvent> fans) {
  std::set<FaceKey> faces;
  for (const FanEvent& fan : fans) {
    for (const FaceSplit& split : fan.faces) {
      FaceKey key;
      for (int i = 0; i < 3; ++i) key[i] = map.point_of_vertex(split.vertices[i]);
      std::ranges::sort(key);
      faces.insert(key);
    }
  }
  return faces;
}

std::set<FaceKey> mirrored(const std::set<FaceKey>& faces, const MirrorBody& body) {
  std::set<FaceKey> images;
  for (FaceKey key : faces) {
    for (std::uint32_t& p : key) p = body.image_of_point[p];
    std::ranges::sort(key);
    images.insert(key);
  }
  return images;
}

/// The result of one breaking step of a mirror body.
struct Outcome {
  Tension tension;
  FractureReport report;
};

Outcome break_once(const MirrorBody& body, Field field, std::uint64_t seed,
                   const std::set<std::uint32_t>& held, CrackMode crack = CrackMode::paper,
                   std::uint32_t order = 1) {
  Outcome outcome{uniform_tension(body.mesh, Vec3::UnitZ(), 1), {}};
  Cells& cells = outcome.tension.cells;
  std::mt19937_64 random(seed);
  apply_field(outcome.tension, body, field, random);
  if (order == 2) raise(outcome.tension, body);
  for (std::size_t v = 0; v < cells.map.vertices(); ++v) {
    if (!held.contains(cells.map.point_of_vertex(VertexId{v}))) continue;
    cells.strength[v] = cells.painted[v] = 1e12;
  }
  FractureSettings settings;
  settings.node_stress = static_cast<NodeStress>(order == 1 ? seed % 3 : seed % 2);
  settings.crack = crack;
  FractureScratch scratch;
  outcome.report = break_vertices({cells, outcome.tension.state}, settings, scratch);
  return outcome;
}

std::set<std::uint32_t> points_on_plane(const MirrorBody& body) {
  std::set<std::uint32_t> points;
  for (std::uint32_t p = 0; p < body.image_of_point.size(); ++p) {
    if (body.image_of_point[p] == p) points.insert(p);
  }
  return points;
}

/// The first vertex on the mirror's plane with a fan that is not its own image.
std::optional<std::uint32_t> one_of_two(const Outcome& outcome, const MirrorBody& body) {
  for (const FanEvent& fan : outcome.report.fans) {
    if (body.image_of_point[fan.point] != fan.point) continue;
    const auto faces = split_faces(outcome.tension.cells.map, {&fan, 1});
    if (faces != mirrored(faces, body)) return fan.point;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("the first breaking step of a mirror-symmetric body is mirror-symmetric",
          "[fracture][mirror]") {
  const CrackMode crack = GENERATE(CrackMode::paper, CrackMode::object);
  const auto order = GENERATE(1u, 2u);
  const Joint joint = GENERATE(Joint::faces, Joint::bridge);
  const Field field =
      GENERATE(Field::tension, Field::random, Field::smooth, Field::biaxial, Field::hydrostatic);
  // Where all directions are equally tense, starts of one tie follow each other round corners and
  // have no side in common.
  if (crack == CrackMode::object && field == Field::hydrostatic) return;
  // Fields with planes that are not their own images at vertices on the mirror's plane: see below.
  const bool chooses =
      field == Field::hydrostatic ||
      (joint == Joint::bridge && (field == Field::random || field == Field::smooth));
  std::size_t split = 0;
  // Of the first 120 bodies of each kind 9 of 2 400 break otherwise, of both orders alike and all
  // with crack objects: those that grow towards each other across the plane (order 1: 4, order 2:
  // 5).
  const std::uint64_t first = order == 1 ? 0 : 20;
  for (std::uint64_t seed = first; seed < first + 12; ++seed) {
    INFO("crack " << int(crack) << " seed " << seed << " field " << int(field) << " joint "
                  << int(joint) << " order " << order);
    const MirrorBody body = mirror_body(seed, joint, seed / 3 % 3, 0.37 * (seed % 2));
    // A vertex on the plane is on the fronts of two cracks that are images, and takes one.
    const bool holds = chooses || crack == CrackMode::object;
    const auto held = holds ? points_on_plane(body) : std::set<std::uint32_t>();
    const Outcome outcome = break_once(body, field, seed, held, crack, order);
    const auto faces = split_faces(outcome.tension.cells.map, outcome.report.fans);
    CHECK(faces == mirrored(faces, body));
    split += faces.size();
  }
  CHECK(split > 20);
}

TEST_CASE("a vertex on the mirror's plane cuts one of two images, and all else is symmetric",
          "[fracture][mirror]") {
  const Field field = GENERATE(Field::random, Field::smooth, Field::hydrostatic);
  int chose = 0;
  for (std::uint64_t seed = 0; seed < (field == Field::hydrostatic ? 1 : 6); ++seed) {
    INFO("seed " << seed);
    const MirrorBody body = mirror_body(seed, Joint::bridge, seed / 3 % 3, 0.37 * (seed % 2));
    // Those that had to choose are held one after the other, until the rest is its own image.
    std::set<std::uint32_t> held;
    while (true) {
      const Outcome outcome = break_once(body, field, seed, held);
      const auto faces = split_faces(outcome.tension.cells.map, outcome.report.fans);
      if (faces == mirrored(faces, body)) break;
      const auto point = one_of_two(outcome, body);
      REQUIRE(point);
      REQUIRE(held.insert(*point).second);
      ++chose;
    }
  }
  CHECK(chose > 0);
}

TEST_CASE("tetrahedra that the mirror's plane cuts in two stay with its positive side",
          "[fracture][mirror]") {
  const int axis = GENERATE(0, 1, 2);
  const MirrorBody body = mirror_body(5, Joint::bridge, axis, 0.37);
  const Tension tension = uniform_tension(body.mesh, Vec3::Unit(axis), 4e6);
  const VolumeMap& map = tension.cells.map;
  const auto centre = [&](TetId t) {
    double x = 0;
    for (const VertexId v : map.corners(t)) x += map.point(v)[axis] / 4;
    return x - body.offset;
  };
  std::size_t faces = 0;
  for (const std::uint32_t p : points_on_plane(body)) {
    PrincipalTension pull{4e6, Vec3(-Vec3::Unit(axis))};
    const VertexStar star = vertex_star(map, VertexId{p});
    for (const HalfFaceId f : choose_fan(tension.cells, star, pull, {0.1, 0.1, 0.1}).faces) {
      CHECK(centre(tetrahedron_of(f)) > -1e-12);
      CHECK(centre(tetrahedron_of(map.neighbour(f))) < -1e-12);
      ++faces;
    }
  }
  CHECK(faces > 20);
}

TEST_CASE("a body that falls flat breaks symmetrically about the planes of its symmetry",
          "[fracture][mirror]") {
  const int axis = GENERATE(0, 1);
  const MirrorBody body = mirror_body(7, Joint::faces, axis, 0);
  Scene scene;
  BodySettings falling;
  falling.mesh = body.mesh;
  double low = 1;
  for (const Point& p : body.mesh.points) low = std::min(low, p[2]);
  falling.translation = {0, 0, 1e-3 - low};
  falling.velocity = {0, 0, -5};
  scene.bodies.push_back(std::move(falling));
  scene.obstacles = {{.shape = Plane{}}};
  Result<Simulation> sim = build_simulation(std::move(scene));
  REQUIRE(sim);
  std::set<FaceKey> faces;
  while (faces.empty() && sim->state->mechanics.time < 0.01) {
    const StepReport report = advance(*sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    // Those of the first search that finds any: from then on crack faces push at each other, by
    // impulses that are alike only as far as contact is solved.
    const auto& parts = report.fan_part;
    const auto first = std::ranges::find_if(parts, [&](auto p) { return p != parts.front(); });
    const std::size_t count = static_cast<std::size_t>(first - parts.begin());
    faces = split_faces(sim->state->cells.map, std::span(report.fracture.fans).first(count));
  }
  REQUIRE_FALSE(faces.empty());
  CHECK((faces == mirrored(faces, body)));
}
