// SPDX-License-Identifier: MIT
// Internal to topology/io: arrays as VTU files hold them besides raw bytes.
#pragma once

#include <string>
#include <string_view>

#include "topology/mesh/file_mesh.hpp"

namespace sunder::io {

/// Text as an attribute or content of XML may have it: `&`, `<`, `>` and quotes by their names;
/// other characters as they are.
std::string in_xml(std::string_view text);

/// Bytes in base64, padded.
std::string in_base64(std::string_view bytes);

/// An array packed by zlib, in blocks: the sizes that stand before them, as 64-bit numbers, and the
/// blocks one after the other.
struct PackedArray {
  std::string header;
  std::string blocks;
};
PackedArray packed(std::string_view bytes);

/// The numbers of an array in digits, `components` a line; reals in the shortest form that reads
/// back to the same bits. `bytes`: numbers of `type` one after the other.
std::string in_digits(NumberType type, std::size_t components, std::string_view bytes);

}  // namespace sunder::io
