// SPDX-License-Identifier: MIT
#include "apps/sunder/run/report/time_sample.hpp"

#include <algorithm>
#include <cmath>

#include "topology/base/whole_number.hpp"

namespace sunder {

void add(TimeSample& s, double time) {
  const auto rounded = static_cast<float>(time);
  if (s.count % s.stride == 0) {
    if (s.kept.size() == TimeSample::most_kept) {
      for (std::size_t i = 0; i < s.kept.size() / 2; ++i) s.kept[i] = s.kept[2 * i];
      s.kept.resize(s.kept.size() / 2);
      s.stride *= 2;
    }
    // With an even number kept the time now is a multiple of the doubled stride too.
    s.kept.push_back(rounded);
  }
  ++s.count;
  s.sum += static_cast<double>(rounded);
  s.largest = std::max(s.largest, rounded);
}

nlohmann::ordered_json distribution(const TimeSample& s) {
  if (s.count == 0) return {{"mean", 0}, {"median", 0}, {"p99", 0}, {"max", 0}};
  std::vector<float> sorted = s.kept;
  std::ranges::sort(sorted);
  const auto rank = [&](double part) {
    const double row = std::ceil(part * static_cast<double>(sorted.size())) - 1;
    return static_cast<double>(sorted[whole_number<std::size_t>(row)]);
  };
  return {{"mean", s.sum / static_cast<double>(s.count)},
          {"median", rank(0.5)},
          {"p99", rank(0.99)},
          {"max", s.largest}};
}

}  // namespace sunder
