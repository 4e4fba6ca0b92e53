// SPDX-License-Identifier: MIT
// Faults of a mesh as a file holds it: every finding, and never a crash; its cells counted
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

/// Checks a mesh and returns all findings, errors first, then in the order of the table. Safe on
/// any contents: every number is checked before it is used as a row.
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
/// `bad_volume`: error for computations with volumes, warning if only the map is needed. Cost:
/// about 0.5 µs per tetrahedron.
std::vector<Finding> check_mesh(const TetMesh& mesh, Severity bad_volume = Severity::error);

/// Meaning of the rows of a place. An edge takes two points, a face three. Triangles and tetrahedra
/// are rows of the mesh's own lists.
enum class PlaceKind { points, edges, faces, triangles, tetrahedra };

/// Number of rows of a place of this kind.
constexpr std::size_t rows_of_place(PlaceKind kind) {
  return kind == PlaceKind::edges ? 2 : kind == PlaceKind::faces ? 3 : 1;
}

/// All places of one finding; `Finding::ids` holds only the first. The list for `hanging_vertex`
/// also has the faces with the hanging vertices, which `Finding::count` leaves out.
struct FindingPlaces {
  std::string code;
  PlaceKind kind = PlaceKind::points;
  /// `rows_of_place(kind)` for each place.
  std::vector<std::uint32_t> rows;
};

/// Shapes of tetrahedra. Among equal values the lowest row is given.
struct Quality {
  struct Extreme {
    double value = 0;
    std::uint32_t tetrahedron = 0;
  };
  /// Angles between two faces, degrees; 70.53 everywhere in a regular tetrahedron.
  Extreme smallest_dihedral, largest_dihedral;
  /// 3 r / R with the radii r and R of the inscribed and circumscribed spheres: 1 for a regular
  /// tetrahedron, 0 for a flat one [Liu and Joe 1994].
  Extreme smallest_radius_ratio;
  double mean_radius_ratio = 0;
  /// m^3, without sign.
  Extreme smallest_volume, largest_volume;
  /// m.
  Extreme shortest_edge, longest_edge;
};

/// Result of a check of a mesh.
struct MeshCheck {
  std::vector<Finding> findings;
  /// In the order of discovery; empty without `keeps_places`.
  std::vector<FindingPlaces> places;
  /// Result of `count_cells` for the map; absent if errors prevent a map. `betti` is also absent if
  /// volumes are bad, because the body may then not lie in space.
  std::optional<Counts> counts;
  /// Absent if no tetrahedron can be measured.
  std::optional<Quality> quality;
};

/// Relative size of a gap that a check ignores: see `hanging_vertex` and `close_points`.
inline constexpr double contact_tolerance = 1e-6;

/// Checks the whole content of a file. The result has the findings of `check_mesh` with bad volumes
/// as errors, and in the order of severity:
///
/// | code | severity | ids |
/// |---|---|---|
/// | hanging_vertex: inside a boundary face or edge that does not have it | warning | points |
/// | close_points: boundary points that miss each other by a rounding | warning | points |
/// | overlapping_faces: boundary faces that go through others | warning | 3 points each |
/// | stray_triangle: a face of no tetrahedron | warning | triangles |
/// | contact_unfinished: not compared with all faces | warning | points |
/// | overlap_unfinished: faces not compared with all others | warning | 3 points each |
/// | nonmanifold_vertex: in one piece, but the surface touches itself there | note | points |
/// | coincident_faces: boundary faces in one place with different points | note | 3 points each |
/// | interface_triangle: a face of two tetrahedra | note | triangles |
///
/// A vertex hangs if it is away from all corners, and its distance to an edge or face is below
/// `contact_tolerance` times the longest edge there. Points are close if their distance is below
/// that factor times the shortest edge of a face at one of them. Neither limit is below 8 roundings
/// of the largest coordinate. Faces intersect if an edge of one crosses the inside of the other,
/// and the edge's ends and the face's edges are farther away than `contact_tolerance` times the
/// longest edge of both. `keeps_places`: fills `places`. Cost: O(n log n) for every mesh, about 1
/// µs per tetrahedron.
MeshCheck check_file_mesh(const FileMesh& mesh, bool keeps_places = false);

}  // namespace sunder
