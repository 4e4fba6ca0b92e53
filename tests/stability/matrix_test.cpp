// SPDX-License-Identifier: MIT
// The stability matrix, all cells; printed, so that a log shows it.
#include <catch2/catch.hpp>

#include <cstdio>

#include "tests/stability/matrix.hpp"

using namespace sunder::stability;

namespace {

void print(const Scenario& scenario, const Method& method, const Cell& cell) {
  std::printf("  %-50s %-26s %-12s %.3g\n", scenario.name.c_str(), method.name.c_str(),
              std::string(name_of(cell.outcome)).c_str(), cell.figure);
}

void check(const Scenario& scenario, const Method& method) {
  const Cell cell = scenario.run(method);
  print(scenario, method, cell);
  INFO(scenario.name << ", " << method.name << ": " << name_of(cell.outcome) << ", "
                     << cell.figure);
  CHECK(std::string(name_of(cell.outcome)) == std::string(name_of(scenario.expected_of(method))));
}

}  // namespace

TEST_CASE("every method does in every motion what is expected of it", "[stability]") {
  for (const Scenario& scenario : motions()) {
    for (const Method& method : methods()) check(scenario, method);
  }
}

TEST_CASE("every method does in every contact what is expected of it", "[stability]") {
  for (const Scenario& scenario : contacts()) {
    for (const Method& method : contact_methods()) check(scenario, method);
  }
}

TEST_CASE("of second order the default does in everything what it does of first",
          "[stability][long]") {
  for (const auto& scenarios : {motions(), contacts()}) {
    for (const Scenario& scenario : scenarios) {
      check(scenario, of_second_order({methods().front()}).front());
    }
  }
}

// Ten minutes: for the command that docs/lab/stability.md names.
TEST_CASE("of second order every method does in everything what it does of first",
          "[.second_order]") {
  for (const auto& scenarios : {motions(), contacts()}) {
    for (const Scenario& scenario : scenarios) {
      for (const Method& method : of_second_order(methods())) check(scenario, method);
    }
  }
}

TEST_CASE("rotations, contact, splits and input do what is expected of them", "[stability]") {
  for (const Scenario& scenario : others()) check(scenario, methods().front());
}
