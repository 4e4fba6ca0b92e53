// SPDX-License-Identifier: MIT
// Elimination and the Smith form against plain dense twins, on random matrices and complexes.
#include "topology/suite/homology/homology_matrix.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <stdexcept>

#include "tests/topology/suite/abstract_bodies.hpp"
#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/homology/homology.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

using Rows = std::vector<std::vector<std::int64_t>>;

SparseMatrix sparse(const Rows& rows, std::size_t columns) {
  SparseMatrix matrix{rows.size(), std::vector<std::vector<MatrixEntry>>(columns)};
  for (std::uint32_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      if (rows[r][c] != 0) matrix.columns[c].push_back({r, rows[r][c]});
    }
  }
  return matrix;
}

/// Rank over the field of `prime` elements by plain elimination.
std::size_t dense_rank(Rows rows, std::int64_t prime) {
  const auto mod = [prime](std::int64_t a) { return (a % prime + prime) % prime; };
  std::size_t rank = 0;
  const std::size_t columns = rows.empty() ? 0 : rows[0].size();
  for (std::size_t c = 0; c < columns && rank < rows.size(); ++c) {
    std::size_t pivot = rank;
    while (pivot < rows.size() && mod(rows[pivot][c]) == 0) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[pivot], rows[rank]);
    for (std::size_t r = rank + 1; r < rows.size(); ++r) {
      const std::int64_t a = mod(rows[rank][c]), b = mod(rows[r][c]);
      for (std::size_t k = 0; k < columns; ++k) {
        rows[r][k] = mod(a * rows[r][k] - b * mod(rows[rank][k]));
      }
    }
    ++rank;
  }
  return rank;
}

/// Determinant of the chosen rows and columns, by expansion along the first row.
std::int64_t minor_of(const Rows& rows, const std::vector<std::size_t>& r,
                      std::vector<std::size_t> c) {
  if (r.empty()) return 1;
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    std::vector<std::size_t> others = c;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    sum +=
        (k % 2 == 0 ? 1 : -1) * rows[r[0]][c[k]] * minor_of(rows, {r.begin() + 1, r.end()}, others);
  }
  return sum;
}

/// All choices of k of the numbers below n.
std::vector<std::vector<std::size_t>> choices(std::size_t n, std::size_t k) {
  std::vector<std::vector<std::size_t>> all;
  for (unsigned mask = 0; mask < 1U << n; ++mask) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < n; ++i) {
      if (mask >> i & 1U) chosen.push_back(i);
    }
    if (chosen.size() == k) all.push_back(chosen);
  }
  return all;
}

/// Elementary divisors as quotients of determinantal divisors: the k-th is the greatest common
/// divisor of all k x k minors over that of all smaller ones by one.
std::vector<std::uint64_t> divisors_by_minors(const Rows& rows, std::size_t columns) {
  std::vector<std::uint64_t> divisors;
  std::int64_t before = 1;
  for (std::size_t k = 1; k <= std::min(rows.size(), columns); ++k) {
    std::int64_t divisor = 0;
    for (const auto& r : choices(rows.size(), k)) {
      for (const auto& c : choices(columns, k)) divisor = std::gcd(divisor, minor_of(rows, r, c));
    }
    if (divisor == 0) break;
    divisors.push_back(static_cast<std::uint64_t>(divisor / before));
    before = divisor;
  }
  return divisors;
}

Rows random_rows(std::size_t rows, std::size_t columns, std::mt19937_64& random) {
  const auto largest = static_cast<std::int64_t>(1 + below(random, 12));
  const std::size_t gap = 1 + below(random, 3);
  Rows result(rows, std::vector<std::int64_t>(columns, 0));
  for (auto& row : result) {
    for (std::int64_t& x : row) {
      if (below(random, gap) > 0) continue;
      x = static_cast<std::int64_t>(below(random, static_cast<std::size_t>(2 * largest + 1))) -
          largest;
    }
  }
  return result;
}

/// The boundary matrix of dimension d, dense.
Rows dense_boundary(const OrbitComplex& complex, std::size_t d) {
  Rows rows(complex.cells[d - 1], std::vector<std::int64_t>(complex.cells[d], 0));
  for (std::size_t c = 0; c < complex.cells[d]; ++c) {
    for (std::size_t i = 0; i <= d; ++i) {
      const BoundaryTerm& term = complex.boundary[d][c][i];
      rows[term.cell][c] += term.sign;
    }
  }
  return rows;
}

}  // namespace

TEST_CASE("elementary divisors are the quotients of greatest common divisors of minors",
          "[suite][homology]") {
  const std::uint64_t seed = 81;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int round = 0; round < 2000; ++round) {
    INFO("round " << round);
    const std::size_t rows = 1 + below(random, 5), columns = 1 + below(random, 5);
    const Rows matrix = random_rows(rows, columns, random);
    const std::vector<std::uint64_t> expected = divisors_by_minors(matrix, columns);
    REQUIRE(elementary_divisors(sparse(matrix, columns)) == expected);
    // With the unit pivots first.
    const Elimination elimination = eliminate_units(sparse(matrix, columns), 0);
    std::vector<std::uint64_t> divisors(elimination.pivots, 1);
    const std::vector<std::uint64_t> rest = elementary_divisors(elimination.rest);
    divisors.insert(divisors.end(), rest.begin(), rest.end());
    REQUIRE(divisors == expected);
  }
}

TEST_CASE("over a field the pivots are the rank, one in each marked row and column",
          "[suite][homology]") {
  const std::uint64_t seed = 82;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int round = 0; round < 500; ++round) {
    INFO("round " << round);
    const std::size_t rows = 1 + below(random, 20), columns = 1 + below(random, 20);
    const Rows matrix = random_rows(rows, columns, random);
    for (const int prime : {2, 3, 7, 32749}) {
      const Elimination elimination = eliminate_units(sparse(matrix, columns), prime);
      REQUIRE(elimination.pivots == dense_rank(matrix, prime));
      REQUIRE(elimination.rest.columns.empty());
      // The square of marked rows and columns is invertible.
      Rows square;
      for (std::size_t r = 0; r < rows; ++r) {
        if (!elimination.pivot_row[r]) continue;
        square.emplace_back();
        for (std::size_t c = 0; c < columns; ++c) {
          if (elimination.pivot_column[c]) square.back().push_back(matrix[r][c]);
        }
      }
      REQUIRE(square.size() == elimination.pivots);
      REQUIRE(dense_rank(square, prime) == elimination.pivots);
    }
  }
}

TEST_CASE("a number that outgrows 64 bits is an error, not a wrong answer", "[suite][homology]") {
  const std::int64_t large = (std::int64_t{1} << 62) - 57;
  CHECK_THROWS_AS(elementary_divisors(sparse({{3, large}, {large, 5}}, 2)), std::overflow_error);
  CHECK_THROWS_AS(eliminate_units(sparse({{1, large}, {large, 5}}, 2), 0), std::overflow_error);
  CHECK(elementary_divisors(sparse({{large, 0}, {0, large}}, 2)) ==
        std::vector<std::uint64_t>(2, static_cast<std::uint64_t>(large)));
}

TEST_CASE("Betti numbers are cells less the ranks of whole boundary matrices, by a dense twin",
          "[suite][homology]") {
  const std::uint64_t seed = 83;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int round = 0; round < 60; ++round) {
    INFO("round " << round);
    const auto points = static_cast<std::uint32_t>(5 + below(random, 4));
    GlueTwin twin = glued(random_pseudomanifold(points, 2 + below(random, 30), random));
    cut_at_random(twin, round % 2 == 0 ? 0.15 : 0.0, random);
    const OrbitComplex complex = orbit_complex(twin);
    for (const int prime : {2, 3}) {
      std::array<std::size_t, 5> rank = {};
      for (std::size_t d = 1; d < 4; ++d) rank[d] = dense_rank(dense_boundary(complex, d), prime);
      BettiNumbers expected;
      for (std::size_t d = 0; d < 4; ++d) expected[d] = complex.cells[d] - rank[d] - rank[d + 1];
      REQUIRE(betti_numbers(complex, prime) == expected);
    }
    IntegerHomology expected{
        {complex.cells[0], complex.cells[1], complex.cells[2], complex.cells[3]}, {}};
    for (std::size_t d = 1; d < 4; ++d) {
      // The Smith form of the whole matrix: no unit pivots first, nothing left out.
      for (const std::uint64_t n :
           elementary_divisors(sparse(dense_boundary(complex, d), complex.cells[d]))) {
        --expected.betti[d];
        --expected.betti[d - 1];
        if (n > 1) expected.torsion[d - 1].push_back(n);
      }
    }
    REQUIRE(integer_homology(complex) == expected);
  }
}
