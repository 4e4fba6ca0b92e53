// SPDX-License-Identifier: MIT
// Comparisons and their words.
#include "topology/suite/judge/judge_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace sunder::suite {
namespace {

std::string edges_text(const std::vector<std::array<std::uint32_t, 2>>& edges) {
  std::string text;
  for (const auto& [a, b] : edges) text += fmt::format("{}{}-{}", text.empty() ? "" : " ", a, b);
  return text.empty() ? "none" : text;
}

std::string points_text(const std::vector<std::uint32_t>& points) {
  return points.empty() ? "none" : fmt::format("{}", fmt::join(points, " "));
}

}  // namespace

void differ(Checks& checks, const std::string& what, const std::string& expected,
            const std::string& answered) {
  if (checks.first) return;
  checks.first = Mismatch{.step = checks.step,
                          .operation = checks.operation,
                          .what = what,
                          .expected = expected,
                          .answered = answered,
                          .steps = {}};
}

void compare(Checks& checks, const std::string& what, std::size_t expected, std::size_t answered) {
  if (same(checks, expected, answered)) return;
  differ(checks, what, std::to_string(expected), std::to_string(answered));
}

void compare(Checks& checks, const CellCounts& expected, const CellCounts& answered) {
  compare(checks, "vertices", expected.vertices, answered.vertices);
  compare(checks, "edges", expected.edges, answered.edges);
  compare(checks, "faces", expected.faces, answered.faces);
  compare(checks, "tetrahedra", expected.tetrahedra, answered.tetrahedra);
  compare(checks, "components", expected.components, answered.components);
  compare(checks, "boundary faces", expected.boundary_faces, answered.boundary_faces);
  compare(checks, "boundary sheets", expected.boundary_sheets, answered.boundary_sheets);
}

void compare(Checks& checks, const std::string& what, const BettiNumbers& expected,
             const BettiNumbers& answered) {
  for (std::size_t d = 0; d < 4; ++d) {
    if (same(checks, expected[d], answered[d])) continue;
    differ(checks, fmt::format("b{} {}", d, what), std::to_string(expected[d]),
           std::to_string(answered[d]));
  }
}

void compare(Checks& checks, const IntegerHomology& expected, const IntegerHomology& answered) {
  compare(checks, "over Z", expected.betti, answered.betti);
  for (std::size_t d = 0; d < 4; ++d) {
    if (same(checks, expected.torsion[d], answered.torsion[d])) continue;
    differ(checks, fmt::format("torsion in dimension {}", d),
           fmt::format("[{}]", fmt::join(expected.torsion[d], " ")),
           fmt::format("[{}]", fmt::join(answered.torsion[d], " ")));
  }
}

void compare(Checks& checks, const std::string& face, const SplitAnswer& expected,
             const SplitAnswer& answered) {
  if (!same(checks, expected.did, answered.did)) {
    differ(checks, "splitting face " + face, expected.did ? "a split" : "a boundary face",
           answered.did ? "a split" : "a boundary face");
  }
  if (!expected.did || !answered.did) return;
  if (!same(checks, expected.vertices, answered.vertices)) {
    differ(checks, "split vertices of face " + face, points_text(expected.vertices),
           points_text(answered.vertices));
  }
  if (!same(checks, expected.edges, answered.edges)) {
    differ(checks, "split edges of face " + face, edges_text(expected.edges),
           edges_text(answered.edges));
  }
  if (!same(checks, expected.separated, answered.separated)) {
    differ(checks, "separation by face " + face, expected.separated ? "two components" : "one",
           answered.separated ? "two components" : "one");
  }
}

std::vector<std::uint32_t> first_places(std::span<const std::uint32_t> numbers) {
  std::vector<std::uint32_t> first(numbers.size());
  // Any number is allowed, but kernels mostly give rows: those need no hashing.
  constexpr std::uint32_t nowhere = 0xffffffffU;
  std::vector<std::uint32_t> by_row(4 * numbers.size(), nowhere);
  std::unordered_map<std::uint32_t, std::uint32_t> by_number;
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    const std::uint32_t n = numbers[i];
    std::uint32_t& place =
        n < by_row.size() ? by_row[n] : by_number.emplace(n, nowhere).first->second;
    if (place == nowhere) place = i;
    first[i] = place;
  }
  return first;
}

std::optional<PartitionDifference> partition_difference(std::span<const std::uint32_t> expected,
                                                        std::span<const std::uint32_t> answered) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] == answered[i]) continue;
    // All before agree: either it should be with an earlier place, or it is and should not.
    const bool together = expected[i] < i;
    return PartitionDifference{together ? expected[i] : answered[i], i, together};
  }
  return std::nullopt;
}

}  // namespace sunder::suite
