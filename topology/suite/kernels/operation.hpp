// SPDX-License-Identifier: MIT
// The questions to a topology kernel under judgement and its answers; in the file's own numbers,
// since a kernel's rows are its own affair.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "topology/base/tet_mesh.hpp"

namespace sunder::suite {

/// A face seen from one of its tetrahedra. Unlike three points it stays unique after cuts, when two
/// faces may have the same points.
struct FaceSide {
  /// Row of the file's tetrahedron.
  std::uint32_t tetrahedron = 0;
  /// The file's point, a corner of that tetrahedron, that is not on the face.
  std::uint32_t opposite = 0;
  friend auto operator<=>(const FaceSide&, const FaceSide&) = default;
};

/// A vertex orbit, named by one of its corners.
struct CornerAt {
  std::uint32_t tetrahedron = 0;
  /// The file's point of that corner.
  std::uint32_t point = 0;
  friend auto operator<=>(const CornerAt&, const CornerAt&) = default;
};

/// On which side of a crack a tetrahedron lies, given to it beforehand.
enum class CrackSide : char { none, negative, positive };
/// A crack as labels: its side of every tetrahedron of the file.
using CrackSides = std::vector<CrackSide>;

/// The two steps that everything else is made of.
struct Step {
  enum class Kind {
    /// Unsew the face `a`.
    split,
    /// Sew `a` to `b`, corners with the same point together.
    glue
  };
  Kind kind = Kind::split;
  FaceSide a;
  /// glue only.
  FaceSide b;
  friend bool operator==(const Step&, const Step&) = default;
};

/// Cells counted as orbits of the 3-map.
struct CellCounts {
  std::size_t vertices = 0, edges = 0, faces = 0, tetrahedra = 0, components = 0;
  std::size_t boundary_faces = 0;
  /// Closed surfaces that make up the boundary: its faces joined across edges.
  std::size_t boundary_sheets = 0;
  friend bool operator==(const CellCounts&, const CellCounts&) = default;
};

/// vertices - edges + faces - tetrahedra.
constexpr std::ptrdiff_t euler_characteristic(const CellCounts& c) {
  return static_cast<std::ptrdiff_t>(c.vertices + c.faces) -
         static_cast<std::ptrdiff_t>(c.edges + c.tetrahedra);
}

/// The effect of splitting a face.
struct SplitAnswer {
  /// False: the face was on the boundary; nothing changed and nothing below holds.
  bool did = false;
  /// The face's points at which the vertex orbit came apart, rising.
  std::vector<std::uint32_t> vertices;
  /// The face's edges at which the orbit came apart: pairs of points, each rising, in rising order.
  std::vector<std::array<std::uint32_t, 2>> edges;
  /// Whether one component became two.
  bool separated = false;
  friend bool operator==(const SplitAnswer&, const SplitAnswer&) = default;
};

/// The vertex-split oracle of section 4.2: all three vertices split.
inline bool oracle_says_new(const SplitAnswer& s) { return s.did && s.vertices.size() == 3; }

/// Fewest edges that come apart with so many vertices: a vertex needs its two edges of the face.
constexpr std::size_t least_split_edges(std::size_t vertices) {
  return vertices >= 2 ? 3 : vertices == 1 ? 2 : 0;
}

/// Betti numbers b0 to b3 over a field.
using BettiNumbers = std::array<std::size_t, 4>;

/// Homology over Z in dimensions 0 to 3: ranks, and torsion coefficients (each > 1, each dividing
/// the next).
struct IntegerHomology {
  BettiNumbers betti = {0, 0, 0, 0};
  std::array<std::vector<std::uint64_t>, 4> torsion;
  friend bool operator==(const IntegerHomology&, const IntegerHomology&) = default;
};

}  // namespace sunder::suite
