// SPDX-License-Identifier: MIT
// Lengths, speeds and balls on the command line.
#include "apps/sunder/break/quantity.hpp"

#include <catch2/catch.hpp>

using namespace sunder;

TEST_CASE("lengths and speeds have units, and SI without one", "[break]") {
  CHECK(length_of("95mm") == Approx(0.095));
  CHECK(length_of("3.5 cm") == Approx(0.035));
  CHECK(length_of("1m") == Approx(1));
  CHECK(length_of("0.2") == Approx(0.2));
  CHECK(length_of("4in") == Approx(0.1016));
  CHECK(speed_of("20m/s") == Approx(20));
  CHECK(speed_of("36km/h") == Approx(10));
  CHECK(speed_of("5") == Approx(5));
  for (const char* text :
       {"", "mm", "-1m", "0", "1 parsec", "1m/s", "nan", "inf", "1e300m", "1,5m"}) {
    INFO(text);
    CHECK_FALSE(length_of(text));
    CHECK_FALSE(check_length(text).empty());
  }
  for (const char* text : {"", "m/s", "-1", "0m/s", "1mph", "3m"}) {
    INFO(text);
    CHECK_FALSE(speed_of(text));
    CHECK_FALSE(check_speed(text).empty());
  }
}

TEST_CASE("times have units, and seconds without one", "[break]") {
  CHECK(time_of("90s") == Approx(90));
  CHECK(time_of("2min") == Approx(120));
  CHECK(time_of("1.5h") == Approx(5400));
  CHECK(time_of("45") == Approx(45));
  for (const char* text : {"", "soon", "-1s", "0min", "2m", "1 year"}) {
    INFO(text);
    CHECK_FALSE(time_of(text));
    CHECK_FALSE(check_time(text).empty());
  }
}

TEST_CASE("a ball is a diameter and a speed", "[break]") {
  const auto ball = ball_of("50mm@20m/s");
  REQUIRE(ball);
  CHECK(ball->diameter == Approx(0.05));
  CHECK(ball->speed == Approx(20));
  CHECK(check_ball("50mm@20m/s").empty());
  for (const char* text : {"50mm", "@20m/s", "50mm@", "50mm@20mm", "a@b"}) {
    INFO(text);
    CHECK_FALSE(ball_of(text));
    CHECK_FALSE(check_ball(text).empty());
  }
}

TEST_CASE("lengths are said in the unit that suits them", "[break]") {
  CHECK(length_words(0.095) == "95 mm");
  CHECK(length_words(1.5) == "1.5 m");
  CHECK(length_words(2e-5) == "20 um");
  CHECK(length_words(3e-17) == "0 mm");
}
