// SPDX-License-Identifier: MIT
// What a reader of mesh files is to keep.
#pragma once

namespace sunder {

struct ReadOptions {
  /// Volume cells that are no tetrahedra are left out with a warning.
  bool tetrahedra_only = false;
  /// For those who compute with simplices of first order: cells of second order are read by their
  /// corners, and what is no simplex is left out, both with a note; volume cells that are no
  /// tetrahedra are an error instead (with `tetrahedra_only` a warning).
  bool simplices = false;
};

}  // namespace sunder
