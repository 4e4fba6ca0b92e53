// SPDX-License-Identifier: MIT
// Faults of a user's input, each with its remedy, and results that carry them.
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

/// One fault or remark about a file, a mesh or a scene.
struct Finding {
  /// Stable machine-readable name in snake_case, such as "flat_tetrahedron".
  std::string code;
  Severity severity = Severity::error;
  /// Number of cells or places that show it.
  std::size_t count = 1;
  /// The first of these cells or places, at most `max_ids`: rows counted from 0.
  std::vector<std::int64_t> ids;
  /// The observation, its place, and the expected value.
  std::string text;
  /// The remedy.
  std::string remedy;
  /// The file with the fault; empty without a file.
  std::string file;
  /// Line counted from 1; 0 if the fault has no line of text.
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

/// A value, or the errors that explain its absence. Warnings and notes may accompany a value.
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
