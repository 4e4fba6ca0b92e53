// SPDX-License-Identifier: MIT
// Internal to the reader of PLY: what its elements share.
#pragma once

#include <array>
#include <vector>

#include "topology/io/draft.hpp"
#include "topology/io/surface/ply_header.hpp"
#include "topology/io/text/number_source.hpp"
#include "topology/io/text/row_watch.hpp"
#include "topology/io/vtk/vtk_columns.hpp"

namespace sunder::io {

/// A triangle of a strip: rows of points, and where its strip stands.
struct StripTriangle {
  std::array<std::int64_t, 3> points{};
  std::size_t at = 0;
};

struct PlyReader {
  NumberSource in;
  Draft draft;
  RowWatch watch;
  PlyHeader header;
  /// Triangles of strips, added behind those of all faces.
  std::vector<StripTriangle> strips;
};

/// The bytes of a raw number.
inline std::size_t size_of(NumberType type) {
  return with_stored(type, [](auto zero) { return sizeof zero; });
}

/// A number of `type`; fails with number_out_of_range where the text's is not of that type.
template <class Stored>
Stored read_scalar(PlyReader& r, std::string_view what) {
  if (r.in.is_binary) return read_raw<Stored>(r.in, what);
  if constexpr (std::is_same_v<Stored, float>) {
    return static_cast<float>(read_number<double>(r.in.s, what));
  } else {
    return read_number<Stored>(r.in.s, what);
  }
}

/// An integer of a property's type; `what` was expected.
std::int64_t read_integer(PlyReader& r, NumberType type, std::string_view what);

/// The length of a list that stands next.
std::size_t read_length(PlyReader& r, const Property& p);

/// Passes a property that is not kept.
void skip_property(PlyReader& r, const Property& p);

/// Where the next row begins, behind comments, which some programs write between rows; and its end.
std::size_t begin_row(PlyReader& r);
void end_row(PlyReader& r);

/// Finds the list of corners of faces or strips. Fails with missing_array.
void assign_corners(const PlyReader& r, Element& e);

/// The element tristrips: its triangles are kept until all faces are there.
void read_strips(PlyReader& r, Element& e);
void add_strips(PlyReader& r);

}  // namespace sunder::io
