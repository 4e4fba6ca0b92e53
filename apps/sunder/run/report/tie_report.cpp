// SPDX-License-Identifier: MIT
// Adding up ties by crack.
#include "apps/sunder/run/report/tie_report.hpp"

#include "apps/sunder/run/report/counters_json.hpp"
#include "fracture/scene/cohesive_settings.hpp"

namespace sunder {
namespace {

using nlohmann::ordered_json;

void add(TiesOfCrack& sum, const TiesOfCrack& more) {
  sum.tied += more.tied;
  sum.released += more.released;
  sum.area += more.area;
  sum.due += more.due;
  sum.energy += more.energy;
}

ordered_json row_of(const TiesOfCrack& ties) {
  return {{"tied_faces", ties.tied},
          {"released_faces", ties.released},
          {"released_projected_area", ties.area},
          {"fracture_energy_of_released", ties.due},
          {"energy", ties.energy}};
}

/// How well the mesh resolves the softening of each material that can break.
ordered_json resolutions(const MechanicsState& mechanics) {
  ordered_json rows = ordered_json::array();
  for (std::size_t m = 0; m < mechanics.materials.size(); ++m) {
    const double length = softening_length(mechanics.materials[m]);
    const double cell = cell_of(mechanics, MaterialId{m});
    if (!(length > 0) || !(cell > 0)) continue;
    rows.push_back({{"material", m},
                    {"softening_length", length},
                    {"cell", cell},
                    {"softening_length_over_cell", length / cell}});
  }
  return rows;
}

}  // namespace

void note_ties(TieStatistics& statistics, const StepReport& report) {
  add_step(statistics.sum, report.ties);
  statistics.releases += report.releases.size();
  for (const TieRelease& release : report.releases) {
    for (const Tie& tie : release.ties) {
      const double area = area_of(tie);
      add(statistics.released[tie.crack], {.released = 1,
                                           .area = area,
                                           .due = tie.fracture_energy * area,
                                           .energy = taken_by(tie)});
    }
  }
}

ordered_json tie_report(const TieStatistics& statistics, const Simulation& now) {
  std::map<CrackId, TiesOfCrack> cracks = statistics.released;
  for (const Tie& tie : now.state->contact.ties) {
    add(cracks[tie.crack], {.tied = 1, .energy = taken_by(tie)});
  }
  TiesOfCrack all;
  ordered_json rows = ordered_json::array();
  for (const auto& [crack, ties] : cracks) {
    add(all, ties);
    rows.push_back({{"crack", crack.value}});
    rows.back().update(row_of(ties));
  }
  ordered_json report = row_of(all);
  report.erase("energy");  // `dissipated`
  report["releases"] = statistics.releases;
  report.update(counters_json(statistics.sum));
  report["materials"] = resolutions(now.state->mechanics);
  report["cracks"] = rows;
  return report;
}

}  // namespace sunder
