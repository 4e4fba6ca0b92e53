// SPDX-License-Identifier: MIT
// What one step did: events, counts, where its energy went.
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

/// Stages of a step whose times are reported.
/// `mechanics` is contact, integration and element stress.
enum class Stage { mechanics, fracture, rebuild, display };
inline constexpr std::array<std::string_view, 4> stage_names = {"mechanics", "fracture", "rebuild",
                                                                "display"};

/// What impact windows did in a step.
struct ImpactReport {
  /// Components for which a window opened.
  std::uint32_t opened = 0;
  /// How often one was struck and judged unable to break with the energy at hand, by which bound
  /// (`ImpactEnergy`).
  std::uint32_t spared_by_pair = 0, spared_by_island = 0;
  /// Windows that closed as the waves had gone to and fro, and as they held too little energy.
  std::uint32_t closed_by_time = 0, closed_by_energy = 0;
  /// Sub-steps, and the time they took together, s.
  std::uint32_t sub_steps = 0;
  double time = 0;
  /// Most components that were sub-stepped at once: those struck and what they could meet.
  std::uint32_t components = 0;
  /// Most that stood round those as rigid bodies.
  std::uint32_t carried = 0;
  /// Largest sub-step over the longest that resolves a blow it met; above 1 where pieces were
  /// struck that are smaller than the one the window was opened for.
  double coarseness = 0;
  /// `ImpactSettings::max_sub_steps` was reached: the rest of the step was taken at once.
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
                    Counter{"coarseness", &ImpactReport::coarseness, Adds::most}};
}

/// Components and their tetrahedra by the rung of the step to come, rows as `Rung`.
struct LadderReport {
  std::array<std::size_t, rung_count> components{}, tetrahedra{};
};

constexpr auto counters_of(const LadderReport*) {
  return std::tuple{Counter{"component_steps", &LadderReport::components},
                    Counter{"tetrahedron_steps", &LadderReport::tetrahedra}};
}

/// What the rung `rubble` did in a step.
struct RubbleStepReport {
  std::uint32_t ticks = 0;
  std::uint32_t awake = 0, asleep = 0;  ///< most bodies, free balls among them
  std::uint32_t points = 0;             ///< most of contact
  double deepest = 0;                   ///< m, overlap where patches were found
  std::uint32_t refused = 0;  ///< islands whose certificate failed: they were stepped in full
  std::uint32_t mixed = 0;    ///< islands of rubble and of what is none: stepped in full
  std::uint32_t solids = 0;   ///< islands near obstacles that are meshes: stepped in full
  std::uint32_t rigid = 0;    ///< most rigid pieces at once, single tetrahedra left out
  std::uint32_t declared = 0;  ///< most components declared never to break again
  double declared_share = 0;   ///< most of the mass of all bodies in them
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
                    Counter{"most_rigid", &RubbleStepReport::rigid, Adds::most},
                    Counter{"declared", &RubbleStepReport::declared, Adds::most},
                    Counter{"declared_share", &RubbleStepReport::declared_share, Adds::most}};
}

/// Where the energy of the bodies went in a step, J: work in = what came of it + residual,
///   gravity + loads + contact + supports
///     = kinetic + strain + cracks + damping work + numerical + energy released + residual.
/// Every term is computed by itself, part by part of the step; none is the difference of others.
struct EnergyLedger {
  double kinetic = 0, strain = 0;  ///< change over the step
  double gravity = 0;              ///< sum m g . dx
  double loads = 0;                ///< of surface loads, sum f . dx
  /// Of contact on bodies: each impulse times the mean velocity of its point over the part. A wall
  /// that stands still takes by friction, and by stopping the lumped layer that touches it.
  double contact = 0;
  double friction = 0;  ///< of that, what sliding turned into heat; free spheres' turning left out
  double push_out = 0;  ///< of that, given by contacts that began overlapped, as they came apart
  double supports = 0;  ///< of supports that move
  double cracks = 0;    ///< done on ties: what cracks take, and what opens and shuts with them
  /// What the scheme took: of deformations by its closed form (`numerical_loss`, `wave_loss`), and
  /// of the frame of what is touched, which a blow stops without a bounce. Only of floating_frame;
  /// what other integrators take is in the residual.
  double numerical = 0;
  double residual = 0;
  double moved = 0;  ///< sum of the magnitudes of all terms, to compare the residual with
};

/// Kinetic and strain energy are those of the ends of a run and do not add up in it.
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

/// Impulses that bodies and free balls got in a step, with their moments about the origin, by where
/// they came from. Each is measured by itself: together they give the change of momentum and
/// angular momentum, or something is wrong.
struct MomentumLedger {
  Impulse gravity = Impulse::Zero();    ///< weight of what moved
  Impulse loads = Impulse::Zero();      ///< of surface loads, what acts at supports too
  Impulse obstacles = Impulse::Zero();  ///< of obstacles that move as they are told
  Impulse supports = Impulse::Zero();   ///< on held components
  Impulse sleep = Impulse::Zero();      ///< what was stopped as it fell asleep
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

/// What one step did.
struct StepReport {
  std::uint64_t step = 0;
  /// s, at the end of the step.
  double time = 0;
  StepStatus status;
  ContactReport contact;
  FractureReport fracture;
  /// s, of each fan: the end of the sub-step in which it came.
  std::vector<double> fan_time;
  /// Of each fan: which search for fractures of the step it came from, from 0; and how many
  /// searches there were.
  std::vector<std::uint32_t> fan_part;
  std::uint32_t parts = 0;
  /// Wall time of each fan, us: choosing its plane, splitting faces, rows, components, thresholds.
  /// For reports only.
  std::vector<double> fan_us;
  /// Whether the script has a fan that cannot be made (`FanScript::departure`).
  bool departed = false;
  ImpactReport impact;
  LadderReport ladder;
  RubbleStepReport rubble;
  MomentumLedger momentum;
  ForceReport forces;
  EnergyLedger energy;
  TieReport ties;
  std::vector<TieRelease> releases;  ///< in their order; those of a part come before its fans
  /// Fans whose energy was settled in this step; not of this step, and not in the ledger: what
  /// they give up goes into motion and from there into losses.
  std::vector<CrackEnergy> cracks;
  /// J, given up by pieces that became rigid tetrahedra and by components that took a lower rung.
  double energy_released = 0;
  std::size_t components = 0;
  /// Those that came off in this step, ascending.
  std::vector<ComponentId> new_components;
  /// Wall time of each stage, ms. For reports only.
  std::array<double, stage_names.size()> stage_ms{};
};

}  // namespace sunder
