// SPDX-License-Identifier: MIT
// Ends of binary data, and passing numbers over.
#include "topology/io/text/number_source.hpp"

#include <fmt/format.h>

namespace sunder::io {

void fail_short(const Scanner& s, std::string_view what, std::size_t bytes) {
  fail(s.text, s.text.size(),
       {.code = "truncated_file",
        .text = fmt::format("the file ends after {} bytes; at byte {} {} of {} bytes was expected",
                            s.text.size(), s.at, what, bytes),
        .remedy = "the file was cut short: copy or write it again"});
}

void skip_numbers(NumberSource& in, std::size_t words, std::size_t raw_bytes,
                  std::string_view what) {
  if (!in.is_binary) return skip_words(in.s, words, what);
  if (in.s.text.size() - in.s.at < raw_bytes) fail_short(in.s, what, raw_bytes);
  in.s.at += raw_bytes;
}

std::size_t place_of_next(NumberSource& in) {
  if (!in.is_binary) skip_blanks(in.s);
  return in.s.at;
}

}  // namespace sunder::io
