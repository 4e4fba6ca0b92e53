// SPDX-License-Identifier: MIT
// The parts of a mesh file that a reader keeps.
#pragma once

namespace sunder {

struct ReadOptions {
  /// Leaves out volume cells other than tetrahedra, with a warning.
  bool tetrahedra_only = false;
  /// Keeps simplices of first order only. Cells of second order are read by their corners, and
  /// other cells are left out, both with a note. Volume cells other than tetrahedra are an error,
  /// or a warning with `tetrahedra_only`.
  bool simplices = false;
};

}  // namespace sunder
