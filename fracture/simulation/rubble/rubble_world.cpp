// SPDX-License-Identifier: MIT
#include "fracture/simulation/rubble/rubble_world.hpp"

#include <algorithm>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/integrators/rigid_motion.hpp"
#include "mechanics/rubble/convex_solid.hpp"

namespace sunder {
namespace {

/// Keys of shapes: tetrahedra by their rows, obstacles behind all of them.
constexpr std::uint64_t first_obstacle_key = std::uint64_t{1} << 40;

/// Whether both sides of a face that came apart are in one piece, and as near as when they parted.
bool is_shut(const SimulationState& s, const Partner& p) {
  const TetId a = tetrahedron_of(p.face), b = tetrahedron_of(p.opposite);
  const auto& component = s.mechanics.elements.component;
  if (component[a.index()] != component[b.index()]) return false;
  const auto& corners = s.cells.map.corners();
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId v = corners[a.index()][p.corner[k]];
    const VertexId w = corners[b.index()][p.opposite_corner[k]];
    const Vec3 apart =
        s.mechanics.vertices.position[v.index()] - s.mechanics.vertices.position[w.index()];
    if (apart.norm() >= p.reach) return false;
  }
  return true;
}

/// Bits of the faces of each tetrahedron that something may meet: those on the boundary but for
/// cracks that part nothing and are shut.
std::vector<std::uint8_t> outer_faces(const SimulationState& s) {
  const auto& neighbours = s.cells.map.neighbours();
  std::vector<std::uint8_t> bits(neighbours.size(), 0);
  for (std::size_t t = 0; t < bits.size(); ++t) {
    for (std::size_t place = 0; place < 4; ++place) {
      if (neighbours[t][place].is_none()) bits[t] |= static_cast<std::uint8_t>(1u << place);
    }
  }
  for (const Partner& p : s.contact.partners) {
    if (!is_shut(s, p)) continue;
    for (const HalfFaceId f : {p.face, p.opposite}) {
      bits[tetrahedron_of(f).index()] &= static_cast<std::uint8_t>(~(1u << place_of(f)));
    }
  }
  return bits;
}

RubbleBody body_of_component(const SimulationState& s, const Component& c, double friction) {
  RubbleBody body;
  body.mass = c.mass;
  body.inertia = deformed_inertia(s.mechanics.vertices, c);
  body.centre = c.centre;
  body.orientation = c.orientation;
  body.momentum = c.momentum;
  body.angular_momentum = c.angular_momentum;
  body.friction = friction;
  body.radius = c.rest_radius;
  body.asleep = c.rung == Rung::asleep;
  body.still = c.id.index() < s.ladder.still.size() ? s.ladder.still[c.id.index()] : 0;
  return body;
}

/// The corner of a cell in the axes of its component, m.
Vec3 own_place(const SimulationState& s, const Component& c, VertexId v) {
  const VertexColumns& vertices = s.mechanics.vertices;
  return vertices.rest_position[v.index()] - c.rest_centre + vertices.displacement[v.index()];
}

/// Triangles of the outside of a component, in its axes.
std::vector<std::array<Vec3, 3>> outside_of(const SimulationState& s, const Component& c) {
  std::vector<std::array<Vec3, 3>> triangles;
  for (const TetId t : c.tetrahedra) {
    const auto& neighbours = s.cells.map.neighbours()[t.index()];
    const Corners& corners = s.cells.map.corners()[t.index()];
    for (std::size_t place = 0; place < 4; ++place) {
      if (!neighbours[place].is_none()) continue;
      const auto v = corners_of_face(corners, half_face(t, place));
      triangles.push_back({own_place(s, c, v[0]), own_place(s, c, v[1]), own_place(s, c, v[2])});
    }
  }
  return triangles;
}

/// Pieces of several tetrahedra that have parted from no other piece and are one convex solid, such
/// as bricks: their rows among the solids, row = ComponentId. Differences below a tenth of the slop
/// are ignored.
std::vector<std::uint32_t> add_convex_pieces(RubbleWorld& world, const Simulation& sim) {
  const SimulationState& s = *sim.state;
  std::vector<std::uint32_t> rows(s.mechanics.components.size(), RubbleWorld::no_row);
  std::vector<char> parted(rows.size(), 0);
  for (const Partner& p : s.contact.partners) {
    for (const HalfFaceId f : {p.face, p.opposite}) {
      parted[s.mechanics.elements.component[tetrahedron_of(f).index()].index()] = 1;
    }
  }
  for (const Component& c : s.mechanics.components) {
    const std::size_t k = c.id.index();
    if (world.of_component[k] == RubbleWorld::no_row || parted[k] || c.tetrahedra.size() < 2)
      continue;
    const std::optional<ConvexSolid> solid =
        find_convex_solid(outside_of(s, c), 0.1 * sim.scene.contact.allowed_penetration);
    if (!solid) continue;
    rows[k] = static_cast<std::uint32_t>(world.solids.size());
    world.solids.push_back(*solid);
  }
  return rows;
}

void add_components(RubbleWorld& world, const Simulation& sim, const std::vector<char>& members) {
  const SimulationState& s = *sim.state;
  world.of_component.assign(s.mechanics.components.size(), RubbleWorld::no_row);
  for (const Component& c : s.mechanics.components) {
    if (!members[c.id.index()]) continue;
    world.of_component[c.id.index()] = static_cast<std::uint32_t>(world.bodies.size());
    world.bodies.push_back(body_of_component(s, c, sim.scene.contact.friction));
  }
  const std::vector<std::uint8_t> outer = outer_faces(s);
  const std::vector<std::uint32_t> solid_of = add_convex_pieces(world, sim);
  // By rows of tetrahedra, so that keys ascend.
  for (std::size_t t = 0; t < s.mechanics.elements.size(); ++t) {
    const ComponentId id = s.mechanics.elements.component[t];
    const std::uint32_t body = world.of_component[id.index()];
    if (body == RubbleWorld::no_row) continue;
    const Component& c = s.mechanics.components[id.index()];
    const bool is_one = solid_of[id.index()] != RubbleWorld::no_row;
    if (is_one && t != c.tetrahedra.front().index()) continue;
    if (!is_one && outer[t] == 0) continue;
    RubbleShape& shape = world.shapes.emplace_back();
    shape.body = body;
    shape.key = t;
    if (is_one) {
      shape.kind = RubbleShape::Kind::solid;
      shape.solid = &world.solids[solid_of[id.index()]];
      continue;
    }
    shape.outer_faces = outer[t];
    const Corners& corners = s.cells.map.corners()[t];
    for (std::size_t k = 0; k < 4; ++k) shape.corner[k] = own_place(s, c, corners[k]);
  }
}

/// Faces that came apart, between bodies. Needs: shapes of all components.
void add_partners(RubbleWorld& world, const SimulationState& s) {
  const auto row_of = [&](HalfFaceId face) {
    const std::uint64_t key = tetrahedron_of(face).index();
    const auto at = std::ranges::lower_bound(world.shapes, key, {}, &RubbleShape::key);
    return at != world.shapes.end() && at->key == key
               ? static_cast<std::uint32_t>(at - world.shapes.begin())
               : RubbleWorld::no_row;
  };
  for (const Partner& p : s.contact.partners) {
    RubblePartner partner{row_of(p.face), row_of(p.opposite), p.corner, p.opposite_corner, {},
                          p.reach};
    if (partner.shape_a == RubbleWorld::no_row || partner.shape_b == RubbleWorld::no_row) continue;
    if (world.shapes[partner.shape_a].body == world.shapes[partner.shape_b].body) continue;
    const Corners& corners = s.cells.map.corners()[tetrahedron_of(p.face).index()];
    for (std::size_t k = 0; k < 3; ++k) {
      partner.point[k] = s.cells.map.point_of_vertex(corners[p.corner[k]]);
    }
    world.partners.push_back(partner);
  }
}

void add_obstacles(RubbleWorld& world, const SimulationState& s, const std::vector<char>& balls) {
  world.of_obstacle.assign(s.obstacles.size(), RubbleWorld::no_row);
  for (std::size_t k = 0; k < s.obstacles.size(); ++k) {
    const Obstacle& o = s.obstacles[k];
    if ((o.mass && !balls[k]) || !has_rubble_shape(o)) continue;
    RubbleBody body;
    body.friction = o.friction;
    body.in_ledger = false;
    RubbleShape shape;
    shape.body = static_cast<std::uint32_t>(world.bodies.size());
    shape.key = first_obstacle_key + k;
    if (const auto* plane = std::get_if<Plane>(&o.shape)) {
      shape.kind = RubbleShape::Kind::half_space;
      shape.normal = plane->normal;
      body.centre = plane->offset * plane->normal;
    } else if (const auto* ball = std::get_if<Sphere>(&o.shape)) {
      shape.kind = RubbleShape::Kind::ball;
      shape.radius = body.radius = ball->radius;
      body.centre = ball->center;
    } else {
      const Box& box = std::get<Box>(o.shape);
      shape.kind = RubbleShape::Kind::box;
      shape.half_extent = box.half_extent;
      body.centre = box.center;
      body.orientation = box.orientation;
      body.radius = box.half_extent.norm();
    }
    if (o.mass) {
      body.mass = *o.mass;
      body.inertia = own_inertia(o);
      body.momentum = *o.mass * o.velocity;
      body.angular_momentum = angular_momentum_of(o);
    } else {
      body.velocity = o.velocity;
    }
    world.of_obstacle[k] = shape.body;
    world.bodies.push_back(body);
    world.shapes.push_back(shape);
  }
}

}  // namespace

bool has_rubble_shape(const Obstacle& obstacle) {
  const Shape& shape = obstacle.shape;
  return std::holds_alternative<Plane>(shape) || std::holds_alternative<Sphere>(shape) ||
         std::holds_alternative<Box>(shape);
}

RubbleWorld make_rubble_world(const Simulation& sim, const std::vector<char>& component,
                              const std::vector<char>& ball) {
  RubbleWorld world;
  add_components(world, sim, component);
  add_partners(world, *sim.state);
  add_obstacles(world, *sim.state, ball);
  return world;
}

}  // namespace sunder
