// SPDX-License-Identifier: MIT
// Central differences in floating frames.
#include "mechanics/contact/waves/wave_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/frame/rotation.hpp"
#include "mechanics/solver/block_lanes.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/inertia.hpp"

namespace sunder {
namespace {

/// Three columns of a matrix, and a vector, as lanes.
struct Turned {
  alignas(32) double column[3][4];
  alignas(32) double centre[4];
};

Turned turned(const Mat3& M, const Vec3& centre) {
  Turned t{};
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) t.column[j][i] = M(i, j);
    t.centre[j] = centre[j];
  }
  return t;
}

/// Sums over the nodes of a body: a vector, or a matrix by its columns.
struct NodeSums {
  alignas(32) double column[3][4];

  Vec3 first() const { return {column[0][0], column[0][1], column[0][2]}; }
  Mat3 matrix() const {
    Mat3 M;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) M(i, j) = column[j][i];
    }
    return M;
  }
};

/// sum m x.
SUNDER_LANES void sum_positions(NodeSums& sums, const WaveNodes& nodes, std::size_t first,
                                std::size_t end) {
  Lanes sum{0, 0, 0, 0};
  for (std::size_t i = first; i < end; ++i) {
    sum += spread(nodes.mass[i]) * load(&nodes.position[4 * i]);
  }
  store(sums.column[0], sum);
}

/// sum (x - c) y^T over the rows y of a column; with `mass`, sum m (x - c) y^T.
SUNDER_LANES void sum_products(NodeSums& sums, const WaveNodes& nodes, std::size_t first,
                               std::size_t end, const Turned& frame, const double* column,
                               const double* mass) {
  Lanes a{0, 0, 0, 0}, b = a, c = a;
  const Lanes centre = load(frame.centre);
  for (std::size_t i = first; i < end; ++i) {
    const Lanes x = spread(mass ? mass[i] : 1) * (load(&nodes.position[4 * i]) - centre);
    const double* y = column + 4 * i;
    a += x * spread(y[0]);
    b += x * spread(y[1]);
    c += x * spread(y[2]);
  }
  store(sums.column[0], a);
  store(sums.column[1], b);
  store(sums.column[2], c);
}

/// displacement = R^T (x - c) - arm, rate = R^T v. No forces yet.
SUNDER_LANES void set_motion(WaveNodes& nodes, std::size_t first, std::size_t end,
                             const Turned& back) {
  const Lanes a = load(back.column[0]), b = load(back.column[1]), c = load(back.column[2]);
  const Lanes centre = load(back.centre);
  for (std::size_t i = first; i < end; ++i) {
    const Lanes p = load(&nodes.position[4 * i]) - centre, v = load(&nodes.velocity[4 * i]);
    store(&nodes.displacement[4 * i],
          a * spread(p[0]) + b * spread(p[1]) + c * spread(p[2]) - load(&nodes.arm[4 * i]));
    store(&nodes.rate[4 * i], a * spread(v[0]) + b * spread(v[1]) + c * spread(v[2]));
    store(&nodes.inner[4 * i], Lanes{0, 0, 0, 0});
  }
}

/// v += step (load - R inner / m + Q arm), Q = R [y]x.
SUNDER_LANES void add_acceleration(WaveNodes& nodes, std::size_t first, std::size_t end,
                                   const Turned& R, const Turned& Q, double step) {
  const Lanes r = load(R.column[0]), s = load(R.column[1]), t = load(R.column[2]);
  const Lanes p = load(Q.column[0]), q = load(Q.column[1]), u = load(Q.column[2]);
  for (std::size_t i = first; i < end; ++i) {
    const double* f = &nodes.inner[4 * i];
    const double* arm = &nodes.arm[4 * i];
    const Lanes force = r * spread(f[0]) + s * spread(f[1]) + t * spread(f[2]);
    const Lanes rigid = p * spread(arm[0]) + q * spread(arm[1]) + u * spread(arm[2]);
    const Lanes change = load(&nodes.load[4 * i]) + rigid - spread(nodes.inverse_mass[i]) * force;
    store(&nodes.velocity[4 * i], load(&nodes.velocity[4 * i]) + spread(step) * change);
  }
}

SUNDER_LANES void add_ways(WaveNodes& nodes, std::size_t first, std::size_t end, double step) {
  for (std::size_t i = first; i < end; ++i) {
    store(&nodes.position[4 * i],
          load(&nodes.position[4 * i]) + spread(step) * load(&nodes.velocity[4 * i]));
  }
}

template <class Rows>
std::span<const typename Rows::value_type> rows_of(const Rows& rows, std::size_t first,
                                                   std::size_t end) {
  return std::span(rows).subspan(first, end - first);
}

/// A body's frame, and the matrix that makes forces free of torque.
struct BodyFrame {
  Mat3 R = Mat3::Identity();
  Mat3 inverse = Mat3::Zero();  ///< (tr(S) I - S)^-1, S = R^T sum m (x - c) arm^T
};

/// tr(P) I - sym(P).
Mat3 turning_matrix(const Mat3& P) {
  Mat3 G = -0.5 * (P + P.transpose());
  G.diagonal().array() += P.trace();
  return G;
}

/// The body's frame where its nodes are (algorithm 2): Newton's method on rotations from the frame
/// before, one turn of which leaves the cube of the turn since then; `refine_rotation` where that
/// is not small.
BodyFrame follow_frame(WaveBody& body, const WaveNodes& nodes) {
  NodeSums sums;
  sum_positions(sums, nodes, body.first_node, body.end_node);
  body.frame.centre = sums.first() / body.mass;
  sum_products(sums, nodes, body.first_node, body.end_node,
               turned(Mat3::Identity(), body.frame.centre), nodes.arm.data(), nodes.mass.data());
  const Mat3 A = sums.matrix();
  BodyFrame frame{body.frame.orientation.toRotationMatrix()};
  const Mat3 P = frame.R.transpose() * A;
  frame.inverse = turning_matrix(P).inverse();
  const Vec3 half =
      0.5 * (frame.inverse * Vec3(P(2, 1) - P(1, 2), P(0, 2) - P(2, 0), P(1, 0) - P(0, 1)));
  constexpr double small = 1e-5;  // rad
  if (half.squaredNorm() < small * small) {
    // The Cayley map: a quaternion (1, half), normalised.
    body.frame.orientation =
        (body.frame.orientation * Eigen::Quaterniond(1, half.x(), half.y(), half.z())).normalized();
  } else {
    body.frame.orientation = refine_rotation(A, body.frame.orientation);
  }
  frame.R = body.frame.orientation.toRotationMatrix();
  frame.inverse = turning_matrix(frame.R.transpose() * A).inverse();
  return frame;
}

/// y = (tr(S) I - S)^-1 tau, with which the forces less m y x arm have no torque
/// (`deformation_forces`); zero where that has no answer, as for nodes on a line.
Vec3 torque_share(const WaveBody& body, const WaveNodes& nodes, const BodyFrame& frame) {
  NodeSums sums;
  sum_products(sums, nodes, body.first_node, body.end_node,
               turned(Mat3::Identity(), body.frame.centre), nodes.inner.data(), nullptr);
  // sum f q^T, q = R^T (x - c): its skew part is the torque sum q x f.
  const Mat3 M = sums.matrix().transpose() * frame.R;
  const Vec3 share = frame.inverse * Vec3(M(2, 1) - M(1, 2), M(0, 2) - M(2, 0), M(1, 0) - M(0, 1));
  return share.allFinite() ? share : Vec3(Vec3::Zero());
}

/// Adds the force -a m (v - rigid motion) of Rayleigh's mass damping to `inner`.
void add_mass_damping(WaveNodes& nodes, const WaveBody& body) {
  if (body.mass_damping == 0) return;
  const Vec3& c = body.frame.centre;
  Vec3 velocity = body.frame_velocity, spin = Vec3::Zero();
  if (!body.supported) {
    Vec3 p = Vec3::Zero(), l = Vec3::Zero();
    for (std::size_t i = body.first_node; i < body.end_node; ++i) {
      const Vec3 x = row_of(nodes.position, i) - c, mv = nodes.mass[i] * row_of(nodes.velocity, i);
      p += mv;
      l += x.cross(mv);
    }
    velocity = p / body.mass;
    spin = solve3(inertia_of(nodes, body), l);
  }
  for (std::size_t i = body.first_node; i < body.end_node; ++i) {
    const Vec3 x = row_of(nodes.position, i) - c;
    const Vec3 rate = row_of(nodes.velocity, i) - velocity - spin.cross(x);
    row_of(nodes.inner, i) +=
        body.mass_damping * nodes.mass[i] * (body.frame.orientation.conjugate() * rate);
  }
}

}  // namespace

Mat3 inertia_of(const WaveNodes& nodes, const WaveBody& body) {
  Mat3 inertia = Mat3::Zero();
  for (std::size_t i = body.first_node; i < body.end_node; ++i) {
    add_inertia(inertia, nodes.mass[i], row_of(nodes.position, i) - body.frame.centre);
  }
  return inertia;
}

bool deforms_in_wave(const Component& component) {
  return !component.tetrahedra.empty() && !component.rigid && component.rung == Rung::full;
}

void find_forces(WaveBodies& waves, WaveBody& body) {
  WaveNodes& nodes = waves.nodes;
  const std::size_t first = body.first_node, end = body.end_node;
  BodyFrame frame{body.frame.orientation.toRotationMatrix()};
  if (!body.supported) frame = follow_frame(body, nodes);
  const Mat3& R = frame.R;
  set_motion(nodes, first, end, turned(R.transpose(), body.frame.centre));
  const NodeMotion motion{nodes.displacement, nodes.rate, nodes.inner};
  add_block_forces(motion, rows_of(waves.blocks, body.first_block, body.end_block));
  add_block_forces(motion, rows_of(waves.second, body.first_second, body.end_second));
  add_mass_damping(nodes, body);
  Mat3 Q = Mat3::Zero();
  if (!body.supported) Q = R * cross_matrix(torque_share(body, nodes, frame));
  body.kicked = {R, Q, 0};
}

namespace {

/// Adds the impulse of surface loads on a body in `step` s.
void note_loads(const WaveBodies& waves, WaveBody& body, double step) {
  const WaveNodes& nodes = waves.nodes;
  for (std::size_t i = body.first_node; i < body.end_node; ++i) {
    const Vec3 force = nodes.mass[i] * (row_of(nodes.load, i) - waves.gravity);
    body.loads += impulse_at(row_of(nodes.position, i), step * force);
  }
}

}  // namespace

void kick(WaveBodies& waves, WaveBody& body, double step) {
  WaveNodes& nodes = waves.nodes;
  const Mat3 &R = body.kicked.R, &Q = body.kicked.Q;
  body.kicked.step = step;
  body.weight_place += step * body.frame.centre;
  if (waves.has_loads) note_loads(waves, body, step);
  begin_scaled_kick(nodes, body, R);
  add_acceleration(nodes, body.first_node, body.end_node, turned(R, Vec3::Zero()),
                   turned(Q, Vec3::Zero()), step);
  end_scaled_kick(nodes, body);
  follow_supports(waves, body);
}

void follow_supports(WaveBodies& waves, const WaveBody& body) {
  const Mat3& R = body.kicked.R;
  for (std::size_t k = body.first_held; k < body.end_held; ++k) {
    const HeldNode& held = waves.held[k];
    auto velocity = row_of(waves.nodes.velocity, held.node);
    Vec3 own = R.transpose() * (velocity - held.velocity);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (held.axes[axis]) own[static_cast<Eigen::Index>(axis)] = 0;
    }
    velocity = held.velocity + R * own;
  }
}

void measure_work(const WaveBodies& waves, WaveBody& body) {
  const WaveNodes& nodes = waves.nodes;
  const auto& [R, Q, step] = body.kicked;
  const auto way_of = [&](std::size_t i) {
    const Vec3 before = row_of(waves.velocity_before, i), after = row_of(nodes.velocity, i);
    return Vec3(0.5 * step * (before + after));
  };
  const auto force_of = [&](std::size_t i) {
    return Vec3(nodes.mass[i] * (Q * row_of(nodes.arm, i)) - R * row_of(nodes.inner, i));
  };
  for (std::size_t i = body.first_node; i < body.end_node; ++i) {
    const Vec3 way = way_of(i);
    const double by_gravity = nodes.mass[i] * waves.gravity.dot(way);
    body.work.inner += force_of(i).dot(way);
    body.work.gravity += by_gravity;
    if (waves.has_loads) {
      body.work.loads += nodes.mass[i] * row_of(nodes.load, i).dot(way) - by_gravity;
    }
  }
  body.work.inner += scaled_work(waves, body);
  for (std::size_t k = body.first_held; k < body.end_held; ++k) {
    const std::size_t i = waves.held[k].node;
    const double mass = nodes.mass[i];
    const double kinetic =
        0.5 * mass *
        (row_of(nodes.velocity, i).squaredNorm() - row_of(waves.velocity_before, i).squaredNorm());
    body.work.supports += kinetic - (force_of(i) + mass * row_of(nodes.load, i)).dot(way_of(i));
  }
}

void drift(WaveBodies& waves, WaveBody& body, double step) {
  add_ways(waves.nodes, body.first_node, body.end_node, step);
  if (body.supported) body.frame.centre += step * body.frame_velocity;
}

double step_of(double s, double d) { return 4 / (d + std::sqrt(d * d + 4 * s)); }

double stable_step(const WaveBodies& waves, const WaveBody& body) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = body.first_node; i < body.end_node; ++i) {
    const double w = waves.nodes.inverse_mass[i];
    const double s = w * waves.nodes.stiffness[i], d = w * waves.nodes.damping[i];
    if (s > 0) least = std::min(least, step_of(s, d));
  }
  return least;
}

}  // namespace sunder
