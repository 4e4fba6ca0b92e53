// SPDX-License-Identifier: MIT
// The kinds of elements of Abaqus and CalculiX by the beginnings of their names.
#include <algorithm>

#include "topology/io/abaqus/abaqus.hpp"
#include "topology/io/abaqus/abaqus_reader.hpp"

namespace sunder::io {
namespace {

constexpr std::string_view other = "elements of another kind";
constexpr AbaqusType types[] = {
    {"C3D4", 4, 3, "tetrahedra"},
    {"DC3D4", 4, 3, "tetrahedra"},
    {"AC3D4", 4, 3, "tetrahedra"},
    {"F3D4", 4, 3, "tetrahedra"},
    {"C3D10", 10, 3, "second-order tetrahedra"},
    {"DC3D10", 10, 3, "second-order tetrahedra"},
    {"AC3D10", 10, 3, "second-order tetrahedra"},
    {"F3D10", 10, 3, "second-order tetrahedra"},
    {"C3D5", 5, 3, "pyramids"},
    {"DC3D5", 5, 3, "pyramids"},
    {"AC3D5", 5, 3, "pyramids"},
    {"C3D6", 6, 3, "prisms"},
    {"DC3D6", 6, 3, "prisms"},
    {"AC3D6", 6, 3, "prisms"},
    {"F3D6", 6, 3, "prisms"},
    {"SC6", 6, 3, "prisms"},
    {"COH3D6", 6, 3, "cohesive prisms"},
    {"C3D15V", 18, 3, "18-node prisms"},
    {"C3D15", 15, 3, "second-order prisms"},
    {"DC3D15", 15, 3, "second-order prisms"},
    {"AC3D15", 15, 3, "second-order prisms"},
    {"C3D8", 8, 3, "hexahedra"},
    {"DC3D8", 8, 3, "hexahedra"},
    {"AC3D8", 8, 3, "hexahedra"},
    {"F3D8", 8, 3, "hexahedra"},
    {"SC8", 8, 3, "hexahedra"},
    {"COH3D8", 8, 3, "cohesive hexahedra"},
    {"C3D20", 20, 3, "second-order hexahedra"},
    {"DC3D20", 20, 3, "second-order hexahedra"},
    {"AC3D20", 20, 3, "second-order hexahedra"},
    {"C3D27", 27, 3, "second-order hexahedra"},
    {"S3", 3, 2, "triangles"},
    {"DS3", 3, 2, "triangles"},
    {"STRI3", 3, 2, "triangles"},
    {"M3D3", 3, 2, "triangles"},
    {"R3D3", 3, 2, "triangles"},
    {"SFM3D3", 3, 2, "triangles"},
    {"CPS3", 3, 2, "triangles"},
    {"CPE3", 3, 2, "triangles"},
    {"CPEG3", 3, 2, "triangles"},
    {"CAX3", 3, 2, "triangles"},
    {"CGAX3", 3, 2, "triangles"},
    {"DC2D3", 3, 2, "triangles"},
    {"DCAX3", 3, 2, "triangles"},
    {"AC2D3", 3, 2, "triangles"},
    {"F3D3", 3, 2, "triangles"},
    {"S6", 6, 2, "second-order triangles"},
    {"DS6", 6, 2, "second-order triangles"},
    {"STRI65", 6, 2, "second-order triangles"},
    {"M3D6", 6, 2, "second-order triangles"},
    {"SFM3D6", 6, 2, "second-order triangles"},
    {"CPS6", 6, 2, "second-order triangles"},
    {"CPE6", 6, 2, "second-order triangles"},
    {"CPEG6", 6, 2, "second-order triangles"},
    {"CAX6", 6, 2, "second-order triangles"},
    {"CGAX6", 6, 2, "second-order triangles"},
    {"DC2D6", 6, 2, "second-order triangles"},
    {"AC2D6", 6, 2, "second-order triangles"},
    {"S4R5", 4, 2, "quadrilaterals"},
    {"S8R5", 8, 2, "quadrilaterals"},
    {"S9R5", 9, 2, "quadrilaterals"},
    {"S4", 4, 2, "quadrilaterals"},
    {"S8", 8, 2, "quadrilaterals"},
    {"DS4", 4, 2, "quadrilaterals"},
    {"DS8", 8, 2, "quadrilaterals"},
    {"M3D4", 4, 2, "quadrilaterals"},
    {"M3D8", 8, 2, "quadrilaterals"},
    {"M3D9", 9, 2, "quadrilaterals"},
    {"R3D4", 4, 2, "quadrilaterals"},
    {"SFM3D4", 4, 2, "quadrilaterals"},
    {"SFM3D8", 8, 2, "quadrilaterals"},
    {"CPS4", 4, 2, "quadrilaterals"},
    {"CPS8", 8, 2, "quadrilaterals"},
    {"CPE4", 4, 2, "quadrilaterals"},
    {"CPE8", 8, 2, "quadrilaterals"},
    {"CPEG4", 4, 2, "quadrilaterals"},
    {"CPEG8", 8, 2, "quadrilaterals"},
    {"CAX4", 4, 2, "quadrilaterals"},
    {"CAX8", 8, 2, "quadrilaterals"},
    {"CGAX4", 4, 2, "quadrilaterals"},
    {"CGAX8", 8, 2, "quadrilaterals"},
    {"DC2D4", 4, 2, "quadrilaterals"},
    {"DC2D8", 8, 2, "quadrilaterals"},
    {"AC2D4", 4, 2, "quadrilaterals"},
    {"AC2D8", 8, 2, "quadrilaterals"},
    {"COH2D4", 4, 2, "quadrilaterals"},
    {"T3D2", 2, 1, "edges"},
    {"T2D2", 2, 1, "edges"},
    {"B21", 2, 1, "edges"},
    {"B23", 2, 1, "edges"},
    {"B31", 2, 1, "edges"},
    {"B33", 2, 1, "edges"},
    {"PIPE21", 2, 1, "edges"},
    {"PIPE31", 2, 1, "edges"},
    {"R2D2", 2, 1, "edges"},
    {"RB2D2", 2, 1, "edges"},
    {"RB3D2", 2, 1, "edges"},
    {"RAX2", 2, 1, "edges"},
    {"SAX1", 2, 1, "edges"},
    {"DC1D2", 2, 1, "edges"},
    {"T3D3", 3, 1, "second-order edges"},
    {"T2D3", 3, 1, "second-order edges"},
    {"B22", 3, 1, "second-order edges"},
    {"B32", 3, 1, "second-order edges"},
    {"PIPE22", 3, 1, "second-order edges"},
    {"PIPE32", 3, 1, "second-order edges"},
    {"SAX2", 3, 1, "second-order edges"},
    {"DC1D3", 3, 1, "second-order edges"},
    {"MASS", 1, 0, "masses"},
    {"ROTARYI", 1, 0, "masses"},
    {"SPRING1", 1, 0, "springs"},
    {"SPRING2", 2, 0, "springs"},
    {"SPRINGA", 2, 0, "springs"},
    {"DASHPOT1", 1, 0, "dashpots"},
    {"DASHPOT2", 2, 0, "dashpots"},
    {"DASHPOTA", 2, 0, "dashpots"},
    {"DCOUP3D", 1, 0, other},
    {"CONN2D2", 2, 0, "connectors"},
    {"CONN3D2", 2, 0, "connectors"},
    {"GAPUNI", 2, 0, "gaps"},
};

/// Of three nodes in a row the middle one comes second.
constexpr std::uint8_t edge_order[] = {0, 2, 1};
/// The whole, then the faces: below, above, and around from the one on the first two corners.
constexpr std::uint8_t hexahedron_order[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13,
                                             14, 15, 16, 17, 18, 19, 26, 24, 25, 22, 21, 23, 20};

}  // namespace

std::optional<CellKind> kind_of(const AbaqusType& type) {
  for (const CellKind kind : all_cell_kinds) {
    const CellKindTraits& t = traits_of(kind);
    if (t.dimension > 0 && t.dimension == type.dimension && t.nodes == type.nodes) return kind;
  }
  return std::nullopt;
}

std::span<const std::uint8_t> abaqus_order(CellKind kind) {
  if (kind == CellKind::edge3) return edge_order;
  if (kind == CellKind::hexahedron27) return hexahedron_order;
  return {};
}

const AbaqusType* abaqus_type(std::string_view word) {
  const std::string lower = lower_case(word);
  for (const AbaqusType& type : types) {
    if (!lower.starts_with(lower_case(type.name))) continue;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    if (std::none_of(lower.begin() + static_cast<std::ptrdiff_t>(type.name.size()), lower.end(),
                     is_digit)) {
      return &type;
    }
  }
  return nullptr;
}

}  // namespace sunder::io
