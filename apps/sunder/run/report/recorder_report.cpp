// SPDX-License-Identifier: MIT
// Adding up a run and writing its report.
#include "apps/sunder/run/report/recorder_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "apps/scene/obstacles_json.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/run/event_log.hpp"
#include "apps/sunder/run/report/counters_json.hpp"
#include "apps/sunder/run/report/turn_check.hpp"
#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "mechanics/element/energy.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

using nlohmann::ordered_json;

ordered_json three_numbers(const Vec3& v) { return {v[0], v[1], v[2]}; }

Energies energies(const Simulation& s) {
  const MechanicsState& m = s.state->mechanics;
  return {kinetic_energy(m.vertices), strain_energy(m),
          gravity_energy(m.vertices, s.scene.gravity.acceleration)};
}

double total_mass(const MechanicsState& mechanics) {
  const std::vector<double>& mass = mechanics.vertices.mass;
  return std::accumulate(mass.begin(), mass.end(), 0.0);
}

void note_contact(RunStatistics& statistics, const StepReport& report) {
  const ContactReport& now = report.contact;
  statistics.contact_steps += now.contacts > 0;
  if (now.converged) return;
  ++statistics.unconverged_steps;
  if (now.residual > statistics.worst_residual) {
    statistics.worst_residual = now.residual;
    statistics.tolerated = now.tolerated;
    statistics.force_error = now.force_error;
    statistics.worst_step = report.step;
  }
}

/// Adds a part of a whole; nothing where there is no whole.
void add_ratio(ordered_json& report, const char* key, std::size_t part, std::size_t whole) {
  if (whole > 0) report[key] = static_cast<double>(part) / static_cast<double>(whole);
}

ordered_json contact_report(const RunStatistics& s) {
  ordered_json report = {
      {"steps", s.contact_steps},           {"not_converged", s.unconverged_steps},
      {"worst_residual", s.worst_residual}, {"tolerated", s.tolerated},
      {"force_error", s.force_error},       {"worst_step", s.worst_step}};
  report.update(counters_json(s.contact));
  return report;
}

ordered_json integrator_report(const RunStatistics& s, std::uint64_t steps) {
  ordered_json report = counters_json(s.solve);
  ordered_json iterations = ordered_json::object();
  add_ratio(iterations, "mean", s.solve.iterations, steps);
  iterations["max"] = s.most_iterations;
  report["iterations"] = std::move(iterations);
  return report;
}

ordered_json impact_report(const RunStatistics& s) {
  ordered_json report = {{"steps", s.impact_steps}, {"stopped_steps", s.stopped_steps}};
  report.update(counters_json(s.impact));
  return report;
}

/// Steps of components, and of tetrahedra, on each rung.
ordered_json ladder_report(const LadderReport& ladder) {
  ordered_json report = ordered_json::object();
  for_each_counter<LadderReport>([&](const auto& counter) {
    const auto& steps = ladder.*counter.member;
    report[std::string(counter.name)] = {{"full", steps[0]},
                                         {"quasi_static", steps[1]},
                                         {"rigid", steps[2]},
                                         {"asleep", steps[3]},
                                         {"rubble", steps[4]}};
  });
  return report;
}

/// Rows of impulses from `first` on: 0 for momentum, 3 for angular momentum.
ordered_json momentum_ledger(const RunStatistics& statistics, const Simulation& now,
                             Eigen::Index first) {
  const auto part_of = [&](const Impulse& impulse) -> ordered_json {
    return three_numbers(impulse.segment<3>(first));
  };
  const Impulse& start = statistics.momentum_at_start;
  const Impulse end = total_momentum(*now.state);
  Impulse given = Impulse::Zero();
  ordered_json report = {{"start", part_of(start)}, {"end", part_of(end)}};
  for_each_counter<MomentumLedger>([&](const auto& counter) {
    given += statistics.momentum.*counter.member;
    report[std::string(counter.name)] = part_of(statistics.momentum.*counter.member);
  });
  report["residual"] = part_of(end - start - given);
  return report;
}

/// Area and energy of all fans with a settled energy, summed.
ordered_json crack_ledger(std::span<const CrackEnergy> cracks) {
  double area = 0, projected = 0, energy = 0;
  for (const CrackEnergy& crack : cracks) {
    area += crack.area;
    projected += crack.projected;
    energy += crack.energy;
  }
  return {{"measured", cracks.size()},
          {"area", area},
          {"projected_area", projected},
          {"energy", energy},
          {"energy_per_area", projected > 0 ? energy / projected : 0}};
}

ordered_json energy_ledger(const RunStatistics& statistics, const Simulation& now) {
  const Energies end = energies(now);
  const Energies& start = statistics.energy_at_start;
  const auto pair = [](double a, double b) { return ordered_json{{"start", a}, {"end", b}}; };
  ordered_json report = {{"kinetic", pair(start.kinetic, end.kinetic)},
                         {"strain", pair(start.strain, end.strain)},
                         {"gravity", pair(start.gravity, end.gravity)},
                         {"damping_work", statistics.damping_work},
                         {"released_by_rigid_pieces", statistics.energy_released}};
  if (!now.scene.energy_ledger) return report;
  const RunTroubles& troubles = statistics.troubles;
  report.update(counters_json(statistics.energy));
  report["residual_over_energy_moved"] =
      troubles.moved > 0 ? troubles.residual_size / troubles.moved : 0;
  return report;
}

/// How far pieces are still drawn from their targets after this step.
void note_drawn(RunStatistics& statistics, const Simulation& now) {
  const SimulationState& s = *now.state;
  for (const Component& c : s.mechanics.components) {
    if (c.tetrahedra.empty()) continue;
    const Pose& drawn = s.display[c.id.index()];
    const Pose& target = s.display_target[c.id.index()];
    const double turn = 2 * (drawn.orientation.conjugate() * target.orientation).vec().norm();
    const double off = (drawn.centre - target.centre).norm() + turn * c.rest_radius;
    if (off <= statistics.drawn_off) continue;
    statistics.drawn_off = off;
    statistics.drawn_off_step = s.step;
  }
}

/// The largest jump of a drawn point (figure 2): a piece that comes off is drawn where it was, and
/// goes the same share of the way to its target in every step. Needs: smoothing.
ordered_json display_report(const RunStatistics& s, const Scene& scene) {
  const double time_constant = scene.display_time_constant;
  const double stays = std::exp(-scene.integrator.time_step / time_constant),
               whole = stays > 0 ? s.drawn_off / stays : s.drawn_off;
  return {{"time_constant", time_constant},
          {"largest_jump",
           {{"step", s.drawn_off_step}, {"as_it_is", whole}, {"smoothed", whole * (1 - stays)}}}};
}

}  // namespace

RunStatistics begin_statistics(const Simulation& start, std::vector<Finding> warnings) {
  RunStatistics statistics;
  statistics.warnings = std::move(warnings);
  statistics.energy_at_start = energies(start);
  statistics.momentum_at_start = total_momentum(*start.state);
  statistics.mass_at_start = total_mass(start.state->mechanics);
  statistics.troubles = begin_troubles(start);
  return statistics;
}

void add_step(RunStatistics& statistics, const Simulation& now, const StepReport& report,
              double step_ms) {
  add(statistics.step_ms, step_ms);
  for (std::size_t i = 0; i < stage_names.size(); ++i) {
    add(statistics.stage_ms[i], report.stage_ms[i]);
  }
  const FractureReport& fracture = report.fracture;
  statistics.fans += fracture.fans.size();
  for (std::size_t row = 0; row < fracture.fans.size(); ++row) {
    const FanEvent& fan = fracture.fans[row];
    statistics.faces_split += fan.faces.size();
    statistics.searched += fan.components.visited;
    add(statistics.fan_us[fan.components.created > 0 ? 1 : 0], report.fan_us[row]);
    statistics.predicted += fan.components.predicted > 0;
    statistics.separated += fan.components.created > 0;
    statistics.predicted_rightly += fan.components.predicted > 0 && fan.components.created > 0;
  }
  add_step<SearchCounts>(statistics.search, fracture);
  add_step(statistics.contact, report.contact);
  add_step(statistics.impact, report.impact);
  add_step(statistics.ladder, report.ladder);
  add_step(statistics.rubble, report.rubble);
  add_step(statistics.solve, report.status.solve);
  add_step(statistics.energy, report.energy);
  note_ties(statistics.ties, report);
  note_contact(statistics, report);
  statistics.impact_steps += report.impact.sub_steps > 0;
  statistics.stopped_steps += report.impact.stopped;
  statistics.most_iterations = std::max(statistics.most_iterations, report.status.solve.iterations);
  add_step(statistics.momentum, report.momentum);
  statistics.cracks.insert(statistics.cracks.end(), report.cracks.begin(), report.cracks.end());
  statistics.damping_work += report.status.damping_work;
  statistics.energy_released += report.energy_released;
  note_troubles(statistics.troubles, now, report);
  note_drawn(statistics, now);
  // A failed step has an error of its own.
  if (statistics.turned_too_far || report.status.outcome != StepOutcome::fine) return;
  if (std::optional<Finding> turned = check_turns(now, report)) {
    statistics.turned_too_far = true;
    statistics.warnings.push_back(std::move(*turned));
  }
}

std::vector<Finding> warnings_on_the_way(const RunStatistics& statistics, const Scene& scene) {
  std::vector<Finding> found;
  std::ranges::copy_if(statistics.warnings, std::back_inserter(found),
                       [](const Finding& f) { return f.code == turned_too_far; });
  std::ranges::move(warnings_of(statistics.troubles, scene), std::back_inserter(found));
  constexpr double most_residual = 0.05;
  if (statistics.ties.sum.residual > most_residual) {
    found.push_back({.code = "ties_not_converged",
                     .severity = Severity::warning,
                     .text = fmt::format(
                         "cohesive forces of a sub-step missed their law by up to {:.2g} of the "
                         "opening at which they end",
                         statistics.ties.sum.residual),
                     .remedy = "raise contact.max_iterations"});
  }
  return found;
}

std::vector<Finding> all_warnings(const RunStatistics& statistics, const Scene& scene) {
  std::vector<Finding> all;
  std::ranges::copy_if(statistics.warnings, std::back_inserter(all),
                       [](const Finding& f) { return f.code != turned_too_far; });
  std::ranges::move(warnings_on_the_way(statistics, scene), std::back_inserter(all));
  return all;
}

std::optional<Finding> step_failure(const StepReport& report, const Simulation& now) {
  if (report.status.outcome != StepOutcome::fine) {
    Finding finding = to_finding(report.status);
    finding.text = fmt::format("step {}: {}", report.step, finding.text);
    return finding;
  }
  if (!report.fracture.not_a_number) return std::nullopt;
  const VertexId vertex = *report.fracture.not_a_number;
  const Vec3& x = now.state->mechanics.vertices.position[vertex.index()];
  return Finding{.code = "stress_not_a_number",
                 .ids = {static_cast<std::int64_t>(vertex.index())},
                 .text = fmt::format("step {} (t = {:.6g} s): the stress of vertex {} at ({:.6g}, "
                                     "{:.6g}, {:.6g}) m is not a number",
                                     report.step, report.time, vertex.value, x[0], x[1], x[2]),
                 .remedy = "take a shorter time_step or the integrator floating_frame"};
}

ordered_json run_report(const RunStatistics& s, const Simulation& now,
                        std::span<const Fragment> pieces, RunEnd end) {
  ordered_json stages = ordered_json::object();
  for (std::size_t i = 0; i < stage_names.size(); ++i) {
    stages[std::string(stage_names[i])] = distribution(s.stage_ms[i]);
  }
  double mass = 0, largest = 0;
  for (const Fragment& piece : pieces) {
    mass += piece.mass;
    largest = std::max(largest, piece.mass);
  }
  ordered_json search = counters_json(s.search), gershgorin = ordered_json::object();
  for (const char* key : {"tested", "suspects", "reached"}) {
    gershgorin[key] = search[key];
    search.erase(key);
  }
  add_ratio(gershgorin, "efficiency", s.search.reached, s.search.suspects);
  ordered_json oracle = {{"fans", s.fans}, {"predicted", s.predicted}, {"separated", s.separated}};
  add_ratio(oracle, "efficiency", s.predicted_rightly, s.predicted);
  oracle["missed"] = s.separated - s.predicted_rightly;
  const DenseMap& dense = now.state->cells.map.dense();
  ordered_json report = {
      {"scene", now.scene.name},
      {"end", to_string(end)},
      {"steps", now.state->step},
      {"time", now.state->mechanics.time},
      {"time_step", now.scene.integrator.time_step},
      {"tetrahedra", dense.tetrahedra()},
      {"vertices", std::ranges::count(dense.incident_tetrahedra(), false, &TetId::is_none)},
      {"step_ms", distribution(s.step_ms)},
      {"stage_ms", stages},
      {"fans", s.fans},
      {"faces_split", s.faces_split},
      {"fan_us",
       {{"no_new_component", distribution(s.fan_us[0])},
        {"new_component", distribution(s.fan_us[1])}}},
      {"searched_tetrahedra", s.searched},
      {"components", pieces.size()},
      {"fragments",
       {{"count", pieces.size()},
        {"single_tetrahedra", std::ranges::count(pieces, 1, &Fragment::tetrahedra)},
        {"largest_mass", largest},
        {"mass", mass},
        {"mass_error", (mass - s.mass_at_start) / s.mass_at_start}}},
      {"gershgorin", gershgorin},
      {"oracle", std::move(oracle)},
      {"contact", contact_report(s)},
      {"impact", impact_report(s)},
      {"ladder", ladder_report(s.ladder)},
      {"rubble", counters_json(s.rubble)},
      {"integrator", integrator_report(s, now.state->step)},
      {"momentum", momentum_ledger(s, now, 0)},
      {"angular_momentum", momentum_ledger(s, now, 3)},
      {"energy", energy_ledger(s, now)},
      {"cracks", crack_ledger(s.cracks)},
      {"warnings", findings_json(all_warnings(s, now.scene))}};
  if (now.scene.display_time_constant > 0) report["display"] = display_report(s, now.scene);
  report["gravity"] = three_numbers(now.scene.gravity.acceleration);
  report["obstacles"] = obstacles_json(now.scene.obstacles);
  if (now.state->cells.pieces) report["ties"] = tie_report(s.ties, now);
  report.update(search);
  return report;
}

std::string summary_table(const ordered_json& r) {
  const auto number = [&](const char* pointer) {
    return r.at(ordered_json::json_pointer(pointer)).get<double>();
  };
  std::string text;
  const auto row = [&](std::string_view name, const std::string& value) {
    text += fmt::format("{:<14} {}\n", name, value);
  };
  row("scene", plain_line(r["scene"].get<std::string>()));
  row("end", fmt::format("{} at t = {:.6g} s", r["end"].get<std::string>(), number("/time")));
  row("steps",
      fmt::format("{} of {:.6g} s", r["steps"].get<std::uint64_t>(), number("/time_step")));
  row("step time",
      fmt::format("mean {:.3g} ms, max {:.3g} ms, {:.3g} s in all", number("/step_ms/mean"),
                  number("/step_ms/max"), number("/step_ms/mean") * number("/steps") / 1000));
  if (const auto sub_steps = r["impact"]["sub_steps"].get<std::uint64_t>(); sub_steps > 0) {
    row("impacts", fmt::format("{}, {} over {:.4g} s",
                               counted(r["impact"]["windows"].get<std::uint64_t>(), "window"),
                               counted(sub_steps, "sub-step"), number("/impact/time")));
  }
  if (const auto stopped = r["impact"]["stopped_steps"].get<std::uint64_t>(); stopped > 0) {
    row("", fmt::format("impact.max_sub_steps was reached in {}", counted(stopped, "step")));
  }
  if (const auto given_up = r["integrator"]["not_converged"].get<std::uint64_t>(); given_up > 0) {
    row("integrator",
        fmt::format("not converged in {}, replaced by a direct solve", counted(given_up, "step")));
  }
  row("fans", fmt::format("{} ({})", r["fans"].get<std::uint64_t>(),
                          counted(r["faces_split"].get<std::uint64_t>(), "face")));
  row("pieces", fmt::format("{} ({})", r["components"].get<std::uint64_t>(),
                            counted(r["fragments"]["single_tetrahedra"].get<std::uint64_t>(),
                                    "single tetrahedron", "single tetrahedra")));
  if (r.contains("ties")) {
    row("cracks took",
        fmt::format("{:.4g} J of {:.4g} J due over {:.4g} m^2 released, {} tied",
                    number("/ties/dissipated"), number("/ties/fracture_energy_of_released"),
                    number("/ties/released_projected_area"),
                    counted(r["ties"]["tied_faces"].get<std::uint64_t>(), "face")));
  }
  row("largest piece", fmt::format("{:.4g} kg of {:.4g} kg", number("/fragments/largest_mass"),
                                   number("/fragments/mass")));
  if (const auto missed = r["contact"]["not_converged"].get<std::uint64_t>(); missed > 0) {
    row("contact", fmt::format("not converged in {}, worst {:.2g} m (tolerated {:.1g} m), {:.2g} N",
                               counted(missed, "step"), number("/contact/worst_residual"),
                               number("/contact/tolerated"), number("/contact/force_error")));
  }
  row("mass error", fmt::format("{:.1e}", number("/fragments/mass_error")));
  return text;
}

}  // namespace sunder
