// SPDX-License-Identifier: MIT
// Which tetrahedra share a face, and whether all of them can be oriented alike.
#include <algorithm>

#include "topology/kernel/kernel.hpp"
#include "topology/mesh/face_table.hpp"
#include "topology/mesh/survey.hpp"

namespace sunder {
namespace {

constexpr FindingWords duplicate_tetrahedron = {
    "duplicate_tetrahedron", Severity::error,
    "% [tetrahedron repeats|tetrahedra repeat] an earlier one", "remove the later of each pair"};
constexpr FindingWords mirrored_tetrahedron = {
    "mirrored_tetrahedron", Severity::error,
    "% [tetrahedron has|tetrahedra have] the four points of an earlier one in the opposite "
    "orientation",
    "remove the later of each pair"};
constexpr FindingWords overfull_face = {"overfull_face", Severity::error,
                                        "% [face belongs|faces belong] to more than two "
                                        "tetrahedra; the ids give the first one's three points and "
                                        "then its tetrahedra",
                                        "remove tetrahedra until each face has at most two"};
constexpr FindingWords non_orientable = {"non_orientable", Severity::error,
                                         "% [tetrahedron cannot|tetrahedra cannot] be oriented "
                                         "like all neighbours: the body closes on itself with a "
                                         "twist",
                                         "cut the body open: a 3-map holds orientable bodies only"};
constexpr FindingWords inverted_tetrahedron = {
    "inverted_tetrahedron", Severity::warning,
    "% [tetrahedron is|tetrahedra are] numbered with negative volume; the last two corners are "
    "exchanged",
    "nothing to do; writing the mesh again makes it permanent"};
constexpr FindingWords folded_tetrahedron = {
    "folded_tetrahedron", Severity::error,
    "% [tetrahedron is|tetrahedra are] turned inside out against the neighbours they share faces "
    "with",
    "move their points back: the body overlaps itself there"};

/// Whether sorting a face's points takes an odd number of exchanges, from the order in which its
/// darts run.
bool is_odd_face(const std::array<std::uint32_t, 4>& t, int p) {
  const auto& c = dart_order::face_corners[p];
  const std::uint32_t a = t[c[0]], b = t[c[1]], d = t[c[2]];
  return ((b < a) + (d < b) + (d < a)) % 2 != 0;
}

void note_parities(Survey& s) {
  s.odd.assign(s.mesh.tetrahedra.size(), 0);
  for (std::size_t t = 0; t < s.odd.size(); ++t) {
    for (int p = 0; s.usable[t] && p < 4; ++p) {
      const unsigned odd = is_odd_face(s.mesh.tetrahedra[t], p) ? 1 : 0;
      s.odd[t] |= static_cast<std::uint8_t>(odd << p);
    }
  }
}

struct FaceDefects {
  Places overfull;
  std::vector<std::int64_t> overfull_ids;  // three points, then tetrahedra, of the first
};

std::uint32_t opposite_point(const Survey& s, std::uint32_t f) {
  return s.mesh.tetrahedra[f / 4][f % 4];
}
bool is_odd(const Survey& s, std::uint32_t f) { return (s.odd[f / 4] >> f % 4 & 1) != 0; }

/// Marks later copies of a tetrahedron (2 in `usable`, 3 when mirrored), drops them from the run.
/// Entries of a run have the same three points; those with the same fourth are one tetrahedron.
void drop_copies(Survey& s, std::vector<std::uint32_t>& run) {
  std::sort(run.begin(), run.end(), [&s](std::uint32_t f, std::uint32_t g) {
    const std::uint32_t a = opposite_point(s, f), b = opposite_point(s, g);
    return a != b ? a < b : f < g;
  });
  std::size_t kept = 1;
  for (std::size_t i = 1; i < run.size(); ++i) {
    const std::uint32_t first = run[kept - 1];
    if (opposite_point(s, run[i]) != opposite_point(s, first)) {
      run[kept++] = run[i];
    } else {
      s.usable[run[i] / 4] = is_odd(s, run[i]) == is_odd(s, first) ? 2 : 3;
    }
  }
  run.resize(kept);
}

void join_run(Survey& s, const std::array<std::uint32_t, 3>& points,
              std::vector<std::uint32_t>& run, FaceDefects& defects) {
  drop_copies(s, run);
  if (run.size() == 2) {
    s.neighbours[run[0] / 4][run[0] % 4] = HalfFaceId{run[1]};
    s.neighbours[run[1] / 4][run[1] % 4] = HalfFaceId{run[0]};
  }
  if (run.size() <= 2) return;
  defects.overfull.add(points);
  if (!defects.overfull_ids.empty()) return;
  defects.overfull_ids.assign(points.begin(), points.end());
  std::sort(run.begin(), run.end());
  for (std::size_t i = 0; i < run.size() && defects.overfull_ids.size() < Finding::max_ids; ++i) {
    defects.overfull_ids.push_back(run[i] / 4);
  }
}

void report_copies(Survey& s) {
  Places duplicates(PlaceKind::tetrahedra, s.keeps_places);
  Places mirrored(PlaceKind::tetrahedra, s.keeps_places);
  for (std::size_t t = 0; t < s.usable.size(); ++t) {
    if (s.usable[t] == 2) duplicates.add(t);
    if (s.usable[t] == 3) mirrored.add(t);
    if (s.usable[t] > 1) s.usable[t] = 0;
  }
  report(s, duplicate_tetrahedron, duplicates);
  report(s, mirrored_tetrahedron, mirrored);
}

/// One face-connected set of tetrahedra: orients them relative to the first.
struct ParityWalk {
  std::vector<std::uint32_t> members;
  bool has_boundary = false;
  Places& conflicts;
};

void walk_parity(Survey& s, std::uint32_t first, std::vector<char>& met, ParityWalk& walk) {
  walk.members.assign(1, first);
  walk.has_boundary = false;
  met[first] = 1;
  for (std::size_t i = 0; i < walk.members.size(); ++i) {
    const std::uint32_t t = walk.members[i];
    bool conflict = false;
    for (unsigned p = 0; p < 4; ++p) {
      const HalfFaceId across = s.neighbours[t][p];
      if (across.is_none()) {
        walk.has_boundary = true;
        continue;
      }
      // Alike means that the face's order leaves one as it enters the other: opposite parity.
      const bool alike = is_odd(s, 4 * t + p) != is_odd(s, across.value);
      const std::uint32_t u = across.value / 4;
      const char flip = static_cast<char>(s.flipped[t] ^ (alike ? 0 : 1));
      if (!met[u]) {
        met[u] = 1;
        s.flipped[u] = flip;
        walk.members.push_back(u);
      } else if (s.flipped[u] != flip) {
        conflict = true;
      }
    }
    if (conflict) walk.conflicts.add(t);
  }
}

/// Turns the whole set over when that agrees with more volumes (on a tie: with the first one's).
void orient_by_volume(Survey& s, const std::vector<std::uint32_t>& members) {
  std::size_t agree = 0, disagree = 0;
  std::uint32_t decider = members.front();
  for (const std::uint32_t t : members) {
    if (s.sign[t] == 0) continue;
    ((s.sign[t] < 0) == (s.flipped[t] != 0) ? agree : disagree) += 1;
    if (s.sign[decider] == 0 || t < decider) decider = t;
  }
  const bool tie_says_turn = (s.sign[decider] < 0) != (s.flipped[decider] != 0);
  if (disagree > agree || (disagree == agree && disagree > 0 && tie_says_turn)) {
    for (const std::uint32_t t : members) s.flipped[t] ^= 1;
  }
}

}  // namespace

void survey_faces(Survey& s) {
  s.neighbours.assign(s.mesh.tetrahedra.size(), {});
  note_parities(s);
  FaceDefects defects{Places(PlaceKind::faces, s.keeps_places), {}};
  std::vector<std::uint32_t> run;
  const FaceTable table = face_table(s.mesh.tetrahedra, s.mesh.points.size(), s.usable);
  for_each_face(table, [&](const auto& points, std::span<const TableFace> sides) {
    if (sides.size() < 2) return;
    run.clear();
    for (const TableFace& side : sides) run.push_back(side.half_face);
    join_run(s, points, run, defects);
  });
  report_copies(s);
  report(s, overfull_face, defects.overfull);
  if (defects.overfull.count() > 0) s.findings.back().ids = defects.overfull_ids;
}

void survey_orientation(Survey& s) {
  const std::size_t tetrahedra = s.mesh.tetrahedra.size();
  s.flipped.assign(tetrahedra, 0);
  std::vector<char> met(tetrahedra, 0);
  Places conflicts(PlaceKind::tetrahedra, s.keeps_places);
  Places inverted = conflicts, folded = conflicts;
  ParityWalk walk{.conflicts = conflicts};
  for (std::size_t t = 0; t < tetrahedra; ++t) {
    if (met[t] || !s.usable[t]) continue;
    walk_parity(s, static_cast<std::uint32_t>(t), met, walk);
    orient_by_volume(s, walk.members);
    ++s.components;
    s.closed_components += walk.has_boundary ? 0 : 1;
  }
  for (std::size_t t = 0; t < tetrahedra; ++t) {
    if (!s.usable[t]) continue;
    if (s.flipped[t]) inverted.add(t);
    if (s.sign[t] != 0 && (s.sign[t] < 0) != (s.flipped[t] != 0)) folded.add(t);
  }
  report(s, non_orientable, conflicts);
  if (conflicts.count() > 0) return;  // no common orientation to compare with
  report(s, inverted_tetrahedron, inverted);
  FindingWords words = folded_tetrahedron;
  words.severity = s.bad_volume;
  report(s, words, folded);
}

}  // namespace sunder
