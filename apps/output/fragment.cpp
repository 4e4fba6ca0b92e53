// SPDX-License-Identifier: MIT
// Measures pieces on the state of a simulation.
#include "apps/output/fragment.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder {
namespace {

/// Sum of m r r^T over a solid tetrahedron with corners `r`.
Mat3 second_moment(const std::array<Vec3, 4>& r, double mass) {
  Vec3 sum = Vec3::Zero();
  Mat3 squares = Mat3::Zero();
  for (const Vec3& corner : r) {
    sum += corner;
    squares += corner * corner.transpose();
  }
  return mass / 20 * (squares + sum * sum.transpose());
}

Mat3 inertia_of(const Mat3& moment) { return moment.trace() * Mat3::Identity() - moment; }

/// Lumped inertia, and the rigid spin with the angular momentum of the vertices about the centre.
void add_spin(Fragment& f, const Component& component, const VertexColumns& v) {
  Vec3 L = Vec3::Zero();
  Mat3 moment = Mat3::Zero();
  for (const VertexId i : component.vertices) {
    const Vec3 r = v.position[i.index()] - f.center;
    L += v.mass[i.index()] * r.cross(v.velocity[i.index()] - f.velocity);
    moment += v.mass[i.index()] * r * r.transpose();
  }
  f.lumped_inertia = inertia_of(moment);
  f.spin = solve3(f.lumped_inertia, L);
}

/// The area of a face as it counts for its crack: projected along the mean normal of the crack's
/// anchors around it, or whole where there are none. `area`: its area vector.
double area_of_crack(const Cells& cells, HalfFaceId face, const Vec3& area) {
  if (cells.cracks.of_face.empty()) return area.norm();
  const CrackId crack = cells.cracks.of_face[face.index()];
  if (crack.is_none()) return area.norm();
  const TetId t = tetrahedron_of(face);
  Vec3 centre = Vec3::Zero();
  for (const VertexId v : corners_of_face(cells.map.corners(t), face)) {
    centre += Vec3(cells.map.point(v).data()) / 3;
  }
  const std::vector<ComponentId>& component = cells.labels.of_vertex;
  const ComponentId own = component[cells.map.corners(t)[0].index()];
  const double edge = std::sqrt(2 * area.norm());
  const Vec3 normal = anchors_near(cells.cracks, crack, centre, edge, component, own).normal;
  return normal.isZero(0) ? area.norm() : projected_area(area, normal.normalized());
}

/// Adds the boundary faces of one tetrahedron.
void add_surface(Fragment& f, const Cells& cells, TetId t) {
  for (int place = 0; place < 4; ++place) {
    const HalfFaceId face = half_face(t, place);
    if (!cells.map.neighbour(face).is_none()) continue;
    const Vec3 area = rest_area_vector(cells.map, face);
    f.surface += area.norm();
    if (!is_crack_face(cells, face)) continue;
    f.crack_area += area.norm();
    f.crack_projected += area_of_crack(cells, face, area);
  }
}

const Component& component_of(const Simulation& sim, ComponentId id) {
  const std::vector<Component>& all = sim.state->mechanics.components;
  require(id.index() < all.size() && !all[id.index()].tetrahedra.empty(),
          "fragment: there is no piece of this id");
  return all[id.index()];
}

}  // namespace

Fragment fragment(const Simulation& simulation, ComponentId id) {
  const Component& component = component_of(simulation, id);
  const Cells& cells = simulation.state->cells;
  const MechanicsState& mechanics = simulation.state->mechanics;
  const VertexColumns& v = mechanics.vertices;
  Fragment f;
  f.id = id;
  f.body = static_cast<std::int32_t>(body_of(simulation, component.tetrahedra.front()));
  f.parent = cells.labels.parent[id.index()];
  const std::vector<std::uint64_t>& birth = simulation.state->birth_step;
  if (id.index() < birth.size()) f.birth_step = birth[id.index()];
  f.tetrahedra = component.tetrahedra.size();
  f.vertices = static_cast<std::size_t>(
      std::ranges::count_if(component.vertices, [&](VertexId i) { return !cells.map.is_node(i); }));
  for (const VertexId i : component.vertices) {
    f.mass += v.mass[i.index()];
    f.center += v.mass[i.index()] * v.position[i.index()];
    f.velocity += v.mass[i.index()] * v.velocity[i.index()];
  }
  f.center /= f.mass;
  f.velocity /= f.mass;
  add_spin(f, component, v);
  Mat3 moment = Mat3::Zero();
  for (const TetId t : component.tetrahedra) {
    f.volume += mechanics.elements.rest_volume[t.index()];
    add_surface(f, cells, t);
    std::array<Vec3, 4> r;
    for (std::size_t a = 0; a < 4; ++a) {
      r[a] = v.position[cells.map.corners(t)[a].index()] - f.center;
    }
    moment += second_moment(r, mechanics.elements.mass[t.index()]);
  }
  f.inertia = inertia_of(moment);
  return f;
}

std::vector<Fragment> fragments(const Simulation& simulation) {
  std::vector<Fragment> all;
  for (const Component& component : simulation.state->mechanics.components) {
    if (!component.tetrahedra.empty()) all.push_back(fragment(simulation, component.id));
  }
  return all;
}

FragmentSurface fragment_surface(const Simulation& simulation, ComponentId id) {
  const Component& component = component_of(simulation, id);
  const SimulationState& s = *simulation.state;
  std::vector<std::array<VertexId, 3>> faces;
  FragmentSurface surface;
  for (const TetId t : component.tetrahedra) {
    for (int place = 0; place < 4; ++place) {
      const HalfFaceId face = half_face(t, place);
      if (!s.cells.map.neighbour(face).is_none()) continue;
      faces.push_back(corners_of_face(s.cells.map.corners(t), face));
      surface.vertex.insert(surface.vertex.end(), faces.back().begin(), faces.back().end());
      surface.is_crack.push_back(is_crack_face(s.cells, face) ? 1 : 0);
    }
  }
  sort_unique(surface.vertex);
  for (const std::array<VertexId, 3>& face : faces) {
    auto& triangle = surface.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[i] = static_cast<std::uint32_t>(std::ranges::lower_bound(surface.vertex, face[i]) -
                                               surface.vertex.begin());
    }
  }
  const Pose& drawn = s.display[id.index()];
  for (const VertexId v : surface.vertex) {
    const Vec3& rest = s.mechanics.vertices.rest_position[v.index()];
    surface.rest_position.push_back(rest);
    surface.position.push_back(s.mechanics.vertices.position[v.index()]);
    surface.drawn_position.push_back(drawn.orientation * (rest - component.rest_centre) +
                                     drawn.centre);
  }
  return surface;
}

}  // namespace sunder
