// SPDX-License-Identifier: MIT
// Spent ties, one face after the other.
#include "fracture/ties/release_ties.hpp"

#include "fracture/breaking/partners.hpp"

namespace sunder {
namespace {

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
    if (!tie.is_spent()) return false;
    release.faces.push_back(split_face(cells.pieces->map, tie.face));
    contact.partners.push_back(partner_of(cells.map, tie.face, tie.opposite));
    return true;
  });
  if (release.faces.empty()) return release;
  release.components = update_components(cells.pieces->map, release.faces, detection,
                                         cells.pieces->labels, scratch);
  if (release.components.created > 0) follow_pieces(cells);
  return release;
}

}  // namespace sunder
