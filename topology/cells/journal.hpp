// SPDX-License-Identifier: MIT
// A journal of changes of a map: undo and redo of any number of them, to the same bytes.
#pragma once

#include <utility>
#include <vector>

#include "topology/kernel/kernel.hpp"
#include "topology/kernel/split_face.hpp"

namespace sunder {

/// Changes that undo operations, and changes that redo them; the latest stand last.
struct Journal {
  std::vector<CellChange> undo, redo;
};

/// Enters an operation by its inverse change, such as `CellEdit::undo`. Changes that could be
/// redone are deleted.
inline void enter(Journal& journal, CellChange undo) {
  journal.undo.push_back(std::move(undo));
  journal.redo.clear();
}

/// Undoes the last operation; false if there is none. Requires: a journal with all changes of the
/// map.
template <CellKernel K>
bool undo(K& map, Journal& journal) {
  if (journal.undo.empty()) return false;
  journal.redo.push_back(map.apply(journal.undo.back()));
  journal.undo.pop_back();
  return true;
}

/// Redoes the last undone operation; false if there is none.
template <CellKernel K>
bool redo(K& map, Journal& journal) {
  if (journal.redo.empty()) return false;
  journal.undo.push_back(map.apply(journal.redo.back()));
  journal.redo.pop_back();
  return true;
}

/// Splits a face and enters the change into the journal. O(stars of the face's vertices).
template <CellKernel K>
FaceSplit split_face(K& map, HalfFaceId face, Journal& journal);

}  // namespace sunder
