// SPDX-License-Identifier: MIT
// Cracks in a mesh file: points are duplicated exactly where cut faces part the cells around them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// The number of a region that tetrahedra are in: its name's, or the word itself.
/// Errors: unknown_region, which lists those there are.
Result<std::int32_t> region_called(const FileMesh& mesh, std::string_view word);

/// Neighbours across the faces of each tetrahedron. Face p is opposite to corner p.
struct FaceLinks {
  static constexpr std::uint32_t none = 0xffffffffU;
  /// 4 t + p of the face on the other side, or none.
  std::vector<std::array<std::uint32_t, 4>> across;
};

/// Pairs up the faces of the mesh's tetrahedra. Errors: overfull_face, for a face of more than two;
/// too_many_tetrahedra (2^30). O(n log n).
Result<FaceLinks> face_links(const FileMesh& mesh);

/// The error of `face_links` for as many tetrahedra, if any.
std::optional<Finding> too_many_to_link(std::size_t tetrahedra);

/// Faces to cut, each as 4 t + p of its side in the tetrahedron of lower row; sorted, each once.
using CutFaces = std::vector<std::uint32_t>;

/// The faces on three rows of points each. Errors: not_interior (ids: places in the list), for
/// those that no two tetrahedra share.
Result<CutFaces> listed_faces(const FileMesh& mesh, const FaceLinks& links,
                              std::span<const std::array<std::uint32_t, 3>> points);

/// The section of a plane: faces between tetrahedra with centres on different sides, by the rule of
/// plane_faces (fan.hpp). Errors: not_a_direction, no_face.
Result<CutFaces> section_faces(const FileMesh& mesh, const FaceLinks& links,
                               const CuttingPlane& plane);

/// The faces between tetrahedra of two regions, which are given by number or name.
/// Errors: unknown_region, no_face.
Result<CutFaces> interface_faces(const FileMesh& mesh, const FaceLinks& links,
                                 std::array<std::string_view, 2> regions);

/// Both sides of a cut face: rows of tetrahedra, the lower first, and of the points that face each
/// other. Where the crack does not open, the points are the same.
struct CrackFace {
  std::array<std::uint32_t, 2> tetrahedra;
  std::array<std::array<std::uint32_t, 3>, 2> points;
};

/// The changes of a mesh by a crack.
struct Crack {
  /// Rows of points and of their copies, which stand behind all points of before.
  std::vector<std::array<std::uint32_t, 2>> copies;
  /// In the order of the faces given.
  std::vector<CrackFace> faces;
  /// Faces of which no point came apart: a crack of zero opening shows nothing there.
  std::size_t closed_faces = 0;
  /// Triangles of the mesh that lie on the crack.
  std::size_t triangles_on_it = 0;
};

/// Cuts the faces. A point is duplicated where the tetrahedra around it no longer hang together
/// across faces that are not cut: of those that did before, the part with the tetrahedron of
/// lowest row keeps the point, each other part gets a copy, in the order of points and of lowest
/// tetrahedra. So a front stays joined, and where cracks branch or cross there are several copies.
/// Copies have coordinates, region, data and (where points have them) numbers of their point.
/// Tetrahedra keep their rows. Triangles, edges and vertices go with the tetrahedron of lowest row
/// that has them as face, edge or corner; those of none stay where they are.
/// Needs: `links` and `faces` of this mesh. O(n log n).
Crack open_crack(FileMesh& mesh, const FaceLinks& links, const CutFaces& faces);

}  // namespace sunder
