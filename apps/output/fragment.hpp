// SPDX-License-Identifier: MIT
// The pieces of a simulation: mass, motion, inertia, surface, crack faces.
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
  /// Mass, kg; volume at rest, m^3.
  double mass = 0;
  double volume = 0;
  /// Areas at rest, m^2: of all boundary faces, and of those from cracks and initial cuts. The
  /// difference was the body's own surface.
  double surface = 0;
  double crack_area = 0;
  /// `crack_area` with faces projected on the plane of their crack (`CrackMode::object`), m^2: the
  /// crack's own area, independent of the mesh. Faces of cracks without a plane count whole.
  double crack_projected = 0;
  /// The piece that it came off, none() for a piece of the start; and the step of that separation.
  ComponentId parent;
  std::uint64_t birth_step = 0;
  /// Mass centre, m, its velocity, m/s, and the spin of the rigid motion with the same angular
  /// momentum, rad/s; all in the world, from the vertices.
  Vec3 center = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 spin = Vec3::Zero();
  /// Inertia about the mass centre, kg m^2, world: of the solid, and of the masses lumped at its
  /// vertices, which the simulation moves. The latter is larger, and approaches the former on finer
  /// meshes.
  Mat3 inertia = Mat3::Zero();
  Mat3 lumped_inertia = Mat3::Zero();
};

/// The present state of one piece. Requires: the id of an existing piece
/// (`StepReport::new_components`, `Fragment::id`); any other throws Misuse. O(size of the piece).
Fragment fragment(const Simulation& simulation, ComponentId id);

/// All pieces in the order of their ids. O(|V| + |T|).
std::vector<Fragment> fragments(const Simulation& simulation);

/// The boundary of one piece as triangles; columns have one row per vertex of the surface.
struct FragmentSurface {
  /// Rows of the simulation's vertices, ascending. They stay the same until the piece splits there.
  std::vector<VertexId> vertex;
  /// Positions, m: in the bodies' meshes, deformed in the world, and on the drawn rigid reference
  /// (section 3.3 of the paper), which follows a split smoothly.
  std::vector<Vec3> rest_position, position, drawn_position;
  /// Triangles by three rows of this surface, counterclockwise from outside.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// One entry per triangle: 1 for a face from a crack or an initial cut.
  std::vector<char> is_crack;
};

/// The present surface of one piece. Requires: the id of an existing piece, as for `fragment`. O(n
/// log n) in its size.
FragmentSurface fragment_surface(const Simulation& simulation, ComponentId id);

}  // namespace sunder
