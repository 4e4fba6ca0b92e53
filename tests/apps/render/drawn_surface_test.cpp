// SPDX-License-Identifier: MIT
// Boundary faces face outwards; skin is smooth within its crease angle and piece, cracks are sharp.
#include "apps/render/drawn_surface.hpp"

#include <catch2/catch.hpp>
#include <vector>

using namespace sunder;
using namespace sunder::render;

namespace {

struct Body {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<VertexId, 4>> corners;
  std::vector<HalfFaceId> half_faces;
};

std::array<VertexId, 4> rows(std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  return {VertexId{a}, VertexId{b}, VertexId{c}, VertexId{d}};
}

/// Eight tetrahedra about the origin; its boundary is the regular octahedron of radius 1.
/// Rows 1 to 6: +x, -x, +y, -y, +z, -z; row 7 is used by nothing.
Body octahedron() {
  Body body;
  body.positions.assign(8, Eigen::Vector3d::Zero());
  for (int i = 0; i < 6; ++i) body.positions[1 + i][i / 2] = i % 2 == 0 ? 1 : -1;
  for (std::size_t x = 0; x < 2; ++x) {
    for (std::size_t y = 0; y < 2; ++y) {
      for (std::size_t z = 0; z < 2; ++z) {
        const bool odd = (x + y + z) % 2 == 1;
        const std::size_t a = 1 + x, b = 3 + y, c = 5 + z;
        body.half_faces.push_back(half_face(TetId{body.corners.size()}, 0));
        body.corners.push_back(odd ? rows(0, b, a, c) : rows(0, a, b, c));
      }
    }
  }
  return body;
}

Surface surface_of(const Body& body, double crease_angle) {
  return drawn_surface({.positions = body.positions,
                        .corners = body.corners,
                        .half_faces = body.half_faces,
                        .crease_angle = crease_angle});
}

Eigen::Vector3f face_normal(const Surface& s, std::size_t t) {
  const auto& [a, b, c] = s.triangles[t];
  return (s.positions[b] - s.positions[a]).cross(s.positions[c] - s.positions[a]).normalized();
}

constexpr float rounding = 1e-6f;  // a few units in the last place of a unit vector in float

}  // namespace

TEST_CASE("every face of a tetrahedron is seen counterclockwise from outside",
          "[render][drawn_surface]") {
  const std::vector<Eigen::Vector3d> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto corners = rows(0, 1, 2, 3);
  for (int place = 0; place < 4; ++place) {
    const auto face = outward_corners(corners, half_face(TetId{0}, place));
    const Eigen::Vector3d a = positions[face[0].index()];
    const Eigen::Vector3d normal =
        (positions[face[1].index()] - a).cross(positions[face[2].index()] - a);
    const Eigen::Vector3d opposite = positions[static_cast<std::size_t>(place)];
    CHECK(normal.dot(opposite - a) < 0);
  }
}

TEST_CASE("the surface of a body encloses its volume and holds only the points it uses",
          "[render][drawn_surface]") {
  const Surface s = surface_of(octahedron(), 0);
  REQUIRE(s.triangles.size() == 8);
  CHECK(s.positions.size() == 6);  // neither the center nor the unused row
  float volume = 0;
  for (const auto& [a, b, c] : s.triangles) {
    volume += s.positions[a].dot(s.positions[b].cross(s.positions[c])) / 6;
  }
  CHECK(volume == Approx(4.0 / 3));
}

TEST_CASE("below the crease angle the skin is smooth, above it sharp", "[render][drawn_surface]") {
  const Body body = octahedron();  // neighbouring faces turn by 1.23 rad, opposite ones by 1.91
  const Surface sharp = surface_of(body, 1.2), smooth = surface_of(body, 2.0);
  for (std::size_t t = 0; t < 8; ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(sharp.corner_normals[t][i].isApprox(face_normal(sharp, t), rounding));
      // By symmetry the smooth normal of an octahedron's corner is the corner itself.
      const Eigen::Vector3f corner = smooth.positions[smooth.triangles[t][i]];
      CHECK(smooth.corner_normals[t][i].isApprox(corner, rounding));
    }
  }
}

TEST_CASE("crack faces keep their own normal and do not bend the skin's",
          "[render][drawn_surface]") {
  const Body body = octahedron();
  std::vector<FaceClass> face_class(8, FaceClass::skin);
  face_class[0] = FaceClass::crack;
  const Surface s = drawn_surface({.positions = body.positions,
                                   .corners = body.corners,
                                   .half_faces = body.half_faces,
                                   .face_class = face_class,
                                   .crease_angle = 2.0});
  CHECK(s.face_class == face_class);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(s.corner_normals[0][i].isApprox(face_normal(s, 0), rounding));
  }
  // Face 7 lies opposite and meets no crack; a neighbour of face 0 does, and leans away from it.
  CHECK(s.corner_normals[7][0].cwiseAbs().maxCoeff() == Approx(1));
  CHECK(s.corner_normals[1][0].cwiseAbs().maxCoeff() < 0.99f);
}

TEST_CASE("the skin is not smoothed across pieces", "[render][drawn_surface]") {
  const Body body = octahedron();
  std::vector<ComponentId> component;
  for (std::size_t t = 0; t < 8; ++t) component.push_back(ComponentId{t});
  const Surface s = drawn_surface({.positions = body.positions,
                                   .corners = body.corners,
                                   .half_faces = body.half_faces,
                                   .component = component,
                                   .crease_angle = 2.0});
  for (std::size_t t = 0; t < 8; ++t) {
    CHECK(s.piece[t] == t);
    CHECK(s.corner_normals[t][0].isApprox(face_normal(s, t), rounding));
  }
}

TEST_CASE("a face without area and an empty body are no trouble", "[render][drawn_surface]") {
  const std::vector<Eigen::Vector3d> positions(4, Eigen::Vector3d::Zero());
  const std::vector<std::array<VertexId, 4>> corners = {rows(0, 1, 2, 3)};
  const std::vector<HalfFaceId> faces = {half_face(TetId{0}, 0)};
  const Surface s =
      drawn_surface({.positions = positions, .corners = corners, .half_faces = faces});
  CHECK(s.corner_normals[0][0] == Eigen::Vector3f::Zero());
  CHECK(drawn_surface({}).triangles.empty());
}
