// SPDX-License-Identifier: MIT
// Internal to the writers: numbers one after the other, as text or as raw bytes.
#pragma once

#include <fmt/compile.h>

#include <bit>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>

#include "topology/io/text/number_source.hpp"

namespace sunder::io {

/// A file while it is written. Doubles become their shortest text that reads back to the same bits.
struct NumberSink {
  std::string bytes;
  bool is_binary = false;
};

/// Appends a number as text, whatever the sink is.
template <class Number>
requires std::is_arithmetic_v<Number>
void put_text(NumberSink& out, Number number) {
  // std::to_chars writes 2e-04 for 0.0002.
  fmt::format_to(std::back_inserter(out.bytes), FMT_COMPILE("{}"), number);
}

inline void put_text(NumberSink& out, std::string_view text) { out.bytes += text; }

/// Appends a raw number, stored as `Stored`.
template <class Stored, class Number>
void put_raw(NumberSink& out, Number number) {
  const auto stored = number_cast<Stored>(number);
  out.bytes.append(reinterpret_cast<const char*>(&stored), sizeof stored);
}

/// Appends a raw number in little-endian order, whatever this machine's is.
template <class Stored>
void put_little(NumberSink& out, Stored number) {
  put_raw<Stored>(out, std::endian::native == std::endian::big ? byte_swapped(number) : number);
}

/// Appends a number and, in text, `after` it.
template <class Stored, class Number>
void put(NumberSink& out, Number number, char after = ' ') {
  if (out.is_binary) return put_raw<Stored>(out, number);
  put_text(out, number);
  out.bytes += after;
}

}  // namespace sunder::io
