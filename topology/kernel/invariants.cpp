// SPDX-License-Identifier: MIT
// Counts of a map for its users, and the table of the changes that a face split can make.
#include "topology/kernel/invariants_impl.hpp"
#include "topology/kernel/map_answers.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {
namespace {

using Change = std::array<std::ptrdiff_t, 3>;

/// The changes of (b0, b1, b2) that a split of s_v vertices and s_e edges can make. With all
/// vertices split the two copies of the face are disjoint discs: the old body is the new one and an
/// arc. With fewer, the glued pair shares a part of the triangle, hence b0 cannot change.
std::vector<Change> possible_changes(int s_v, int s_e) {
  switch (4 * s_v + s_e) {
    case 0:
      return {{0, 0, 1}};
    case 1:
      return {{0, 0, 0}};
    case 2:
      return {{0, 0, -1}, {0, 1, 0}};
    case 3:
      return {{0, 2, 0}, {0, 1, -1}, {0, 0, -2}};
    case 4 + 2:
      return {{0, 0, 0}};
    case 4 + 3:
      return {{0, 0, -1}, {0, 1, 0}};
    case 8 + 3:
      return {{0, 0, 0}};
    case 12 + 3:
      return {{1, 0, 0}, {0, -1, 0}};
    default:
      break;  // no split is like this
  }
  return {};
}

std::ptrdiff_t difference(std::size_t after, std::size_t before) {
  return static_cast<std::ptrdiff_t>(after) - static_cast<std::ptrdiff_t>(before);
}

void expect(std::vector<Finding>& findings, const FaceSplit& split, const std::string& what,
            std::ptrdiff_t seen, std::ptrdiff_t expected) {
  if (seen == expected) return;
  Finding finding;
  finding.code = "split_law";
  finding.ids = {static_cast<std::int64_t>(split.face.value)};
  finding.text = "splitting half-face " + std::to_string(split.face.value) + " (" +
                 std::to_string(split.vertex_count) + " vertices, " +
                 std::to_string(edge_count(split)) + " edges split): " + what + " is " +
                 std::to_string(seen) + ", the law says " + std::to_string(expected);
  finding.remedy = "report this: the map's kernel is wrong";
  findings.push_back(std::move(finding));
}

void expect_betti(std::vector<Finding>& findings, const Counts& before, const Counts& after,
                  const FaceSplit& split) {
  Change change;
  for (int i = 0; i < 3; ++i) change[i] = (*after.betti)[i] - (*before.betti)[i];
  for (const Change& possible : possible_changes(split.vertex_count, edge_count(split))) {
    if (change == possible) return;
  }
  const std::string seen = std::to_string(change[0]) + ", " + std::to_string(change[1]) + ", " +
                           std::to_string(change[2]);
  expect(findings, split, "a possible change of the Betti numbers (seen: " + seen + ")", 0, 1);
}

}  // namespace

std::vector<Finding> check_split_laws(const Counts& before, const Counts& after,
                                      const FaceSplit& split) {
  std::vector<Finding> findings;
  if (!split.did) {
    expect(findings, split, "did (nothing else to hold)", 0, 1);
    return findings;
  }
  const int s_v = split.vertex_count, s_e = edge_count(split);
  expect(findings, split, "dV", difference(after.vertices, before.vertices), s_v);
  expect(findings, split, "dE", difference(after.edges, before.edges), s_e);
  expect(findings, split, "dF", difference(after.faces, before.faces), 1);
  expect(findings, split, "dT", difference(after.tetrahedra, before.tetrahedra), 0);
  expect(findings, split, "d(boundary faces)",
         difference(after.boundary_faces, before.boundary_faces), 2);
  expect(findings, split, "dchi", after.euler_characteristic - before.euler_characteristic,
         s_v - s_e + 1);
  expect(findings, split, "enough edges for the vertices (1: 2, more: 3)",
         s_e >= (s_v >= 2   ? 3
                 : s_v == 1 ? 2
                            : 0)
             ? 1
             : 0,
         1);
  const std::ptrdiff_t separated = difference(after.components, before.components);
  expect(findings, split, "a separation that the oracle allows",
         separated == 0 || (separated == 1 && s_v == 3) ? 1 : 0, 1);
  if (before.betti && after.betti) expect_betti(findings, before, after, split);
  return findings;
}

Counts counts_after(const Counts& before, const VolumeMap& map, std::span<const FaceSplit> splits,
                    std::size_t created) {
  // Counts do not show which of several components had a boundary.
  if (!before.betti) return count_cells(map);
  Counts after = before;
  after.components += created;
  for (const FaceSplit& split : splits) {
    if (!split.did) continue;
    after.vertices += static_cast<std::size_t>(split.vertex_count);
    after.edges += static_cast<std::size_t>(edge_count(split));
    after.faces += 1;
    after.boundary_faces += 2;
  }
  after.boundary_sheets = count_boundary_sheets(map);
  detail::derive_invariants(after, 0);
  return after;
}

template Counts count_cells<VolumeMap>(const VolumeMap&);
template std::size_t count_boundary_sheets<VolumeMap>(const VolumeMap&);
template Counts count_cells<DenseMap>(const DenseMap&);

}  // namespace sunder
