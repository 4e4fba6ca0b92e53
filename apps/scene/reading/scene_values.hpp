// SPDX-License-Identifier: MIT
// Single values of scene files: numbers, texts, vectors, names of files. Objects and lists of them
// are read by scene_json.cpp.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <concepts>
#include <memory>
#include <string>
#include <vector>

#include "apps/scene/scene_fields.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/scene/scene_text.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder::reading {

using fields::Key;
using nlohmann::json;

/// The text, the files and the findings of a scene that is read.
struct Context {
  const SceneText& text;
  const SceneFiles& files;
  std::vector<Finding>& findings;

  /// Line of a value, or of the nearest one around it that the file has.
  std::size_t line_of(std::string pointer) const;

  /// Adds an error about the value at `pointer`; `what` goes on after the place.
  void add(const std::string& code, const std::string& pointer, const std::string& what,
           const std::string& remedy) const;

  /// The same with the line of its place.
  void add(Finding finding, const std::string& pointer) const;

  void wrong_type(const json& value, const std::string& pointer, const char* wanted) const;
};

/// Reads one number; false after a finding.
bool read_number(const Context& c, const Key& key, const json& value, const std::string& at,
                 double& number);

/// Reads a vector whose length is of no importance, and gives it length 1.
void read_direction(const Context& c, const Key& key, const json& value, const std::string& at,
                    Eigen::Vector3d& member);

// Each reads `value`, which stands at the pointer `at`, into `member`, or adds findings.
void read(const Context& c, const Key& key, const json& value, const std::string& at,
          double& member);
void read(const Context& c, const Key& key, const json& value, const std::string& at, bool& member);
void read(const Context& c, const Key& key, const json& value, const std::string& at,
          std::string& member);
void read(const Context& c, const Key& key, const json& value, const std::string& at,
          Eigen::Vector3d& member);
void read(const Context& c, const Key& key, const json& value, const std::string& at,
          TetMesh& member);
void read(const Context& c, const Key& key, const json& value, const std::string& at,
          std::shared_ptr<const SolidSurface>& member);
void read(const Context& c, const Key& key, const json& value, const std::string& at,
          FaceList& member);
void read(const Context& c, const Key& key, const json& value, const std::string& at,
          RegionName& member);
void read(const Context& c, const Key& key, const json& value, const std::string& at,
          HistorySettings& member);

template <std::integral Integer>
void read(const Context& c, const Key& key, const json& value, const std::string& at,
          Integer& member) {
  double number = 0;
  if (!value.is_number() || std::floor(value.get<double>()) != value.get<double>()) {
    c.wrong_type(value, at, "a whole number");
  } else if (read_number(c, key, value, at, number)) {
    member = whole_number<Integer>(number);
  }
}

/// A value that one of the functions above reads; everything else is an enum, a list or an object.
template <class T>
concept Plain = requires(const Context& c, const Key& k, const json& j, T& t) {
  read(c, k, j, std::string(), t);
};

}  // namespace sunder::reading
