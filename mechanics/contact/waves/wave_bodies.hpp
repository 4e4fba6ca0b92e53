// SPDX-License-Identifier: MIT
// Bodies that deform in explicit steps: lumped nodes, packed elements, and the steps themselves.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mechanics/contact/waves/element_blocks.hpp"
#include "mechanics/contact/waves/scaled_cells.hpp"
#include "mechanics/contact/waves/wave_work.hpp"
#include "mechanics/state/impulse.hpp"
#include "mechanics/state/pose.hpp"
#include "mechanics/state/step_input.hpp"

namespace sunder {

/// Rows of the nodes of all bodies.
struct WaveNodes {
  QuadColumn position;      ///< m, world
  QuadColumn velocity;      ///< m/s, world
  QuadColumn displacement;  ///< m, body frame
  QuadColumn rate;          ///< m/s, body frame: the velocity
  QuadColumn inner;         ///< N, body frame: K times displacements, and C times their rates
  QuadColumn arm;           ///< m: rest position against the rest centre
  QuadColumn load;          ///< m/s^2, world: gravity and surface loads
  std::vector<double> mass,
      inverse_mass;               ///< kg, 1/kg; the inverse is 0 where a node is held whole
  std::vector<double> stiffness;  ///< N/m: sum over elements of c k_a (`coupling_of`)
  std::vector<double> damping;    ///< N s/m: likewise, each times the viscosity of its element
  std::vector<char> is_held;      ///< by a support, along some axis at least
  std::vector<VertexId> vertex;
  std::vector<ScaledCells> scaled;     ///< clusters of bad cells
  std::vector<std::uint32_t> cluster;  ///< row of `scaled`, or `ScaledCells::none`
  std::vector<std::uint32_t> place;    ///< in it

  std::size_t size() const { return vertex.size(); }
};

/// A node that supports hold along some axes of its body's frame.
struct HeldNode {
  std::uint32_t node = 0;
  AxisSet axes{};
  Vec3 velocity = Vec3::Zero();  ///< m/s, world
};

/// One body: consecutive rows of nodes, cells, blocks of either order and held nodes.
struct WaveBody {
  ComponentId id;
  std::size_t first_node = 0, end_node = 0;
  std::size_t first_cell = 0, end_cell = 0;
  std::size_t first_block = 0, end_block = 0;
  std::size_t first_second = 0, end_second = 0;
  std::size_t first_held = 0, end_held = 0;
  std::size_t first_scaled = 0, end_scaled = 0;
  double mass = 0;          ///< kg
  double mass_damping = 0;  ///< 1/s: factor of the mass, on rates of deformation
  bool supported = false;
  Vec3 frame_velocity{0, 0, 0};     ///< m/s, of a supported one
  Pose frame;                       ///< algorithm 2 where the nodes were at the last kick
  Vec3 weight_place{0, 0, 0};       ///< m s: places of the mass centre, times the lengths of kicks
  Impulse loads = Impulse::Zero();  ///< N s and N m s about the origin: got from surface loads
  /// The last forces and their kick: R, R [y]x of the torque's share, and its length, s.
  struct Kick {
    Mat3 R = Mat3::Identity(), Q = Mat3::Zero();
    double step = 0;
  } kicked;
  WaveWork work;
};

template <std::size_t nodes>
using BlockColumn = std::vector<ElementBlock<nodes>, CacheLineAllocator<ElementBlock<nodes>>>;

/// All bodies of a part of a step.
struct WaveBodies {
  static constexpr std::uint32_t no_node = std::numeric_limits<std::uint32_t>::max();
  WaveNodes nodes;
  std::vector<WaveBody> bodies;
  std::vector<TetId> cells;
  BlockColumn<4> blocks;
  BlockColumn<10> second;
  std::vector<HeldNode> held;
  std::vector<std::uint32_t> node_of_vertex;     ///< row = VertexId
  std::vector<std::uint32_t> body_of_component;  ///< row = ComponentId; `no_node`: moves rigidly
  /// Row = TetId: N/m, c k_a of its nodes (`coupling_of`); elements keep it for ever.
  std::vector<std::array<double, 10>> stiffness;
  std::vector<ScaledCells> scaled_before;  ///< of the part before
  QuadColumn velocity_before;   ///< m/s, as the step at hand began, where work is measured
  Vec3 gravity{0, 0, 0};        ///< m/s^2
  RayleighDamping damping;      ///< as the bodies were packed
  double of_fronts = 0;         ///< `StepPart::viscosity`, as the bodies were packed
  double longest_step = 0;      ///< s: `longest_step` as the bodies were packed
  std::vector<char> is_scaled;  ///< row = TetId: of cells in `WaveNodes::scaled`
  /// Highest eigenvalue that an element was known to have with some inverse masses (1/kg) of its
  /// nodes, 1/s^2.
  struct KnownHighest {
    std::array<double, 4> inverse{};
    double value = 0;
  };
  std::vector<std::array<KnownHighest, 3>> highest;  ///< row = TetId: of each round of shares
  bool measures_work = false;
  bool has_loads = false;
};

/// kg m^2, world: of the nodes of a body about the centre of its frame.
Mat3 inertia_of(const WaveNodes& nodes, const WaveBody& body);

/// Whether a component deforms in explicit steps. Others move as rigid bodies.
bool deforms_in_wave(const Component& component);

/// The members that deform, in the state as it is. Bodies are packed where one of them has changed
/// since the part before; else their motion is read. O(vertices + tetrahedra).
void pack_bodies(WaveBodies& waves, const MechanicsState& state, const StepInput& input);

/// Displacements where the nodes are, and the forces of algorithm 1 in its conservative form
/// (`deformation_forces`), with viscosity C d' in it.
void find_forces(WaveBodies& waves, WaveBody& body);

/// velocity += `step` s times the acceleration by these forces and by loads. Held nodes keep the
/// velocity of their support. `step` is half of a step at the ends of a part. Needs: `find_forces`,
/// `prepare_scaled_cells`.
void kick(WaveBodies& waves, WaveBody& body, double step);

/// Gives held nodes the velocity of their support along the axes on which they are held.
void follow_supports(WaveBodies& waves, const WaveBody& body);

/// Adds the work of the last kick's forces on the mean of two velocities: before the kick, and
/// after its contacts. On held nodes the rest is the work of supports and contacts
/// (`RowWork::on_held`).
void measure_work(const WaveBodies& waves, WaveBody& body);

/// position += `step` s times velocity.
void drift(WaveBodies& waves, WaveBody& body, double step);

/// s: the h of h^2 s + 2 h d = 4, with s in 1/s^2 and d in 1/s.
double step_of(double s, double d);

/// s: the longest step h that is stable for a body once its bad cells are scaled
/// (`prepare_scaled_cells`): at each node, of all other cells, h^2 s + 2 h d <= 4 m, with s and d
/// the sums of stiffness and damping. Then h^2 K + 2 h C <= 4 M, the bound of central differences
/// with forces of viscosity from the velocity half a step before.
double stable_step(const WaveBodies& waves, const WaveBody& body);

}  // namespace sunder
