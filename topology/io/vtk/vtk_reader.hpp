// SPDX-License-Identifier: MIT
// Internal to the legacy VTK reader: the state that its sections share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "topology/io/text/number_source.hpp"
#include "topology/io/vtk/vtk_columns.hpp"

namespace sunder::io {

struct VtkType {
  std::string_view name;
  NumberType type;
  std::size_t bytes;
};

struct VtkReader {
  NumberSource in;
  Draft draft;
  VtkCells cells;
  VtkPiece piece;
  VtkNames names;
  bool has_points = false;
  bool has_cells = false;
  bool has_types = false;
  std::size_t cells_at = 0;
  /// The owner of the data that come next: 0 nothing, 1 points, 2 cells.
  int data_of = 0;
  std::size_t rows = 0;
  /// Bits that were kept as numbers.
  std::size_t bits = 0;
};

/// In lower case: keywords may be written either way.
std::string lower(std::string_view word);

/// The next word as a type of numbers; `read_integer_type` fails at types of reals. Components may
/// follow the type without a blank (FreeFem: int1); where they do, `components` becomes that.
const VtkType& read_type(VtkReader& r, std::size_t& components);
const VtkType& read_type(VtkReader& r);
const VtkType& read_integer_type(VtkReader& r);

/// A word of a type without the digits behind it.
std::string_view without_digits(std::string_view word);

/// The type of lists of cells, of exact coordinates, and of colours in text and raw.
const VtkType& int_type();
const VtkType& double_type();
const VtkType& float_type();
const VtkType& byte_type();

/// Raw numbers begin behind the line's end. Fails where the rest cannot hold `n` of them.
void begin_numbers(VtkReader& r, std::size_t n, const VtkType& type, std::string_view what);

/// Hands `n` numbers to `take`, one after the other.
template <class Value, class Take>
void read_numbers(VtkReader& r, std::size_t n, const VtkType& type, Take&& take) {
  with_stored(type.type, [&]<class Stored>(Stored) {
    for (std::size_t i = 0; i < n; ++i) {
      take(r.in.is_binary ? number_cast<Value>(read_raw<Stored>(r.in, "a number"))
                          : read_text_as<Stored, Value>(r.in.s, "a number"));
    }
  });
}

std::vector<std::int64_t> read_integers(VtkReader& r, std::size_t n, const VtkType& type);

/// A product of two counts that have to fit into the file: fails with count_too_big.
std::size_t product(VtkReader& r, std::size_t a, std::size_t b, std::string_view what);

/// Fails with wrong_section_order where `seen` is true, and makes it so.
void refuse_second(VtkReader& r, bool& seen, std::string_view section);

/// Fails with missing_section where the file ended without it.
void expect_section(VtkReader& r, bool seen, std::string_view name);

/// Counts, ends and points of a list of cells, counted or with offsets.
void read_cell_list(VtkReader& r);

/// A section with everything in it, from behind its keyword. Fails with unknown_section.
void read_keyword(VtkReader& r, std::string_view word, std::size_t at);

/// Passes a keyword, in upper or lower case, or fails because it was expected.
void expect_keyword(VtkReader& r, std::string_view word);

/// Data, from behind their keyword (in lower case) to their last value: SCALARS, VECTORS, FIELD and
/// their kin; false where the keyword is none of these.
bool read_attribute(VtkReader& r, std::string_view keyword);

/// METADATA, up to the blank line behind it.
void skip_metadata(VtkReader& r);

}  // namespace sunder::io
