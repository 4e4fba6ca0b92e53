// SPDX-License-Identifier: MIT
// base64, zlib and digits for VTU's arrays.
#include "topology/io/vtu/vtu_encode.hpp"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <vector>

#include "topology/base/assert.hpp"
#include "topology/io/text/number_sink.hpp"
#include "topology/io/vtk/vtk_cells.hpp"

namespace sunder::io {
namespace {

constexpr char digits64[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Bytes packed at a time; VTK unpacks single blocks where it needs a part of an array.
constexpr std::size_t block_bytes = 1 << 18;

}  // namespace

std::string in_xml(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string in_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::string_view three = bytes.substr(at, 3);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto byte = k < three.size() ? static_cast<unsigned char>(three[k]) : 0U;
      bits = bits << 8 | byte;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= three.size() ? digits64[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

PackedArray packed(std::string_view bytes) {
  const std::size_t blocks = (bytes.size() + block_bytes - 1) / block_bytes;
  std::vector<std::uint64_t> header{blocks, block_bytes, bytes.size() % block_bytes};
  PackedArray array;
  std::vector<Bytef> room(compressBound(block_bytes));
  for (std::size_t at = 0; at < bytes.size(); at += block_bytes) {
    const std::string_view block = bytes.substr(at, block_bytes);
    uLongf size = room.size();
    // The quickest level: the usual one takes three times as long and saves little on such numbers.
    const int reason = compress2(room.data(), &size, reinterpret_cast<const Bytef*>(block.data()),
                                 block.size(), Z_BEST_SPEED);
    if (reason == Z_MEM_ERROR) throw std::bad_alloc();
    SUNDER_ASSERT(reason == Z_OK, "zlib has room for every block");
    array.blocks.append(reinterpret_cast<const char*>(room.data()), size);
    header.push_back(size);
  }
  array.header.assign(reinterpret_cast<const char*>(header.data()), 8 * header.size());
  return array;
}

std::string in_digits(NumberType type, std::size_t components, std::string_view bytes) {
  NumberSink out;
  with_stored(type, [&]<class Stored>(Stored value) {
    out.bytes.reserve(bytes.size() / sizeof(Stored) * 6);
    for (std::size_t i = 0; sizeof(Stored) * i < bytes.size(); ++i) {
      std::memcpy(&value, bytes.data() + sizeof(Stored) * i, sizeof(Stored));
      if constexpr (sizeof(Stored) == 1) {
        put_text(out, static_cast<int>(value));  // a number, not a character
      } else {
        put_text(out, value);
      }
      out.bytes += (i + 1) % components == 0 ? '\n' : ' ';
    }
  });
  return std::move(out.bytes);
}

}  // namespace sunder::io
