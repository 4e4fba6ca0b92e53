// SPDX-License-Identifier: MIT
// Parsing of JSON with line numbers through nlohmann's SAX interface, `--set`, and nearest words.
#include "apps/scene/scene_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

#include "topology/base/counted.hpp"
#include "topology/base/limits.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

using nlohmann::json;

/// Walks over characters and counts them where its owner can see: the only way to learn from
/// nlohmann's parser where an event happens.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at = nullptr;
  std::size_t* count = nullptr;

  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    ++at;
    if (count) ++*count;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) {
    return a.at == b.at;
  }
  friend bool operator!=(const CountingIterator& a, const CountingIterator& b) {
    return a.at != b.at;
  }
};

/// Line and column (both from 1) of byte `offset`.
std::pair<std::size_t, std::size_t> place_of_byte(std::string_view bytes, std::size_t offset) {
  const std::string_view before = bytes.substr(0, std::min(offset, bytes.size()));
  const std::size_t line = 1 + static_cast<std::size_t>(std::ranges::count(before, '\n'));
  const std::size_t start = before.rfind('\n');
  return {line, before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1};
}

/// Builds the document and notes lines and repeated keys on the way (SAX events of nlohmann::json).
class Builder {
 public:
  using number_integer_t = json::number_integer_t;
  using number_unsigned_t = json::number_unsigned_t;
  using number_float_t = json::number_float_t;
  using string_t = json::string_t;
  using binary_t = json::binary_t;

  Builder(SceneText& text, std::vector<Finding>& findings, std::string_view bytes)
      : text_(text), findings_(findings), bytes_(bytes) {}

  std::size_t read = 0;

  bool null() { return put(json()); }
  bool boolean(bool v) { return put(v); }
  bool number_integer(number_integer_t v) { return put(v); }
  bool number_unsigned(number_unsigned_t v) { return put(v); }
  bool number_float(number_float_t v, const string_t&) { return put(v); }
  bool string(string_t& v) { return put(std::move(v)); }
  bool binary(binary_t&) { return false; }
  bool start_object(std::size_t) { return open(json::object()); }
  bool start_array(std::size_t) { return open(json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(string_t& k) {
    if (open_.back()->contains(k)) {
      add("repeated_key", read,
          fmt::format("the key \"{}\" of {} stands here a second time", k,
                      here().empty() ? "the scene" : dotted(here())),
          "keep one of them");
    }
    key_ = k;
    return true;
  }

  bool parse_error(std::size_t offset, const std::string&, const json::exception& e) {
    std::string what = e.what();
    // nlohmann prefixes its code and place; the place is said in our own words.
    if (const std::size_t colon = what.find(": "); colon != std::string::npos) {
      what.erase(0, colon + 2);
    }
    add("syntax_error", offset == 0 ? 0 : offset - 1, "not valid JSON: " + what,
        "mend the text there; JSON knows no comments and no comma after the last value");
    return false;
  }

 private:
  const std::string& here() const { return paths_.back(); }

  void add(const char* code, std::size_t offset, const std::string& what, const char* remedy) {
    const auto [line, column] = place_of_byte(bytes_, offset);
    findings_.push_back({.code = code,
                         .ids = {},
                         .text = fmt::format("line {}, column {}: {}", line, column, what),
                         .remedy = remedy,
                         .file = text_.file,
                         .line = line});
  }

  json* put(json value) {
    if (open_.empty()) {
      text_.root = std::move(value);
      last_path_.clear();
      return &text_.root;
    }
    json& parent = *open_.back();
    // The lexer may have read one character past a number, never past its line's end.
    if (parent.is_array()) {
      last_path_ = here() + "/" + std::to_string(parent.size());
      parent.push_back(std::move(value));
    } else {
      last_path_ = here() + "/" + pointer_token(key_);
      parent[key_] = std::move(value);
    }
    text_.line[last_path_] = place_of_byte_cached(read == 0 ? 0 : read - 1);
    return parent.is_array() ? &parent.back() : &parent[key_];
  }

  bool open(json value) {
    if (open_.size() >= limits().scene_levels) {
      add("nested_too_deeply", read,
          fmt::format("more than {} of nesting", counted(limits().scene_levels, "level")),
          "a scene needs six levels: look for a bracket too many");
      return false;
    }
    open_.push_back(put(std::move(value)));
    paths_.push_back(last_path_);
    return true;
  }

  bool close() {
    open_.pop_back();
    paths_.pop_back();
    return true;
  }

  /// Lines are asked for in growing order: counted on from the last question.
  std::size_t place_of_byte_cached(std::size_t offset) {
    for (; counted_ < std::min(offset, bytes_.size()); ++counted_) {
      line_ += bytes_[counted_] == '\n';
    }
    return line_;
  }

  SceneText& text_;
  std::vector<Finding>& findings_;
  std::string_view bytes_;
  std::vector<json*> open_;
  std::vector<std::string> paths_;
  std::string key_, last_path_;
  std::size_t counted_ = 0, line_ = 1;
};

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> tokens(1);
  for (const char c : path) {
    if (c == '.') {
      tokens.emplace_back();
    } else {
      tokens.back() += c;
    }
  }
  return tokens;
}

Finding bad_setting(const std::string& setting, const std::string& why, const std::string& remedy) {
  return {.code = "bad_setting",
          .ids = {},
          .text = fmt::format("--set {}: {}", setting, why),
          .remedy = remedy,
          .file = ""};
}

/// The row that `token` names in `array`, or an error.
Result<std::size_t> array_row(const json& array, const std::string& token,
                              const std::string& setting) {
  std::size_t row = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), row);
  if (error != std::errc() || end != token.data() + token.size() || row >= array.size()) {
    return bad_setting(setting,
                       fmt::format("\"{}\" is not a row of an array of {}", token, array.size()),
                       array.empty() ? "the array is empty: set it as a whole"
                                     : fmt::format("use 0 to {}", array.size() - 1));
  }
  return row;
}

}  // namespace

Result<SceneText> parse_scene_text(std::string_view bytes, const std::string& file) {
  Result<SceneText> result;
  SceneText text;
  text.file = file;
  Builder builder(text, result.findings, bytes);
  const CountingIterator begin{bytes.data(), &builder.read};
  const CountingIterator end{bytes.data() + bytes.size(), nullptr};
  if (json::sax_parse(begin, end, &builder) && !has_error(result.findings)) {
    result.value = std::move(text);
  }
  return result;
}

std::vector<Finding> apply_setting(SceneText& text, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    return {bad_setting(setting, "there is no key or no `=`",
                        "write --set key=value, such as --set gravity.ramp_time=2")};
  }
  const std::vector<std::string> path = split_path(setting.substr(0, equals));
  if (path.size() > limits().scene_levels) {
    return {bad_setting(setting, fmt::format("the path has {}", counted(path.size(), "step")),
                        "no key of a scene lies deeper than six steps")};
  }
  json* at = &text.root;
  std::string pointer;
  for (const std::string& token : path) {
    (pointer += '/') += pointer_token(token);
    if (at->is_array()) {
      const Result<std::size_t> row = array_row(*at, token, setting);
      if (!row) return row.findings;
      at = &(*at)[*row];
    } else if (at->is_object() || at->is_null()) {
      if (at->is_null()) *at = json::object();  // a null cannot become one where memory runs out
      at = &(*at)[token];
    } else {
      return {bad_setting(setting,
                          fmt::format("{} is {}, which has no keys",
                                      dotted(pointer.substr(0, pointer.rfind('/'))), shown(*at)),
                          "shorten the path")};
    }
  }
  const std::string value = setting.substr(equals + 1);
  Result<SceneText> parsed = parse_scene_text(value, "");
  *at = parsed ? std::move(parsed->root) : json(value);
  std::erase_if(text.line, [&](const auto& entry) {
    return entry.first == pointer || entry.first.starts_with(pointer + "/");
  });
  return {};
}

std::string pointer_token(const std::string& key) {
  std::string token;
  for (const char c : key) {
    token += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  }
  return token;
}

std::vector<std::string> given_keys(const nlohmann::json& root) {
  std::vector<std::string> keys;
  if (!root.is_object() && !root.is_array()) return keys;
  // Entries of an array have their numbers for keys.
  for (const auto& [key, value] : root.items()) {
    if (root.is_object()) keys.push_back(key);
    for (const std::string& inner : given_keys(value)) keys.push_back(key + "." + inner);
  }
  return keys;
}

std::string dotted(const std::string& pointer) {
  std::string path = pointer.empty() ? pointer : pointer.substr(1);
  std::ranges::replace(path, '/', '.');
  return path;
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  std::size_t best = word.size() / 2 + 1;
  std::string nearest;
  for (const std::string& candidate : known) {
    // Levenshtein's distance with swapped neighbours as one change, by rows of its table.
    std::vector<std::size_t> before, last, row(candidate.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < word.size(); ++i) {
      before = std::exchange(last, row);
      row[0] = i + 1;
      for (std::size_t j = 0; j < candidate.size(); ++j) {
        const std::size_t replace = last[j] + (word[i] != candidate[j]);
        row[j + 1] = std::min({replace, row[j] + 1, last[j + 1] + 1});
        const bool is_swapped =
            i > 0 && j > 0 && word[i] == candidate[j - 1] && word[i - 1] == candidate[j];
        if (is_swapped) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
      }
    }
    if (row.back() < best) {
      best = row.back();
      nearest = candidate;
    }
  }
  return nearest;
}

std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

void make_plain(std::vector<Finding>& findings) {
  for (Finding& f : findings) {
    f.text = plain_line(f.text);
    f.remedy = plain_line(f.remedy);
  }
}

}  // namespace sunder
