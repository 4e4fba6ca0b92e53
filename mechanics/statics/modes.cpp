// SPDX-License-Identifier: MIT
// Shift-inverted Lanczos with rigid motions projected out, and a count that nothing was missed.
#include "mechanics/statics/modes.hpp"

#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include <Eigen/SparseCholesky>

#include "mechanics/integrators/component_step.hpp"
#include "mechanics/state/dense_solve.hpp"

namespace sunder {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The generalised problem in the free degrees of freedom with y = M^(1/2) phi: symmetric, and
/// orthogonal in the usual sense.
struct Problem {
  ComponentSystem& system;
  VectorXd root_mass;         ///< sqrt(m) of each degree of freedom
  double shift = 0;           ///< 1/s^2, s in (K + s M)^-1; above 0 where K is singular
  MatrixXd found;             ///< orthonormal columns: rigid motions, then modes
  std::vector<double> value;  ///< (2 pi f)^2 of each column

  Index size() const { return root_mass.size(); }
};

/// Rigid motions that leave the held vertices where they are, mass-orthonormal, in y.
MatrixXd rigid_motions(const Problem& problem) {
  const ComponentSystem& system = problem.system;
  const auto free = static_cast<Index>(system.free_count);
  const auto all = static_cast<Index>(system.size());
  MatrixXd motion(3 * all, 6);
  const double scale = std::max(system.shape.arm.colwise().norm().maxCoeff(), 1e-300);
  for (Index i = 0; i < all; ++i) {
    const Vec3 r = system.shape.arm.col(i) / scale;
    motion.block<3, 3>(3 * i, 0).setIdentity();
    for (int axis = 0; axis < 3; ++axis) {
      motion.block<3, 1>(3 * i, 3 + axis) = Vec3::Unit(axis).cross(r);
    }
  }
  MatrixXd allowed = MatrixXd::Identity(6, 6);
  if (all > free) {
    // The kernel of the motion of the held vertices; 1e-6 of the body's size as in is_fixed.
    const Eigen::JacobiSVD<MatrixXd> held(motion.bottomRows(3 * (all - free)), Eigen::ComputeFullV);
    const auto rank = (held.singularValues().array() > 1e-6).count();
    allowed = held.matrixV().rightCols(6 - rank);
  }
  const MatrixXd y = problem.root_mass.asDiagonal() * motion.topRows(3 * free) * allowed;
  if (y.cols() == 0 || y.rows() == 0) return MatrixXd(y.rows(), 0);
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(y);
  return qr.householderQ() * MatrixXd::Identity(y.rows(), qr.rank());
}

void project_out(VectorXd& y, const MatrixXd& found) {
  // Twice is enough (Kahan): after one pass errors from cancellation remain.
  for (int pass = 0; pass < 2; ++pass) y -= found * (found.transpose() * y);
}

/// Spectra's operator: y -> P M^(1/2) (K + s M)^-1 M^(1/2) P y.
class Inverse {
 public:
  using Scalar = double;
  explicit Inverse(const Problem& problem) : problem_(problem) {}
  Index rows() const { return problem_.size(); }
  Index cols() const { return problem_.size(); }
  void perform_op(const double* in, double* out) const {
    VectorXd y = Eigen::Map<const VectorXd>(in, rows());
    project_out(y, problem_.found);
    y.array() *= problem_.root_mass.array();
    solve_system(problem_.system, y);
    y.array() *= problem_.root_mass.array();
    project_out(y, problem_.found);
    Eigen::Map<VectorXd>(out, rows()) = y;
  }

 private:
  const Problem& problem_;
};

/// Rayleigh's quotient of a column y: second-order accurate in the vector's error.
double quotient(const Problem& problem, const VectorXd& y) {
  const auto all = static_cast<Index>(3 * problem.system.size());
  VectorXd phi = VectorXd::Zero(all), product(all);
  phi.head(problem.size()) = y.cwiseQuotient(problem.root_mass);
  multiply_stiffness(product, problem.system, phi);
  return phi.dot(product) / y.squaredNorm();
}

void keep(Problem& problem, const MatrixXd& vectors) {
  const Index before = problem.found.cols();
  problem.found.conservativeResize(problem.size(), before + vectors.cols());
  for (Index j = 0; j < vectors.cols(); ++j) {
    VectorXd y = vectors.col(j);
    project_out(y, problem.found.leftCols(before + j));
    y.normalize();
    problem.found.col(before + j) = y;
    problem.value.push_back(quotient(problem, y));
  }
}

/// Adds up to `count` further modes; false when Lanczos does not converge.
bool find_by_lanczos(Problem& problem, Index count) {
  Inverse inverse(problem);
  const Index basis = std::min(problem.size(), std::max<Index>(2 * count + 2, 20));
  Spectra::SymEigsSolver<Inverse> solver(inverse, count, basis);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-12);
  if (solver.info() != Spectra::CompInfo::Successful) return false;
  keep(problem, solver.eigenvectors());
  return true;
}

/// Small bodies: the `wanted` lowest from all at once.
void find_densely(Problem& problem, Index wanted) {
  MatrixXd K = MatrixXd(leading_scalars(problem.system.stiffness, problem.system.free_count))
                   .selfadjointView<Eigen::Lower>();
  const VectorXd root = problem.root_mass.cwiseInverse();
  K = root.asDiagonal() * K * root.asDiagonal();
  // Rigid motions are moved above everything else, exactly.
  const MatrixXd& R = problem.found;
  const double bound = K.cwiseAbs().rowwise().sum().maxCoeff();
  K += 2 * bound * (R * R.transpose());
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver = symmetric_eigen(K);
  keep(problem, solver.eigenvectors().leftCols(wanted - R.cols()));
}

/// How many eigenvalues lie below `value`: negative pivots of K - value M (Sylvester's law).
Index count_below(const Problem& problem, double value) {
  using Sparse = Eigen::SparseMatrix<double>;
  Sparse A = leading_scalars(problem.system.stiffness, problem.system.free_count);
  for (Index i = 0; i < problem.size(); ++i) {
    const double root = problem.root_mass[i];
    A.valuePtr()[A.outerIndexPtr()[i]] -= value * root * root;
  }
  const Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(A);
  return (factor.vectorD().array() < 0).count();
}

/// Looks until nothing below the `wanted`-th mode is missing; false when that does not end.
bool find_lowest(Problem& problem, Index wanted) {
  Index missing = wanted - problem.found.cols();
  for (int round = 0; round < 6 && missing > 0; ++round) {
    if (!find_by_lanczos(problem, missing)) return false;
    std::vector<double> sorted = problem.value;
    std::ranges::sort(sorted);
    const double above = sorted[static_cast<std::size_t>(wanted - 1)] * (1 + 1e-7);
    const auto have = std::ranges::count_if(sorted, [&](double v) { return v < above; });
    missing = count_below(problem, above) - static_cast<Index>(have);
  }
  return missing <= 0;
}

/// The `wanted` lowest, rigid ones first, as the caller wants them.
Modes sorted_modes(const Problem& problem, const Component& component, Index wanted,
                   std::size_t rigid) {
  std::vector<std::size_t> row(problem.value.size());
  std::iota(row.begin(), row.end(), std::size_t{0});
  std::stable_sort(
      row.begin() + static_cast<std::ptrdiff_t>(rigid), row.end(),
      [&](std::size_t a, std::size_t b) { return problem.value[a] < problem.value[b]; });
  Modes modes;
  modes.rigid = rigid;
  modes.shape = MatrixXd::Zero(static_cast<Index>(3 * component.vertices.size()), wanted);
  for (Index k = 0; k < wanted; ++k) {
    const std::size_t from = row[static_cast<std::size_t>(k)];
    const bool is_rigid = static_cast<std::size_t>(k) < rigid;
    modes.frequency.push_back(
        is_rigid ? 0 : std::sqrt(std::max(problem.value[from], 0.0)) / (2 * std::numbers::pi));
    const VectorXd phi =
        problem.found.col(static_cast<Index>(from)).cwiseQuotient(problem.root_mass);
    for (std::size_t i = 0; i < problem.system.free_count; ++i) {
      const auto at = std::ranges::lower_bound(component.vertices, problem.system.order[i]);
      modes.shape.block<3, 1>(3 * (at - component.vertices.begin()), k) =
          phi.segment<3>(static_cast<Index>(3 * i));
    }
    Index largest = 0;
    modes.shape.col(k).cwiseAbs().maxCoeff(&largest);
    if (modes.shape(largest, k) < 0) modes.shape.col(k) *= -1;
  }
  return modes;
}

/// Below this many degrees of freedom all modes at once cost less than Lanczos.
constexpr Index small_body = 200;

}  // namespace

Result<Modes> natural_modes(MechanicsState& state, std::span<const Corners> corners, ComponentId id,
                            std::size_t count) {
  const Component& component = state.components[id.index()];
  if (component.partly_held) {
    return Finding{.code = "axes_not_supported",
                   .ids = {static_cast<std::int64_t>(id.value)},
                   .text = "component " + std::to_string(id.value) +
                           " is held along some axes only, and modes are found of bodies whose "
                           "held vertices are held along all three",
                   .remedy = "leave \"axes\" out of the held boxes"};
  }
  ComponentSystem& system = built_system(state, corners, component);
  Problem problem{system, {}, 0, {}, {}};
  problem.root_mass.resize(static_cast<Index>(3 * system.free_count));
  for (Index i = 0; i < problem.size(); ++i) {
    problem.root_mass[i] = std::sqrt(system.shape.mass[i / 3]);
  }
  problem.found = rigid_motions(problem);
  const auto rigid = static_cast<std::size_t>(problem.found.cols());
  problem.value.assign(rigid, 0.0);
  const Index wanted = std::min(problem.size(), static_cast<Index>(rigid + count));
  if (problem.size() <= small_body || 3 * wanted > problem.size()) {
    find_densely(problem, wanted);
    return sorted_modes(problem, component, wanted, rigid);
  }
  if (rigid > 0) {
    // A fiftieth of the first axial frequency: far below it, and K + s M stays well conditioned.
    const Material& material = material_of(state, component.tetrahedra.front());
    const double slow = 0.02 * bar_wave_speed(material) / component.rest_radius;
    problem.shift = slow * slow;
  }
  factor_system(system, {.mass = problem.shift, .stiffness = 1});
  if (!find_lowest(problem, wanted)) {
    Finding finding;
    finding.code = "modes_not_found";
    finding.ids = {static_cast<std::int64_t>(id.value)};
    finding.text = "Component " + std::to_string(id.value) + ": not all of its " +
                   std::to_string(count) + " lowest modes were found.";
    finding.remedy = "Ask for fewer or more modes; look for slivers with `sunder check`.";
    return finding;
  }
  return sorted_modes(problem, component, wanted, rigid);
}

}  // namespace sunder
