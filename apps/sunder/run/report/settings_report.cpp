// SPDX-License-Identifier: MIT
// Chosen settings and expected times in words.
#include "apps/sunder/run/report/settings_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/scene/scene_fields.hpp"
#include "topology/base/counted.hpp"

namespace sunder {
namespace {

std::string_view word_of(Accuracy accuracy) {
  for (const auto& [value, word] : fields::names_of(accuracy)) {
    if (value == accuracy) return word;
  }
  return {};
}

}  // namespace

nlohmann::ordered_json settings_json(const SceneFile& file, const ExpectedTime& time) {
  nlohmann::ordered_json chosen = nlohmann::ordered_json::array();
  for (const Choice& c : file.choices) {
    chosen.push_back(
        {{"key", c.key}, {"value", nlohmann::ordered_json::parse(c.value)}, {"reason", c.reason}});
  }
  std::size_t tetrahedra = 0;
  for (const BodySettings& body : file.scene.bodies) tetrahedra += body.mesh.tetrahedra.size();
  const std::uint64_t steps = step_count(file.scene);
  nlohmann::ordered_json phases = nlohmann::ordered_json::array();
  for (const ExpectedTime::Phase& p : time.phases) {
    phases.push_back({{"begin", p.begin}, {"seconds_per_second", p.rate}});
  }
  return {{"accuracy", word_of(file.accuracy)},
          {"chosen", std::move(chosen)},
          {"expected",
           {{"tetrahedra", tetrahedra},
            {"steps", steps},
            {"step_ms", flight_ms(file.scene)},
            {"seconds", time.between(0, file.scene.duration)},
            {"phases", std::move(phases)}}}};
}

std::string settings_lines(const SceneFile& file, const ExpectedTime& time) {
  const nlohmann::ordered_json settings = settings_json(file, time);
  std::string lines;
  for (const Choice& c : file.choices) {
    lines += fmt::format("accuracy {}: {} = {} ({})\n", word_of(file.accuracy), c.key, c.value,
                         c.reason);
  }
  const nlohmann::ordered_json& expected = settings["expected"];
  lines += fmt::format("expected: {} of {}, {:.2g} ms per step in free flight, {:.2g} s in all\n",
                       counted(expected["steps"].get<std::uint64_t>(), "step"),
                       counted_tetrahedra(expected["tetrahedra"].get<std::uint64_t>()),
                       expected["step_ms"].get<double>(), expected["seconds"].get<double>());
  return lines;
}

std::string time_words(double seconds) {
  constexpr double minute = 60, hour = 3600;
  // Two digits are more than an estimate has.
  const auto about = [](double value, const char* unit) {
    const double tens = value < 10 ? 1 : std::pow(10, std::floor(std::log10(value)) - 1);
    return fmt::format("about {:.0f} {}", std::max(1.0, std::round(value / tens) * tens), unit);
  };
  // Shorter estimates are worth no number: start and files take as long.
  if (seconds < 3) return "at most a few seconds";
  if (seconds < 2 * minute) return about(seconds, "s");
  if (seconds < 2 * hour) return about(seconds / minute, "min");
  return about(seconds / hour, "h");
}

}  // namespace sunder
