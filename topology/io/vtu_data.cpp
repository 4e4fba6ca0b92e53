// SPDX-License-Identifier: MIT
// Decoding VTU arrays: text, base64, raw bytes, zlib blocks, either byte order, any number type.
#include "topology/io/vtu_data.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "topology/io/number_source.hpp"

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

/// One zlib stream of `packed` bytes into `out`, which it has to fill.
void unfold(ByteSource& in, std::uint64_t packed, std::span<char> out) {
  if (packed > most_left(in)) fail_short(in, packed - most_left(in));
  std::string block(packed, '\0');
  take(in, block.data(), packed);
  uLongf size = out.size();
  const int status = uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                                reinterpret_cast<const Bytef*>(block.data()), packed);
  if (status != Z_OK || size != out.size()) {
    fail_array(in.layout, in.array, "bad_zlib",
               fmt::format("a block of {} bytes does not unfold to {}: {}", packed, out.size(),
                           status == Z_OK ? fmt::format("it holds {}", size) : zError(status)));
  }
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
  std::string bytes(expected, '\0');
  std::size_t at = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::size_t size = i < whole ? block_bytes : last_bytes;
    unfold(in, packed[i], std::span(bytes.data() + at, size));
    at += size;
  }
  return bytes;
}

std::string decode(const VtuLayout& layout, const VtuArray& array, std::size_t expected_bytes) {
  std::string_view encoded = array.content;
  if (array.is_appended) {
    if (array.offset > layout.appended.size()) {
      fail_array(layout, array, "truncated_file",
                 fmt::format("its data begin at byte {} of the appended data, which end after {}",
                             array.offset, layout.appended.size()));
    }
    encoded = layout.appended.substr(array.offset);
  }
  ByteSource in{.layout = layout,
                .array = array,
                .encoded = encoded,
                .is_base64 = !array.is_appended || layout.appended_encoding == VtuEncoding::base64};
  return layout.is_compressed ? take_compressed(in, expected_bytes)
                              : take_plain(in, expected_bytes);
}

template <class Stored, class Value>
std::vector<Value> converted(const std::string& bytes, bool swap) {
  std::vector<Value> values(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Stored stored;
    std::memcpy(&stored, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    values[i] = static_cast<Value>(swap ? byte_swapped(stored) : stored);
  }
  return values;
}

template <class Value>
std::vector<Value> read_text(const VtuLayout& layout, const VtuArray& array, std::size_t expected) {
  const std::size_t begin = static_cast<std::size_t>(array.content.data() - layout.text.data());
  Scanner s{layout.text.substr(0, begin + array.content.size()), begin};
  std::vector<Value> values;
  values.reserve(std::min(expected, array.content.size() / 2 + 1));
  while (!peek_word(s).empty()) values.push_back(read_number<Value>(s, "a number"));
  if (values.size() != expected) {
    fail_array(layout, array, "wrong_count",
               fmt::format("it holds {} numbers, {} were expected from the numbers of points and "
                           "cells",
                           values.size(), expected));
  }
  return values;
}

template <class Value>
std::vector<Value> read_values(const VtuLayout& layout, const VtuArray& array,
                               std::size_t expected) {
  if (array.is_ascii) return read_text<Value>(layout, array, expected);
  const bool swap = layout.byte_order != std::endian::native;
  const auto read_as = [&]<class Stored>(Stored) {
    return converted<Stored, Value>(decode(layout, array, expected * sizeof(Stored)), swap);
  };
  if (array.type == "Float64") return read_as(double{});
  if (array.type == "Float32") return read_as(float{});
  if (array.type == "Int8") return read_as(std::int8_t{});
  if (array.type == "UInt8") return read_as(std::uint8_t{});
  if (array.type == "Int16") return read_as(std::int16_t{});
  if (array.type == "UInt16") return read_as(std::uint16_t{});
  if (array.type == "Int32") return read_as(std::int32_t{});
  if (array.type == "UInt32") return read_as(std::uint32_t{});
  if (array.type == "Int64") return read_as(std::int64_t{});
  if (array.type == "UInt64") return read_as(std::uint64_t{});
  fail_array(
      layout, array, "bad_attribute",
      fmt::format("type {} is not one of Float32, Float64, Int8 ... UInt64", in_quotes(array.type)),
      "write the array with one of these types");
}

}  // namespace

std::vector<double> read_doubles(const VtuLayout& layout, const VtuArray& array,
                                 std::size_t expected) {
  return read_values<double>(layout, array, expected);
}

std::vector<std::int64_t> read_integers(const VtuLayout& layout, const VtuArray& array,
                                        std::size_t expected) {
  if (array.type.substr(0, 5) == "Float") {
    fail_array(layout, array, "bad_attribute",
               fmt::format("type {} where integers were expected", in_quotes(array.type)),
               "write the array with an integer type");
  }
  return read_values<std::int64_t>(layout, array, expected);
}

}  // namespace sunder::io
