// SPDX-License-Identifier: MIT
// The wording of refused settings, and the rules between keys of an integrator.
#include "mechanics/state/settings/check_settings.hpp"

#include <cmath>
#include <cstdio>

namespace sunder {
namespace fields {
namespace {

std::string allowed(const Range& range) {
  std::string text;
  if (range.low > -infinity) {
    text = (range.without_low ? "above " : "at least ") + text_of(range.low);
  }
  if (range.high < infinity) {
    text += (text.empty() ? "at most " : " and at most ") + text_of(range.high);
  }
  return text.empty() ? "a finite number" : text;
}

/// Whether squares and products of the number, and quotients by it, stay finite.
bool has_usual_size(double value, const Range& range) {
  const double size = std::abs(value);
  return size <= most_number && !(range.low >= 0 && size > 0 && size < least_number);
}

std::string allowed_sizes(const Range& range) {
  const std::string most = "at most " + text_of(most_number);
  return (range.low >= 0 ? "at least " + text_of(least_number) + " and " + most : most) +
         " in size";
}

}  // namespace

std::string text_of(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

bool is_allowed(double value, const Range& range) {
  if (!std::isfinite(value)) return range.with_infinity && value == infinity;
  if (!has_usual_size(value, range)) return false;
  return value <= range.high && (range.without_low ? value > range.low : value >= range.low);
}

Finding out_of_range(const Key& key, std::string_view place, std::string_view seen, double value) {
  const bool has_wrong_size = std::isfinite(value) && !has_usual_size(value, key.range) &&
                              !(value < key.range.low) && !(value > key.range.high);
  const std::string wanted = has_wrong_size ? allowed_sizes(key.range) : allowed(key.range);
  const std::string unit = key.unit.empty() ? "" : " " + std::string(key.unit);
  Finding finding;
  finding.code = "out_of_range";
  finding.text.append(place).append(" is ").append(seen).append(unit);
  finding.text.append("; allowed is ").append(wanted);
  finding.remedy = "give a value " + wanted + unit;
  if (!key.remedy.empty()) finding.remedy += ": " + std::string(key.remedy);
  return finding;
}

std::string SettingsCheck::at(std::string_view key) const {
  return place_.empty() || key.empty() ? place_ + std::string(key)
                                       : place_ + "." + std::string(key);
}

void SettingsCheck::add(const char* code, std::string_view key, const std::string& what,
                        const std::string& remedy) {
  const std::string place = at(key);
  Finding finding;
  finding.code = code;
  finding.text = (place.empty() ? "the scene" : place) + " " + what;
  finding.remedy = remedy;
  findings_.push_back({place, std::move(finding)});
}

void SettingsCheck::number(const Key& key, const std::string& place, double number) {
  if (is_allowed(number, key.range)) return;
  findings_.push_back({place, out_of_range(key, place, text_of(number), number)});
}

void SettingsCheck::direction(const Key& key, const Eigen::Vector3d& member) {
  if (!member.allFinite()) return field(key, member);
  if (member.isZero(0)) {
    add("zero_direction", key.name, "is [0, 0, 0], which points nowhere",
        "give three numbers that are not all 0");
  }
}

void SettingsCheck::rotation(const std::string& place, const Eigen::Quaterniond& rotation) {
  if (std::abs(rotation.norm() - 1) < 1e-9) return;
  Finding finding;
  finding.code = "not_a_rotation";
  finding.text = place + " is a quaternion of length " + text_of(rotation.norm());
  finding.remedy = "normalise the quaternion";
  findings_.push_back({place, std::move(finding)});
}

}  // namespace fields

void check_together(fields::SettingsCheck& check, const IntegratorSettings& settings) {
  const bool corotational = settings.model == ElasticModel::corotational;
  const bool takes_both = settings.integrator == Integrator::floating_frame ||
                          (settings.integrator == Integrator::implicit_euler && !corotational);
  if (settings.damping.mass_factor != 0 && !takes_both) {
    check.add(
        "damping_not_supported", "damping.mass_factor",
        "is set, but only the method floating_frame has it, and implicit_euler with the model "
        "rigid_reference",
        "leave it out, or take floating_frame");
  }
  if (settings.damping.stiffness_factor != 0 && !takes_both && !is_explicit(settings.integrator)) {
    check.add("damping_not_supported", "damping.stiffness_factor",
              "is set, but only the methods floating_frame, verlet and sub_stepped have it, and "
              "implicit_euler with the model rigid_reference",
              "leave it out, or take one of these");
  }
  if (corotational && is_floating(settings.integrator)) {
    check.add("model_not_supported", "method",
              "moves each body in one frame, which is the model rigid_reference; the model is "
              "corotational",
              "take the method implicit_euler, or leave the model out");
  }
}

}  // namespace sunder
