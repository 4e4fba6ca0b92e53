// SPDX-License-Identifier: MIT
// The questions to GUDHI and Regina about a moment, and the numbers that have to be equal.
#include "tests/topology/cells/cell_homology.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "tests/topology/suite/gudhi_homology.hpp"

namespace sunder::test {
namespace {

using suite::BettiNumbers;

constexpr std::array<int, 2> primes = {2, 3};

/// Empty when both are equal.
std::string differ(const char* what, const BettiNumbers& expected, const BettiNumbers& answered) {
  if (expected == answered) return {};
  return fmt::format("{}: Betti numbers {} instead of {}", what, fmt::join(answered, " "),
                     fmt::join(expected, " "));
}

std::string differ(const char* what, const suite::IntegerHomology& expected,
                   const suite::IntegerHomology& answered) {
  if (expected == answered) return {};
  std::string wrong = differ(what, expected.betti, answered.betti);
  return wrong.empty() ? fmt::format("{}: another torsion", what) : wrong;
}

/// The body for a kernel in another process: whole, then split where it is cut.
TetMesh whole(const suite::GlueTwin& body) {
  TetMesh mesh;
  mesh.tetrahedra = body.tetrahedra;
  for (std::size_t p = 0; p < body.around.size(); ++p) {
    const auto x = static_cast<double>(p);
    mesh.points.push_back({x, x * x, x * x * x});  // Regina knows no points
  }
  return mesh;
}

}  // namespace

std::string HomologyWatch::ask_gudhi(const suite::OrbitComplex& complex, std::size_t tetrahedra) {
  const bool directly = is_simplicial(complex), subdivided = tetrahedra <= limits_.gudhi;
  if (!directly && !subdivided) return gudhi_before_.reset(), std::string();
  std::array<BettiNumbers, 2> now{};
  for (std::size_t i = 0; i < 2; ++i) {
    now[i] =
        directly ? gudhi_betti(complex, primes[i]) : gudhi_betti_of_subdivision(complex, primes[i]);
    if (directly && subdivided) {
      const auto again = gudhi_betti_of_subdivision(complex, primes[i]);
      if (again != now[i]) return differ("GUDHI, subdivided", now[i], again);
    }
    const std::string wrong =
        differ("GUDHI against ours", suite::betti_numbers(complex, primes[i]), now[i]);
    if (!wrong.empty()) return wrong;
  }
  ++report_.by_gudhi;
  gudhi_before_ = now;
  return {};
}

std::string HomologyWatch::ask_regina(const CellMoment& moment,
                                      const suite::IntegerHomology& ours) {
  const suite::GlueTwin& body = moment.body;
  if (!regina_ || body.tetrahedra.size() > limits_.regina) return regina_before_.reset(), "";
  regina_->load(whole(body));
  const suite::GlueTwin intact = suite::glue_twin(body.tetrahedra, body.around.size());
  for (std::size_t f = 0; f < body.glued.size(); ++f) {
    const HalfFaceId other = intact.glued[f];
    if (!body.glued[f].is_none() || other.is_none() || other.index() < f) continue;
    const auto t = static_cast<std::uint32_t>(f / 4);
    if (!regina_->split({t, body.tetrahedra[t][f % 4]}).did) return "Regina cannot split a face";
  }
  const suite::CellCounts counts = regina_->counts();
  if (counts.vertices != moment.counts.vertices || counts.edges != moment.counts.edges ||
      counts.faces != moment.counts.faces || counts.tetrahedra != moment.counts.tetrahedra) {
    return "Regina counts other cells";
  }
  const auto homology = regina_->homology();
  if (!homology) return "Regina was given a body too large for it";
  ++report_.by_regina;
  regina_before_ = *homology;
  return differ("Regina against ours", ours, *homology);
}

std::string HomologyWatch::operator()(const CellMoment& moment) {
  ++report_.moments;
  const suite::OrbitComplex complex = suite::orbit_complex(moment.body);
  const suite::IntegerHomology ours = suite::integer_homology(complex);
  const auto ours_before = std::exchange(ours_before_, ours);
  const auto gudhi_before = gudhi_before_;
  const auto regina_before = regina_before_;
  std::string wrong = ask_gudhi(complex, moment.body.tetrahedra.size());
  if (wrong.empty()) wrong = ask_regina(moment, ours);
  if (wrong.empty() && moment.counts.betti) {
    const auto& [b0, b1, b2] = *moment.counts.betti;
    const BettiNumbers map = {static_cast<std::size_t>(b0), static_cast<std::size_t>(b1),
                              static_cast<std::size_t>(b2), 0};
    wrong = differ("the map against ours", ours.betti, map);
  }
  if (!wrong.empty() || moment.after != CellMoment::After::division) return wrong;
  if (!ours_before || *ours_before != ours) return "a division has changed homology over Z";
  if (gudhi_before && gudhi_before_) {
    if (*gudhi_before != *gudhi_before_) return "a division has changed GUDHI's Betti numbers";
    ++report_.kept_by_gudhi;
  }
  if (regina_before && regina_before_) {
    if (*regina_before != *regina_before_) return "a division has changed Regina's homology";
    ++report_.kept_by_regina;
  }
  return {};
}

}  // namespace sunder::test
