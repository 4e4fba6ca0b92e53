// SPDX-License-Identifier: MIT
// The queue of vertices on crack faces, and the areas of the faces left.
#include "tests/experiments/cases/even_tension.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <random>

#include "apps/output/smooth_cracks.hpp"
#include "fracture/algorithms/choose_fan.hpp"
#include "fracture/breaking/choose_crack.hpp"
#include "fracture/breaking/decide_sides.hpp"
#include "tests/support/tension.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder::accuracy {
namespace {

/// Where a body is torn.
struct Tearing {
  const EvenTension& tension;
  test::Tension body;
  Vec3 middle = Vec3::Zero();
  std::deque<VertexId> queue = {};
  std::vector<char> broken = {};  // row = VertexId
  ComponentScratch scratch = {};
  std::vector<FanEvent> fans = {};
};

Vec3 rest(const Tearing& t, VertexId v) { return Vec3(t.body.cells.map.point(v).data()); }

double normal_number(std::mt19937_64& random) {
  const double a = 1 - suite::unit(random), b = suite::unit(random);
  return std::sqrt(-2 * std::log(a)) * std::cos(2 * std::numbers::pi * b);
}

/// The axis as a vertex feels it; copies feel the same.
PrincipalTension tension_at(const Tearing& t, VertexId v) {
  std::mt19937_64 random(t.tension.seed * 1000003 + t.body.cells.map.point_of_vertex(v));
  const Vec3 side = t.tension.axis.unitOrthogonal();
  const Vec3 other = t.tension.axis.cross(side);
  const double each = t.tension.noise / std::numbers::sqrt2;
  const double a = each * normal_number(random);
  const double b = each * normal_number(random);
  PrincipalTension tension{1, {}};
  tension.directions = (t.tension.axis + a * side + b * other).normalized();
  return tension;
}

/// The fan of a vertex; none where it waits or nothing parts.
std::optional<PlannedFan> plan(Tearing& t, VertexId v) {
  Cells& cells = t.body.cells;
  const PrincipalTension tension = tension_at(t, v);
  PlannedFan fan{vertex_star(cells.map, v)};
  const bool has_objects = t.tension.crack == CrackMode::object;
  CrackChoice choice;
  if (has_objects) {
    const double h = mean_edge_length(t.body.state.vertices, cells.map.corners(), fan.v);
    choice = choose_crack(cells, fan.v, tension, {h, t.middle, 0, cells.cracks.anchors.size()});
    if (choice.step == CrackStep::waits) return std::nullopt;
  }
  t.broken[v.index()] = 1;
  if (choice.step == CrackStep::grows) {
    fan.crack = choice.crack;
    fan.normal = choice.plane.normal;
    fan.at = choice.plane.at;
  } else {
    fan.normal = choose_fan(cells, fan.v, tension, t.middle).normal;
    fan.at = rest(t, v);
    if (fan.normal.isZero(0)) return std::nullopt;
  }
  if (has_objects) {
    decide_sides(cells, t.body.state, {&fan, 1});
  } else {
    fan.positive = plane_signs(cells.map, fan.v, {fan.normal[0], fan.normal[1], fan.normal[2]});
  }
  return fan;
}

/// Those on the faces of a fan, old and new rows, in rising order.
void enqueue(Tearing& t, const FanEvent& fan) {
  std::vector<VertexId> rows;
  t.broken.resize(t.body.cells.map.vertices(), 0);
  for (const FaceSplit& split : fan.faces) {
    rows.insert(rows.end(), split.vertices.begin(), split.vertices.end());
    for (int i = 0; i < split.vertex_count; ++i) {
      const auto [old_row, new_row] = split.split_vertices[i];
      t.broken[new_row.index()] = t.broken[old_row.index()];
      rows.push_back(new_row);
    }
  }
  sort_unique(rows);
  std::ranges::copy_if(rows, std::back_inserter(t.queue),
                       [&](VertexId v) { return !t.broken[v.index()]; });
}

/// Area of a plane's section through a tetrahedron.
double section_of(const std::array<Vec3, 4>& x, const Vec3& at, const Vec3& normal) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      const double a = normal.dot(x[i] - at), b = normal.dot(x[j] - at);
      if ((a < 0) != (b < 0)) corners.push_back(x[i] + a / (a - b) * (x[j] - x[i]));
    }
  }
  if (corners.size() < 3) return 0;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& c : corners) centre += c / static_cast<double>(corners.size());
  const Vec3 u = normal.unitOrthogonal(), w = normal.cross(u);
  const auto angle = [&](const Vec3& c) {
    return std::atan2(w.dot(c - centre), u.dot(c - centre));
  };
  std::ranges::sort(corners, {}, angle);
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& next = corners[(i + 1) % corners.size()];
    area += 0.5 * normal.dot((corners[i] - centre).cross(next - centre));
  }
  return area;
}

double section_of(const Tearing& t, const Vec3& at) {
  double sum = 0;
  for (const Corners& c : t.body.cells.map.corners()) {
    sum += section_of({rest(t, c[0]), rest(t, c[1]), rest(t, c[2]), rest(t, c[3])}, at,
                      t.tension.axis);
  }
  return sum;
}

void measure_pieces(TornBody& torn, const Tearing& t) {
  std::vector<std::pair<double, std::size_t>> pieces(t.body.cells.labels.size.size());
  double whole = 0;
  for (std::size_t e = 0; e < t.body.cells.map.tetrahedra(); ++e) {
    auto& [volume, tetrahedra] = pieces[t.body.cells.labels.of_tetrahedron[e].index()];
    volume += t.body.state.elements.rest_volume[e];
    whole += t.body.state.elements.rest_volume[e];
    ++tetrahedra;
  }
  std::erase_if(pieces, [](const auto& piece) { return piece.second == 0; });
  std::ranges::sort(pieces, std::greater());
  torn.pieces = pieces.size();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (i < 2) torn.two_largest += pieces[i].first / whole;
    if (i >= 2) torn.debris += pieces[i].second;
  }
}

/// Areas of the faces, as they are and as drawn, over `section`.
void measure_faces(TornBody& torn, const Tearing& t, std::span<const HalfFaceId> faces,
                   double section) {
  const VolumeMap& map = t.body.cells.map;
  const std::vector<Vec3> moves = smooth_crack_moves(t.body.cells);
  for (const HalfFaceId face : faces) {
    std::array<Vec3, 3> x;
    const auto corners = corners_of_face(map.corners(tetrahedron_of(face)), face);
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = rest(t, corners[i]) + moves[map.point_of_vertex(corners[i])];
    }
    const Vec3 drawn = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]);
    const Vec3 area = rest_area_vector(map, face);
    torn.raw += area.norm() / section;
    torn.projected += projected_area(area, t.tension.axis) / section;
    torn.smooth_raw += drawn.norm() / section;
    torn.smooth_projected += projected_area(drawn, t.tension.axis) / section;
  }
}

}  // namespace

TornBody tear(const TetMesh& mesh, const EvenTension& tension) {
  Tearing t{tension, test::uniform_tension(mesh, tension.axis, 1e6)};
  t.middle = t.body.state.components.front().rest_centre;
  t.broken.assign(t.body.cells.map.vertices(), 0);
  VertexId first{0};
  for (std::size_t v = 0; v < t.body.cells.map.vertices(); ++v) {
    const bool is_nearer =
        (rest(t, VertexId{v}) - t.middle).norm() < (rest(t, first) - t.middle).norm();
    if (is_nearer) first = VertexId{v};
  }
  const double section = section_of(t, rest(t, first));
  TornBody torn;
  std::vector<HalfFaceId> faces;
  for (t.queue.push_back(first); !t.queue.empty(); t.queue.pop_front()) {
    if (t.broken[t.queue.front().index()]) continue;
    const std::optional<PlannedFan> fan = plan(t, t.queue.front());
    if (!fan) continue;
    const FanEvent event = split_planned({t.body.cells, t.body.state}, *fan, {}, t.scratch);
    torn.fans += !event.faces.empty();
    for (const FaceSplit& split : event.faces) faces.push_back(split.face);
    enqueue(t, event);
  }
  torn.cracks = t.body.cells.cracks.cracks;
  measure_pieces(torn, t);
  measure_faces(torn, t, faces, section);
  return torn;
}

}  // namespace sunder::accuracy
