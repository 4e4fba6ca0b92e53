// SPDX-License-Identifier: MIT
// One sign rule for all: runs, `sunder split`, `sunder convert` and fixtures cut the same faces
// along the same plane, also where tetrahedra have their centres on it.
#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "fracture/algorithms/choose_fan.hpp"
#include "fracture/algorithms/split_fan.hpp"
#include "tests/support/tension.hpp"
#include "topology/kernel/plane_side.hpp"
#include "topology/mesh/crack.hpp"
#include "topology/suite/fixtures/steps.hpp"
#include "topology/suite/judge/glue_twin.hpp"

#include <catch2/catch.hpp>

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

using Faces = std::set<std::array<std::uint32_t, 3>>;

std::array<std::uint32_t, 3> points_of(const VolumeMap& map, HalfFaceId face) {
  std::array<std::uint32_t, 3> points;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto place = static_cast<std::size_t>(dart_order::face_corners[place_of(face)][k]);
    points[k] = map.point_of_vertex(map.corners(tetrahedron_of(face))[place]);
  }
  std::ranges::sort(points);
  return points;
}

Faces faces_of(const VolumeMap& map, std::span<const HalfFaceId> faces) {
  Faces all;
  for (const HalfFaceId f : faces) all.insert(points_of(map, f));
  return all;
}

Faces faces_of(const GlueTwin& twin, std::span<const Step> steps) {
  Faces all;
  for (const Step& step : steps) all.insert(suite::points_of(twin, step.a));
  return all;
}

/// Those of a whole section that touch a vertex.
Faces at(const Faces& section, std::uint32_t point) {
  Faces fan;
  for (const auto& face : section) {
    if (std::ranges::find(face, point) != face.end()) fan.insert(face);
  }
  return fan;
}

Vec3 centre_of(const TetMesh& mesh, std::size_t t) {
  Vec3 centre = Vec3::Zero();
  for (const std::uint32_t p : mesh.tetrahedra[t]) centre += Vec3(mesh.points[p].data()) / 4;
  return centre;
}

double radius_of(const TetMesh& mesh, std::size_t t) {
  double radius = 0;
  for (const std::uint32_t p : mesh.tetrahedra[t]) {
    radius = std::max(radius, (Vec3(mesh.points[p].data()) - centre_of(mesh, t)).norm());
  }
  return radius;
}

Vec3 random_vector(std::mt19937_64& random) {
  return {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
}

}  // namespace

TEST_CASE("everybody who cuts along a plane cuts the same faces", "[fracture][plane_side]") {
  const std::uint64_t seed = 43;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  const TetMesh mesh = jittered(kuhn_box({3, 3, 3}, 0.1), 0.02, 5);
  const FileMesh file = file_mesh_of(mesh);
  const FaceLinks links = *face_links(file);
  const GlueTwin twin = glue_twin(mesh.tetrahedra, mesh.points.size());
  const Tension intact = uniform_tension(mesh, Vec3::UnitZ(), 1e6);
  const VolumeMap& map = intact.cells.map;
  REQUIRE(map.reoriented().empty());
  for (int trial = 0; trial < 400; ++trial) {
    const VertexId v{below(random, map.vertices())};
    const std::uint32_t point = map.point_of_vertex(v);
    const VertexStar star = vertex_star(map, v);
    // A plane that passes one centre of the star at some share of the tolerance.
    const std::size_t t = tetrahedron_of(star.corners[below(random, star.corners.size())]).index();
    const Vec3 x(map.point(v).data()), away = centre_of(mesh, t) - x;
    const double off = std::array{-3.0, -0.9, -0.1, 0.1, 0.9, 3.0}[below(random, 6)];
    const Vec3 in_plane = away.cross(random_vector(random)).normalized();
    const double tilt = off * 1e-6 * radius_of(mesh, t) / away.norm();
    const Vec3 n = (in_plane + tilt * away.normalized()).normalized();
    INFO("trial " << trial << ", vertex " << v.value << ", " << off << " tolerances off");
    const Point normal = {n.x(), n.y(), n.z()}, direction = canonical_direction(normal);

    // The rule's answer for that tetrahedron.
    const double height = normal == direction ? off : -off;
    const auto own =
        std::ranges::find(star.corners, TetId{t}, [](CornerId c) { return tetrahedron_of(c); });
    const std::vector<char> signs = plane_signs(map, star, direction);
    CHECK((signs[static_cast<std::size_t>(own - star.corners.begin())] != 0) == (height >= -1));

    const Faces expected = faces_of(map, fan_faces(map, star, signs));
    CHECK(faces_of(map, *fan_faces(map, v, normal)) == expected);  // split --fan, static
    const CuttingPlane plane{normal, n.dot(x)};
    CHECK(at(faces_of(map, *plane_faces(map, plane)), point) == expected);  // split --plane, cuts
    Faces section;                                                          // convert --crack-plane
    if (const Result<CutFaces> cut = section_faces(file, links, plane)) {
      for (const std::uint32_t f : *cut) section.insert(points_of(map, HalfFaceId{f}));
    }
    CHECK(at(section, point) == expected);
    CHECK(faces_of(twin, steps_of(SplitFan{point, normal}, twin, twin, mesh)) == expected);
    CHECK(at(faces_of(twin, steps_of(SplitPlane{plane}, twin, twin, mesh)), point) == expected);

    // A run: of n and -n it may take either where anything lies on the plane, and no other.
    const FanPlane chosen = choose_fan(intact.cells, star, PrincipalTension{1e6, n});
    const Point taken = {chosen.normal.x(), chosen.normal.y(), chosen.normal.z()};
    if (chosen.faces.empty()) {
      CHECK(expected.empty());
      continue;
    }
    const Faces of_run = faces_of(map, fan_faces(map, star, plane_signs(map, star, taken)));
    CHECK(faces_of(map, chosen.faces) == of_run);
    if (std::abs(off) > 1) CHECK(of_run == expected);
    if (trial % 20 > 0) continue;
    Tension body = intact;
    ComponentScratch scratch;
    const FanEvent event = split_fan({body.cells, body.state}, star, chosen.normal, {}, scratch);
    Faces split;
    for (const FaceSplit& face : event.faces) split.insert(points_of(map, face.face));
    CHECK(split == of_run);
  }
}
