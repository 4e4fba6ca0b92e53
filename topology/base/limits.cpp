// SPDX-License-Identifier: MIT
// Limits by name, from the environment.
#include "topology/base/limits.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

struct NamedLimit {
  std::string_view name;
  std::uint64_t Limits::*member;
};
constexpr NamedLimit named_limits[] = {{"file_bytes", &Limits::file_bytes},
                                       {"unpacked_bytes", &Limits::unpacked_bytes},
                                       {"scene_levels", &Limits::scene_levels},
                                       {"xml_levels", &Limits::xml_levels},
                                       {"steps", &Limits::steps},
                                       {"frames", &Limits::frames}};

/// Those of this process, with the mistake in SUNDER_LIMITS.
struct ProcessLimits {
  Limits now;
  std::string fault;

  ProcessLimits() {
    const char* const list = std::getenv("SUNDER_LIMITS");
    if (list != nullptr) fault = lower_limits(now, list);
  }
};

ProcessLimits& of_process() {
  static ProcessLimits all;
  return all;
}

}  // namespace

const Limits& limits() { return of_process().now; }

std::string limits_fault() { return of_process().fault; }

void lower_limits(const Limits& wanted) {
  Limits& now = of_process().now;
  for (const NamedLimit& limit : named_limits) {
    now.*limit.member = std::min(now.*limit.member, wanted.*limit.member);
  }
}

std::string lower_limits(Limits& lowered, std::string_view list) {
  Limits all = lowered;
  constexpr std::string_view between = " ,\t\n";
  for (;;) {
    list.remove_prefix(std::min(list.find_first_not_of(between), list.size()));
    if (list.empty()) break;
    const std::string_view part = list.substr(0, list.find_first_of(between));
    list.remove_prefix(part.size());
    const std::string_view name = part.substr(0, part.find('='));
    const std::string_view number = part.substr(std::min(name.size() + 1, part.size()));
    const auto* const limit = std::ranges::find(named_limits, name, &NamedLimit::name);
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (limit == std::end(named_limits) || error != std::errc() ||
        end != number.data() + number.size() || !(value >= 0)) {
      std::string names;
      for (const NamedLimit& known : named_limits) {
        names += (names.empty() ? "" : ", ") + std::string(known.name);
      }
      return "'" + std::string(part) + "' is no limit with a number; limits are " + names;
    }
    all.*limit->member = std::min(all.*limit->member, whole_number<std::uint64_t>(value));
  }
  lowered = all;
  return {};
}

}  // namespace sunder
