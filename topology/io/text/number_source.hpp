// SPDX-License-Identifier: MIT
// Internal to the readers: numbers one after the other, from text or from raw bytes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "topology/base/whole_number.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {

template <class Value>
Value byte_swapped(Value value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(Value)>>(value);
  std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<Value>(bytes);
}

/// Where numbers come from; sections' names and some counts are text in binary files too.
struct NumberSource {
  Scanner s;
  bool is_binary = false;
  /// Raw numbers have the other byte order than this machine.
  bool swap = false;
};

/// Ends the reading because the bytes end before the expected `what`.
[[noreturn]] void fail_short(const Scanner& s, std::string_view what, std::size_t bytes);

/// The next raw number. Fails with truncated_file.
template <class Value>
Value read_raw(NumberSource& in, std::string_view what) {
  if (in.s.text.size() - in.s.at < sizeof(Value)) fail_short(in.s, what, sizeof(Value));
  Value value;
  std::memcpy(&value, in.s.text.data() + in.s.at, sizeof(Value));
  in.s.at += sizeof(Value);
  return in.swap ? byte_swapped(value) : value;
}

/// The next number: in text any of `Value`, in binary data one stored as `Stored`.
template <class Value, class Stored = Value>
Value read_next(NumberSource& in, std::string_view what) {
  if (!in.is_binary) return read_number<Value>(in.s, what);
  return number_cast<Value>(read_raw<Stored>(in, what));
}

/// A count of things that take at least `least_bytes` of the rest each: of text, or of raw bytes
/// where the source is binary; the count itself is stored as `Stored` there. Fails as `read_count`.
template <class Stored>
std::size_t read_bounded(NumberSource& in, std::string_view what, std::size_t least_text,
                         std::size_t least_raw) {
  if (!in.is_binary) return read_count(in.s, what, least_text);
  const std::size_t at = in.s.at;
  const auto count = read_raw<Stored>(in, what);
  check_count(in.s, at, static_cast<std::int64_t>(count), what, least_raw);
  return static_cast<std::size_t>(count);
}

/// Passes `n` raw bytes, or `words` words of text.
void skip_numbers(NumberSource& in, std::size_t words, std::size_t raw_bytes,
                  std::string_view what);

/// Where the next number stands, blanks of text passed: for messages.
std::size_t place_of_next(NumberSource& in);

}  // namespace sunder::io
