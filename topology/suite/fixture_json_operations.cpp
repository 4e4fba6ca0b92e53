// SPDX-License-Identifier: MIT
// Operations of a fixture: read, and held against the body they are meant for.
#include <algorithm>
#include <cmath>
#include <set>

#include "topology/suite/fixture_json.hpp"

namespace sunder::suite {
namespace {

using Quad = std::array<std::uint32_t, 4>;

bool has_corner(const Quad& t, std::uint32_t point) {
  return std::find(t.begin(), t.end(), point) != t.end();
}

/// Number of tetrahedra that have the three points.
std::ptrdiff_t sides_of(const TetMesh& body, const std::array<std::uint32_t, 3>& face) {
  if (face[0] == face[1] || face[1] == face[2] || face[0] == face[2]) return 0;
  return std::count_if(body.tetrahedra.begin(), body.tetrahedra.end(), [&face](const Quad& t) {
    return has_corner(t, face[0]) && has_corner(t, face[1]) && has_corner(t, face[2]);
  });
}

bool is_corner(const JsonAt& at, const TetMesh& body, std::uint32_t tetrahedron,
               std::uint32_t point) {
  if (tetrahedron >= body.tetrahedra.size()) {
    return complain(at, "names tetrahedron " + std::to_string(tetrahedron) + " of " +
                            std::to_string(body.tetrahedra.size()));
  }
  if (has_corner(body.tetrahedra[tetrahedron], point)) return true;
  return complain(at, "names point " + std::to_string(point) +
                          ", which is no corner of tetrahedron " + std::to_string(tetrahedron));
}

bool read_points(const JsonAt& at, const TetMesh& body, std::ptrdiff_t least_sides,
                 std::array<std::uint32_t, 3>& face) {
  if (!read(at, face)) return false;
  const std::ptrdiff_t sides = sides_of(body, face);
  if (sides >= least_sides) return true;
  return complain(at, sides == 0 ? "is no face of the body" : "is a boundary face of the body");
}

bool read_side(const JsonAt& at, const TetMesh& body, FaceSide& side) {
  return is_object_of(at, {"tetrahedron", "opposite"}) &&
         read_member(at, "tetrahedron", side.tetrahedron) &&
         read_member(at, "opposite", side.opposite) &&
         is_corner(at, body, side.tetrahedron, side.opposite);
}

bool read(const JsonAt& at, const TetMesh& body, SplitFace& split) {
  if (at.value->is_array()) {
    return read_points(at, body, 1, split.face.emplace<std::array<std::uint32_t, 3>>());
  }
  return read_side(at, body, split.face.emplace<FaceSide>());
}

bool read(const JsonAt& at, const TetMesh& body, GlueFace& glue) {
  if (!at.value->is_array() || at.value->size() != 2) {
    return read_points(at, body, 2, glue.face.emplace<std::array<std::uint32_t, 3>>());
  }
  auto& sides = glue.face.emplace<std::array<FaceSide, 2>>();
  for (std::size_t i = 0; i < 2; ++i) {
    if (!read_side(element(at, i), body, sides[i])) return false;
  }
  const auto points = [&body](const FaceSide& side) {
    std::set<std::uint32_t> face(body.tetrahedra[side.tetrahedron].begin(),
                                 body.tetrahedra[side.tetrahedron].end());
    face.erase(side.opposite);
    return face;
  };
  const bool fine =
      sides[0].tetrahedron != sides[1].tetrahedron && points(sides[0]) == points(sides[1]);
  return fine || complain(at, "names two sides that do not have the same three points");
}

bool read_normal(const JsonAt& at, Point& normal) {
  if (!read_member(at, "normal", normal)) return false;
  const bool finite =
      std::isfinite(normal[0]) && std::isfinite(normal[1]) && std::isfinite(normal[2]);
  if (finite && normal != Point{0, 0, 0}) return true;
  return complain(*member(at, "normal"), "is no direction: three numbers, not all 0");
}

bool read(const JsonAt& at, const TetMesh& body, SplitFan& fan) {
  if (!is_object_of(at, {"point", "normal"}, {"tetrahedron"}) || !read_normal(at, fan.normal)) {
    return false;
  }
  std::uint32_t point = 0;
  if (!read_member(at, "point", point)) return false;
  if (!at.value->contains("tetrahedron")) {
    fan.vertex = point;
    const bool used = std::any_of(body.tetrahedra.begin(), body.tetrahedra.end(),
                                  [point](const Quad& t) { return has_corner(t, point); });
    return used || complain(at, "names point " + std::to_string(point) +
                                    ", which is no corner of any tetrahedron");
  }
  CornerAt& corner = fan.vertex.emplace<CornerAt>(CornerAt{.tetrahedron = 0, .point = point});
  return read_member(at, "tetrahedron", corner.tetrahedron) &&
         is_corner(at, body, corner.tetrahedron, point);
}

bool read(const JsonAt& at, SplitPlane& split) {
  if (!is_object_of(at, {"normal", "offset"}) || !read_normal(at, split.plane.normal) ||
      !read_member(at, "offset", split.plane.offset)) {
    return false;
  }
  return std::isfinite(split.plane.offset) || expect(*member(at, "offset"), "a finite number");
}

bool read(const JsonAt& at, Shatter& shatter) {
  if (at.value->is_object()) {
    shatter.order = Shatter::Order::seeded;
    return is_object_of(at, {"seed"}) && read_member(at, "seed", shatter.seed);
  }
  if (*at.value != "rising" && *at.value != "falling") {
    return expect(at, R"("rising", "falling" or {"seed": n})");
  }
  shatter.order = *at.value == "rising" ? Shatter::Order::rising : Shatter::Order::falling;
  return true;
}

}  // namespace

bool read(const JsonAt& at, const TetMesh& body, ExpectedOperation& operation) {
  if (!is_object_of(at, {}, {"split", "glue", "fan", "plane", "shatter", "after"})) return false;
  bool fine = read_member(at, "after", operation.after);
  const std::size_t named = at.value->size() - at.value->count("after");
  if (named != 1) return complain(at, "is not exactly one of split, glue, fan, plane, shatter");
  if (const auto split = member(at, "split")) {
    fine = read(*split, body, operation.operation.emplace<SplitFace>()) && fine;
  } else if (const auto glue = member(at, "glue")) {
    fine = read(*glue, body, operation.operation.emplace<GlueFace>()) && fine;
  } else if (const auto fan = member(at, "fan")) {
    fine = read(*fan, body, operation.operation.emplace<SplitFan>()) && fine;
  } else if (const auto plane = member(at, "plane")) {
    fine = read(*plane, operation.operation.emplace<SplitPlane>()) && fine;
  } else {
    fine = read(*member(at, "shatter"), operation.operation.emplace<Shatter>()) && fine;
  }
  return fine;
}

}  // namespace sunder::suite
