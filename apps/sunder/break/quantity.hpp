// SPDX-License-Identifier: MIT
// Lengths and speeds as people write them on a command line: 95mm, 20m/s.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sunder {

/// A length in m from a positive number and a unit (m, cm, mm, um, in, ft); without a unit m. None
/// where it is not such a text.
std::optional<double> length_of(std::string_view text);

/// A speed in m/s from a positive number and a unit (m/s, cm/s, mm/s, km/h); without a unit m/s.
std::optional<double> speed_of(std::string_view text);

/// A time in s from a positive number and a unit (s, min, h); without a unit s.
std::optional<double> time_of(std::string_view text);

/// A ball of a diameter (m) with a speed (m/s).
struct ThrownBall {
  double diameter = 0, speed = 0;
};

/// A ball from DIAMETER@SPEED, such as 50mm@20m/s.
std::optional<ThrownBall> ball_of(std::string_view text);

/// Why an option's value is no length, no speed, no time, no ball; empty where it is one.
std::string check_length(const std::string& text);
std::string check_speed(const std::string& text);
std::string check_time(const std::string& text);
std::string check_ball(const std::string& text);

/// A length with the unit that suits it: "95 mm", "1.2 m", "0 mm".
std::string length_words(double metres);

}  // namespace sunder
