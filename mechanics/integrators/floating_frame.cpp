// SPDX-License-Identifier: MIT
// Floating frame of reference with a constant factor.
#include "mechanics/integrators/floating_frame.hpp"

#include "mechanics/frame/rotation.hpp"
#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/integrators/modal.hpp"
#include "mechanics/integrators/rigid_motion.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

using Field = Eigen::Map<Eigen::Matrix3Xd>;

/// The fields of the component at hand, in its system's numbering.
struct BodyDeformation {
  Field displacement, rate, acceleration;
};

BodyDeformation gather_deformation(const ComponentStep& step) {
  const std::size_t n = step.system->size();
  BodyDeformation d{scratch_field(step.scratch, ScratchField::displacement, n),
                    scratch_field(step.scratch, ScratchField::rate, n),
                    scratch_field(step.scratch, ScratchField::acceleration, n)};
  const VertexColumns& vertices = step.state.vertices;
  gather(d.displacement, step.system->order, vertices.displacement);
  gather(d.rate, step.system->order, vertices.displacement_rate);
  gather(d.acceleration, step.system->order, vertices.displacement_acceleration);
  return d;
}

/// Dd . C d' with the rate where the scheme balances forces: at `balance` of the way from the rate
/// of the start to `d.rate`. This is the energy taken by the damping in the step, exactly, J.
double damping_work(const ComponentStep& step, const RayleighDamping& damping,
                    const BodyDeformation& d, double balance) {
  const std::size_t n = step.system->size();
  Field way = scratch_field(step.scratch, ScratchField::argument, n);
  gather(way, step.system->order, step.state.vertices.displacement);
  way = d.displacement - way;
  Field rate = scratch_field(step.scratch, ScratchField::spare, n);
  gather(rate, step.system->order, step.state.vertices.displacement_rate);
  rate = balance * d.rate + (1 - balance) * rate;
  Field product = scratch_field(step.scratch, ScratchField::product, n);
  multiply_stiffness(as_vector(product), *step.system, as_vector(way));
  const double inner =
      way.cwiseProduct(rate).colwise().sum().dot(step.system->shape.mass.transpose());
  return damping.mass_factor * inner + damping.stiffness_factor * rate.cwiseProduct(product).sum();
}

/// Held vertices go on at their constant rate, for any time scale of the deformation.
void move_held(const ComponentStep& step, BodyDeformation& d) {
  const auto held = static_cast<Eigen::Index>(step.system->size() - step.system->free_count);
  d.displacement.rightCols(held) += step.input.settings.time_step * d.rate.rightCols(held);
}

/// Generalised-alpha for M d'' + C d' + K d = load, in place; gives the damping work. Held vertices
/// go on at their constant rate: their acceleration is zero and drops out of the system.
double advance_deformation(const ComponentStep& step, BodyDeformation& d, const Field& load) {
  const IntegratorSettings settings = settings_of(step.input, step.state, step.component);
  const auto [alpha_m, alpha_f, beta, gamma] = generalised_alpha(settings.rho_infinity);
  const auto [a, b] = settings.damping;
  const double h = step.input.deformation_step(step.component);
  const std::size_t n = step.system->size();
  const auto free = static_cast<Eigen::Index>(step.system->free_count);
  const bool damped = a > 0 || b > 0;

  Field argument = scratch_field(step.scratch, ScratchField::argument, n);
  argument = alpha_f * (d.displacement + b * d.rate);
  Field rhs = scratch_field(step.scratch, ScratchField::product, n);
  // d and d' become their predictors; the weighted rate is alpha_f old + (1 - alpha_f) predictor.
  d.displacement.leftCols(free) +=
      h * d.rate.leftCols(free) + h * h * (0.5 - beta) * d.acceleration.leftCols(free);
  move_held(step, d);
  d.rate += h * (1 - gamma) * d.acceleration;
  argument += (1 - alpha_f) * (d.displacement + b * d.rate);
  multiply_stiffness(as_vector(rhs), *step.system, as_vector(argument));

  const Eigen::VectorXd& mass = step.system->shape.mass;
  for (Eigen::Index i = 0; i < mass.size(); ++i) {
    const Vec3 weighted_rate = d.rate.col(i) - alpha_f * h * (1 - gamma) * d.acceleration.col(i);
    rhs.col(i) =
        load.col(i) - rhs.col(i) - mass[i] * (alpha_m * d.acceleration.col(i) + a * weighted_rate);
  }
  solve_system(*step.system, as_vector(rhs).head(3 * step.system->free_count));
  rhs.rightCols(static_cast<Eigen::Index>(n - step.system->free_count)).setZero();
  d.acceleration = rhs;
  d.displacement += beta * h * h * d.acceleration;
  d.rate += gamma * h * d.acceleration;
  return damped ? damping_work(step, settings.damping, d, 1 - alpha_f) : 0;
}

/// Takes the deformation through the part of a step at hand; gives the damping work.
double advance_part(const ComponentStep& step, BodyDeformation& d, const Field& load) {
  switch (deformation_of(step.input, step.state, step.component)) {
    case Deformation::frozen:
      return 0;
    case Deformation::wave:  // Explicit steps write their own rows.
    case Deformation::whole:
    case Deformation::catch_up:
      break;
  }
  if (step.input.settings.integrator == Integrator::modal) {
    advance_modes(step, {d.displacement, d.rate}, load);
    move_held(step, d);
    return 0;
  }
  return advance_deformation(step, d, load);
}

/// Angular velocity of the frame and its derivative, body frame, at the start of the step.
struct Spin {
  Mat3 inertia;
  Vec3 inner;  ///< sum m q x d'
  Vec3 velocity, acceleration;
};

Spin present_spin(const ComponentStep& step, const BodyDeformation& d, const Field& q,
                  const Vec3& torque) {
  const Eigen::VectorXd& mass = step.system->shape.mass;
  Spin spin;
  spin.inertia = inertia_of(mass, q);
  spin.inner = moment_of(mass, q, d.rate);
  const Eigen::LDLT<Mat3> solver(spin.inertia);
  const Vec3 l = step.component.orientation.conjugate() * step.component.angular_momentum;
  spin.velocity = solver.solve(l - spin.inner);
  // d/dt (I w + sum m q x d') = R^T tau - w x l, with I' w = sum m [2 (q.d') w - d' (q.w) - q
  // (d'.w)]
  const Mat3 mixed = product_of(mass, q, d.rate);
  const Vec3& w = spin.velocity;
  const Vec3 inertia_rate = 2 * mixed.trace() * w - mixed.transpose() * w - mixed * w;
  spin.acceleration = solver.solve(step.component.orientation.conjugate() * torque - w.cross(l) -
                                   moment_of(mass, q, d.acceleration) - inertia_rate);
  return spin;
}

/// b at the time where the scheme balances forces, freed of its rigid part. Positions and
/// rates are extrapolated there: taken at the start, the Coriolis force lags and feeds energy in.
Field inertial_load(const ComponentStep& step, const BodyDeformation& d, const Spin& spin) {
  const IntegratorSettings settings = settings_of(step.input, step.state, step.component);
  double balance = 1 - generalised_alpha(settings.rho_infinity).alpha_f;
  if (settings.integrator == Integrator::modal) balance = 0.5;
  const double ahead = balance * settings.time_step;
  const RestShape& shape = step.system->shape;
  Field load = scratch_field(step.scratch, ScratchField::load, step.system->size());
  const Vec3 w = spin.velocity + ahead * spin.acceleration;
  for (Eigen::Index i = 0; i < load.cols(); ++i) {
    const Vec3 displaced = d.displacement.col(i) + ahead * d.rate.col(i);
    const Vec3 rate = d.rate.col(i) + ahead * d.acceleration.col(i);
    const Vec3 q = shape.arm.col(i) + displaced;
    load.col(i) = -shape.mass[i] *
                  (w.cross(w.cross(q)) + 2 * w.cross(rate) + spin.acceleration.cross(displaced));
  }
  // Gravity is rigid: it would be projected out again, and leave its rounding.
  if (!step.input.loads.force.empty()) {
    const Mat3 R =
        (step.component.orientation * rotation_of(ahead * spin.velocity)).toRotationMatrix();
    add_body_load(load, step, R);
  }
  project_load(load, shape);
  return load;
}

/// Deformation from which inertial forces are extrapolated: for modes their mean rate over the
/// step.
BodyDeformation motion_ahead(const ComponentStep& step, const BodyDeformation& d) {
  if (step.input.settings.integrator != Integrator::modal) return d;
  const std::size_t n = step.system->size();
  BodyDeformation ahead{d.displacement, scratch_field(step.scratch, ScratchField::spare, n),
                        scratch_field(step.scratch, ScratchField::argument, n)};
  mean_modal_rate(ahead.rate, step, {d.displacement, d.rate});
  ahead.acceleration.setZero();
  return ahead;
}

/// Moves the rigid motion that rounding left in d and d' into the frame: no vertex moves.
void settle_frame(const ComponentStep& step, BodyDeformation& d, PredictedFrame& next) {
  const RestShape& shape = step.system->shape;
  const Vec3 shift = d.displacement * shape.mass / shape.total_mass;
  d.displacement.colwise() -= shift;
  next.centre += next.orientation * shift;

  Field q = scratch_field(step.scratch, ScratchField::position, step.system->size());
  q = shape.arm + d.displacement;
  const Mat3 A = product_of(shape.mass, q, shape.arm);
  const Eigen::Quaterniond turn = refine_rotation(A, Eigen::Quaterniond::Identity());
  const Mat3 back = turn.toRotationMatrix().transpose();
  next.orientation = (next.orientation * turn).normalized();
  for (Eigen::Index i = 0; i < q.cols(); ++i) {
    q.col(i) = back * Vec3(q.col(i));
    d.displacement.col(i) = q.col(i) - shape.arm.col(i);
    d.rate.col(i) = back * Vec3(d.rate.col(i));
    d.acceleration.col(i) = back * Vec3(d.acceleration.col(i));
  }
  project_rate(d.rate, shape, q);
  project_acceleration(d.acceleration, shape);
}

/// Writes the rows; `q` must be arm + displacement, `spin` the body-frame angular velocity.
void write_rows(const ComponentStep& step, const BodyDeformation& d, const PredictedFrame& next,
                const Vec3& spin, const Vec3& velocity) {
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  const ComponentSystem& system = *step.system;
  const Mat3 R = next.orientation.toRotationMatrix();
  for (std::size_t i = 0; i < system.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const std::size_t v = system.order[i].index();
    const Vec3 q = system.shape.arm.col(column) + d.displacement.col(column);
    predicted.position[v] = next.centre + R * q;
    predicted.velocity[v] = velocity + R * (spin.cross(q) + d.rate.col(column));
  }
  scatter(predicted.displacement, system.order, d.displacement);
  scatter(predicted.displacement_rate, system.order, d.rate);
  scatter(predicted.displacement_acceleration, system.order, d.acceleration);
  PredictedFrame& frame = predicted.frame[step.component.id.index()];
  frame = next;
  frame.spin = R * spin;
}

void step_free(const ComponentStep& step) {
  const ComponentSystem& system = *step.system;
  const Eigen::VectorXd& mass = system.shape.mass;
  BodyDeformation d = gather_deformation(step);
  Field q = scratch_field(step.scratch, ScratchField::position, system.size());
  q = system.shape.arm + d.displacement;

  const RigidLoad load = rigid_load(step);
  const Spin spin = present_spin(step, d, q, load.torque);
  const Field b = inertial_load(step, motion_ahead(step, d), spin);
  PredictedFrame next = advance_centre(step, load);
  next.damping_work = advance_part(step, d, b);

  q = system.shape.arm + d.displacement;
  const Mat3 inertia_new = inertia_of(mass, q);
  const Vec3 inner_new = moment_of(mass, q, d.rate);
  turn_under_load(
      next, step.component,
      {0.5 * (spin.inertia + inertia_new), 0.5 * (spin.inner + inner_new),
       step.component.angular_momentum, next.angular_momentum, step.input.settings.time_step},
      load);
  // With the inertia of the start: that of the end means nothing after a step that went too far.
  next.spun = step.input.settings.time_step * spin.velocity.norm();

  settle_frame(step, d, next);
  q = system.shape.arm + d.displacement;
  const Vec3 l = next.orientation.conjugate() * next.angular_momentum;
  const Vec3 w = solve3(inertia_of(mass, q), l - moment_of(mass, q, d.rate));
  write_rows(step, d, next, w, next.momentum / step.component.mass);
}

/// Along axes on which nothing holds it a body may go far: once that is its radius, the frame
/// follows, and no vertex moves.
void follow_sliding(const ComponentStep& step, BodyDeformation& d, PredictedFrame& next) {
  if (!step.component.partly_held) return;
  const RestShape& shape = step.system->shape;
  Vec3 shift = d.displacement * shape.mass / shape.total_mass;
  if (shift.norm() <= step.component.rest_radius) return;
  for (VertexId v : step.component.vertices) shift = free_part(step.state, v, shift);
  d.displacement.colwise() -= shift;
  next.centre += next.orientation * shift;
}

void step_supported(const ComponentStep& step) {
  const Component& body = step.component;
  BodyDeformation d = gather_deformation(step);
  Field load = scratch_field(step.scratch, ScratchField::load, step.system->size());
  load.setZero();
  add_body_load(load, step, body.orientation.toRotationMatrix());

  PredictedFrame next;
  next.damping_work = advance_part(step, d, load);
  next.centre = body.centre + step.input.settings.time_step * body.frame_velocity;
  next.orientation = body.orientation;
  follow_sliding(step, d, next);
  write_rows(step, d, next, Vec3::Zero(), body.frame_velocity);

  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  PredictedFrame& frame = predicted.frame[body.id.index()];
  for (VertexId v : body.vertices) {
    const Vec3 p = step.state.vertices.mass[v.index()] * predicted.velocity[v.index()];
    frame.momentum += p;
    frame.angular_momentum += (predicted.position[v.index()] - next.centre).cross(p);
  }
}

}  // namespace

void step_floating_frame(const ComponentStep& step) {
  if (step.component.supported) {
    step_supported(step);
  } else {
    step_free(step);
  }
}

}  // namespace sunder
