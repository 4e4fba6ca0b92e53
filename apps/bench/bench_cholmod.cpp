// SPDX-License-Identifier: MIT
// CHOLMOD and OpenBLAS behind one function.
#include "apps/bench/bench_cholmod.hpp"

#ifdef SUNDER_CHOLMOD

#include <cholmod.h>

#include <algorithm>
#include <vector>

#include "apps/bench/clock.hpp"

extern "C" void openblas_set_num_threads(int);

namespace sunder {
namespace {

/// CHOLMOD's workspace and the factor made in it, freed together.
struct Cholmod {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  Cholmod() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    common.nmethods = 0;  // AMD, and METIS where that fills too much
    openblas_set_num_threads(1);
  }
  ~Cholmod() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
};

template <class Work>
double median_ms(int runs, const Work& work) {
  std::vector<double> times;
  for (int i = 0; i < std::max(1, runs); ++i) {
    const double start = wall_us();
    work();
    times.push_back(1e-3 * (wall_us() - start));
  }
  return median(std::move(times));
}

}  // namespace

std::optional<CholmodTimes> time_cholmod(const Eigen::SparseMatrix<double>& A,
                                         const Eigen::VectorXd& b, const Eigen::VectorXd& expected,
                                         int runs) {
  Cholmod c;
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(A.cols());
  view.nzmax = static_cast<std::size_t>(A.nonZeros());
  // CHOLMOD reads them only.
  view.p = const_cast<int*>(A.outerIndexPtr());
  view.i = const_cast<int*>(A.innerIndexPtr());
  view.x = const_cast<double*>(A.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  cholmod_dense load{};
  load.nrow = load.nzmax = load.d = static_cast<std::size_t>(b.size());
  load.ncol = 1;
  load.x = const_cast<double*>(b.data());
  load.xtype = CHOLMOD_REAL;
  load.dtype = CHOLMOD_DOUBLE;
  CholmodTimes times;
  times.analyse = median_ms(runs, [&] {
    cholmod_free_factor(&c.factor, &c.common);
    c.factor = cholmod_analyze(&view, &c.common);
  });
  if (c.factor == nullptr) return std::nullopt;
  times.factor = median_ms(runs, [&] { cholmod_factorize(&view, c.factor, &c.common); });
  if (c.common.status != CHOLMOD_OK) return std::nullopt;
  times.solve = median_ms(4 * runs, [&] {
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, c.factor, &load, &c.common);
    const Eigen::Map<const Eigen::VectorXd> answer(static_cast<double*>(x->x), b.size());
    times.error = (answer - expected).norm() / expected.norm();
    cholmod_free_dense(&x, &c.common);
  });
  return times;
}

}  // namespace sunder

#else

namespace sunder {

std::optional<CholmodTimes> time_cholmod(const Eigen::SparseMatrix<double>&, const Eigen::VectorXd&,
                                         const Eigen::VectorXd&, int) {
  return std::nullopt;
}

}  // namespace sunder

#endif
