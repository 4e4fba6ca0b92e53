// SPDX-License-Identifier: MIT
// Holds settings to their descriptions (field.hpp): the range of every key, and the rules between
// keys. A scene's reader and a program that fills settings itself are refused for the same reasons.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "mechanics/state/settings/settings_fields.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// A finding and the key it is about, as `--set` takes it: "bodies.0.material.density".
struct SettingFinding {
  std::string place;
  Finding finding;
};

namespace fields {

/// A number as messages show it, with six digits.
std::string text_of(double number);

/// Whether a number is in the range: not beyond `most_number` nor, where it cannot be below 0,
/// under `least_number`; or the infinity that the range allows.
bool is_allowed(double value, const Range& range);

/// The error out_of_range of the key at `place`; `seen`: its value as the user knows it.
Finding out_of_range(const Key& key, std::string_view place, std::string_view seen, double value);

/// A visitor of descriptions that checks the values it visits. In addition to its description, a
/// struct may have a function `check_together(SettingsCheck&, const T&)` for rules between several
/// of its keys.
class SettingsCheck {
 public:
  SettingsCheck(std::string place, std::vector<SettingFinding>& findings)
      : place_(std::move(place)), findings_(findings) {}

  /// Checks a described struct whole.
  template <class T>
  void object(const T& settings) {
    // Descriptions take the settings by reference, for readers; a check writes nothing.
    describe(*this, const_cast<T&>(settings));
    if constexpr (requires { check_together(*this, settings); }) check_together(*this, settings);
  }

  /// Adds an error about the key `key` of this object, or, where that is empty, about the object.
  /// `what` goes on after the place: "is 3; ...".
  void add(const char* code, std::string_view key, const std::string& what,
           const std::string& remedy);

  template <class T>
  void field(const Key& key, const T& member) {
    value(key, at(key.name), member);
  }
  /// Any length but 0.
  void direction(const Key& key, const Eigen::Vector3d& member);
  template <class T, class Variant>
  void alternative(const Key& key, const T&, const Variant& member) {
    if (const T* chosen = std::get_if<T>(&member)) field(key, *chosen);
  }

 private:
  template <class T>
  static constexpr bool is_described = requires(SettingsCheck& c, T& t) {
    describe(c, t);
  };

  std::string at(std::string_view key) const;
  void number(const Key& key, const std::string& place, double number);
  void rotation(const std::string& place, const Eigen::Quaterniond& rotation);

  template <class T>
  void value(const Key& key, const std::string& place, const T& value) {
    if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T>) {
    } else if constexpr (std::is_arithmetic_v<T>) {
      number(key, place, static_cast<double>(value));
    } else if constexpr (is_described<T>) {
      SettingsCheck(place, findings_).object(value);
    }
  }
  void value(const Key& key, const std::string& place, const Eigen::Vector3d& vector) {
    for (int i = 0; i < 3; ++i) number(key, place + "." + std::to_string(i), vector[i]);
  }
  void value(const Key&, const std::string& place, const Eigen::Quaterniond& turn) {
    rotation(place, turn);
  }
  template <class T>
  void value(const Key& key, const std::string& place, const std::optional<T>& member) {
    if (member) value(key, place, *member);
  }
  template <class T>
  void value(const Key& key, const std::string& place, const std::vector<T>& members) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      value(key, place + "." + std::to_string(i), members[i]);
    }
  }

  std::string place_;
  std::vector<SettingFinding>& findings_;
};

}  // namespace fields

/// Faults of settings, all of them, as errors with the value, the allowed range and a remedy:
/// out_of_range, zero_direction, not_a_rotation, and those of the rules between keys. `place` names
/// the settings in the texts, such as "bodies.0.material"; empty for a scene.
template <class T>
std::vector<SettingFinding> setting_findings(const T& settings, std::string place) {
  std::vector<SettingFinding> findings;
  fields::SettingsCheck(std::move(place), findings).object(settings);
  return findings;
}

/// The same without places, which the texts name too.
template <class T>
std::vector<Finding> check_settings(const T& settings, std::string place) {
  std::vector<Finding> findings;
  for (SettingFinding& f : setting_findings(settings, std::move(place))) {
    findings.push_back(std::move(f.finding));
  }
  return findings;
}

/// damping_not_supported, model_not_supported: settings that only some integrators and models take.
void check_together(fields::SettingsCheck& check, const IntegratorSettings& settings);
}  // namespace sunder
