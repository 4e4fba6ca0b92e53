// SPDX-License-Identifier: MIT
// A scene without time: the equilibrium of its bodies, and their natural frequencies.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fracture/simulation/simulation.hpp"

namespace sunder {

/// A largest value and where it is.
struct Extreme {
  double value = 0;
  /// Row of the body's mesh points.
  std::size_t point = 0;
  /// m, world, of the undeformed body where the scene places it.
  Vec3 position = Vec3::Zero();
};

/// What one box of held vertices carries.
struct SupportReaction {
  std::size_t vertices = 0;
  Vec3 force = Vec3::Zero();   ///< N, world, of the support on the body
  Vec3 moment = Vec3::Zero();  ///< N m, world, about the body's mass centre
};

/// Equilibrium of one body.
struct BodyEquilibrium {
  std::string name;
  std::size_t vertices = 0, nodes = 0, tetrahedra = 0;  ///< nodes: with those of edges
  double mass = 0;           ///< kg
  Extreme displacement;      ///< m, size, against the place in the scene
  double strain_energy = 0;  ///< J
  Extreme principal_stress;  ///< Pa, largest eigenvalue of a node stress (eq. 6)
  Extreme strength_share;    ///< the same over the vertex's tensile strength; from 1 on it breaks
  Vec3 load = Vec3::Zero();  ///< N, world: gravity, pressure and forces, those at supports too
  std::vector<SupportReaction> supports;  ///< as the scene's `held`
  /// N: largest force that is missing at a free node. Rounding.
  double residual = 0;
};

/// Equilibrium of all bodies of a scene.
struct Equilibrium {
  std::vector<BodyEquilibrium> bodies;  ///< row = body of the scene
  /// Row = vertex of the simulation, Pa, in the axes of the bodies' meshes, averaged as the scene
  /// says (`FractureSettings::node_stress`); of second order the average of what the tetrahedra have
  /// at that place. Then the nodes of edges.
  std::vector<Mat3> node_stress;
};

/// A simulation for what stands below: `build_simulation`, but for what only a body of order 2 that
/// moves cannot do (`second_order_findings`).
Result<Simulation> build_statics(Scene scene);

/// Puts the bodies of `simulation`, which stands at its start, where a slow run of the scene would
/// leave them at its end: gravity and loads fully raised, held vertices displaced by velocity times
/// duration. Obstacles have no part in it. Notes tell of starting velocities, which have none
/// either, and a warning of parts that turn too far for the linear model. Nothing breaks.
/// Errors: "not_supported" with the body's name; "not_a_number". Cost: one factor and one solve.
Result<Equilibrium> solve_scene(Simulation& simulation);

/// The lowest natural modes of one piece, its held vertices at rest.
struct PieceModes {
  ComponentId component;
  std::size_t body = 0;  ///< row of its body in the scene
  /// How many of the modes are rigid motions (6 of a free piece, fewer with one or two held
  /// vertices or held ones on a line, 0 of a held one). They come first and have frequency 0.
  std::size_t rigid = 0;
  std::vector<double> frequency;  ///< Hz, ascending
  std::vector<VertexId> vertex;   ///< rows of the piece's vertices, ascending
  /// shape[k][i]: displacement of vertex[i] in mode k in the axes of the body's mesh, scaled so
  /// that the sum of m |shape|^2 over the vertices is 1 kg m^2; the entry of largest size is
  /// positive.
  std::vector<std::vector<Vec3>> shape;
};

/// The rigid modes and the `count` lowest others of every piece of `simulation`, which stands at
/// its start; without gravity, loads and obstacles. Errors: "modes_not_found". Cost: two factors
/// and some 3 `count` solves a piece (docs/explanation/theory.md).
Result<std::vector<PieceModes>> scene_modes(Simulation& simulation, std::size_t count);

}  // namespace sunder
