// SPDX-License-Identifier: MIT
// `impact_schemes`: time schemes for impact side by side on a chain of masses, as a CSV: what the
// scheme of impact windows was chosen by. L = rho = c = v = 1, so that the exact bar has stress 1
// at the wall, no tension, contact for 2 and rebound at 1.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <Eigen/Dense>

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

enum class Kind { theta, generalised_alpha, contact_stabilised };

/// A time scheme with its contact.
struct Scheme {
  const char* name;
  Kind kind = Kind::theta;
  double parameter = 0.5;  ///< theta, or rho_infinity
  double viscosity = 0;    ///< C = viscosity x dx/c x K
  bool massless = false;   ///< the contact vertex gives its mass to its neighbour
};

/// A bar of equal cells with lumped masses; vertex 0 meets the wall at 0.
struct Chain {
  MatrixXd K, C;
  VectorXd mass, u, v, a;
  double dx;
};

Chain make_chain(int cells, const Scheme& scheme) {
  Chain chain;
  chain.dx = 1.0 / cells;
  chain.K = MatrixXd::Zero(cells + 1, cells + 1);
  for (int e = 0; e < cells; ++e) {
    chain.K.block<2, 2>(e, e) += Eigen::Matrix2d{{1, -1}, {-1, 1}} / chain.dx;
  }
  chain.C = scheme.viscosity * chain.dx * chain.K;
  chain.mass = VectorXd::Constant(cells + 1, chain.dx);
  chain.mass[0] = chain.mass[cells] = 0.5 * chain.dx;
  if (scheme.massless) {
    chain.mass[1] += chain.mass[0];
    chain.mass[0] = 1e-9 * chain.dx;  // as good as none, and no other system to solve
  }
  chain.v = VectorXd::Constant(cells + 1, -1);
  chain.u = chain.a = VectorXd::Zero(cells + 1);
  return chain;
}

/// What an impulse at the wall must be so that the end's velocity does not lead through it.
double stopping_impulse(const Chain& chain, double u_end, double v_end, double answer, double h) {
  const double lack = v_end + std::max(chain.u[0], 0.0) / h;
  const bool near = chain.u[0] <= 1e-12 || u_end < 0;
  return near && lack < 0 ? -lack / answer : 0;
}

double step_theta(Chain& c, const Scheme& s, double h) {
  const double reach = s.parameter * h;
  const MatrixXd A = MatrixXd(c.mass.asDiagonal()) + reach * c.C + reach * reach * c.K;
  const Eigen::LLT<MatrixXd> solver(A);
  VectorXd dv = solver.solve(-h * (c.C * c.v + c.K * (c.u + reach * c.v)));
  const VectorXd answer = solver.solve(VectorXd::Unit(c.u.size(), 0));
  const double u_end = c.u[0] + h * c.v[0] + reach * dv[0];
  const double j = stopping_impulse(c, u_end, c.v[0] + dv[0], answer[0], h);
  dv += j * answer;
  c.u += h * c.v + reach * dv;
  c.v += dv;
  return j;
}

double step_generalised_alpha(Chain& c, const Scheme& s, double h) {
  const double rho = s.parameter;
  const double am = (2 * rho - 1) / (rho + 1), af = rho / (rho + 1), width = 1 - am + af;
  const double beta = 0.25 * width * width, gamma = 0.5 - am + af;
  const MatrixXd A =
      (1 - am) * MatrixXd(c.mass.asDiagonal()) + (1 - af) * (gamma * h * c.C + beta * h * h * c.K);
  const Eigen::LLT<MatrixXd> solver(A);
  const VectorXd u = c.u + h * c.v + h * h * (0.5 - beta) * c.a;
  const VectorXd v = c.v + h * (1 - gamma) * c.a;
  VectorXd a = solver.solve(-(c.K * (af * c.u + (1 - af) * u) + c.C * (af * c.v + (1 - af) * v) +
                              am * c.mass.cwiseProduct(c.a)));
  const VectorXd answer = solver.solve(VectorXd::Unit(c.u.size(), 0));
  const double j = stopping_impulse(c, u[0] + beta * h * h * a[0], v[0] + gamma * h * a[0],
                                    gamma * answer[0], h);
  a += j / h * answer;
  c.u = u + beta * h * h * a;
  c.v = v + gamma * h * a;
  c.a = a;
  return j;
}

/// Newmark with the predictor projected on what is allowed and contact forces at the end only
/// [Deuflhard, Krause, Ertel 2008].
double step_contact_stabilised(Chain& c, double h) {
  VectorXd predicted = c.u + h * c.v;
  predicted[0] = std::max(predicted[0], 0.0);
  const MatrixXd A = MatrixXd(c.mass.asDiagonal()) + 0.5 * h * c.C + 0.25 * h * h * c.K;
  const Eigen::LLT<MatrixXd> solver(A);
  VectorXd u = solver.solve(c.mass.cwiseProduct(predicted) - 0.25 * h * h * (c.K * c.u) +
                            0.5 * h * (c.C * c.u));
  double r = 0;
  if (u[0] < 0) {
    const VectorXd answer = solver.solve(VectorXd::Unit(c.u.size(), 0));
    r = -u[0] / answer[0];
    u += r * answer;
  }
  const double j = 2 * r / h;
  const VectorXd impulse = -0.5 * h * (c.K * (c.u + u)) - c.C * (u - c.u);
  c.v += impulse.cwiseQuotient(c.mass);
  c.v[0] += j / c.mass[0];
  c.u = u;
  return j;
}

double take_step(Chain& chain, const Scheme& scheme, double h) {
  switch (scheme.kind) {
    case Kind::theta:
      return step_theta(chain, scheme, h);
    case Kind::generalised_alpha:
      return step_generalised_alpha(chain, scheme, h);
    case Kind::contact_stabilised:
      break;
  }
  return step_contact_stabilised(chain, h);
}

void print_run(const Scheme& scheme, int cells, double h) {
  Chain chain = make_chain(cells, scheme);
  double peak = 0, tension = 0, first = -1, last = 0;
  const int steps = static_cast<int>(std::lround(4 / h));
  for (int k = 1; k <= steps; ++k) {
    const double j = take_step(chain, scheme, h);
    const VectorXd strain = (chain.u.tail(cells) - chain.u.head(cells)) / chain.dx;
    peak = std::max(peak, -strain.minCoeff());
    tension = std::max(tension, strain.maxCoeff());
    if (j <= 0.01 * h) continue;
    if (first < 0) first = (k - 1) * h;
    last = k * h;
  }
  const double energy =
      0.5 * chain.v.dot(chain.mass.cwiseProduct(chain.v)) + 0.5 * chain.u.dot(chain.K * chain.u);
  std::printf("%s,%d,%g,%.3f,%.3f,%.3f,%.3f,%.3f\n", scheme.name, cells, h, peak, tension,
              chain.mass.dot(chain.v), 0.5 * (last - first), 2 * energy);
}

}  // namespace

int main() {
  constexpr Scheme schemes[] = {
      {"trapezoidal", Kind::theta, 0.5},
      {"implicit Euler", Kind::theta, 1},
      {"generalised-alpha rho 1", Kind::generalised_alpha, 1},
      {"generalised-alpha rho 0.5", Kind::generalised_alpha, 0.5},
      {"generalised-alpha rho 0", Kind::generalised_alpha, 0},
      {"contact-stabilised Newmark", Kind::contact_stabilised},
      {"contact-stabilised Newmark + viscosity 0.5", Kind::contact_stabilised, 0, 0.5},
      {"massless contact vertex", Kind::theta, 0.5, 0, true},
      {"massless contact vertex + viscosity 0.3", Kind::theta, 0.5, 0.3, true},
      {"trapezoidal + viscosity 0.3", Kind::theta, 0.5, 0.3},
      {"trapezoidal + viscosity 0.5", Kind::theta, 0.5, 0.5},
      {"generalised-alpha rho 0 + viscosity 0.3", Kind::generalised_alpha, 0, 0.3},
      {"theta 0.6 + viscosity 0.3", Kind::theta, 0.6, 0.3},
      {"theta 0.65 + viscosity 0.3 (chosen)", Kind::theta, 0.65, 0.3},
      {"theta 0.75 + viscosity 0.3", Kind::theta, 0.75, 0.3},
  };
  std::puts("scheme,cells,sub-step/(L/c),peak,tension,rebound,contact/(2L/c),energy");
  for (const Scheme& scheme : schemes) {
    for (const int cells : {20, 50, 100}) {
      for (const double h : {0.01, 0.025, 0.0625, 0.1}) print_run(scheme, cells, h);
    }
  }
}
