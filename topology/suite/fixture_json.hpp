// SPDX-License-Identifier: MIT
// Internal to the reader of fixtures: a JSON value that knows where it stands, and complaints.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "topology/finding.hpp"
#include "topology/suite/fixture.hpp"

namespace sunder::suite {

/// A fixture file while it is read.
struct JsonFile {
  std::filesystem::path path;
  std::vector<Finding> findings;
};

/// A value and the values around it, so that its pointer is only spelled out for a complaint.
/// Needs: `around` outlives it.
struct JsonAt {
  const nlohmann::json* value;
  JsonFile* file;
  const JsonAt* around = nullptr;
  /// Its key in an object around it, its row in an array.
  std::string_view key = {};
  std::size_t row = 0;
};

/// RFC 6901 pointer: "/cases/0/body/points/3". "/" stands for the whole document, too.
std::string pointer_of(const JsonAt& at);

/// Notes a bad_fixture finding at a place. Returns false, for readers to hand on.
bool complain(const JsonAt& at, const std::string& text);

/// Complains that something else was expected; shows what stands there.
bool expect(const JsonAt& at, std::string_view what);

/// Whether the value is an object with all of `required` and nothing but those and `optional`.
bool is_object_of(const JsonAt& at, std::initializer_list<std::string_view> required,
                  std::initializer_list<std::string_view> optional = {});

/// A member of an object; nothing when it is not there. Needs: is_object_of.
std::optional<JsonAt> member(const JsonAt& at, std::string_view key);
JsonAt element(const JsonAt& at, std::size_t row);

// Each reads a value of its kind; false after a complaint.
bool read(const JsonAt& at, bool& value);
bool read(const JsonAt& at, std::uint64_t& value);
bool read(const JsonAt& at, std::uint32_t& value);
bool read(const JsonAt& at, int& value);
bool read(const JsonAt& at, std::ptrdiff_t& value);
/// null stands for NaN, which JSON has no number for.
bool read(const JsonAt& at, double& value);
bool read(const JsonAt& at, std::string& value);

template <class T, std::size_t N>
bool read(const JsonAt& at, std::array<T, N>& values) {
  if (!at.value->is_array() || at.value->size() != N) {
    return expect(at, "an array of " + std::to_string(N));
  }
  bool fine = true;
  for (std::size_t i = 0; i < N; ++i) fine = read(element(at, i), values[i]) && fine;
  return fine;
}

template <class T>
bool read(const JsonAt& at, std::vector<T>& values) {
  if (!at.value->is_array()) return expect(at, "an array");
  values.resize(at.value->size());
  bool fine = true;
  for (std::size_t i = 0; i < values.size(); ++i) fine = read(element(at, i), values[i]) && fine;
  return fine;
}

/// Reads a member where it is there.
template <class T>
bool read_member(const JsonAt& at, std::string_view key, T& value) {
  const std::optional<JsonAt> there = member(at, key);
  return !there || read(*there, value);
}

template <class T>
bool read_member(const JsonAt& at, std::string_view key, std::optional<T>& value) {
  const std::optional<JsonAt> there = member(at, key);
  return !there || read(*there, value.emplace());
}

bool read(const JsonAt& at, CellCounts& counts);
bool read(const JsonAt& at, IntegerHomology& homology);
bool read(const JsonAt& at, SplitAnswer& answer);
bool read(const JsonAt& at, Expected& expected);
bool read(const JsonAt& at, KnownDifference& difference);

/// One operation with its "after". Needs: an accepted body, against which its faces and corners are
/// held.
bool read(const JsonAt& at, const TetMesh& body, ExpectedOperation& operation);

}  // namespace sunder::suite
