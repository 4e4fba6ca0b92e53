// SPDX-License-Identifier: MIT
// Nastran's elements: names, shapes, the order of their nodes.
#include <algorithm>

#include "topology/io/msh/msh_elements.hpp"
#include "topology/io/nastran/nastran_reader.hpp"

namespace sunder::io {
namespace {

constexpr NastranType types[] = {
    {"CTETRA", CellKind::tetrahedron, 2, 10}, {"CHEXA", CellKind::hexahedron8, 2, 27},
    {"CPENTA", CellKind::prism6, 2, 18},      {"CPYRAM", CellKind::pyramid5, 2, 14},
    {"CPYRA", CellKind::pyramid5, 2, 14},     {"CTRIA3", CellKind::triangle, 2, 3},
    {"CTRIAR", CellKind::triangle, 2, 3},     {"CTRIA6", CellKind::triangle, 2, 6},
    {"CQUAD4", CellKind::quad4, 2, 4},        {"CQUADR", CellKind::quad4, 2, 4},
    {"CSHEAR", CellKind::quad4, 2, 4},        {"CQUAD8", CellKind::quad4, 2, 8},
    {"CQUAD9", CellKind::quad4, 2, 9},        {"CQUAD", CellKind::quad4, 2, 9},
    {"CBAR", CellKind::edge, 2, 2},           {"CBEAM", CellKind::edge, 2, 2},
    {"CROD", CellKind::edge, 2, 2},           {"CTUBE", CellKind::edge, 2, 2},
    {"CBEND", CellKind::edge, 2, 2},          {"CONROD", CellKind::edge, 1, 2},
    {"CBEAM3", CellKind::edge, 2, 3},         {"PLOTEL", CellKind::edge, 1, 2},
};

constexpr std::string_view other_elements[] = {
    "CELAS1",  "CELAS2",  "CELAS3",  "CELAS4",  "CDAMP1",  "CDAMP2",  "CDAMP3",  "CDAMP4",
    "CDAMP5",  "CMASS1",  "CMASS2",  "CMASS3",  "CMASS4",  "CONM1",   "CONM2",   "CBUSH",
    "CBUSH1D", "CBUSH2D", "CGAP",    "CVISC",   "CWELD",   "CFAST",   "CTRIAX",  "CTRIAX6",
    "CQUADX",  "CQUADX4", "CQUADX8", "CTRAX3",  "CTRAX6",  "CPLSTN3", "CPLSTN4", "CPLSTN6",
    "CPLSTN8", "CPLSTS3", "CPLSTS4", "CPLSTS6", "CPLSTS8", "CHBDYG",  "CHBDYP",  "CHBDYE",
    "CAABSF",  "CRAC2D",  "CRAC3D",  "CHACAB",  "CHACBR",  "RBE1",    "RBE2",    "RBE3",
    "RBAR",    "RROD",    "RTRPLT",  "RSPLINE", "GENEL"};

constexpr std::string_view other_bulk_cards[] = {
    "GRID",   "GRDSET", "CORD1R", "CORD1C", "CORD1S", "CORD2R", "CORD2C", "CORD2S", "PSOLID",
    "PSHELL", "PCOMP",  "PBAR",   "PBARL",  "PBEAM",  "PBEAML", "PROD",   "MAT1",   "MAT2",
    "MAT8",   "MAT9",   "PARAM",  "SPC1",   "SPC",    "FORCE",  "PLOAD4", "EIGRL"};

bool is_one_of(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

// Behind the corners the edges of the bottom, then those that stand, then those of the top; VTK has
// the top before those that stand.
constexpr std::uint8_t hexahedron[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                       10, 11, 16, 17, 18, 19, 12, 13, 14, 15};
constexpr std::uint8_t prism[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11};

}  // namespace

const NastranType* nastran_type(std::string_view card) {
  // meshio puts _ behind names of second order, and some programs the number of nodes.
  while (!card.empty() && card.back() == '_') card.remove_suffix(1);
  const auto* const exact = std::ranges::find(types, card, &NastranType::name);
  if (exact != std::end(types)) return exact;
  for (const std::string_view solid : {"CTETRA", "CHEXA", "CPENTA", "CPYRAM", "CPYRA"}) {
    const bool begins = card.starts_with(solid) && card.size() > solid.size();
    if (!begins || card.find_first_not_of("0123456789", solid.size()) != std::string_view::npos) {
      continue;
    }
    return std::ranges::find(types, solid, &NastranType::name);
  }
  return nullptr;
}

bool is_other_element(std::string_view card) { return is_one_of(other_elements, card); }

bool is_bulk_card(std::string_view card) {
  return nastran_type(card) != nullptr || is_other_element(card) ||
         is_one_of(other_bulk_cards, card);
}

CellKind nastran_kind(CellKind linear, std::size_t nodes) {
  for (const CellKind kind : all_cell_kinds) {
    if (linear_kind(kind) == linear && traits_of(kind).nodes == nodes) return kind;
  }
  return linear;
}

std::span<const std::uint8_t> nastran_order(CellKind kind) {
  switch (kind) {
    case CellKind::hexahedron20:
      return hexahedron;
    case CellKind::prism15:
      return prism;
    // Nastran has none of these: Gmsh writes them, in its own order.
    case CellKind::hexahedron27:
    case CellKind::prism18:
    case CellKind::pyramid14:
      return msh_order(kind);
    default:
      return {};
  }
}

}  // namespace sunder::io
