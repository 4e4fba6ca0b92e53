// SPDX-License-Identifier: MIT
// Faces to ties, and the tractions that corners begin with.
#include "fracture/ties/insert_ties.hpp"

#include <algorithm>
#include <map>

#include "fracture/breaking/partners.hpp"
#include "mechanics/ties/tie_law.hpp"
#include "mechanics/state/wave_travel.hpp"

namespace sunder {
namespace {

Tie tie_of(const Cells& cells, const MechanicsState& mechanics, const FanEvent& fan,
           const FaceSplit& split) {
  const Partner sides = partner_of(cells.map, split.face, split.opposite);
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

std::array<VertexId, 2> vertices_of(const Cells& cells, const Tie& tie, std::size_t k) {
  return {cells.map.corners(tetrahedron_of(tie.face))[tie.corner[k]],
          cells.map.corners(tetrahedron_of(tie.opposite))[tie.opposite_corner[k]]};
}

/// N, body frame: what the tetrahedra around a vertex do to it.
Vec3 elastic_force(const Cells& cells, const MechanicsState& mechanics, VertexId v) {
  Vec3 force = Vec3::Zero();
  for (const TetId t : star(cells.map, v)) {
    const int place = place_of_vertex(cells.map.corners(t), v);
    force -= mechanics.elements.rest_volume[t.index()] * mechanics.elements.stress[t.index()] *
             mechanics.elements.shape_gradient[t.index()].col(place);
  }
  return force;
}

/// Corners of two vertices, which begin together.
struct Beginning {
  std::vector<std::pair<Tie*, std::size_t>> corners;
  double area = 0;
  Vec3 normal = Vec3::Zero();  ///< times area, from b to a
};

/// Pa: traction between a and b, along the normal where it pulls them together, that keeps both at
/// the acceleration they have together.
Vec3 traction_between(const Cells& cells, const MechanicsState& mechanics, VertexId a, VertexId b,
                        const Beginning& beginning) {
  const double mass_a = mechanics.vertices.mass[a.index()];
  const double mass_b = mechanics.vertices.mass[b.index()];
  const Vec3 on_a = (mass_a * elastic_force(cells, mechanics, b) -
                     mass_b * elastic_force(cells, mechanics, a)) /
                    (mass_a + mass_b);
  // What pulls a back towards b is tension.
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
      auto [a, b] = vertices_of(cells, tie, k);
      if (a == b) continue;
      if (tie.corners[k].is_apart()) {
        // Other ties pull at these two already: what they bear together is not known here.
        copies[a] = copies[b] = 2;
        continue;
      }
      const double sign = a < b ? 1 : -1;
      const bool is_new = !beginnings.contains(std::minmax(a, b));
      copies[a] += is_new;
      copies[b] += is_new;
      Beginning& beginning = beginnings[std::minmax(a, b)];
      beginning.corners.emplace_back(&tie, k);
      beginning.area += tie.corners[k].area;
      beginning.normal += sign * tie.corners[k].area * tie.normal;
    }
  }
  for (auto& [pair, beginning] : beginnings) {
    const auto [a, b] = pair;
    const double threshold = std::min(cells.strength[a.index()], cells.strength[b.index()]);
    const bool alone = copies[a] == 1 && copies[b] == 1 && !beginning.normal.isZero(0);
    const Vec3 normal = beginning.normal.normalized();
    Vec3 traction = Vec3::Zero();
    if (alone) traction = traction_between(cells, mechanics, a, b, beginning);
    for (const auto& [tie, k] : beginning.corners) {
      const double strength =
          std::max(threshold, effective_traction(traction, normal, tie->shear));
      tie->corners[k].strength = strength;
      tie->corners[k].opening_end = 2 * tie->fracture_energy / strength;
    }
  }
}

}  // namespace sunder
