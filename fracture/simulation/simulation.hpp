// SPDX-License-Identifier: MIT
// A scene in motion: one step is contact, mechanics, fracture, components. No file, no clock of
// walls in any result (times of stages are reported, never used).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/energy/crack_energy.hpp"
#include "fracture/simulation/fan_script.hpp"
#include "fracture/algorithms/find_fractures.hpp"
#include "fracture/simulation/scene.hpp"
#include "mechanics/contact/contact.hpp"
#include "mechanics/state/display_state.hpp"
#include "mechanics/loads.hpp"
#include "mechanics/step.hpp"

namespace sunder {

/// Impact windows: which components are stepped finely, and how finely.
struct ImpactWindow {
  static constexpr double closed = std::numeric_limits<double>::infinity();
  /// Row = ComponentId: s since the component last felt a blow; `closed` for all others.
  std::vector<double> quiet;
  /// s, the scene's step over a power of two; kept while a window is open.
  double sub_step = 0;
};

/// What decides on which rung components take their steps, beside their rows.
struct LadderState {
  std::vector<double> still;  ///< row = ComponentId: s for which it has lain still
};

/// What evolves and would have to be saved to go on later.
struct SimulationState {
  Cells cells;
  MechanicsState mechanics;
  /// Those of the scene, where they are now.
  std::vector<Obstacle> obstacles;
  ContactMemory contact;
  ImpactWindow impact;
  LadderState ladder;
  /// Row = ComponentId: where each component is drawn (section 3.3), and the target it was given in
  /// the last step.
  std::vector<DisplayState> display, display_target;
  std::vector<OpenCrack> cracks;  ///< whose energy is still being measured
  std::uint64_t fans = 0;         ///< so far
  std::uint64_t step = 0;
};

/// The state at the start of the part of a step at hand, for the energy ledger.
struct PartStart {
  std::vector<Vec3> position;                          ///< m, world
  std::vector<Vec3> displacement, rate, acceleration;  ///< m, m/s, m/s^2, body frame
  std::vector<Vec3> momentum, angular_momentum;        ///< row = ComponentId
  std::vector<double> work;                            ///< of a product with K
  std::vector<char> touched;                           ///< row = ComponentId: contact gave it some
};

/// What the choice of rungs looks at, rows = ComponentId.
struct LadderScratch {
  std::vector<char> touched;  ///< a contact has pushed at it in this step
  std::vector<char> rested, loaded;
  std::vector<std::array<std::size_t, 2>> touching;
};

/// Working memory of a step and caches; can be thrown away between steps.
struct SimulationScratch {
  MechanicsScratch mechanics;
  ContactScratch contact;
  FractureScratch fracture;
  LadderScratch ladder;
  PartStart before;
  Loads loads;
};

/// Rows of one body of the scene: its tetrahedra and the points of its mesh are consecutive.
struct BodyRows {
  std::size_t first_tetrahedron = 0, end_tetrahedron = 0;
  std::size_t first_point = 0, end_point = 0;
};

/// A scene with its state. The scene's settings do not change while it runs.
struct Simulation {
  Scene scene;
  std::vector<BodyRows> bodies;
  /// Those of all bodies (`BodySettings::loads`); corners keep them through every split.
  std::vector<CornerLoad> loads;
  /// Fans to make in place of finding any: those of an earlier run (replay).
  std::optional<FanScript> script;
  SimulationState state;
  SimulationScratch scratch;
};

/// Stages of a step whose times are reported.
/// `mechanics` is contact, integration and element stress.
enum class Stage { mechanics, fracture, rebuild, display };
inline constexpr std::array<std::string_view, 4> stage_names = {"mechanics", "fracture", "rebuild",
                                                                "display"};

/// What impact windows did in a step.
struct ImpactReport {
  /// Components for which a window opened.
  std::uint32_t opened = 0;
  /// Sub-steps, and the time they took together, s.
  std::uint32_t sub_steps = 0;
  double time = 0;
  /// Most components that were stepped finely at once: the struck ones and what they could reach.
  std::uint32_t components = 0;
  /// Largest sub-step over the longest that resolves a blow it met; above 1 where pieces were
  /// struck that are smaller than the one the window was opened for.
  double coarseness = 0;
  /// `ImpactSettings::max_sub_steps` was reached: the rest of the step was taken at once.
  bool stopped = false;
};

/// Components and their tetrahedra by the rung of the step to come, rows as `Rung`.
struct LadderReport {
  std::array<std::size_t, rung_count> components{}, tetrahedra{};
};

/// Where the energy of the bodies went in a step, J: work in = what came of it + residual,
///   gravity + loads + contact + supports
///     = kinetic + strain + damping work + numerical + energy released + residual.
/// Everything is recomputed from rows and impulses, part by part; nothing is taken as the rest.
struct EnergyLedger {
  double kinetic = 0, strain = 0;  ///< change over the step
  double gravity = 0;              ///< sum m g . dx
  double loads = 0;                ///< of surface loads, sum f . dx
  /// Of contact on bodies: each impulse times the mean velocity of its point over the part. A wall
  /// that stands still takes by friction, and by stopping the lumped layer that touches it.
  double contact = 0;
  double friction = 0;  ///< of that, what sliding turned into heat; free spheres' turning left out
  double supports = 0;  ///< of supports that move
  /// What the scheme took: of deformations by its closed form (`numerical_loss`, `wave_loss`), and
  /// of the frame of what is touched, which a blow stops without a bounce. Only of floating_frame;
  /// what other integrators take is in the residual.
  double numerical = 0;
  double residual = 0;
  double moved = 0;  ///< sum of the sizes of all terms: what the residual is to be compared with
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
  /// Whether the script has a fan that cannot be made (`FanScript::departure`).
  bool departed = false;
  ImpactReport impact;
  LadderReport ladder;
  /// N s, given by surface loads, what acts at supports too.
  Vec3 load_impulse = Vec3::Zero();
  EnergyLedger energy;
  /// Fans whose energy was settled in this step; not of this step, and not in the ledger: what
  /// they give up goes into motion and from there into losses.
  std::vector<CrackEnergy> cracks;
  /// J, given up by pieces that became rigid tetrahedra and by components that took a lower rung.
  double energy_released = 0;
  std::size_t components = 0;
  /// Wall time of each stage, ms. For reports only.
  std::array<double, stage_names.size()> stage_ms{};
};

/// A part of a step as an observer sees it, right after it was taken and before anything breaks.
struct PartReport {
  Deformation deformation = Deformation::whole;
  double length = 0;  ///< s
  const ContactReport& contact;
};
using StepObserver = std::function<void(const Simulation&, const PartReport&)>;

/// Builds every body of a scene at its start: map, columns, supports, placement, components.
/// The findings tell all that is wrong with meshes, materials, obstacles and settings; warnings and
/// notes may stand beside a simulation. O(|T|).
Result<Simulation> build_simulation(Scene scene);

/// One step of length `scene.time_step`: contact and external forces -> integrate -> element stress
/// at the new state -> fracture -> components (decisions.md, Order of a step).
/// A step that would run into a blow is divided for the components struck and what they can reach:
/// frozen deformations up to the blow, sub-steps while it lasts, each with its own fractures, and
/// the rest at once; all others take the whole step, and everybody meets at its end
/// (docs/impact.md). `observe` is called after each part.
/// With a script its fans are made instead of looking for any.
/// After an outcome other than fine in `status`, a stress that is not a number, or a departure from
/// the script, the simulation must not be advanced further; the state is as computed, for whoever
/// wants to look.
StepReport advance(Simulation& simulation, const StepObserver& observe = {});

/// Gravity at a time, m/s^2: raised linearly over the ramp.
Vec3 gravity_at(const GravitySettings& gravity, double time);

}  // namespace sunder
