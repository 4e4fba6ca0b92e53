// SPDX-License-Identifier: MIT
#include "apps/sunder/run/report/time_sample.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace sunder;

TEST_CASE("times of a run are told by mean, quantiles and the largest", "[run]") {
  TimeSample sample;
  CHECK(distribution(sample) ==
        nlohmann::ordered_json({{"mean", 0}, {"median", 0}, {"p99", 0}, {"max", 0}}));
  for (int i = 200; i > 0; --i) add(sample, i);
  const nlohmann::ordered_json told = distribution(sample);
  CHECK(told["mean"] == 100.5);
  CHECK(told["median"] == 100);
  CHECK(told["p99"] == 198);
  CHECK(told["max"] == 200);
}

TEST_CASE("the times that are kept of a long run are evenly spread and few", "[run]") {
  TimeSample sample;
  double sum = 0;
  const auto n = 10 * TimeSample::most_kept + 7;
  for (std::size_t i = 0; i < n; ++i) {
    add(sample, static_cast<double>(i));
    sum += static_cast<double>(i);
    REQUIRE(sample.kept.size() <= TimeSample::most_kept);
    REQUIRE(sample.kept.size() == i / sample.stride + 1);
  }
  for (std::size_t i = 0; i < sample.kept.size(); ++i) {
    REQUIRE(sample.kept[i] == static_cast<float>(i * sample.stride));
  }
  const nlohmann::ordered_json told = distribution(sample);
  CHECK(told["mean"] == sum / static_cast<double>(n));
  CHECK(told["max"] == static_cast<double>(n - 1));
  CHECK(told["median"].get<double>() == Approx(static_cast<double>(n) / 2).epsilon(1e-3));
  CHECK(told["p99"].get<double>() == Approx(0.99 * static_cast<double>(n)).epsilon(1e-3));
}
