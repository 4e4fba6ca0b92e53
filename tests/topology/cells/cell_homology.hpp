// SPDX-License-Identifier: MIT
// Homology before and after operations on cells, by outside programs: GUDHI, and Regina where
// asked.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "tests/topology/cells/random_cells.hpp"
#include "topology/suite/homology/homology.hpp"
#include "topology/suite/kernels/judged_kernel.hpp"

namespace sunder::test {

/// Up to how many tetrahedra an outside program is asked.
struct OutsideLimits {
  /// GUDHI about the barycentric subdivision; about the cells themselves it is always asked when
  /// they are a simplicial complex.
  std::size_t gudhi = 60;
  /// For Regina, which has dense matrices.
  std::size_t regina = 40;
};

/// The questions to outside programs, and how often a division was found to keep homology.
struct OutsideReport {
  std::size_t moments = 0, by_gudhi = 0, by_regina = 0, kept_by_gudhi = 0, kept_by_regina = 0;
};

/// Looks at every moment: our homology over GF(2), GF(3) and Z, GUDHI's Betti numbers over the same
/// fields, Regina's homology over Z. They have to agree with each other and with the map's own
/// Betti numbers, and a division of cells has to leave each of them as it was.
class HomologyWatch {
 public:
  /// `regina`: a kernel that runs Regina; nothing: it is not asked.
  HomologyWatch(OutsideLimits limits, std::optional<suite::JudgedKernel> regina)
      : limits_(limits), regina_(std::move(regina)) {}

  std::string operator()(const CellMoment& moment);
  const OutsideReport& report() const { return report_; }

 private:
  std::string ask_gudhi(const suite::OrbitComplex& complex, std::size_t tetrahedra);
  std::string ask_regina(const CellMoment& moment, const suite::IntegerHomology& ours);

  OutsideLimits limits_;
  std::optional<suite::JudgedKernel> regina_;
  OutsideReport report_;
  /// Of the moment before; nothing where a program was not asked.
  std::optional<std::array<suite::BettiNumbers, 2>> gudhi_before_;
  std::optional<suite::IntegerHomology> regina_before_, ours_before_;
};

}  // namespace sunder::test
