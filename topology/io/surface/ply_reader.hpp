// SPDX-License-Identifier: MIT
// Internal to the reader of PLY: functions that its elements share.
#pragma once

#include <vector>

#include "topology/io/draft.hpp"
#include "topology/io/surface/ply_header.hpp"
#include "topology/io/text/number_source.hpp"
#include "topology/io/text/row_watch.hpp"
#include "topology/io/vtk/vtk_columns.hpp"

namespace sunder::io {

/// Where the rows of an element tristrips begin.
struct StripPlace {
  const Element* element = nullptr;
  std::size_t at = 0;
};

struct PlyReader {
  NumberSource in;
  Draft draft;
  RowWatch watch;
  PlyHeader header;
  /// Strips are read behind all faces; how many triangles they have.
  std::vector<StripPlace> strips;
  std::size_t strip_triangles = 0;
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

/// An integer of a property's type, expected as a `what`.
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

/// Passes an element tristrips, and counts its triangles. Fails with count_too_big.
void pass_strips(PlyReader& r, Element& e);

/// Triangles of all strips, behind those of the faces.
void add_strips(PlyReader& r);

}  // namespace sunder::io
