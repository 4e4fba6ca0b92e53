// SPDX-License-Identifier: MIT
// Spent ties, one face after the other.
#include "fracture/ties/release_ties.hpp"

#include <algorithm>
#include <cmath>

#include "fracture/breaking/partners.hpp"

namespace sunder {
namespace {

/// rad: largest turn of the sides of a face against each other while a corner of it still holds. A
/// chip that hangs on a corner turns about it. The linear strain in the frame of its piece would
/// stretch it by half the square of the angle. In concrete this is a tenth of its breaking strain.
constexpr double most_turn = 0.005;

/// Whether no tie holds the sides any more. All corners are apart, and one has opened so far that
/// the sides have turned about the holding ones, or the whole tie is spent.
bool lets_go(const Tie& tie) {
  double area = 0, largest = 0;
  bool is_past = false;
  for (const TieCorner& corner : tie.corners) {
    if (!corner.is_apart()) return false;
    area += corner.area;
    largest = std::max(largest, corner.opened);
    is_past = is_past || corner.is_spent();
  }
  return tie.is_spent() || (is_past && largest > most_turn * std::sqrt(2 * area));
}

/// Labels of tetrahedra are those of the pieces; vertices are of the finer map.
void follow_pieces(Cells& cells) {
  const Components& pieces = cells.pieces->labels;
  Components& labels = cells.labels;
  labels.of_tetrahedron = pieces.of_tetrahedron;
  labels.size = pieces.size;
  labels.parent = pieces.parent;
  for (std::size_t t = 0; t < cells.map.tetrahedra(); ++t) {
    for (const VertexId v : cells.map.corners(TetId{t})) {
      labels.of_vertex[v.index()] = labels.of_tetrahedron[t];
    }
  }
}

}  // namespace

TieRelease release_ties(Cells& cells, ContactMemory& contact, Detection detection,
                        ComponentScratch& scratch) {
  TieRelease release;
  std::erase_if(contact.ties, [&](const Tie& tie) {
    if (!lets_go(tie)) return false;
    release.ties.push_back(tie);
    release.faces.push_back(split_face(cells.pieces->map, tie.face));
    contact.partners.push_back(partner_of(cells.map, tie.face, tie.opposite));
    return true;
  });
  if (release.faces.empty()) return release;
  release.components =
      update_components(cells.pieces->map, release.faces, detection, cells.pieces->labels, scratch);
  if (release.components.created > 0) follow_pieces(cells);
  return release;
}

}  // namespace sunder
