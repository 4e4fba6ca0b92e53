// SPDX-License-Identifier: MIT
// Chosen settings and expected times in words.
#include "apps/sunder/run/report/settings_report.hpp"

#include <fmt/format.h>

#include "apps/scene/scene_fields.hpp"

namespace sunder {
namespace {

std::string_view word_of(Accuracy accuracy) {
  for (const auto& [value, word] : fields::names_of(accuracy)) {
    if (value == accuracy) return word;
  }
  return {};
}

}  // namespace

nlohmann::ordered_json settings_json(const SceneFile& file) {
  nlohmann::ordered_json chosen = nlohmann::ordered_json::array();
  for (const Choice& c : file.choices) {
    chosen.push_back(
        {{"key", c.key}, {"value", nlohmann::ordered_json::parse(c.value)}, {"reason", c.reason}});
  }
  std::size_t tetrahedra = 0;
  for (const BodySettings& body : file.scene.bodies) tetrahedra += body.mesh.tetrahedra.size();
  const double step = flight_ms(file.scene);
  const std::uint64_t steps = step_count(file.scene);
  return {{"accuracy", word_of(file.accuracy)},
          {"chosen", std::move(chosen)},
          {"expected",
           {{"tetrahedra", tetrahedra},
            {"steps", steps},
            {"step_ms", step},
            {"seconds", static_cast<double>(steps) * step / 1000}}}};
}

std::string settings_lines(const SceneFile& file) {
  const nlohmann::ordered_json settings = settings_json(file);
  std::string lines;
  for (const Choice& c : file.choices) {
    lines += fmt::format("accuracy {}: {} = {} ({})\n", word_of(file.accuracy), c.key, c.value,
                         c.reason);
  }
  const nlohmann::ordered_json& expected = settings["expected"];
  lines += fmt::format(
      "expected: {} steps of {} tetrahedra, {:.2g} ms per step in free flight, {:.2g} s in all; a "
      "step with contact takes tens of times as long, a step with many cracks hundreds\n",
      expected["steps"].get<std::uint64_t>(), expected["tetrahedra"].get<std::uint64_t>(),
      expected["step_ms"].get<double>(), expected["seconds"].get<double>());
  return lines;
}

}  // namespace sunder
