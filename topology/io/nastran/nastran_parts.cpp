// SPDX-License-Identifier: MIT
// Nastran's decks: their signs, the place of their bulk data, the lines before these.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

#include "topology/io/abaqus/abaqus_lines.hpp"
#include "topology/io/nastran/nastran.hpp"
#include "topology/io/nastran/nastran_cards.hpp"
#include "topology/io/nastran/nastran_reader.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

constexpr int deepest_include = 8;

std::size_t next_line_of(std::string_view text, std::size_t at) {
  return std::min(text.find('\n', at), text.size() - 1) + 1;
}

/// Superelements have numbers of their own each.
void refuse_superelements(std::string_view text, std::size_t at) {
  std::string line(card_line(text, at));
  std::ranges::transform(line, line.begin(), [](unsigned char c) { return std::toupper(c); });
  if (line.find("SUPER") == std::string::npos && line.find("AUXMODEL") == std::string::npos) return;
  fail(text, at,
       {.code = "unsupported_keyword",
        .text = fmt::format("{} begins the bulk data of another part (a superelement): its points "
                            "and elements have their own numbers",
                            in_quotes(trimmed(card_line(text, at)))),
        .remedy =
            "write the model as one part, with one BEGIN BULK, or give each part its own file"});
}

[[noreturn]] void fail_include(std::string_view text, std::size_t at, std::string_view code,
                               std::string words, std::string_view remedy) {
  fail(text, at,
       {.code = std::string(code), .text = std::move(words), .remedy = std::string(remedy)});
}

void find_parts(NastranReader& r, std::uint32_t file, std::size_t begin, int depth);

/// INCLUDE 'name': its bulk data stand in place of the line. Gives where the next line begins.
std::size_t include(NastranReader& r, std::uint32_t file, std::size_t at, int depth) {
  const std::string_view text = r.files[file].text;
  const std::size_t end = std::min(text.find('\n', at), text.size());
  std::string_view name = trimmed(trimmed(text.substr(at, end - at)).substr(7));
  const char quote = name.empty() ? ' ' : name.front();
  if (quote == '\'' || quote == '"') {
    name = name.substr(1, std::min(name.find(quote, 1), name.size()) - 1);
  }
  if (name.empty()) {
    fail_include(text, at, "bad_keyword", "INCLUDE names no file",
                 "name it in quotes, in the same line");
  }
  const std::string path = std::filesystem::path(name).lexically_normal().string();
  const bool is_known =
      path == r.source.name ||
      std::ranges::any_of(r.files, [&](const NastranText& f) { return f.name == path; });
  if (is_known || depth >= deepest_include) {
    fail_include(text, at, "include_cycle",
                 fmt::format("{} is included {}", in_quotes(path),
                             is_known ? "a second time" : "too deeply"),
                 "include every file once");
  }
  std::optional<std::string> other = other_text(r.source, path);
  if (!other) {
    fail_include(text, at, "missing_file",
                 fmt::format("{} is not there, which this file includes", in_quotes(path)),
                 "put it beside the mesh");
  }
  r.included.push_back(std::move(*other));
  r.files.push_back({path, r.included.back()});
  in_file(r.draft, path, r.included.back(),
          [&] { find_parts(r, static_cast<std::uint32_t>(r.files.size() - 1), 0, depth + 1); });
  return end + 1;
}

/// The cards of a file from byte `begin` on, up to ENDDATA.
void find_parts(NastranReader& r, std::uint32_t file, std::size_t begin, int depth) {
  const std::string_view text = r.files[file].text;
  const auto add = [&](std::size_t end) {
    if (end > begin) r.parts.push_back({file, begin, end});
  };
  std::size_t next = begin;
  while (next < text.size() && !r.is_ended) {
    const std::size_t at = next;
    next = next_line_of(text, at);
    const char first = text[std::min(text.find_first_not_of(" \t", at), text.size() - 1)];
    if (std::string_view("IiEeBb").find(first) == std::string_view::npos) continue;
    const std::string word = card_word(card_line(text, at));
    if (word == "BEGIN") refuse_superelements(text, at);
    if (word == "INCLUDE") {
      add(at);
      begin = next = include(r, file, at, depth);
    } else if (word == "ENDDATA") {
      add(at);
      begin = text.size();
      r.is_ended = true;
    }
  }
  add(text.size());
}

/// Where the line BEGIN BULK stands; none where the file has none.
std::optional<std::size_t> begin_of_bulk(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); at = next_line_of(text, at)) {
    if (card_word(card_line(text, at)) == "BEGIN") return at;
  }
  return std::nullopt;
}

/// Commands of solution and output; titles and marks are no commands.
void skip_control(NastranReader& r, std::size_t end) {
  constexpr std::string_view silent[] = {"CEND",  "ID",   "TITLE",    "SUBTITLE",
                                         "LABEL", "ECHO", "MAXLINES", "LINE"};
  const std::string_view text = r.files[0].text;
  bool goes_on = false;
  for (std::size_t at = 0; at < end; at = next_line_of(text, at)) {
    const std::string_view line = trimmed(card_line(text, at));
    if (line.empty()) continue;
    const std::string word = card_word(line);
    const bool is_told = !goes_on && std::ranges::find(silent, word) == std::end(silent);
    goes_on = line.ends_with(',');
    if (is_told) add_skipped(r.draft, "lines before BEGIN BULK", word, at);
  }
}

/// Raw data has bytes that no line of text has.
bool is_text(std::string_view line) {
  return std::ranges::none_of(
      line, [](char c) { return static_cast<unsigned char>(c) < ' ' && c != '\t'; });
}

/// Executive and case control have a word at the beginning of each line, or go on behind a comma.
bool may_be_control(std::string_view line, bool goes_on) {
  constexpr std::size_t longest = 200;
  const char c = line.front();
  return line.size() <= longest && is_text(line) &&
         (goes_on || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'));
}

}  // namespace

void find_bulk_data(NastranReader& r) {
  const std::string_view text = r.files[0].text;
  const std::optional<std::size_t> begin = begin_of_bulk(text);
  if (begin) {
    refuse_superelements(text, *begin);
    skip_control(r, *begin);
  }
  find_parts(r, 0, begin ? next_line_of(text, *begin) : 0, 0);
}

bool is_nastran(std::string_view text) {
  constexpr std::size_t most_lines = 1000;
  bool is_first = true, goes_on = false;
  for (std::size_t at = 0, n = 0; at < text.size() && n < most_lines; at = next_line_of(text, at)) {
    const std::string_view line = trimmed(card_line(text, at));
    if (line.empty()) continue;
    ++n;
    const std::string word = card_word(line);
    const bool is_of_mesh = word == "GRID" || nastran_type(word) != nullptr;
    if (word == "BEGIN" || is_of_mesh || (is_first && is_bulk_card(word))) return true;
    if (!may_be_control(line, goes_on)) return false;
    goes_on = line.ends_with(',');
    is_first = false;
  }
  return false;
}

}  // namespace sunder::io
