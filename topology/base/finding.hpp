// SPDX-License-Identifier: MIT
// What is wrong with a user's input, said so that the user can mend it; and results that carry it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sunder {

enum class Severity { note, warning, error };

/// The severity's word, as JSON and tables print it: "note", "warning", "error".
constexpr std::string_view to_string(Severity s) {
  return s == Severity::error ? "error" : s == Severity::warning ? "warning" : "note";
}

/// One thing found in a file, a mesh or a scene.
struct Finding {
  /// Stable machine-readable name in snake_case, such as "flat_tetrahedron".
  std::string code;
  Severity severity = Severity::error;
  /// How many cells (or places) show it.
  std::size_t count = 1;
  /// The first few of them, at most `max_ids`: rows counted from 0.
  std::vector<std::int64_t> ids;
  /// What was seen, where, and what was expected.
  std::string text;
  /// What to do about it.
  std::string remedy;
  /// The file it stands in, empty where there is none.
  std::string file;
  /// Line counted from 1; 0 when it is not a line of text.
  std::size_t line = 0;

  static constexpr std::size_t max_ids = 16;
};

/// True when one of the findings is an error.
inline bool has_error(const std::vector<Finding>& findings) {
  for (const Finding& f : findings) {
    if (f.severity == Severity::error) return true;
  }
  return false;
}

/// A value, or the reasons why there is none; warnings and notes may stand beside a value.
template <class T>
struct Result {
  std::optional<T> value;
  std::vector<Finding> findings;

  Result() = default;
  Result(T v) : value(std::move(v)) {}                     // NOLINT: a value is a result
  Result(Finding f) { findings.push_back(std::move(f)); }  // NOLINT: so is a reason
  explicit operator bool() const { return value.has_value(); }
  T& operator*() { return *value; }
  const T& operator*() const { return *value; }
  T* operator->() { return &*value; }
  const T* operator->() const { return &*value; }
};

}  // namespace sunder
