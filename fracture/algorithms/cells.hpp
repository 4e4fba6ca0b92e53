// SPDX-License-Identifier: MIT
// The cells of all bodies and their data for breaking: map, components, skin, strength.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "fracture/cracks/crack_labels.hpp"
#include "mechanics/state/mechanics_state.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// A vertex over its threshold with every tetrahedron on one side of every plane its stress allows.
struct EmptyFan {
  VertexId vertex;
  /// Its stress when that was found, divided by its norm.
  Mat3 stress_direction;
};

/// Pieces connected by faces or by ties (`CrackMode::cohesive`): the same tetrahedra as in
/// `Cells::map`, sewn wherever they are sewn there or tied. Its components are the pieces. A face
/// that is sewn in the map is sewn here to the same face; a vertex there lies in one vertex here.
struct Pieces {
  DenseMap map;
  Components labels;  ///< `of_vertex`: by the rows of this map
};

/// The topological half of a simulation's state.
struct Cells {
  VolumeMap map;
  Components labels;  ///< components are the pieces, where there are `pieces`
  /// 4 |T|, by half-face: 1 where the face was on the surface before anything broke. A boundary
  /// half-face that is not skin is a crack face.
  std::vector<char> skin;
  /// |V|, Pa: the tensile threshold xi of each vertex (see `vertex_strength`).
  std::vector<double> strength;
  /// |V|, Pa: painted on the mesh; 0 where the materials around decide.
  std::vector<double> painted;
  /// |V|: factor on the material's or painted strength (Weibull); copies keep it.
  std::vector<double> flaw;
  /// |V|: 1 where the vertex never splits: no face that touches it is ever unsewn in a fan.
  std::vector<char> unbreakable;
  /// |V|: 1 while a vertex waits for a fan that the budget of a step did not allow.
  std::vector<char> waits;
  /// Those that wait until their stress changes, each vertex once.
  std::vector<EmptyFan> empty_fans;
  /// But for `CrackMode::paper`.
  CrackLabels cracks;
  /// With `CrackMode::cohesive`.
  std::optional<Pieces> pieces = {};
};

/// The bodies of a simulation as breaking changes them: their cells, and the columns of mechanics
/// that belong to the same rows.
struct BreakableBody {
  Cells& cells;
  MechanicsState& mechanics;
};

/// Which half-faces lie on the boundary, 4 |T|.
std::vector<char> boundary_of(const VolumeMap& map);

/// The cells of a body that has not broken yet, all of the strength of their materials.
/// `mechanics`: made from the same rows. `skin`: `boundary_of` the map before it was cut; empty:
/// nothing was cut.
Cells make_cells(VolumeMap map, const MechanicsState& mechanics, std::vector<char> skin = {});

/// Appends the columns of a copy of vertex `from`, its component label among them: it inherits
/// everything.
void append_copy(Cells& cells, VertexId from);

/// Appends the columns of a node that is no vertex: it never breaks.
void append_node(Cells& cells, ComponentId component);

/// Gives the edges of a body's tetrahedra first to end - 1 nodes in their middles, with all
/// columns. Requires that they have none and that no later body has any. Corner stresses are left
/// to the caller.
void raise_order(BreakableBody body, TetId first, TetId end);

/// C of the threshold at a crack tip, C K_Ic / sqrt(h): with it an edge crack breaks within 5 per
/// cent of the closed form at any size of elements from an eighth of its length down, of second
/// order a penny crack of at least two elements too (docs/lab/energy.md). `order`: of the
/// tetrahedra round the tip.
constexpr double crack_tip_factor(int order) { return order == 2 ? 1.03 : 0.54; }

/// Threshold xi of one vertex, Pa: the smallest tensile strength around it or that painted on it,
/// times its flaw; infinite where it is unbreakable. Where its material has a
/// toughness K_Ic, given or sqrt(E G_c / (1 - nu^2)) (`toughness_of`), and the vertex is a crack
/// tip (a cracked face lies in its star), C K_Ic / sqrt(h)
/// (`crack_tip_factor`) alone, h the mean edge length of its star, because the stress there grows
/// like 1 / sqrt(h) and a bare strength would depend on the mesh (docs/explanation/theory.md). With
/// `CrackMode::cohesive` the smaller of the two. `star`: every tetrahedron around `vertex`.
/// Infinite for a material that never breaks.
double vertex_strength(const Cells& cells, const MechanicsState& mechanics, VertexId vertex,
                       std::span<const TetId> star);

/// Mean length of the edges of a star's tetrahedra at rest, each tetrahedron's six counted, m.
double mean_edge_length(const VertexColumns& vertices, std::span<const Corners> corners,
                        std::span<const TetId> star);
double mean_edge_length(const VertexColumns& vertices, std::span<const Corners> corners,
                        const VertexStar& star);

/// Area vector of a half-face at rest, m^2, out of its tetrahedron.
Vec3 rest_area_vector(const VolumeMap& map, HalfFaceId face);

/// A |n . n_f|, m^2: the share of a face in the area of its crack. Faces zigzag about the crack's
/// plane (see `CrackEnergy`). `area`: of the face, A n_f; `normal`: n of the plane, of length 1.
inline double projected_area(const Vec3& area, const Vec3& normal) {
  return std::abs(area.dot(normal));
}

/// The fan of a star's signs (`plane_signs`): `fan_faces`, but for those that touch an unbreakable
/// vertex. A vertex splits by faces at it alone, so an unbreakable one never does.
std::vector<HalfFaceId> breakable_fan(const Cells& cells, const VertexStar& v,
                                      std::span<const char> positive);

/// Whether a half-face lies on the boundary because of a crack.
inline bool is_crack_face(const Cells& cells, HalfFaceId face) {
  return cells.map.neighbour(face).is_none() && !cells.skin[face.index()];
}

}  // namespace sunder
