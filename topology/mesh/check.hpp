// SPDX-License-Identifier: MIT
// What is wrong with a mesh as a file gave it: every finding, and never a crash; its cells counted
// and the shapes of its tetrahedra measured.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/kernel/counts.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// Everything found in a mesh, errors first, then in the order of the table below; never only the
/// first. Safe on any contents: no number is used as a row before its range was checked.
///
/// | code | severity | ids |
/// |---|---|---|
/// | empty_mesh, no_tetrahedron, column_length, too_large | error | - |
/// | index_out_of_range, repeated_vertex | error | tetrahedra |
/// | nan_coordinate (infinite ones too) | error | points |
/// | duplicate_tetrahedron, mirrored_tetrahedron | error | tetrahedra, the later of each pair |
/// | overfull_face: in more than two tetrahedra | error | 3 points, then its tetrahedra |
/// | non_orientable: neighbours that cannot be oriented alike | error | tetrahedra |
/// | flat_tetrahedron: no volume beyond rounding | `bad_volume` | tetrahedra |
/// | folded_tetrahedron: turned inside out against its neighbours | `bad_volume` | tetrahedra |
/// | inverted_tetrahedron: re-oriented on building | warning | tetrahedra |
/// | pinched_vertex, pinched_edge: several orbits | note | points; pairs of points |
/// | unused_point, coincident_points | note | points |
///
/// `bad_volume`: error for those who compute with volumes, warning for those who only need the map.
/// Cost: about 0.5 us a tetrahedron.
std::vector<Finding> check_mesh(const TetMesh& mesh, Severity bad_volume = Severity::error);

/// What the rows of a place number. An edge takes two points, a face three; triangles and
/// tetrahedra are rows of the mesh's own lists.
enum class PlaceKind { points, edges, faces, triangles, tetrahedra };

/// How many rows a place of this kind takes.
constexpr std::size_t rows_of_place(PlaceKind kind) {
  return kind == PlaceKind::edges ? 2 : kind == PlaceKind::faces ? 3 : 1;
}

/// All places of one finding, where a Finding keeps the first few. The faces in which vertices hang
/// are further places of `hanging_vertex`, which its count leaves out.
struct FindingPlaces {
  std::string code;
  PlaceKind kind = PlaceKind::points;
  /// `rows_of_place(kind)` for each place.
  std::vector<std::uint32_t> rows;
};

/// Shapes of tetrahedra. Of several with one value the lowest row is told.
struct Quality {
  struct Extreme {
    double value = 0;
    std::uint32_t tetrahedron = 0;
  };
  /// Angles between two faces, degrees; 70.53 everywhere in a regular tetrahedron.
  Extreme smallest_dihedral, largest_dihedral;
  /// 3 r / R, r and R the radii of the spheres inside and around: 1 for a regular tetrahedron, 0
  /// for a flat one [Liu and Joe 1994].
  Extreme smallest_radius_ratio;
  double mean_radius_ratio = 0;
  /// m^3, without sign.
  Extreme smallest_volume, largest_volume;
  /// m.
  Extreme shortest_edge, longest_edge;
};

/// What is known of a mesh after a check.
struct MeshCheck {
  std::vector<Finding> findings;
  /// In the order in which they were found; empty unless asked for.
  std::vector<FindingPlaces> places;
  /// Orbits, as `count_cells` gives them of the map; none where errors allow no map. `betti` is
  /// none also where volumes are bad: the body may not lie in space.
  std::optional<Counts> counts;
  /// None where no tetrahedron can be measured.
  std::optional<Quality> quality;
};

/// Relative size of a gap that a check takes for none: see `hanging_vertex` and `close_points`.
inline constexpr double contact_tolerance = 1e-6;

/// Checks all that a file holds, from adjacency alone: the findings of `check_mesh` with bad
/// volumes as errors, and, in the order of severity,
///
/// | code | severity | ids |
/// |---|---|---|
/// | hanging_vertex: inside a boundary face or edge that does not have it | warning | points |
/// | close_points: boundary points that miss each other by a rounding | warning | points |
/// | overlapping_faces: boundary faces that go through others | warning | 3 points each |
/// | stray_triangle: a face of no tetrahedron | warning | triangles |
/// | contact_unfinished: not held against all faces | warning | points |
/// | overlap_unfinished: faces not held against all others | warning | 3 points each |
/// | nonmanifold_vertex: in one piece, but the surface touches itself there | note | points |
/// | coincident_faces: boundary faces in one place with different points | note | 3 points each |
/// | interface_triangle: a face of two tetrahedra | note | triangles |
///
/// A vertex hangs when it is nearer to an edge than `contact_tolerance` times that edge, or to a
/// face than that times its longest edge, and is not near a corner; points are close nearer than
/// that times the shortest edge of a face at one of them. Either distance is never taken smaller
/// than 8 roundings of the largest coordinate. Faces go through each other where an edge of one
/// passes the inside of the other, its ends and that face's edges being farther away than
/// `contact_tolerance` times the longest edge of both. `keeps_places`: whether `places` is wanted.
/// Cost: O(n log n) whatever the mesh, about 1 us a tetrahedron.
MeshCheck check_file_mesh(const FileMesh& mesh, bool keeps_places = false);

}  // namespace sunder
