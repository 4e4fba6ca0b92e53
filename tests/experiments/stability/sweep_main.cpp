// SPDX-License-Identifier: MIT
// `stability_sweep [CSV]`: every method over stiffness, step, spin, nu, slivers and masses. maps.py
// draws the table.
#include <chrono>
#include <cstdio>
#include <string>

#include "tests/experiments/stability/sweep.hpp"

using namespace sunder::stability;

int main(int count, char** words) {
  const std::string csv = count > 1 ? words[1] : "stability.csv";
  std::FILE* file = std::fopen(csv.c_str(), "w");
  if (!file) {
    std::fprintf(stderr, "cannot write %s\n", csv.c_str());
    return 2;
  }
  std::fputs("map,method,value,step / s,outcome,figure\n", file);
  const std::vector<Map> all = maps();
  for (const Method& method : mapped_methods()) {
    const auto start = std::chrono::steady_clock::now();
    std::size_t tally[std::size(outcome_names)] = {};
    for (const Map& map : all) {
      for (const double value : map.values) {
        for (const double step : map.time_steps) {
          const Cell cell = map.run(method, value, step);
          ++tally[static_cast<std::size_t>(cell.outcome)];
          std::fprintf(file, "%s,\"%s\",%g,%g,%s,%.3g\n", map.name.c_str(), method.name.c_str(),
                       value, step, std::string(name_of(cell.outcome)).c_str(), cell.figure);
        }
      }
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    std::printf("%-28s %6.1f s ", method.name.c_str(), took.count());
    for (std::size_t i = 1; i < std::size(tally); ++i) {
      if (tally[i]) std::printf(" %zu %s ", tally[i], std::string(outcome_names[i]).c_str());
    }
    std::puts("");
    std::fflush(stdout);
  }
  std::fclose(file);
}
