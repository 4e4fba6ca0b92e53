// SPDX-License-Identifier: MIT
// One step with contact at work: the data that its passes share. For the sources of contact only.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "mechanics/contact/cohesion/contact_ties.hpp"
#include "mechanics/contact/detection/contact_detect.hpp"
#include "mechanics/contact/response/contact_bodies.hpp"

namespace sunder {

/// The values that identify a contact.
using ContactKey =
    std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, VertexId, TetId, std::uint8_t,
               std::uint32_t, std::uint32_t, TetId, HalfFaceId, std::uint8_t>;
inline ContactKey key_of(const ContactPoint& c) {
  return {c.ball,     c.corner, c.edge_a,      c.vertex, c.tetrahedron_a, c.place_a,
          c.obstacle, c.edge_b, c.tetrahedron, c.face,   c.place};
}

/// The values at the start that a step changes before it is adopted.
struct StepStart {
  std::vector<std::array<Vec3, 2>> momenta;  ///< row = ComponentId: P, L
  std::vector<Rung> rungs;
  std::vector<Obstacle> obstacles;
  std::vector<Vec3> velocity;  ///< |V|, m/s
};

struct WaveScratch;

struct ContactScratch::Buffers {
  Buffers();
  ~Buffers();
  DetectScratch detect;
  StepStart start;
  ContactBodies bodies;
  StepBlows blows;
  std::vector<Pose> ball_end;
  std::vector<Vec3> change;
  std::vector<ContactKey> known;
  std::vector<char> rests;  ///< components, then obstacles: that begin on something
  /// Row = ComponentId, m/s^2 and rad/s^2 of free components; empty without surface loads.
  std::vector<std::array<Vec3, 2>> load_acceleration;
  std::unique_ptr<WaveScratch> wave;   ///< of explicit steps; null until needed
  std::vector<ContactPoint> left_out;  ///< that end too deep and were not solved for
};

/// One step at work.
struct ContactStep {
  /// The contacts that the next detection looks for.
  enum class Look {
    resting,  ///< all; of bodies that rest on something only those with their supports
    all,
    overlaps,  ///< tetrahedra that overlap as the step ends, once all else is solved
  };
  ContactPass pass;
  IntegratorSettings& integrator;  ///< of `pass.input`: an explicit wave may shorten its length
  ContactMemory& memory;
  const ContactSettings& settings;
  ContactScratch::Buffers& scratch;
  ContactReport report;
  Blows blows;
  std::vector<ContactPoint> contacts;
  std::vector<TiePair> ties = {};
  std::vector<ContactPoint> tied = {};  ///< the same as contacts, with their impulses
  std::size_t tied_rows = 0;            ///< so many of `contacts`, the first ones, are ties
  double tie_residual = 0;
  Look look = Look::all;
  double ahead = 0;                   ///< s: how far paths go, where that is not the part's length
  double margin = 0;                  ///< m: `StepPaths::margin`
  std::span<const Scope> scope = {};  ///< `StepPaths::scope`
  std::optional<WaveTrace> trace = {};  ///< of explicit steps
  std::uint32_t sub_steps = 1;          ///< of an explicit wave, that were taken
  bool has_left = false;                ///< something was left to the next pass
  bool stalled = false;  ///< the last solve ended near its tolerance (`SolveOutcome`)

  double h() const { return pass.input.settings.time_step; }
  Deformation deformation() const { return pass.input.part.deformation; }
  bool is_wave() const { return deformation() == Deformation::wave; }
};

/// Pa, of the weakest vertex of a component. Needs: `StepPart::impact`.
inline double strength_of(const ContactStep& step, ComponentId id) {
  return step.pass.input.part.strength[id.index()];
}

/// The components that a contact acts on; null where a side is none. Both are the same where a
/// crack closes within one component.
std::array<Component*, 2> sides_of(const ContactStep& step, const ContactPoint& contact);

/// Sums of the surface loads on a component as the step begins: force (N), and moment about its
/// centre (N m). Zero without loads.
std::array<Vec3, 2> surface_load(const ContactStep& step, const Component& component);

/// Paths through the step as it is predicted now.
StepPaths paths_of(const ContactStep& step);

/// Keeps the values that a step changes before it is adopted. Explicit parts are always taken.
void remember_start(ContactStep& step);

/// A step that is not taken leaves nothing behind.
void put_back(ContactStep& step);

/// Free obstacles at the end of the step.
void predict_balls(ContactStep& step);

/// Passes until the predicted gaps are as solved for. The residual is the largest error left. False
/// when there are blows ahead.
bool resolve(ContactStep& step);

/// `ContactStepResult::passing_way`: of pieces that pass each other between the ends of the step.
double way_of_passing(ContactStep& step);

/// Where the gap may be at the end of the step, m: no deeper than it began.
double target_gap(const ContactPoint& contact);

/// How much farther out a contact that is too deep should come in the step, m.
double push_out(const ContactStep& step, const ContactPoint& contact);

/// m: how far the gap of a contact's row is from where it may be with the impulse as it is.
double row_error(const Constraint& row);

/// How much farther apart two sides end than predicted, m, once gravity is an impulse at the start
/// for sides that have not been touched yet.
Vec3 relative_shift(const ContactStep& step, const ContactPoint& contact);

/// Predicted gap at the end of the step less its target, m; negative: a constraint violation.
double predicted_gap_error(const ContactStep& step, const ContactPoint& contact,
                           const ContactPath& path);

/// Finds contacts along the paths and wakes the components that they act on. False when there are
/// blows on them that the step must not run into.
bool meet(ContactStep& step, double deepest);

/// Puts the contacts that have come near since the last pass into `detect.order`: overlaps, deepest
/// first, and gaps smaller than the largest depth. Gives that depth, m; 0 when nothing overlaps.
double find_new_contacts(ContactStep& step, double deepest);

/// Adds these contacts to those of the step: for each pair a set that spans its patch.
void take_new_contacts(ContactStep& step);

/// For the last pass instead: notes those of them that end too deep. Gives the largest depth, m.
double leave_new_contacts(ContactStep& step);

/// Raises all components that contacts of the step act on to the rung `full`. Contacts of which
/// neither side moves are forgotten.
void wake_touched(ContactStep& step);

/// N s that a contact had in the last step, for the length of this one; 0 if it was none.
Vec3 last_impulse(const ContactStep& step, const ContactPoint& contact);

/// Lets the first pass begin with the forces that the same contacts needed in the last step.
void guess_from_last_step(ContactStep& step);

/// Contacts of this step in place of those of the members' last one.
void remember_contacts(ContactStep& step);

/// Contact as the paper has it, for `ContactMethod::penalty`: finds the contacts of the step and
/// gives their impulses.
void push_by_penalty(ContactStep& step);

/// Tolerance of ties, as a share of the opening that ends a tie. Impulses of ties are exact for any
/// force. This value bounds the creep of ties that stick.
inline constexpr double tie_tolerance = 1e-3;

/// The ties of a whole step, as the first of its contacts.
void begin_ties(ContactStep& step);

/// Takes the ties from the contacts after the last pass. Corners note how far they have opened.
TieReport finish_ties(ContactStep& step);

/// Reports the blows among the contacts found, and in a frozen part forgets them.
void look_for_blows(ContactStep& step);

/// Lists the components inside a blow in `step.blows`. Needs: the state of the start.
void feel_blows(ContactStep& step);

}  // namespace sunder
