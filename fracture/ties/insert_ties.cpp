// SPDX-License-Identifier: MIT
// Faces to ties, and the tractions that corners begin with.
#include "fracture/ties/insert_ties.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "fracture/breaking/partners.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/ties/tie_law.hpp"

namespace sunder {
namespace {

/// Where in a tetrahedron of second order the middles of a face's edges are, from where its corners
/// are.
std::array<std::uint8_t, 3> middles_of(const std::array<std::uint8_t, 3>& corner) {
  std::array<std::uint8_t, 3> middle{};
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = static_cast<std::uint8_t>(4 + edge_between(corner[k], corner[(k + 1) % 3]));
  }
  return middle;
}

Tie tie_of(const Cells& cells, const MechanicsState& mechanics, const FanEvent& fan,
           const FaceSplit& split) {
  Partner sides = partner_of(cells.map, split.face, split.opposite);
  // Bodies are of one order, so both sides are.
  if (is_second_order(mechanics.elements, tetrahedron_of(split.face))) {
    sides.corner = middles_of(sides.corner);
    sides.opposite_corner = middles_of(sides.opposite_corner);
  }
  Tie tie{.face = split.face,
          .opposite = split.opposite,
          .crack = fan.crack,
          .corner = sides.corner,
          .opposite_corner = sides.opposite_corner};
  const TetId a = tetrahedron_of(split.face), b = tetrahedron_of(split.opposite);
  const bool is_positive = side_of(cells.cracks, fan.crack, a) == Side::positive;
  tie.normal = (is_positive ? 1 : -1) * fan.normal.normalized();
  const Material& of_a = material_of(mechanics, a);
  const Material& of_b = material_of(mechanics, b);
  const Material& weaker = fracture_energy_of(of_b) < fracture_energy_of(of_a) ? of_b : of_a;
  tie.fracture_energy = fracture_energy_of(weaker);
  tie.shear = weaker.shear;
  const double area = projected_area(rest_area_vector(cells.map, split.face), tie.normal);
  for (TieCorner& corner : tie.corners) corner.area = area / 3;
  return tie;
}

/// A node of a tetrahedron.
struct NodePlace {
  TetId tetrahedron;
  std::size_t place = 0;  ///< in `nodes_of`

  /// Vertices that it is at, or between.
  std::vector<VertexId> vertices(const Cells& cells) const {
    const Corners& c = cells.map.corners(tetrahedron);
    if (place < 4) return {c[place]};
    const auto [i, j] = edge_ends[place - 4];
    return {c[static_cast<std::size_t>(i)], c[static_cast<std::size_t>(j)]};
  }
  VertexId row(const Cells& cells, const MechanicsState& mechanics) const {
    return nodes_of(mechanics.elements, cells.map.corners(), tetrahedron).row[place];
  }
};

/// The k-th nodes of the two sides.
std::array<NodePlace, 2> nodes_of_tie(const Tie& tie, std::size_t k) {
  return {NodePlace{tetrahedron_of(tie.face), tie.corner[k]},
          NodePlace{tetrahedron_of(tie.opposite), tie.opposite_corner[k]}};
}

/// N, body frame: force of the tetrahedra around a node on it.
Vec3 elastic_force(const Cells& cells, const MechanicsState& mechanics, const NodePlace& at) {
  const ElementColumns& elements = mechanics.elements;
  const VertexId row = at.row(cells, mechanics);
  Vec3 force = Vec3::Zero();
  for (const TetId t : star(cells.map, at.vertices(cells).front())) {
    const ElementNodes nodes = nodes_of(elements, cells.map.corners(), t);
    const auto place = static_cast<std::size_t>(std::ranges::find(nodes, row) - nodes.begin());
    if (place == nodes.count) continue;  // at the edge's end, but not round the edge
    force -= node_force(elements, elements.stress, elements.corner_stress, t, place);
  }
  return force;
}

/// Pa: the least threshold of the vertices at a node.
double threshold_at(const Cells& cells, const NodePlace& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const VertexId v : at.vertices(cells)) least = std::min(least, cells.strength[v.index()]);
  return least;
}

/// Corners of two nodes, which begin together.
struct Beginning {
  NodePlace a, b;
  std::vector<std::pair<Tie*, std::size_t>> corners;
  double area = 0;
  Vec3 normal = Vec3::Zero();  ///< times area, from b to a
};

/// Pa: traction between a and b, along the normal where it pulls them together, that keeps both at
/// the acceleration they have together.
Vec3 traction_between(const Cells& cells, const MechanicsState& mechanics,
                      const Beginning& beginning) {
  const NodePlace &a = beginning.a, &b = beginning.b;
  const double mass_a = mechanics.vertices.mass[a.row(cells, mechanics).index()];
  const double mass_b = mechanics.vertices.mass[b.row(cells, mechanics).index()];
  const Vec3 on_a =
      (mass_a * elastic_force(cells, mechanics, b) - mass_b * elastic_force(cells, mechanics, a)) /
      (mass_a + mass_b);
  // A force that pulls a back towards b is tension.
  if (!(beginning.area > 0)) return Vec3::Zero();
  return -on_a / beginning.area;
}

}  // namespace

void add_ties(std::vector<Tie>& ties, const Cells& cells, const MechanicsState& mechanics,
              std::span<const FanEvent> fans) {
  for (const FanEvent& fan : fans) {
    for (const FaceSplit& split : fan.faces) {
      if (split.did) ties.push_back(tie_of(cells, mechanics, fan, split));
    }
  }
}

void begin_corners(std::vector<Tie>& ties, const Cells& cells, const MechanicsState& mechanics) {
  std::map<std::pair<VertexId, VertexId>, Beginning> beginnings;
  std::map<VertexId, int> copies;  // pairs, old ones too, that a vertex is part of
  for (Tie& tie : ties) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [on_a, on_b] = nodes_of_tie(tie, k);
      const VertexId a = on_a.row(cells, mechanics), b = on_b.row(cells, mechanics);
      if (a == b) continue;
      if (tie.corners[k].is_apart()) {
        // Other ties pull at these two already: their common force is not known here.
        copies[a] = copies[b] = 2;
        continue;
      }
      const double sign = a < b ? 1 : -1;
      const bool is_new = !beginnings.contains(std::minmax(a, b));
      copies[a] += is_new;
      copies[b] += is_new;
      Beginning& beginning = beginnings[std::minmax(a, b)];
      if (is_new) {
        beginning.a = a < b ? on_a : on_b;
        beginning.b = a < b ? on_b : on_a;
      }
      beginning.corners.emplace_back(&tie, k);
      beginning.area += tie.corners[k].area;
      beginning.normal += sign * tie.corners[k].area * tie.normal;
    }
  }
  for (auto& [pair, beginning] : beginnings) {
    const auto [a, b] = pair;
    const double threshold =
        std::min(threshold_at(cells, beginning.a), threshold_at(cells, beginning.b));
    const bool alone = copies[a] == 1 && copies[b] == 1 && !beginning.normal.isZero(0);
    const Vec3 normal = beginning.normal.normalized();
    Vec3 traction = Vec3::Zero();
    if (alone) traction = traction_between(cells, mechanics, beginning);
    for (const auto& [tie, k] : beginning.corners) {
      const double strength = std::max(threshold, effective_traction(traction, normal, tie->shear));
      tie->corners[k].strength = strength;
      tie->corners[k].opening_end = 2 * tie->fracture_energy / strength;
    }
  }
}

}  // namespace sunder
