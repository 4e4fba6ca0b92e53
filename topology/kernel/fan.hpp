// SPDX-License-Identifier: MIT
// Sets of faces to split: the fan at a vertex, the section of a plane, and the order within them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/base/ids.hpp"
#include "topology/kernel/kernel.hpp"
#include "topology/kernel/plane_side.hpp"

namespace sunder {

/// A vertex and the tetrahedra around it, each by its corner at the vertex, in rising order.
/// Corners keep their names when faces split. An earlier star still holds the same tetrahedra,
/// although its vertex may have split since.
struct VertexStar {
  VertexId vertex;
  std::vector<CornerId> corners;
};
template <Kernel K>
VertexStar vertex_star(const K& map, VertexId vertex);

/// The tetrahedra of `vertex_star`, in rising order. O(star).
template <Kernel K>
std::vector<TetId> star(const K& map, VertexId vertex);

/// Sign of each tetrahedron of a star relative to the plane through its vertex (algorithm 4,
/// plane_side.hpp): 1 positive, 0 negative. `normal`: rest frame, of any length but 0.
template <Kernel K>
std::vector<char> plane_signs(const K& map, const VertexStar& around, const Point& normal);

/// The fan of a vertex (section 4.1, algorithm 4): the interior faces at `vertex` between two
/// tetrahedra of different sign, seen from the positive side, in rising order of half-face.
///
///        + | -          around an inner vertex the fan closes, at the surface it is open;
///      ____|____        it may have several branches: more than two copies of the vertex can
///        + v  +         result.
///
/// `positive`: one flag per tetrahedron of the star. The result is empty if all are on one side.
template <Kernel K>
std::vector<HalfFaceId> fan_faces(const K& map, const VertexStar& around,
                                  std::span<const char> positive);

/// The fan at a vertex for a normal in the rest frame, taken in its canonical direction: n and -n
/// are one plane. Errors: `not_a_direction` (zero or not finite normal), `no_such_vertex` (row out
/// of range or retired). An empty fan is not an error.
template <Kernel K>
Result<std::vector<HalfFaceId>> fan_faces(const K& map, VertexId vertex, const Point& normal);

/// The section of a plane through the whole body: the interior faces between tetrahedra with rest
/// centres on different sides. The rule of signs (plane_side.hpp) and the order are those of the
/// fan. Errors: `not_a_direction`, also for an offset that is not finite. O(|T|).
template <Kernel K>
Result<std::vector<HalfFaceId>> plane_faces(const K& map, const CuttingPlane& plane);

/// The order in which the faces of a fan are split.
enum class FaceOrder {
  /// The order of the list.
  given,
  /// Faces with an edge on the surface first (section 4.2, figure 5); cracked faces count as
  /// surface. The map at the time of the call decides. Other faces keep the order of the list.
  paper
};

/// Sorts `faces` into the given order. O(faces x edge stars).
template <Kernel K>
void order_faces(const K& map, FaceOrder order, std::vector<HalfFaceId>& faces);

/// The half-face on each triple of file points (any order of the three), seen from the lower
/// tetrahedron; none() if no tetrahedron has such a face. Boundary faces are found too: their
/// `neighbour` is none(). A face of the file has at most two sides, so on an intact map the answer
/// is unique. O(|T| + n log n) for n triples.
template <Kernel K>
std::vector<HalfFaceId> find_faces(const K& map,
                                   std::span<const std::array<std::uint32_t, 3>> points);

}  // namespace sunder
