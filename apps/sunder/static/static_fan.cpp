// SPDX-License-Identifier: MIT
// Finds the fan, asks for its energy, and writes the answer down.
#include "apps/sunder/static/static_fan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "apps/scene/words.hpp"
#include "fracture/algorithms/choose_fan.hpp"
#include "fracture/energy/tip_energy.hpp"
#include "topology/base/counted.hpp"
#include "topology/base/whole_number.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

/// A body in equilibrium and its loads, by node.
struct LoadedBody {
  Simulation& sim;
  std::span<const Vec3> force;
};

std::vector<Vec3> fully_raised(const Simulation& sim) {
  return node_loads(sim.state->loads, sim.state->mechanics,
                    std::numeric_limits<double>::infinity());
}

/// Adds its release to an answer. Gives the errors, or nothing when it has it.
std::vector<Finding> add_release(FanAnswer& answer, const LoadedBody& body, VertexId vertex,
                                 std::span<const HalfFaceId> faces) {
  const Cells& cells = body.sim.state->cells;
  MechanicsState& m = body.sim.state->mechanics;
  answer.faces = faces.size();
  const auto release = energy_release({cells, m, body.sim.scene.gravity.acceleration, body.force},
                                      faces, answer.normal);
  if (!release) return release.findings;
  answer.release = *release;
  const TetId t = cells.map.incident_tetrahedron(vertex);
  answer.fracture_energy = fracture_energy_of(m.materials[m.elements.material[t.index()].index()]);
  return {};
}

}  // namespace

std::string check_fan_text(const std::string& list) {
  const auto x = numbers_of(list, 4);
  const bool is_row = x && (*x)[0] >= 0 && (*x)[0] < 4294967295.0 && (*x)[0] == std::floor((*x)[0]);
  return is_row ? "" : "'" + list + "' is not V,NX,NY,NZ: a row of a point and three numbers";
}

Result<FanAnswer> fan_answer(Simulation& sim, const std::string& list) {
  const std::vector<double> x = *numbers_of(list, 4);
  FanAnswer answer{.point = whole_number<std::uint32_t>(x[0]), .normal = {x[1], x[2], x[3]}};
  const Cells& cells = sim.state->cells;
  std::size_t row = 0;
  const auto is_asked_for = [&](VertexId v) {
    return cells.map.point_of_vertex(v) == answer.point && !cells.map.is_node(v);
  };
  while (row < cells.map.vertices() && !is_asked_for(VertexId{row})) ++row;
  if (row == cells.map.vertices()) row = std::max<std::size_t>(row, answer.point);
  const auto faces = fan_faces(cells.map, VertexId{row}, {x[1], x[2], x[3]});
  Result<FanAnswer> result;
  if (!faces) {
    result.findings = faces.findings;
    return result;
  }
  answer.normal.normalize();
  const auto force = fully_raised(sim);
  result.findings = add_release(answer, {sim, force}, VertexId{row}, *faces);
  if (result.findings.empty()) result.value = answer;
  return result;
}

Result<std::vector<FanCandidate>> fan_candidates(Simulation& sim, std::span<const Mat3> node_stress,
                                                 double share) {
  const Cells& cells = sim.state->cells;
  const MechanicsState& m = sim.state->mechanics;
  const auto force = fully_raised(sim);
  Result<std::vector<FanCandidate>> result;
  std::vector<FanCandidate> candidates;
  for (std::size_t v = 0; v < node_stress.size(); ++v) {
    const PrincipalTension tension = principal_tension(node_stress[v]);
    if (!(tension.value > 0) || !(tension.value >= share * cells.strength[v])) continue;
    const FanPlane plane = choose_fan(cells, vertex_star(cells.map, VertexId{v}), tension);
    if (plane.faces.empty()) continue;
    FanCandidate candidate{
        .fan = {.point = cells.map.point_of_vertex(VertexId{v}), .normal = plane.normal},
        .share = tension.value / cells.strength[v]};
    result.findings = add_release(candidate.fan, {sim, force}, VertexId{v}, plane.faces);
    if (!result.findings.empty()) return result;
    candidate.front = tip_energy(
        cells, m.elements, {m.vertices.displacement, m.elements.stress, m.elements.corner_stress},
        VertexId{v});
    candidates.push_back(candidate);
  }
  std::ranges::stable_sort(candidates, std::greater<>(),
                           [](const FanCandidate& c) { return c.fan.release.per_area(); });
  result.value = std::move(candidates);
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
          {"projected_area", answer.release.projected},
          {"copies", answer.release.copies},
          {"comes_free", answer.release.comes_free},
          {"energy", number(answer.release.energy)},
          {"energy_per_area", number(answer.release.per_area())},
          {"fracture_energy", number(answer.fracture_energy)}};
}

std::string to_table(const FanAnswer& answer) {
  std::string text = fmt::format(
      "{:<18} at vertex {}, normal ({:.6g}, {:.6g}, {:.6g}): {}, {:.6g} m^2 "
      "({:.6g} projected), {}{}\n",
      "fan", answer.point, answer.normal[0], answer.normal[1], answer.normal[2],
      counted(answer.faces, "face"), answer.release.area, answer.release.projected,
      counted(answer.release.copies, "copy", "copies"),
      answer.release.comes_free ? "; a piece comes free" : "");
  text += fmt::format("{:<18} {:.6g} J, {:.6g} J/m^2", "energy released", answer.release.energy,
                      answer.release.per_area());
  if (std::isfinite(answer.fracture_energy)) {
    text += fmt::format(" (K_Ic^2 (1 - nu^2) / E: {:.6g} J/m^2)", answer.fracture_energy);
  }
  return text + "\n";
}

nlohmann::ordered_json to_json(const std::vector<FanCandidate>& candidates) {
  auto list = nlohmann::ordered_json::array();
  for (const FanCandidate& c : candidates) {
    nlohmann::ordered_json row = to_json(c.fan);
    row["strength_share"] = c.share;
    row["front_energy_per_area"] =
        c.front ? nlohmann::ordered_json(*c.front) : nlohmann::ordered_json();
    list.push_back(std::move(row));
  }
  return list;
}

std::string to_table(const std::vector<FanCandidate>& candidates) {
  std::string text = fmt::format("{:>8} {:>9} {:>12} {:>12} {:>12} {:>12}  {}\n", "vertex", "share",
                                 "area m^2", "fan J/m^2", "front J/m^2", "limit J/m^2", "normal");
  for (const FanCandidate& c : candidates) {
    text += fmt::format(
        "{:>8} {:>9.4g} {:>12.5g} {:>12.5g} {:>12} {:>12.5g}  ({:.3f}, {:.3f}, {:.3f})\n",
        c.fan.point, c.share, c.fan.release.area, c.fan.release.per_area(),
        c.front ? fmt::format("{:.5g}", *c.front) : "-", c.fan.fracture_energy, c.fan.normal[0],
        c.fan.normal[1], c.fan.normal[2]);
  }
  return text;
}

}  // namespace sunder
