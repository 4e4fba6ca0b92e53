// SPDX-License-Identifier: MIT
// Comparisons: counted, and the first that failed kept in words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "topology/suite/kernels/operation.hpp"

namespace sunder::suite {

/// The first answer that was not the expected one.
struct Mismatch {
  /// Number of steps done when it showed: 0 right after loading.
  std::size_t step = 0;
  /// Which operation of the fixture that was, counted from 1; 0 right after loading.
  std::size_t operation = 0;
  /// "edges", "split vertices of face 1 4 14", ...; then the expected and the actual answer.
  std::string what, expected, answered;
  /// The shortest sequence of steps found that still shows a mismatch.
  std::vector<Step> steps;
};

/// Comparisons of one run, and where it is.
struct Checks {
  std::size_t made = 0;
  std::size_t step = 0, operation = 0;
  std::optional<Mismatch> first;
};

/// Notes a mismatch, unless there is one already.
void differ(Checks& checks, const std::string& what, const std::string& expected,
            const std::string& answered);

/// Counts a comparison; gives its outcome.
template <class T>
bool same(Checks& checks, const T& expected, const T& answered) {
  ++checks.made;
  return expected == answered;
}

// Each compares field by field and notes the first that differs.
void compare(Checks& checks, const std::string& what, std::size_t expected, std::size_t answered);
void compare(Checks& checks, const CellCounts& expected, const CellCounts& answered);
void compare(Checks& checks, const std::string& what, const BettiNumbers& expected,
             const BettiNumbers& answered);
void compare(Checks& checks, const IntegerHomology& expected, const IntegerHomology& answered);
/// `face`: its points, as texts name it.
void compare(Checks& checks, const std::string& face, const SplitAnswer& expected,
             const SplitAnswer& answered);

/// A partition in normal form: for each place the first place with the same number. Two lists of
/// numbers are equal in the same places exactly when their normal forms are equal. O(n).
std::vector<std::uint32_t> first_places(std::span<const std::uint32_t> numbers);

/// Where two partitions in normal form, of equal length, first differ.
struct PartitionDifference {
  /// The first place that is wrong, and an earlier one that it should, or should not, be with.
  std::size_t earlier = 0, place = 0;
  /// Whether the two are expected together.
  bool together = false;
};
std::optional<PartitionDifference> partition_difference(std::span<const std::uint32_t> expected,
                                                        std::span<const std::uint32_t> answered);

}  // namespace sunder::suite
