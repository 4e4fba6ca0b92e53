// SPDX-License-Identifier: MIT
// Internal to the VTU reader: one DataArray's values, however they are encoded.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sunder::io {

enum class VtuEncoding { ascii, base64, raw };

/// How a file writes its binary arrays; the same for all of them.
struct VtuLayout {
  /// The whole file.
  std::string_view text;
  std::endian byte_order = std::endian::little;
  /// Bytes of a word of a block header: 4 or 8.
  std::size_t header_bytes = 4;
  bool is_compressed = false;
  VtuEncoding appended_encoding = VtuEncoding::base64;
  /// The bytes behind the underscore of AppendedData, to the file's end.
  std::string_view appended;
  /// How many of its bytes the arrays read so far took. They may not share any: a small file could
  /// say to be big.
  std::size_t taken = 0;
};

/// A DataArray's tag.
struct VtuArray {
  std::string name;
  /// VTK's word: "Float64", "Int32", ...
  std::string type;
  std::size_t components = 1;
  /// Of the cells of PolyData: the list, in the order of PolyList.
  std::uint8_t poly_list = 0;
  bool is_appended = false;
  bool is_ascii = false;
  /// Into VtuLayout::appended.
  std::size_t offset = 0;
  /// Into VtuLayout::text: the tag itself, and the text between it and its end tag.
  std::size_t at = 0;
  std::string_view content;
};

/// Takes an array's values, block by block.
template <class Value>
using TakeValues = std::function<void(std::span<const Value>)>;

/// The array's values, all of them. `expected`: how many there have to be.
/// Throws ReadFailure (wrong_count, truncated_file, bad_number, bad_base64, bad_zlib,
/// bad_attribute, count_too_big); never allocates more than the array's bytes, unfolded.
void read_doubles(VtuLayout& layout, const VtuArray& array, std::size_t expected,
                  const TakeValues<double>& take);
void read_integers(VtuLayout& layout, const VtuArray& array, std::size_t expected,
                   const TakeValues<std::int64_t>& take);
std::vector<std::int64_t> read_integers(VtuLayout& layout, const VtuArray& array,
                                        std::size_t expected);

/// zlib never unfolds a byte to more than this (zlib's technical notes: 1032 to 1).
inline constexpr std::size_t most_unfolding = 1032;

}  // namespace sunder::io
