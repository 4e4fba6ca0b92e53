// SPDX-License-Identifier: MIT
// Report of one step: events, counts, energies.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "fracture/algorithms/fracture_report.hpp"
#include "fracture/energy/settled_crack.hpp"
#include "fracture/ties/tie_release.hpp"
#include "mechanics/contact/contact_report.hpp"
#include "mechanics/state/impulse.hpp"
#include "mechanics/state/rung.hpp"
#include "mechanics/state/step_status.hpp"

namespace sunder {

/// Stages of a step with reported times. `mechanics` covers contact, integration and element
/// stress.
enum class Stage { mechanics, fracture, rebuild, display };
inline constexpr std::array<std::string_view, 4> stage_names = {"mechanics", "fracture", "rebuild",
                                                                "display"};

/// Impact windows of a step.
struct ImpactReport {
  /// Number of components with a new window.
  std::uint32_t opened = 0;
  /// Impacts without a window, because the available energy cannot break the component, by the
  /// bound that proves it (`ImpactEnergy`).
  std::uint32_t spared_by_pair = 0, spared_by_island = 0;
  /// Windows that closed after the waves had crossed twice, and for lack of energy.
  std::uint32_t closed_by_time = 0, closed_by_energy = 0;
  /// Number of sub-steps, and their total simulated time, s.
  std::uint32_t sub_steps = 0;
  double time = 0;
  /// Most components sub-stepped at once: the struck ones and those in reach.
  std::uint32_t components = 0;
  /// Most neighbours of these, taken as rigid bodies.
  std::uint32_t carried = 0;
  /// Most cells with selective mass scaling (`ScaledCells`).
  std::uint32_t scaled_cells = 0;
  /// Largest ratio of a sub-step to the longest one that resolves its impact. Above 1 if a struck
  /// piece is smaller than the component of the window.
  double coarseness = 0;
  /// True: `ImpactSettings::max_sub_steps` was reached, and the rest of the step was taken at once.
  bool stopped = false;
};

constexpr auto counters_of(const ImpactReport*) {
  return std::tuple{Counter{"windows", &ImpactReport::opened},
                    Counter{"spared_by_pair", &ImpactReport::spared_by_pair},
                    Counter{"spared_by_island", &ImpactReport::spared_by_island},
                    Counter{"closed_by_time", &ImpactReport::closed_by_time},
                    Counter{"closed_by_energy", &ImpactReport::closed_by_energy},
                    Counter{"sub_steps", &ImpactReport::sub_steps},
                    Counter{"time", &ImpactReport::time},
                    Counter{"most_components", &ImpactReport::components, Adds::most},
                    Counter{"most_carried", &ImpactReport::carried, Adds::most},
                    Counter{"most_scaled_cells", &ImpactReport::scaled_cells, Adds::most},
                    Counter{"coarseness", &ImpactReport::coarseness, Adds::most}};
}

/// Numbers of components and of their tetrahedra by their activity level in the next step, rows as
/// `Rung`.
struct LadderReport {
  std::array<std::size_t, rung_count> components{}, tetrahedra{};
};

constexpr auto counters_of(const LadderReport*) {
  return std::tuple{Counter{"component_steps", &LadderReport::components},
                    Counter{"tetrahedron_steps", &LadderReport::tetrahedra}};
}

/// Rubble of a step.
struct RubbleStepReport {
  std::uint32_t ticks = 0;
  std::uint32_t awake = 0, asleep = 0;  ///< most bodies, with free balls
  std::uint32_t points = 0;             ///< most contact points
  double deepest = 0;                   ///< m, deepest overlap of contact patches
  std::uint32_t refused = 0;            ///< islands without a certificate: stepped in full
  std::uint32_t mixed = 0;              ///< islands of rubble and other pieces: stepped in full
  std::uint32_t solids = 0;             ///< islands near obstacles that are meshes: stepped in full
  std::uint32_t struck = 0;             ///< islands with a blow that could break: stepped in full
  std::uint32_t rigid = 0;              ///< most rigid pieces at once, single tetrahedra left out
  std::uint32_t declared = 0;           ///< most components declared never to break again
  double declared_share = 0;            ///< their largest share of the mass of all bodies
};

constexpr auto counters_of(const RubbleStepReport*) {
  return std::tuple{Counter{"ticks", &RubbleStepReport::ticks},
                    Counter{"most_awake", &RubbleStepReport::awake, Adds::most},
                    Counter{"most_asleep", &RubbleStepReport::asleep, Adds::most},
                    Counter{"most_points", &RubbleStepReport::points, Adds::most},
                    Counter{"deepest", &RubbleStepReport::deepest, Adds::most},
                    Counter{"refused", &RubbleStepReport::refused},
                    Counter{"mixed", &RubbleStepReport::mixed},
                    Counter{"solids", &RubbleStepReport::solids},
                    Counter{"struck", &RubbleStepReport::struck},
                    Counter{"most_rigid", &RubbleStepReport::rigid, Adds::most},
                    Counter{"declared", &RubbleStepReport::declared, Adds::most},
                    Counter{"declared_share", &RubbleStepReport::declared_share, Adds::most}};
}

/// Energy balance of the bodies in a step, J:
///   gravity + loads + contact + supports
///     = kinetic + strain + cracks + damping work + numerical + energy released + residual.
/// Each term is computed separately for each part of the step. None is the difference of others.
struct EnergyLedger {
  double kinetic = 0, strain = 0;  ///< change over the step
  double gravity = 0;              ///< sum m g . dx
  double loads = 0;                ///< work of surface loads, sum f . dx
  /// Work of contact on bodies: each impulse times the mean velocity of its point over the part. A
  /// fixed wall takes energy by friction, and by stopping the lumped layer that touches it.
  double contact = 0;
  double friction = 0;  ///< of that, heat of sliding, without the spin of free spheres
  double push_out = 0;  ///< of that, work of separating contacts that overlap at the start
  double supports = 0;  ///< work of supports that move
  double cracks = 0;    ///< work on ties: taken by cracks, or stored in ties
  /// Loss of the integration scheme: of deformations by its closed form (`numerical_loss`,
  /// `wave_loss`), and of the frames of touched pieces, which an impact stops without a rebound.
  /// For floating_frame only. The losses of other integrators are in the residual.
  double numerical = 0;
  double residual = 0;
  double moved = 0;  ///< sum of the magnitudes of all terms, to compare the residual with
};

/// Kinetic and strain energy of a run are those of its ends, and are not summed.
constexpr auto counters_of(const EnergyLedger*) {
  return std::tuple{Counter{"gravity_work", &EnergyLedger::gravity},
                    Counter{"load_work", &EnergyLedger::loads},
                    Counter{"contact_work", &EnergyLedger::contact},
                    Counter{"support_work", &EnergyLedger::supports},
                    Counter{"crack_work", &EnergyLedger::cracks},
                    Counter{"friction_heat", &EnergyLedger::friction},
                    Counter{"push_out_work", &EnergyLedger::push_out},
                    Counter{"numerical_loss", &EnergyLedger::numerical},
                    Counter{"residual", &EnergyLedger::residual}};
}

/// Impulses on bodies and free balls in a step, with their moments about the origin, by source.
/// Each is measured separately. Their sum must equal the change of momentum and angular momentum.
struct MomentumLedger {
  Impulse gravity = Impulse::Zero();    ///< weight of moving components
  Impulse loads = Impulse::Zero();      ///< surface loads, including those at supports
  Impulse obstacles = Impulse::Zero();  ///< of driven obstacles
  Impulse supports = Impulse::Zero();   ///< on supported components
  Impulse sleep = Impulse::Zero();      ///< motion stopped at the start of sleep
};

constexpr auto counters_of(const MomentumLedger*) {
  return std::tuple{
      Counter{"gravity", &MomentumLedger::gravity}, Counter{"loads", &MomentumLedger::loads},
      Counter{"obstacles", &MomentumLedger::obstacles},
      Counter{"supports", &MomentumLedger::supports}, Counter{"sleep", &MomentumLedger::sleep}};
}

/// Impulses of a step with their moments about the origin, and works, by rows of the scene.
/// Contact of sleeping pieces is not solved and is left out.
struct ForceReport {
  /// Of bodies and other obstacles on the obstacle. Row = obstacle.
  std::vector<Impulse> obstacle;
  /// Of supports on held boxes. Rows: `BodySettings::held`, body by body. The sum over one
  /// component is exact. Where several boxes hold it, each takes the impulses that balance stress,
  /// weight, loads and contact at its nodes, and a share of the rest by mass.
  std::vector<Impulse> held;
  /// J. Rows: `BodySettings::loads`, body by body. Their sum is `EnergyLedger::loads`.
  std::vector<double> load_work;
};

/// Report of one step.
struct StepReport {
  std::uint64_t step = 0;
  /// Simulated time at the end of the step, s.
  double time = 0;
  StepStatus status;
  ContactReport contact;
  FractureReport fracture;
  /// Time of each fan, s: the end of its sub-step.
  std::vector<double> fan_time;
  /// Number of each fan's search for fractures within the step, from 0 (`fan_part`), and the number
  /// of searches (`parts`).
  std::vector<std::uint32_t> fan_part;
  std::uint32_t parts = 0;
  /// Wall time of each fan, µs: choice of its plane, face splits, rows, components, thresholds. For
  /// reports only.
  std::vector<double> fan_us;
  /// True if the script has a fan that cannot be made (`FanScript::departure`).
  bool departed = false;
  ImpactReport impact;
  LadderReport ladder;
  RubbleStepReport rubble;
  MomentumLedger momentum;
  ForceReport forces;  ///< empty without `Simulation::reports_forces`
  EnergyLedger energy;
  TieReport ties;
  std::vector<TieRelease> releases;  ///< in order; those of a part precede its fans
  /// Earlier fans with their energy settled in this step. It is not in the ledger, because it goes
  /// into motion and from there into losses.
  std::vector<CrackEnergy> cracks;
  /// Energy released by pieces that became rigid tetrahedra, and by components at a lower activity
  /// level, J.
  double energy_released = 0;
  std::size_t components = 0;
  /// Components that came off in this step, ascending.
  std::vector<ComponentId> new_components;
  /// Wall time of each stage, ms. For reports only.
  std::array<double, stage_names.size()> stage_ms{};
};

}  // namespace sunder
