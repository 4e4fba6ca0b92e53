// SPDX-License-Identifier: MIT
// A journal of changes of a map: any number of them taken back and done again, to the same bytes.
#pragma once

#include <utility>
#include <vector>

#include "topology/kernel/kernel.hpp"
#include "topology/kernel/split_face.hpp"

namespace sunder {

/// Changes that take back what was done, and those that do it again; the last ones at the end.
struct Journal {
  std::vector<CellChange> undo, redo;
};

/// Enters an operation by what takes it back, as `CellEdit::undo` does. What could be done again is
/// forgotten.
inline void enter(Journal& journal, CellChange undo) {
  journal.undo.push_back(std::move(undo));
  journal.redo.clear();
}

/// Takes back the last operation; false when there is none. Needs: all changes of the map entered.
template <CellKernel K>
bool undo(K& map, Journal& journal) {
  if (journal.undo.empty()) return false;
  journal.redo.push_back(map.apply(journal.undo.back()));
  journal.undo.pop_back();
  return true;
}

/// Does again what was taken back last; false when there is nothing.
template <CellKernel K>
bool redo(K& map, Journal& journal) {
  if (journal.redo.empty()) return false;
  journal.undo.push_back(map.apply(journal.redo.back()));
  journal.redo.pop_back();
  return true;
}

/// `split_face`, entered. O(stars of the face's vertices).
template <CellKernel K>
FaceSplit split_face(K& map, HalfFaceId face, Journal& journal);

}  // namespace sunder
