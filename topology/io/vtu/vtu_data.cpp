// SPDX-License-Identifier: MIT
// Decoding VTU arrays: text, base64, raw bytes, zlib blocks, either byte order, any number type.
#include "topology/io/vtu/vtu_data.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <memory>
#include <new>

#include "topology/base/limits.hpp"
#include "topology/io/text/number_source.hpp"
#include "topology/io/vtk/vtk_cells.hpp"

namespace sunder::io {
namespace {

constexpr std::string_view write_again = "the file is damaged: copy or write it again";

[[noreturn]] void fail_array(const VtuLayout& layout, const VtuArray& array, std::string_view code,
                             std::string_view text, std::string_view remedy = write_again) {
  fail(layout.text, array.at,
       {.code = std::string(code),
        .text = fmt::format("array {}: {}", in_quotes(array.name), text),
        .remedy = std::string(remedy)});
}

/// -1 for characters that are no base64 digit.
constexpr std::array<std::int8_t, 256> base64_digits = [] {
  std::array<std::int8_t, 256> digits{};
  digits.fill(-1);
  constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < alphabet.size(); ++i) {
    digits[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
  }
  return digits;
}();

/// The bytes behind an encoding, one after the other.
struct ByteSource {
  const VtuLayout& layout;
  const VtuArray& array;
  std::string_view encoded;
  bool is_base64;
  std::size_t at = 0;
  std::array<unsigned char, 3> group{};
  std::size_t group_at = 0;
  std::size_t group_size = 0;
};

/// At most this many bytes are left.
std::size_t most_left(const ByteSource& in) {
  const std::size_t rest = in.encoded.size() - in.at;
  return in.is_base64 ? rest / 4 * 3 + in.group_size - in.group_at : rest;
}

[[noreturn]] void fail_short(const ByteSource& in, std::size_t wanted) {
  fail_array(in.layout, in.array, "truncated_file",
             fmt::format("its data end {} bytes too early", wanted));
}

/// Decodes the next four digits. Padding may come in the middle of the data, where a writer
/// encoded the header and the values apart.
void next_group(ByteSource& in, std::size_t wanted) {
  std::uint32_t bits = 0;
  std::size_t digits = 0, padding = 0;
  while (digits + padding < 4) {
    while (in.at < in.encoded.size() && is_blank(in.encoded[in.at])) ++in.at;
    if (in.at == in.encoded.size() || in.encoded[in.at] == '<') fail_short(in, wanted);
    const char c = in.encoded[in.at];
    const int digit = base64_digits[static_cast<unsigned char>(c)];
    if (c == '=' && digits >= 2) {
      ++padding;
      bits <<= 6;
    } else if (digit >= 0 && padding == 0) {
      ++digits;
      bits = bits << 6 | static_cast<std::uint32_t>(digit);
    } else {
      fail_array(in.layout, in.array, "bad_base64",
                 fmt::format("{} at byte {} of the file is no base64",
                             in_quotes(in.encoded.substr(in.at, 1)),
                             in.encoded.data() + in.at - in.layout.text.data()));
    }
    ++in.at;
  }
  in.group = {static_cast<unsigned char>(bits >> 16), static_cast<unsigned char>(bits >> 8),
              static_cast<unsigned char>(bits)};
  in.group_at = 0;
  in.group_size = 3 - padding;
}

void take(ByteSource& in, char* out, std::size_t n) {
  if (!in.is_base64) {
    if (n > in.encoded.size() - in.at) fail_short(in, n - (in.encoded.size() - in.at));
    if (n > 0) std::memcpy(out, in.encoded.data() + in.at, n);
    in.at += n;
    return;
  }
  while (n > 0) {
    if (in.group_at == in.group_size) next_group(in, n);
    for (; n > 0 && in.group_at < in.group_size; --n) {
      *out++ = static_cast<char>(in.group[in.group_at++]);
    }
  }
}

/// A word of a block header.
std::uint64_t take_word(ByteSource& in) {
  const bool swap = in.layout.byte_order != std::endian::native;
  if (in.layout.header_bytes == 4) {
    std::uint32_t word = 0;
    take(in, reinterpret_cast<char*>(&word), sizeof word);
    return swap ? byte_swapped(word) : word;
  }
  std::uint64_t word = 0;
  take(in, reinterpret_cast<char*>(&word), sizeof word);
  return swap ? byte_swapped(word) : word;
}

void expect_bytes(const ByteSource& in, std::uint64_t announced, std::size_t expected) {
  if (announced == expected) return;
  fail_array(in.layout, in.array, "wrong_count",
             fmt::format("{} bytes are announced, {} were expected from the numbers of points and "
                         "cells",
                         announced, expected));
}

std::string take_plain(ByteSource& in, std::size_t expected) {
  expect_bytes(in, take_word(in), expected);
  if (expected > most_left(in)) fail_short(in, expected - most_left(in));
  std::string bytes(expected, '\0');
  take(in, bytes.data(), expected);
  return bytes;
}

/// Appends the unpacked bytes of one zlib stream of `packed` bytes, which have to be `size` bytes.
/// Room is made as they come: `size` is only a header's claim.
void unfold(ByteSource& in, std::uint64_t packed, std::size_t size, std::string& out) {
  if (packed > most_left(in)) fail_short(in, packed - most_left(in));
  std::string block(packed, '\0');
  take(in, block.data(), packed);
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, &inflateEnd);
  constexpr std::size_t most = std::size_t{1} << 30;  // zlib counts in 32 bits
  const std::size_t begin = out.size();
  std::size_t filled = 0, taken = 0;
  int status = Z_OK;
  while (status == Z_OK) {
    if (filled == out.size() - begin) {
      out.resize(begin + std::min(size + 1, std::max<std::size_t>(4 * packed, 2 * filled) + 64));
    }
    const std::size_t given = std::min(most, block.size() - taken);
    const std::size_t room = std::min(most, out.size() - begin - filled);
    stream.next_in = reinterpret_cast<Bytef*>(block.data() + taken);
    stream.avail_in = static_cast<uInt>(given);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + begin + filled);
    stream.avail_out = static_cast<uInt>(room);
    status = inflate(&stream, Z_NO_FLUSH);
    taken += given - stream.avail_in;
    filled += room - stream.avail_out;
    if (filled > size) break;
  }
  if (status != Z_STREAM_END || filled != size) {
    fail_array(in.layout, in.array, "bad_zlib",
               fmt::format("a block of {} bytes does not unfold to {}: {}", packed, size,
                           status == Z_STREAM_END ? fmt::format("it holds {}", filled)
                           : filled > size        ? std::string("it holds more")
                                                  : zError(status)));
  }
  out.resize(begin + size);
}

/// [blocks, bytes of a block, bytes of the last one or 0, packed bytes of each block], then those.
std::string take_compressed(ByteSource& in, std::size_t expected) {
  const std::uint64_t blocks = take_word(in);
  const std::uint64_t block_bytes = take_word(in);
  const std::uint64_t last_bytes = take_word(in);
  if (blocks > most_left(in) / in.layout.header_bytes) {
    fail_short(in, blocks * in.layout.header_bytes - most_left(in));
  }
  if (expected / most_unfolding > most_left(in)) fail_short(in, expected);
  if (expected > limits().unpacked_bytes) {
    fail_array(in.layout, in.array, "too_large",
               fmt::format("it unfolds to {} bytes; the limit unpacked_bytes is {}", expected,
                           limits().unpacked_bytes),
               "write it unpacked if you trust it, or look at SUNDER_LIMITS and --confined");
  }
  // The last block may be shorter; where it is the only one, the size of the others means nothing.
  const std::uint64_t whole = blocks == 0 || last_bytes == 0 ? blocks : blocks - 1;
  const bool too_many = whole > 0 && (block_bytes == 0 || whole > expected / block_bytes);
  if (too_many || whole * block_bytes + (blocks == 0 ? 0 : last_bytes) != expected) {
    fail_array(in.layout, in.array, "wrong_count",
               fmt::format("{} blocks of {} bytes (the last of {}) are announced, {} bytes were "
                           "expected from the numbers of points and cells",
                           blocks, block_bytes, last_bytes, expected));
  }
  std::vector<std::uint64_t> packed(blocks);
  for (std::uint64_t& p : packed) p = take_word(in);
  // Some writers end a base64 stream here and begin another: next_group sees to that.
  std::string bytes;
  for (std::size_t i = 0; i < blocks; ++i) {
    unfold(in, packed[i], i < whole ? block_bytes : last_bytes, bytes);
  }
  return bytes;
}

std::string decode(VtuLayout& layout, const VtuArray& array, std::size_t expected_bytes) {
  std::string_view encoded = array.content;
  if (array.is_appended) {
    if (array.offset > layout.appended.size()) {
      fail_array(layout, array, "truncated_file",
                 fmt::format("its data begin at byte {} of the appended data, which end after {}",
                             array.offset, layout.appended.size()));
    }
    const std::size_t size = layout.appended.size();
    const std::size_t known =
        layout.is_compressed || expected_bytes > size - array.offset ? 0 : expected_bytes;
    if (layout.taken > size || known > size - layout.taken) {
      fail_array(layout, array, "bad_offsets",
                 fmt::format("with the arrays before it takes more than the {} bytes of appended "
                             "data: some share bytes",
                             size));
    }
    encoded = layout.appended.substr(array.offset);
  }
  ByteSource in{.layout = layout,
                .array = array,
                .encoded = encoded,
                .is_base64 = !array.is_appended || layout.appended_encoding == VtuEncoding::base64};
  std::string bytes =
      layout.is_compressed ? take_compressed(in, expected_bytes) : take_plain(in, expected_bytes);
  if (array.is_appended) layout.taken += in.at;
  return bytes;
}

constexpr std::size_t block_size = 512;

template <class Stored, class Value>
void take_raw(const std::string& bytes, bool swap, const TakeValues<Value>& take) {
  std::array<Value, block_size> block;
  for (std::size_t at = 0; at < bytes.size();) {
    std::size_t n = 0;
    for (; n < block_size && at < bytes.size(); ++n, at += sizeof(Stored)) {
      Stored stored;
      std::memcpy(&stored, bytes.data() + at, sizeof(Stored));
      block[n] = number_cast<Value>(swap ? byte_swapped(stored) : stored);
    }
    take({block.data(), n});
  }
}

template <class Stored, class Value>
void take_text(const VtuLayout& layout, const VtuArray& array, std::size_t expected,
               const TakeValues<Value>& take) {
  const std::size_t begin = static_cast<std::size_t>(array.content.data() - layout.text.data());
  Scanner s{layout.text.substr(0, begin + array.content.size()), begin};
  std::array<Value, block_size> block;
  std::size_t found = 0;
  while (found < expected && !peek_word(s).empty()) {
    block[found++ % block_size] = read_text_as<Stored, Value>(s, "a number");
    if (found % block_size == 0) take(block);
  }
  if (found % block_size > 0) take({block.data(), found % block_size});
  if (found < expected || !peek_word(s).empty()) {
    fail_array(layout, array, "wrong_count",
               fmt::format("it holds {} numbers, {} were expected from the numbers of points and "
                           "cells",
                           found < expected ? fmt::format("{}", found) : "more", expected));
  }
}

template <class Value>
void read_values(VtuLayout& layout, const VtuArray& array, std::size_t expected,
                 const TakeValues<Value>& take) {
  const auto* const word = std::ranges::find(vtu_types, array.type);
  if (word == std::end(vtu_types)) {
    fail_array(layout, array, "bad_attribute",
               fmt::format("type {} is not one of Float32, Float64, Int8 ... UInt64",
                           in_quotes(array.type)),
               "write the array with one of these types");
  }
  const bool swap = layout.byte_order != std::endian::native;
  with_stored(static_cast<NumberType>(word - std::begin(vtu_types)), [&]<class Stored>(Stored) {
    if (array.is_ascii) return take_text<Stored>(layout, array, expected, take);
    take_raw<Stored>(decode(layout, array, expected * sizeof(Stored)), swap, take);
  });
}

}  // namespace

void read_doubles(VtuLayout& layout, const VtuArray& array, std::size_t expected,
                  const TakeValues<double>& take) {
  read_values<double>(layout, array, expected, take);
}

void read_integers(VtuLayout& layout, const VtuArray& array, std::size_t expected,
                   const TakeValues<std::int64_t>& take) {
  if (array.type.substr(0, 5) == "Float") {
    fail_array(layout, array, "bad_attribute",
               fmt::format("type {} where integers were expected", in_quotes(array.type)),
               "write the array with an integer type");
  }
  read_values<std::int64_t>(layout, array, expected, take);
}

std::vector<std::int64_t> read_integers(VtuLayout& layout, const VtuArray& array,
                                        std::size_t expected) {
  std::vector<std::int64_t> values;
  read_integers(layout, array, expected, [&](std::span<const std::int64_t> block) {
    if (values.empty()) values.reserve(expected);  // the bytes for so many are there
    values.insert(values.end(), block.begin(), block.end());
  });
  return values;
}

}  // namespace sunder::io
