// SPDX-License-Identifier: MIT
// Measures a run from the rows of its state, and its fans from the step reports.
#include "apps/bench/chart/chart_measure.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "fracture/algorithms/find_fractures.hpp"
#include "mechanics/element/energy.hpp"

namespace sunder {
namespace {

constexpr std::string_view of_the_value = "the reference's size";
constexpr auto table = std::to_array<QuantityTraits>({
    {Quantity::position, "position", "m", "place of a point of the first body at the end", true,
     "the way of the point in the reference"},
    {Quantity::peak_stress, "peak_stress", "Pa",
     "largest size of a principal node stress over the run", false, of_the_value},
    {Quantity::end_stress, "end_stress", "Pa", "largest size of a principal node stress at the end",
     false, of_the_value},
    {Quantity::energy, "energy", "J",
     "kinetic and strain energy of the bodies at the end, less the work of gravity", false,
     of_the_value},
    {Quantity::momentum, "momentum", "kg m/s", "momentum of the bodies at the end", true,
     of_the_value},
    {Quantity::angular_momentum, "angular_momentum", "kg m^2/s",
     "angular momentum of the bodies about the world's origin at the end", true, of_the_value},
    {Quantity::first_fan_time, "first_fan_time", "s", "time of the first crack", false,
     of_the_value},
    {Quantity::first_fan_place, "first_fan_place", "m",
     "where the vertex that breaks first is at rest", true, "the bodies' extent at rest"},
    {Quantity::fans, "fans", "", "number of cracks, a vertex each", false, of_the_value},
    {Quantity::largest_piece, "largest_piece", "",
     "mass of the largest piece at the end, as a share of all", false, of_the_value},
    {Quantity::pieces, "pieces", "", "number of pieces at the end", false, of_the_value},
    {Quantity::debris, "debris", "",
     "mass of the pieces smaller than eight mean tetrahedra of the first mesh, as a share of all",
     false, of_the_value},
});

/// Barycentric coordinates of a point in a tetrahedron at rest.
Eigen::Vector4d weights(const MechanicsState& state, const Corners& corners, TetId tet,
                        const Vec3& point) {
  const ShapeGradient& gradient = state.elements.shape_gradient[tet.index()];
  Vec3 middle = Vec3::Zero();
  for (const VertexId v : corners) middle += state.vertices.rest_position[v.index()] / 4;
  return Eigen::Vector4d::Constant(0.25) + gradient.transpose() * (point - middle);
}

/// Largest size of an eigenvalue over all node stresses, Pa.
double largest_stress(const Simulation& now) {
  const MechanicsState& m = now.state->mechanics;
  const std::vector<Mat3> node =
      node_stress_of(now.state->cells, m, now.scene.fracture.node_stress);
  double largest = 0;
  for (const Mat3& sigma : node) {
    // The largest size of an eigenvalue is no larger than the norm: most need no eigenvalues.
    if (sigma.norm() <= largest || !sigma.allFinite()) continue;
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(sigma, Eigen::EigenvaluesOnly);
    largest = std::max(largest, solver.eigenvalues().cwiseAbs().maxCoeff());
  }
  return largest;
}

double potential(const Simulation& now) {
  const MechanicsState& m = now.state->mechanics;
  return gravity_energy(m.vertices, gravity_at(now.scene.gravity, m.time));
}

double largest_share(const MechanicsState& m) {
  double largest = 0, all = 0;
  for (const Component& c : m.components) {
    largest = std::max(largest, c.mass);
    all += c.mass;
  }
  return largest / all;
}

/// Mass of pieces below a volume at rest, as a share of all.
double debris_share(const MechanicsState& m, double below) {
  double debris = 0, all = 0;
  for (const Component& c : m.components) {
    double volume = 0;
    for (const TetId t : c.tetrahedra) volume += m.elements.rest_volume[t.index()];
    if (volume < below) debris += c.mass;
    all += c.mass;
  }
  return debris / all;
}

double rest_extent(const VertexColumns& vertices) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : vertices.rest_position) box.extend(p);
  return box.diagonal().norm();
}

}  // namespace

std::span<const QuantityTraits> quantities() { return table; }

const QuantityTraits& traits_of(Quantity quantity) {
  return table[static_cast<std::size_t>(quantity)];
}

Measure::Measure(const Probe& probe, const Simulation& start) : probe_(probe) {
  const MechanicsState& m = start.state->mechanics;
  double best = -std::numeric_limits<double>::infinity();
  const BodyRows& body = start.bodies.front();
  for (std::size_t t = body.first_tetrahedron; t < body.end_tetrahedron; ++t) {
    const Eigen::Vector4d w =
        weights(m, start.state->cells.map.corners()[t], TetId{t}, probe.point);
    if (w.minCoeff() > best) {
      best = w.minCoeff();
      holder_ = TetId{t};
      weight_ = w;
    }
  }
  potential_at_start_ = potential(start);
  extent_ = rest_extent(m.vertices);
  at_start_ = state_value(start);
}

bool Measure::watches_parts() const { return probe_.quantity == Quantity::peak_stress; }

void Measure::see_part(const Simulation& now) { peak_ = std::max(peak_, largest_stress(now)); }

void Measure::see_step(const Simulation&, const StepReport& report) {
  fans_ += static_cast<double>(report.fracture.fans.size());
  if (first_fan_ || report.fracture.fans.empty()) return;
  first_fan_ = probe_.quantity == Quantity::first_fan_place
                   ? report.fracture.fans.front().rest_position
                   : Vec3(report.fan_time.front(), 0, 0);
}

Vec3 Measure::position(const Simulation& now) const {
  const Corners& corners = now.state->cells.map.corners()[holder_.index()];
  Vec3 x = Vec3::Zero();
  for (std::size_t a = 0; a < 4; ++a) {
    x += weight_[static_cast<Eigen::Index>(a)] *
         now.state->mechanics.vertices.position[corners[a].index()];
  }
  return x;
}

Vec3 Measure::state_value(const Simulation& now) const {
  const MechanicsState& m = now.state->mechanics;
  switch (probe_.quantity) {
    case Quantity::position:
      return position(now);
    case Quantity::end_stress:
      return {largest_stress(now), 0, 0};
    case Quantity::energy:
      return {kinetic_energy(m.vertices) + strain_energy(m) + potential(now) - potential_at_start_,
              0, 0};
    case Quantity::momentum:
      return momentum(m.vertices);
    case Quantity::angular_momentum:
      return angular_momentum(m.vertices);
    case Quantity::largest_piece:
      return {largest_share(m), 0, 0};
    case Quantity::pieces:
      return {static_cast<double>(m.components.size()), 0, 0};
    case Quantity::debris:
      return {debris_share(m, probe_.debris_volume), 0, 0};
    case Quantity::peak_stress:
    case Quantity::first_fan_time:
    case Quantity::first_fan_place:
    case Quantity::fans:
      break;
  }
  return Vec3::Zero();
}

std::optional<Vec3> Measure::value(const Simulation& end) const {
  if (probe_.quantity == Quantity::peak_stress) return Vec3(peak_, 0, 0);
  if (probe_.quantity == Quantity::fans) return Vec3(fans_, 0, 0);
  if (probe_.quantity == Quantity::first_fan_time || probe_.quantity == Quantity::first_fan_place) {
    return first_fan_;
  }
  return state_value(end);
}

double Measure::scale(const Vec3& reference) const {
  double scale = reference.norm();
  if (probe_.quantity == Quantity::position) scale = (reference - at_start_).norm();
  if (probe_.quantity == Quantity::first_fan_place) scale = extent_;
  // Where the reference is zero, errors have the quantity's own unit.
  return scale > 0 ? scale : 1;
}

}  // namespace sunder
