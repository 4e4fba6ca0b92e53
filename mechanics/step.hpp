// SPDX-License-Identifier: MIT
// One step of mechanics: predict, then adopt; loads, settings and scratch, each a type of its own.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "mechanics/element/energy.hpp"
#include "mechanics/integrators/settings.hpp"
#include "mechanics/state/mechanics_state.hpp"
#include "mechanics/step_status.hpp"

namespace sunder {

struct BaselineSystem;
struct ColumnScratch;
struct ImpactSettings;

/// What acts during one step from outside, constant over the step.
struct Loads {
  Vec3 gravity = Vec3::Zero();   ///< m/s^2
  std::vector<Vec3> force = {};  ///< N, world, |V| rows; empty: none
  /// Which part of `force` turns with its body during the step, as pressure does, so that its
  /// moment stays what it was at the start; the rest keeps its direction. |V| rows; empty: none.
  std::vector<Vec3> turning = {};
  /// Gravity changes velocities at the start of the step instead of bending paths to parabolas: for
  /// what contact presses, whose rest would otherwise be a saw-tooth of +- g h / 2. For implicit
  /// Euler; others take no note of it.
  bool weight_at_start = false;
};

/// What `predict` computes for one component beside its rows.
struct PredictedFrame {
  Vec3 centre = Vec3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vec3 momentum = Vec3::Zero();
  Vec3 angular_momentum = Vec3::Zero();
  double damping_work = 0;  ///< J taken by Rayleigh damping in this step
  double turned = 0;        ///< rad: h^2 / I times the largest moment of forces that do not turn
  SolveReport solve = {};
};

/// Scratch of one step, and what follows from the state to the bit. All of it can be thrown away
/// between two steps; the next gives the same bytes. Bounded by the present mesh.
struct MechanicsScratch {
  MechanicsScratch();
  ~MechanicsScratch();
  MechanicsScratch(MechanicsScratch&&) noexcept;
  MechanicsScratch& operator=(MechanicsScratch&&) noexcept;

  /// What the baselines keep for a component; row = ComponentId, null until needed.
  std::vector<std::unique_ptr<BaselineSystem>> baselines;

  /// Predicted state, rows as in the state. `position` is what contact looks at.
  struct Predicted {
    std::vector<Vec3> position, velocity;
    std::vector<Vec3> displacement, displacement_rate, displacement_acceleration;
    std::vector<PredictedFrame> frame;  ///< row = ComponentId
  } predicted;

  /// Local vectors of the component at hand, 3 n each, grown to the largest and kept.
  std::array<std::vector<double>, 8> local;
  std::vector<Lame> lame;                   ///< row = MaterialId
  std::vector<StressEnergy> stress_energy;  ///< row = MaterialId
  /// Row = TetId: the step that its element stands explicitly, s; elements keep it for ever. Empty
  /// until needed.
  std::vector<double> element_step_bound;
  std::vector<ColumnScratch> columns;  ///< one a thread
};

/// How deformations go through a step of floating_frame, or through a part of one.
enum class Deformation {
  whole,     ///< by generalised-alpha
  frozen,    ///< not at all: the frame moves alone (held vertices keep their motion)
  catch_up,  ///< by generalised-alpha over the whole step, in a part that may be shorter
  wave,      ///< by the scheme of impacts (`WaveScheme`)
};

/// Which part of a step is taken; `IntegratorSettings::time_step` is its length.
struct StepPart {
  Deformation deformation = Deformation::whole;
  double whole_step = 0;  ///< s, for `catch_up`
  /// Given, contact looks out for blows (`advance_with_contact`).
  const ImpactSettings* impact = nullptr;
};

/// What a step moves, by rows of components and obstacles: 0 keeps still and meets nothing.
/// Empty: everything moves.
struct StepMembers {
  std::span<const char> component, ball;
  bool has(ComponentId id) const { return component.empty() || component[id.index()] != 0; }
  bool has_ball(std::size_t row) const { return ball.empty() || ball[row] != 0; }
};

/// What acts on the state in one step; nothing in it is changed. The spans and references must
/// outlive the call. Parts and members are for whoever divides steps
/// (fracture/simulation/plan.hpp).
struct StepInput {
  std::span<const Corners> corners;  ///< |T|
  const Loads& loads;
  const IntegratorSettings& settings;
  StepPart part = {};
  StepMembers members = {};
  /// Whether `Component::strain_change` is wanted.
  bool measures_strain = false;
  /// Threads that factors and columns of the inverse are made on. Results are the same bytes for
  /// any number.
  unsigned threads = 1;

  /// s, over which the deformation goes by generalised-alpha.
  double deformation_step() const {
    return part.deformation == Deformation::catch_up ? part.whole_step : settings.time_step;
  }
};

/// Computes the state of `components` at the end of the step into `scratch.predicted`: it may be
/// run again, say after `apply_impulses`. Builds and factors what is missing for these components
/// in `state.systems` (110 ms at 6 000 tetrahedra, once), then one solve each; changes nothing
/// else.
void predict(MechanicsScratch& scratch, MechanicsState& state, const StepInput& input,
             std::span<const ComponentId> components);

/// Builds and factors what the components will need in this part of a step, on
/// `StepInput::threads` threads: `predict` would do it one by one.
void prepare(MechanicsState& state, const StepInput& input);

/// Makes the predicted state of every member the present one, advances the time, and computes
/// element stress and turn in one pass. Needs: `predict` for every living member since the last
/// adoption. On an outcome other than fine the state is as computed, for whoever wants to look.
StepStatus adopt(MechanicsState& state, MechanicsScratch& scratch, const StepInput& input);

/// The whole step without contact: predict all, adopt.
StepStatus advance(MechanicsState& state, MechanicsScratch& scratch, const StepInput& input);

/// Which elements are measured, and how.
struct ElementMeasure {
  StepMembers members = {};
  ElasticModel model = ElasticModel::rigid_reference;
  bool strain = false;  ///< whether the change of strain energy is wanted
};

/// Element stress (eq. 5) and the largest turn of an element in each component, in one pass, from
/// the displacements as they are. `adopt` does it; for whoever sets displacements otherwise. With
/// corotational elements the stress is that of their own strain, in the body frame as if they had
/// not turned in it (the rest configuration, where cracks are decided), and turns count as none.
void measure_elements(MechanicsState& state, MechanicsScratch& scratch,
                      std::span<const Corners> corners, const ElementMeasure& measure = {});

/// The ids of the components that live (have tetrahedra) and are members, ascending.
std::vector<ComponentId> living_components(const MechanicsState& state,
                                           const StepMembers& members = {});

}  // namespace sunder
