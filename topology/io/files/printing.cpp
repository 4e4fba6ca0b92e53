// SPDX-License-Identifier: MIT
// Escaping and writing of text for people.
#include "topology/io/files/printing.hpp"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdint>

namespace sunder {
namespace {

/// Whether standard output did not take something.
std::atomic<bool> is_output_lost = false;

/// The length of the character with which the text begins, and its number; length 0: no UTF-8.
struct Utf8 {
  std::size_t length = 0;
  std::uint32_t code = 0;
};

Utf8 first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {1, lead};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
  std::uint32_t code = lead & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_half = code >= 0xd800 && code < 0xe000;
  return code < least[length] || code > 0x10ffff || is_half ? Utf8{} : Utf8{length, code};
}

bool moves_a_terminal(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x202a && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069) || code == 0x2028 || code == 0x2029;
}

std::string plain(std::string_view text, bool keeps_lines) {
  std::string all;
  all.reserve(text.size());
  while (!text.empty()) {
    const Utf8 c = first_character(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(c.length, 1));
    const bool stays = c.length > 0 && (!moves_a_terminal(c.code) ||
                                        (keeps_lines && (c.code == '\n' || c.code == '\t')));
    if (stays) {
      all += bytes;
    } else {
      for (const char b : bytes) all += fmt::format("\\x{:02x}", static_cast<unsigned char>(b));
    }
    text.remove_prefix(bytes.size());
  }
  return all;
}

}  // namespace

std::string plain_line(std::string_view text) { return plain(text, false); }

std::string plain_lines(std::string_view text) { return plain(text, true); }

std::string json_escaped(std::string_view json) {
  std::string all;
  all.reserve(json.size());
  while (!json.empty()) {
    const Utf8 c = first_character(json);
    const std::string_view bytes = json.substr(0, std::max<std::size_t>(c.length, 1));
    if (c.code >= 0x7f && moves_a_terminal(c.code)) {
      all += fmt::format("\\u{:04x}", c.code);  // below 0x20 JSON's writers escape already
    } else {
      all += bytes;
    }
    json.remove_prefix(bytes.size());
  }
  return all;
}

std::string shell_word(std::string_view word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("/._-").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

void write_text(std::FILE* stream, std::string_view text) noexcept {
  const std::size_t taken = std::fwrite(text.data(), 1, text.size(), stream);
  if (taken < text.size() && stream == stdout) is_output_lost = true;
}

bool output_was_lost() noexcept {
  return std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || is_output_lost;
}

void print_text(std::FILE* stream, std::string_view text) { write_text(stream, plain_lines(text)); }

}  // namespace sunder
