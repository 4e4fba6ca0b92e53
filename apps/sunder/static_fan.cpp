// SPDX-License-Identifier: MIT
// Finds the fan, asks for its energy, and writes the answer down.
#include "apps/sunder/static_fan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/sunder/words.hpp"
#include "topology/fan.hpp"

namespace sunder {

std::string check_fan_text(const std::string& list) {
  const auto x = numbers_of(list, 4);
  const bool is_row = x && (*x)[0] >= 0 && (*x)[0] < 4294967295.0 &&
                      (*x)[0] == static_cast<double>(static_cast<std::uint32_t>((*x)[0]));
  return is_row ? "" : "'" + list + "' is not V,NX,NY,NZ: a row of a point and three numbers";
}

Result<FanAnswer> fan_answer(Simulation& sim, const std::string& list) {
  const std::vector<double> x = *numbers_of(list, 4);
  FanAnswer answer{.point = static_cast<std::uint32_t>(x[0]), .normal = {x[1], x[2], x[3]}};
  const Cells& cells = sim.state.cells;
  std::size_t row = 0;
  while (row < cells.map.vertices() && cells.map.point_of_vertex(VertexId{row}) != answer.point) {
    ++row;
  }
  if (row == cells.map.vertices()) row = std::max<std::size_t>(row, answer.point);
  const auto faces = fan_faces(cells.map, VertexId{row}, {x[1], x[2], x[3]});
  Result<FanAnswer> result;
  if (!faces) {
    result.findings = faces.findings;
    return result;
  }
  answer.normal.normalize();
  answer.faces = faces->size();
  const MechanicsState& m = sim.state.mechanics;
  const auto force = corner_forces(sim.loads, m, std::numeric_limits<double>::infinity());
  const auto release = energy_release(sim.scratch.mechanics,
                                      {cells, m, sim.scene.gravity.acceleration, force}, *faces);
  if (!release) {
    result.findings = release.findings;
    return result;
  }
  answer.release = *release;
  const TetId t = cells.map.incident_tetrahedron(VertexId{row});
  answer.fracture_energy = fracture_energy(m.materials[m.elements.material[t.index()].index()]);
  result.value = answer;
  return result;
}

nlohmann::ordered_json to_json(const FanAnswer& answer) {
  const auto number = [](double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json();
  };
  return {{"vertex", answer.point},
          {"normal", {answer.normal[0], answer.normal[1], answer.normal[2]}},
          {"faces", answer.faces},
          {"area", answer.release.area},
          {"copies", answer.release.copies},
          {"comes_free", answer.release.comes_free},
          {"energy", number(answer.release.energy)},
          {"energy_per_area", number(answer.release.per_area())},
          {"fracture_energy", number(answer.fracture_energy)}};
}

std::string to_table(const FanAnswer& answer) {
  std::string text = fmt::format(
      "{:<18} at vertex {}, normal ({:.6g}, {:.6g}, {:.6g}): {} faces, {:.6g} m^2, {} copies{}\n",
      "fan", answer.point, answer.normal[0], answer.normal[1], answer.normal[2], answer.faces,
      answer.release.area, answer.release.copies,
      answer.release.comes_free ? "; a piece comes free" : "");
  text += fmt::format("{:<18} {:.6g} J, {:.6g} J/m^2", "energy released", answer.release.energy,
                      answer.release.per_area());
  if (std::isfinite(answer.fracture_energy)) {
    text += fmt::format(" (K_Ic^2 (1 - nu^2) / E: {:.6g} J/m^2)", answer.fracture_energy);
  }
  return text + "\n";
}

}  // namespace sunder
