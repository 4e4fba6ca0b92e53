// SPDX-License-Identifier: MIT
#include "apps/sunder/break/quantity.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

#include "apps/scene/reading/length_unit.hpp"

namespace sunder {
namespace {

/// A positive number and the word after it; none without such a number.
std::optional<std::pair<double, std::string_view>> taken_apart(std::string_view text) {
  double number = 0;
  const auto [end, reason] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (reason != std::errc{} || !(number > 0) || !(number < 1e12)) return std::nullopt;
  std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  return std::pair{number, unit};
}

}  // namespace

std::optional<double> length_of(std::string_view text) {
  const auto parts = taken_apart(text);
  if (!parts) return std::nullopt;
  const auto unit = parts->second.empty() ? LengthUnit::m : length_unit_called(parts->second);
  if (!unit) return std::nullopt;
  return parts->first * metres_of(*unit);
}

std::optional<double> speed_of(std::string_view text) {
  const auto parts = taken_apart(text);
  if (!parts) return std::nullopt;
  const auto& [number, unit] = *parts;
  if (unit.empty() || unit == "m/s") return number;
  if (unit == "cm/s") return number * 1e-2;
  if (unit == "mm/s") return number * 1e-3;
  if (unit == "km/h") return number / 3.6;
  return std::nullopt;
}

std::optional<double> time_of(std::string_view text) {
  const auto parts = taken_apart(text);
  if (!parts) return std::nullopt;
  const auto& [number, unit] = *parts;
  if (unit.empty() || unit == "s") return number;
  if (unit == "min") return number * 60;
  if (unit == "h") return number * 3600;
  return std::nullopt;
}

std::optional<ThrownBall> ball_of(std::string_view text) {
  const std::size_t at = text.find('@');
  if (at == std::string_view::npos) return std::nullopt;
  const auto diameter = length_of(text.substr(0, at));
  const auto speed = speed_of(text.substr(at + 1));
  if (!diameter || !speed) return std::nullopt;
  return ThrownBall{*diameter, *speed};
}

std::string check_length(const std::string& text) {
  return length_of(text)
             ? ""
             : fmt::format("'{}' is no length above 0: give 95mm, 3.5cm, 0.2m or 4in", text);
}

std::string check_speed(const std::string& text) {
  return speed_of(text) ? "" : fmt::format("'{}' is no speed above 0: give 20m/s or 30km/h", text);
}

std::string check_time(const std::string& text) {
  return time_of(text) ? "" : fmt::format("'{}' is no time above 0: give 90s, 2min or 1h", text);
}

std::string check_ball(const std::string& text) {
  return ball_of(text) ? "" : fmt::format("'{}' is not DIAMETER@SPEED: give 50mm@20m/s", text);
}

std::string length_words(double metres) {
  if (metres < 1e-9) return "0 mm";  // rounding
  if (metres < 1e-3) return fmt::format("{:.3g} um", metres * 1e6);
  if (metres < 1) return fmt::format("{:.3g} mm", metres * 1e3);
  return fmt::format("{:.3g} m", metres);
}

}  // namespace sunder
