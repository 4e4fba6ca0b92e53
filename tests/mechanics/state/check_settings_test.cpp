// SPDX-License-Identifier: MIT
// Settings against their descriptions: ranges, vectors, directions, rotations, and their places.
#include "mechanics/state/settings/check_settings.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace sunder;
using fields::above;
using fields::at_least;
using fields::between;
using fields::is_allowed;
using fields::Range;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A struct with every kind of member that settings have.
struct Inner {
  double share = 0.5;
};
struct Sample {
  double length = 1;
  std::uint32_t count = 3;
  bool flag = false;
  Eigen::Vector3d place = {0, 0, 0};
  Eigen::Vector3d axis = {0, 0, 5};
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  std::optional<double> mass;
  std::vector<Inner> inner;
  std::variant<Inner, double> either = 1.0;
};

template <class V>
void describe(V& v, Inner& i) {
  v.field(fields::Key{"share", "", "", between(0, 1)}, i.share);
}
template <class V>
void describe(V& v, Sample& s) {
  v.field(fields::Key{"length", "m", "", above(0), false, "a metre"}, s.length);
  v.field(fields::Key{"count", "", "", between(1, 9)}, s.count);
  v.field(fields::Key{"flag", "", ""}, s.flag);
  v.field(fields::Key{"place", "m", ""}, s.place);
  v.direction(fields::Key{"axis", "", ""}, s.axis);
  v.field(fields::Key{"turn", "", ""}, s.turn);
  v.field(fields::Key{"mass", "kg", "", above(0)}, s.mass);
  v.field(fields::Key{"inner", "", ""}, s.inner);
  v.alternative(fields::Key{"either", "", ""}, Inner{}, s.either);
}
void check_together(fields::SettingsCheck& check, const Sample& sample) {
  if (sample.flag && !sample.mass) check.add("no_mass", "mass", "is missing", "give one");
}

std::vector<std::string> places(const Sample& sample) {
  std::vector<std::string> all;
  for (const SettingFinding& f : setting_findings(sample, "a")) {
    CHECK(f.finding.severity == Severity::error);
    CHECK(f.finding.text.find(f.place) == 0);
    CHECK_FALSE(f.finding.remedy.empty());
    all.push_back(f.finding.code + " " + f.place);
  }
  return all;
}

}  // namespace

TEST_CASE("ranges allow what they say, and nothing that is not finite", "[mechanics][settings]") {
  CHECK(is_allowed(0, at_least(0)));
  CHECK_FALSE(is_allowed(0, above(0)));
  CHECK(is_allowed(2e-30, above(0)));
  CHECK(is_allowed(1, between(0, 1)));
  CHECK_FALSE(is_allowed(1.0000001, between(0, 1)));
  for (const double x : {no_number, infinite, -infinite}) {
    CHECK_FALSE(is_allowed(x, Range{}));
    CHECK_FALSE(is_allowed(x, at_least(0)));
  }
  const Range endless{.low = 0, .without_low = true, .with_infinity = true};
  CHECK(is_allowed(infinite, endless));
  CHECK_FALSE(is_allowed(-infinite, endless));
  CHECK_FALSE(is_allowed(no_number, endless));
}

TEST_CASE("every kind of member is held to its description, at its place",
          "[mechanics][settings]") {
  using All = std::vector<std::string>;
  CHECK(places({}) == All{});
  CHECK(places({.length = -1, .count = 0}) == All{"out_of_range a.length", "out_of_range a.count"});
  CHECK(places({.place = {0, no_number, infinite}}) ==
        All{"out_of_range a.place.1", "out_of_range a.place.2"});
  CHECK(places({.axis = {0, 0, 0}}) == All{"zero_direction a.axis"});
  CHECK(places({.axis = {no_number, 0, 0}}) == All{"out_of_range a.axis.0"});
  CHECK(places({.turn = {2, 0, 0, 0}}) == All{"not_a_rotation a.turn"});
  CHECK(places({.mass = 0}) == All{"out_of_range a.mass"});
  CHECK(places({.inner = {{.share = 2}, {}, {.share = -1}}}) ==
        All{"out_of_range a.inner.0.share", "out_of_range a.inner.2.share"});
  CHECK(places({.either = Inner{7}}) == All{"out_of_range a.either.share"});
  CHECK(places({.flag = true}) == All{"no_mass a.mass"});
  const Finding f = check_settings(Sample{.length = -2}, "a")[0];
  CHECK(f.text == "a.length is -2 m; allowed is above 0");
  CHECK(f.remedy == "give a value above 0 m: a metre");
}

TEST_CASE("numbers whose squares and products overflow are refused with what is allowed",
          "[mechanics][settings]") {
  CHECK(is_allowed(1e30, {}));
  CHECK(is_allowed(-1e30, {}));
  CHECK_FALSE(is_allowed(1.01e30, {}));
  CHECK_FALSE(is_allowed(-1e300, {}));
  CHECK(is_allowed(1e-300, {}));  // a coordinate that is 0 but for rounding
  CHECK(is_allowed(1e-30, above(0)));
  CHECK_FALSE(is_allowed(1e-31, above(0)));
  CHECK_FALSE(is_allowed(5e-324, at_least(0)));
  CHECK(is_allowed(0, at_least(0)));
  CHECK(is_allowed(infinite, {.with_infinity = true}));
  CHECK(check_settings(Sample{.length = 1e300}, "a")[0].text ==
        "a.length is 1e+300 m; allowed is at least 1e-30 and at most 1e+30 in size");
  CHECK(check_settings(Sample{.place = {-1e300, 0, 0}}, "a")[0].text ==
        "a.place.0 is -1e+300 m; allowed is at most 1e+30 in size");
}
