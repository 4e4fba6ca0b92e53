// SPDX-License-Identifier: MIT
// Text for people: names from files cannot move a terminal, and a stream that is full or closed
// loses text without an exception. Everything that the programs print goes through here.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace sunder {

/// The text with every byte escaped that could move a terminal: control characters (of ASCII, and
/// U+0080 to U+009F), marks that turn the direction of writing, and bytes that are not UTF-8, each
/// byte as \x1b. The result is one line: ends of lines and tabs are escaped too.
std::string plain_line(std::string_view text);

/// The same, with ends of lines and tabs as they are.
std::string plain_lines(std::string_view text);

/// JSON text, which is UTF-8, with the characters that `plain_line` would escape as \u009b and so
/// on; they can only stand in its strings.
std::string json_escaped(std::string_view json);

/// A value of nlohmann's JSON as text, in lines where `indent` is not negative. Bytes that are not
/// UTF-8, such as a file's name may have, become U+FFFD; control characters are escaped.
template <class Json>
std::string json_text(const Json& json, int indent = 2) {
  return json_escaped(json.dump(indent, ' ', false, Json::error_handler_t::replace));
}

/// A word as a shell reads it: in quotes where it holds more than letters, digits and / . _ -.
std::string shell_word(std::string_view word);

/// Writes bytes as they are, colours of our own for example, or JSON. Never throws: bytes that a
/// stream does not take are lost, and `output_was_lost` reports it of standard output.
void write_text(std::FILE* stream, std::string_view text) noexcept;

/// Flushes standard output; whether it has not taken all that was written to it so far.
bool output_was_lost() noexcept;

/// Writes `plain_lines(text)`. Throws std::bad_alloc alone.
void print_text(std::FILE* stream, std::string_view text);

/// As fmt::print, through `print_text`.
template <class... Parts>
void print(std::FILE* stream, fmt::format_string<Parts...> format, Parts&&... parts) {
  print_text(stream, fmt::format(format, std::forward<Parts>(parts)...));
}
template <class... Parts>
void print(fmt::format_string<Parts...> format, Parts&&... parts) {
  print_text(stdout, fmt::format(format, std::forward<Parts>(parts)...));
}

}  // namespace sunder
