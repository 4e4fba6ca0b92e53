// SPDX-License-Identifier: MIT
// Internal to topology/io: the STL format (.stl), triangles each with their own three points.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Whether a file is like STL: as long as its number of facets says (binary, whatever it begins
/// with), or text that begins with the word solid.
bool is_stl(std::string_view text);

/// Reads STL, text or binary. Points with the same coordinates (-0 is 0) are one, in the order in
/// which they come first. Normals are not looked at, nor are the attribute bytes of binary files.
/// A solid's name (of text) is the region of its facets. Throws ReadFailure.
Draft read_stl(std::string_view text);

/// The bytes of an STL file with the triangles; normals are computed, that of a degenerate triangle
/// is 0 0 0. Text has a solid for each run of triangles of one region. Binary files have floats and
/// no regions. Needs: stl_refused says nothing.
std::string write_stl(const FileMesh& mesh, bool is_binary);

/// Changes of the points of `mesh` in an STL file.
struct StlPoints {
  /// Points that no triangle uses.
  std::size_t unused = 0;
  /// Points that have the place of an earlier one.
  std::size_t merged = 0;
  /// Whether they come back in another order.
  bool is_reordered = false;
  /// Used points with coordinates that are no floats, and the largest change of one, relative to
  /// it.
  std::size_t rounded = 0;
  double largest_change = 0;
  /// Used points with coordinates beyond the largest float: no binary file can be written.
  std::size_t too_big = 0;
};
StlPoints stl_points(const FileMesh& mesh, bool is_binary);

}  // namespace sunder::io
