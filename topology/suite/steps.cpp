// SPDX-License-Identifier: MIT
// Signs of tetrahedra, fans, sections and orders of shattering.
#include "topology/suite/steps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace sunder::suite {
namespace {

using Vector = std::array<long double, 3>;

long double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The direction divided by its largest component, the first of equals.
Vector canonical(const Point& normal) {
  std::size_t largest = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(normal[i]) > std::abs(normal[largest])) largest = i;
  }
  Vector n;
  for (std::size_t i = 0; i < 3; ++i) n[i] = static_cast<long double>(normal[i]) / normal[largest];
  return n;
}

/// Whether the centre of a tetrahedron is on the positive side of the plane through `at`, or on it:
/// to 1e-10 of its distance from `at`, and to 8 eps of the largest coordinate.
bool is_positive(const TetMesh& body, std::size_t t, const Vector& normal, const Vector& at) {
  Vector center = {0, 0, 0};
  long double size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    size = std::max(size, std::abs(at[i]));
    for (const std::uint32_t p : body.tetrahedra[t]) {
      const long double x = body.points[p][i];
      size = std::max(size, std::abs(x));
      center[i] += x / 4;
    }
  }
  const Vector away = {center[0] - at[0], center[1] - at[1], center[2] - at[2]};
  const long double rounding = 8.0L * std::numeric_limits<double>::epsilon() * size;
  const long double slack = 1e-10L * std::sqrt(dot(away, away)) + rounding;
  return dot(normal, away) >= -slack * std::sqrt(dot(normal, normal));
}

Step split_from(const GlueTwin& twin, HalfFaceId face) {
  return {.kind = Step::Kind::split, .a = side_of(twin, face), .b = {}};
}

/// The sides of the face with three points, rising; at most two.
std::vector<FaceSide> sides_of(const GlueTwin& intact, const std::array<std::uint32_t, 3>& face) {
  std::vector<FaceSide> sides;
  for (const std::uint32_t t : intact.around[face[0]]) {
    std::set<std::uint32_t> left(intact.tetrahedra[t].begin(), intact.tetrahedra[t].end());
    for (const std::uint32_t p : face) left.erase(p);
    if (left.size() == 1) sides.push_back({t, *left.begin()});
  }
  return sides;
}

/// Splits of the faces between `positive` tetrahedra and others. With a point only faces that have
/// it.
std::vector<Step> between(const GlueTwin& now, const std::vector<std::uint32_t>& tetrahedra,
                          const std::vector<char>& positive, const std::uint32_t* point) {
  std::vector<Step> steps;
  for (const std::uint32_t t : tetrahedra) {
    for (std::uint32_t p = 0; positive[t] != 0 && p < 4; ++p) {
      const HalfFaceId across = now.glued[4 * t + p];
      if (across.is_none() || positive[across.value / 4] != 0) continue;
      if (point != nullptr && now.tetrahedra[t][p] == *point) continue;
      steps.push_back(split_from(now, HalfFaceId{4 * t + p}));
    }
  }
  return steps;
}

std::vector<Step> steps_of(const SplitFan& fan, const GlueTwin& now, const TetMesh& body) {
  const CornerAt corner = corner_of(now, fan.vertex);
  const std::vector<std::uint32_t> star = orbit_of(now, corner);
  const Point& x = body.points[corner.point];
  const Vector n = canonical(fan.normal), at = {x[0], x[1], x[2]};
  std::vector<char> positive(now.tetrahedra.size(), 0);
  for (const std::uint32_t t : star) positive[t] = is_positive(body, t, n, at) ? 1 : 0;
  return between(now, star, positive, &corner.point);
}

std::vector<Step> steps_of(const SplitPlane& split, const GlueTwin& now, const TetMesh& body) {
  const Vector n = canonical(split.plane.normal);
  // n is the normal over its largest component; so is the offset.
  const Point& normal = split.plane.normal;
  const double largest = *std::max_element(
      normal.begin(), normal.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const long double s = split.plane.offset / static_cast<long double>(largest) / dot(n, n);
  const Vector foot = {s * n[0], s * n[1], s * n[2]};
  std::vector<std::uint32_t> all(now.tetrahedra.size());
  std::vector<char> positive(all.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    all[t] = t;
    positive[t] = is_positive(body, t, n, foot) ? 1 : 0;
  }
  return between(now, all, positive, nullptr);
}

std::vector<Step> steps_of(const Shatter& shatter, const GlueTwin& intact, const GlueTwin& now) {
  std::vector<HalfFaceId> faces;
  for (std::size_t f = 0; f < intact.glued.size(); ++f) {
    const HalfFaceId across = intact.glued[f];
    if (!across.is_none() && across.index() > f) faces.push_back(HalfFaceId{f});
  }
  if (shatter.order == Shatter::Order::falling) std::reverse(faces.begin(), faces.end());
  if (shatter.order == Shatter::Order::seeded) {
    // Knuth's MMIX generator: any language has it in one line.
    std::uint64_t s = shatter.seed;
    for (std::size_t i = faces.size(); i > 1; --i) {
      s = s * 6364136223846793005U + 1442695040888963407U;
      std::swap(faces[i - 1], faces[(s >> 33) % i]);
    }
  }
  std::vector<Step> steps;
  for (const HalfFaceId f : faces) {
    if (!now.glued[f.index()].is_none()) steps.push_back(split_from(now, f));
  }
  return steps;
}

}  // namespace

HalfFaceId half_face_of(const GlueTwin& twin, FaceSide side) {
  const auto& t = twin.tetrahedra[side.tetrahedron];
  const auto place = std::find(t.begin(), t.end(), side.opposite) - t.begin();
  return half_face(TetId{side.tetrahedron}, static_cast<int>(place));
}

FaceSide side_of(const GlueTwin& twin, HalfFaceId face) {
  return {face.value / 4, twin.tetrahedra[face.value / 4][face.value % 4]};
}

std::array<std::uint32_t, 3> points_of(const GlueTwin& twin, FaceSide side) {
  std::array<std::uint32_t, 3> points{};
  std::size_t n = 0;
  for (const std::uint32_t p : twin.tetrahedra[side.tetrahedron]) {
    if (p != side.opposite && n < 3) points[n++] = p;
  }
  std::sort(points.begin(), points.end());
  return points;
}

std::vector<std::uint32_t> orbit_of(const GlueTwin& now, CornerAt corner) {
  std::set<std::uint32_t> orbit = {corner.tetrahedron};
  std::vector<std::uint32_t> stack = {corner.tetrahedron};
  while (!stack.empty()) {
    const std::uint32_t t = stack.back();
    stack.pop_back();
    for (std::uint32_t p = 0; p < 4; ++p) {
      const HalfFaceId across = now.glued[4 * t + p];
      if (across.is_none() || now.tetrahedra[t][p] == corner.point) continue;
      if (orbit.insert(across.value / 4).second) stack.push_back(across.value / 4);
    }
  }
  return {orbit.begin(), orbit.end()};
}

CornerAt corner_of(const GlueTwin& now, const VertexName& vertex) {
  if (const auto* corner = std::get_if<CornerAt>(&vertex)) return *corner;
  const std::uint32_t point = std::get<std::uint32_t>(vertex);
  return {now.around[point].front(), point};
}

std::vector<Step> steps_of(const Operation& operation, const GlueTwin& intact, const GlueTwin& now,
                           const TetMesh& body) {
  if (const auto* split = std::get_if<SplitFace>(&operation)) {
    const auto* side = std::get_if<FaceSide>(&split->face);
    const FaceSide from =
        side != nullptr ? *side
                        : sides_of(intact, std::get<std::array<std::uint32_t, 3>>(split->face))[0];
    return {{.kind = Step::Kind::split, .a = from, .b = {}}};
  }
  if (const auto* glue = std::get_if<GlueFace>(&operation)) {
    if (const auto* named = std::get_if<std::array<FaceSide, 2>>(&glue->face)) {
      return {{.kind = Step::Kind::glue, .a = (*named)[0], .b = (*named)[1]}};
    }
    const std::vector<FaceSide> sides =
        sides_of(intact, std::get<std::array<std::uint32_t, 3>>(glue->face));
    return {{.kind = Step::Kind::glue, .a = sides[0], .b = sides[1]}};
  }
  if (const auto* fan = std::get_if<SplitFan>(&operation)) return steps_of(*fan, now, body);
  if (const auto* plane = std::get_if<SplitPlane>(&operation)) return steps_of(*plane, now, body);
  return steps_of(std::get<Shatter>(operation), intact, now);
}

Operation operation_of(const Step& step) {
  if (step.kind == Step::Kind::split) return SplitFace{step.a};
  return GlueFace{std::array{step.a, step.b}};
}

std::string text_of(const GlueTwin& twin, const Step& step) {
  const auto points = points_of(twin, step.a);
  if (step.kind == Step::Kind::glue) return fmt::format("glue {}", fmt::join(points, " "));
  return fmt::format("split {} from tetrahedron {}", fmt::join(points, " "), step.a.tetrahedron);
}

}  // namespace sunder::suite
