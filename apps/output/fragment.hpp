// SPDX-License-Identifier: MIT
// The pieces of a simulation: mass, motion, inertia, surface, and which faces cracks have made.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fracture/simulation/simulation.hpp"

namespace sunder {

/// One connected piece.
struct Fragment {
  ComponentId id;
  /// Row of its body in the scene.
  std::int32_t body = 0;
  std::size_t tetrahedra = 0;
  std::size_t vertices = 0;
  /// kg; m^3 at rest.
  double mass = 0;
  double volume = 0;
  /// m^2 at rest: of all its boundary faces, and of those among them that cracks (cuts at the start
  /// too) have made; the difference was the body's own surface.
  double surface = 0;
  double crack_area = 0;
  /// m^2: `crack_area` with the faces of cracks that know their plane (`CrackMode::object`)
  /// projected on it, which is the crack's own area whatever the mesh; others count whole.
  double crack_projected = 0;
  /// What it came off, none() for what was there at the start, and the step in which it did.
  ComponentId parent;
  std::uint64_t birth_step = 0;
  /// Mass centre, m, its velocity, m/s, and the spin of the rigid motion with the same angular
  /// momentum, rad/s; all in the world, from the vertices.
  Vec3 center = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 spin = Vec3::Zero();
  /// Inertia about the mass centre, kg m^2, world: of the solid, and of the masses lumped at its
  /// vertices, which the simulation moves; the latter is larger, less so the finer the mesh.
  Mat3 inertia = Mat3::Zero();
  Mat3 lumped_inertia = Mat3::Zero();
};

/// One piece as it is now. Needs: the id of a piece that is there (`StepReport::new_components`,
/// `Fragment::id`); another throws Misuse. O(its size).
Fragment fragment(const Simulation& simulation, ComponentId id);

/// Every piece in the order of the ids. O(|V| + |T|).
std::vector<Fragment> fragments(const Simulation& simulation);

/// The boundary of one piece as triangles; columns have a row a vertex of the surface.
struct FragmentSurface {
  /// Rows of the simulation's vertices, ascending. They stay what they are while a piece does not
  /// split there.
  std::vector<VertexId> vertex;
  /// m: in the bodies' meshes, deformed in the world, and on the rigid reference that is drawn
  /// (section 3.3 of the paper: what a brittle body looks like), which follows a split smoothly.
  std::vector<Vec3> rest_position, position, drawn_position;
  /// Three rows of this surface each, counterclockwise from outside.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Row = triangle: 1 where a crack (or a cut at the start) has made the face.
  std::vector<char> is_crack;
};

/// The surface of one piece as it is now. Needs: as `fragment`. O(n log n) in its size.
FragmentSurface fragment_surface(const Simulation& simulation, ComponentId id);

}  // namespace sunder
