// SPDX-License-Identifier: MIT
// Judging single steps and whole bodies.
#include "topology/suite/random/random_run_trial.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "topology/suite/fixtures/steps.hpp"
#include "topology/suite/homology/homology.hpp"
#include "topology/suite/random/random_run_laws.hpp"

namespace sunder::suite {
namespace {

CellCounts cell_counts(const TwinCounts& c) {
  return {c.vertices,   c.edges,          c.faces,          c.tetrahedra,
          c.components, c.boundary_faces, c.boundary_sheets};
}

SplitAnswer answer_to_trial(const LocalTruth& truth) {
  SplitAnswer answer;
  answer.did = true;
  answer.separated = truth.separated;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t p = truth.points[i], q = truth.points[(i + 1) % 3];
    if (truth.vertex_split[i]) answer.vertices.push_back(p);
    if (truth.edge_split[i]) answer.edges.push_back({std::min(p, q), std::max(p, q)});
  }
  std::sort(answer.vertices.begin(), answer.vertices.end());
  std::sort(answer.edges.begin(), answer.edges.end());
  return answer;
}

/// Components without a face on the boundary.
std::size_t count_closed(const GlueTwin& twin) {
  const std::vector<std::uint32_t> component = component_classes(twin);
  std::vector<char> open(component.size(), 0);
  for (std::size_t f = 0; f < twin.glued.size(); ++f) {
    if (twin.glued[f].is_none()) open[component[f / 4]] = 1;
  }
  std::size_t closed = 0;
  for (std::uint32_t t = 0; t < component.size(); ++t) {
    closed += component[t] == t && open[t] == 0 ? 1 : 0;
  }
  return closed;
}

std::string face_text(const Trial& trial, FaceSide side) {
  return fmt::format("{} from tetrahedron {}", fmt::join(points_of(trial.twin, side), " "),
                     side.tetrahedron);
}

/// Checks the kernel's counts after a split (or, with `undone`, after the glue that undoes one);
/// and the Betti numbers, if those before are known.
void judge_laws(Trial& trial, const SplitAnswer& truth, bool undone) {
  // Homology costs eight times as much as counting.
  const std::size_t cost = trial.body.tetrahedra.size() * (trial.sheets_tell_betti ? 1 : 8);
  if (!due(trial.law_pace, cost)) {
    trial.betti.reset();
    return;
  }
  ++trial.times.laws;
  const CellCounts answered = trial.kernel.counts();
  trial.counts.boundary_sheets = answered.boundary_sheets;  // not known from the step alone
  compare(trial.checks, trial.counts, answered);
  const BettiNumbers now = trial.sheets_tell_betti ? betti_from_sheets(answered, trial.closed)
                                                   : betti_numbers(orbit_complex(trial.twin), 2);
  if (trial.betti) {
    ++trial.times.betti_changes;
    judge_change(trial.checks, undone ? now : *trial.betti, undone ? *trial.betti : now, truth);
  }
  trial.betti = now;
}

void compare_partitions(Trial& trial, const std::string& what,
                        const std::vector<std::uint32_t>& expected,
                        const std::vector<std::uint32_t>& answered) {
  if (!same(trial.checks, expected.size(), answered.size())) {
    differ(trial.checks, "numbers given for " + what, std::to_string(expected.size()),
           std::to_string(answered.size()));
    return;
  }
  ++trial.checks.made;
  const auto wrong = partition_difference(first_places(expected), first_places(answered));
  if (!wrong) return;
  differ(trial.checks, fmt::format("{} {} and {}", what, wrong->earlier, wrong->place),
         wrong->together ? "together" : "apart", wrong->together ? "apart" : "together");
}

/// The kernel's fan against the suite's own, as sets of half-faces.
void compare_fans(Trial& trial, const std::string& what, std::vector<std::uint32_t> expected,
                  std::vector<std::uint32_t> answered) {
  std::sort(expected.begin(), expected.end());
  std::sort(answered.begin(), answered.end());
  if (same(trial.checks, expected, answered)) return;
  differ(trial.checks, what, fmt::format("half-faces {}", fmt::join(expected, " ")),
         fmt::format("half-faces {}", fmt::join(answered, " ")));
}

/// The kernel's faces against the sides that the suite is about to split.
void compare_sides(Trial& trial, const std::string& what, std::span<const Step> steps,
                   const std::vector<FaceSide>& sides) {
  std::vector<std::uint32_t> expected, answered;
  for (const Step& step : steps) expected.push_back(half_face_of(trial.twin, step.a).value);
  for (const FaceSide side : sides) answered.push_back(half_face_of(trial.twin, side).value);
  compare_fans(trial, what, std::move(expected), std::move(answered));
}

/// Betti numbers over GF(2) that go with homology over Z: every even torsion coefficient adds one
/// in its dimension and one in the next.
BettiNumbers mod_2(const IntegerHomology& homology) {
  BettiNumbers betti = homology.betti;
  for (std::size_t d = 0; d < 4; ++d) {
    for (const std::uint64_t order : homology.torsion[d]) {
      if (order % 2 != 0) continue;
      ++betti[d];
      if (d < 3) ++betti[d + 1];
    }
  }
  return betti;
}

}  // namespace

bool due(Pace& pace, std::size_t cost) {
  pace.saved += pace.allowance;
  if (pace.saved < cost) return false;
  pace.saved = 0;
  return true;
}

Trial begin_trial(TetMesh body, JudgedKernel kernel) {
  Trial trial;
  trial.body = std::move(body);
  trial.kernel = std::move(kernel);
  trial.twin = glue_twin(trial.body.tetrahedra, trial.body.points.size());
  trial.closed = trial.closed_intact = count_closed(trial.twin);
  trial.counts = cell_counts(union_find_counts(trial.twin));
  trial.betti = betti_numbers(orbit_complex(trial.twin), 2);
  trial.sheets_tell_betti = *trial.betti == betti_from_sheets(trial.counts, trial.closed);
  try {
    for (const Finding& f : trial.kernel.load(trial.body)) {
      if (f.severity == Severity::error) differ(trial.checks, "loading", "a body", f.code);
    }
  } catch (const KernelLost& lost) {
    differ(trial.checks, "loading", "a body", lost.what());
  }
  return trial;
}

SplitAnswer split(Trial& trial, HalfFaceId face) {
  SplitAnswer truth;
  if (trial.checks.first) return truth;
  const FaceSide side = side_of(trial.twin, face);
  trial.steps.push_back({.kind = Step::Kind::split, .a = side, .b = {}});
  trial.checks.step = trial.steps.size();
  if (!trial.twin.glued[face.index()].is_none()) truth = answer_to_trial(unglue(trial.twin, face));
  const SplitAnswer answered = trial.kernel.split(side);
  ++(truth.did ? trial.times.splits : trial.times.refusals);
  if (!(answered == truth)) compare(trial.checks, face_text(trial, side), truth, answered);
  trial.checks.made += 4;
  judge_answer(trial.checks, answered);
  if (!truth.did || trial.checks.first) return truth;
  trial.counts = counts_after(trial.counts, truth);
  if (trial.closed > 0) trial.closed = count_closed(trial.twin);
  judge_laws(trial, truth, false);
  return truth;
}

bool glue(Trial& trial, HalfFaceId a, HalfFaceId b) {
  if (trial.checks.first) return false;
  const auto free = [&trial](HalfFaceId f) { return trial.twin.glued[f.index()].is_none(); };
  const bool can = a != b && free(a) && free(b);
  const Step step = {
      .kind = Step::Kind::glue, .a = side_of(trial.twin, a), .b = side_of(trial.twin, b)};
  trial.steps.push_back(step);
  trial.checks.step = trial.steps.size();
  ++(can ? trial.times.glues : trial.times.refusals);
  if (!same(trial.checks, can, trial.kernel.glue(step.a, step.b))) {
    differ(trial.checks, text_of(trial.twin, step), can ? "glued" : "refused",
           can ? "refused" : "glued");
  }
  if (!can) return false;
  // Gluing joins the same cells that parting the faces again would part.
  glue_again(trial.twin, a, b);
  const SplitAnswer truth = answer_to_trial(unglue(trial.twin, a));
  glue_again(trial.twin, a, b);
  trial.counts = counts_before(trial.counts, truth);
  if (trial.closed_intact > 0) trial.closed = count_closed(trial.twin);
  judge_laws(trial, truth, true);
  return true;
}

void judge_whole(Trial& trial) {
  if (trial.checks.first) return;
  ++trial.times.wholes;
  const CellCounts expected = cell_counts(union_find_counts(trial.twin));
  trial.counts.boundary_sheets = expected.boundary_sheets;
  compare(trial.checks, expected, trial.kernel.counts());
  compare(trial.checks, expected, trial.counts);  // the sum of all single steps
  compare_partitions(trial, "vertices of corners", corner_classes(trial.twin),
                     trial.kernel.vertex_of_corner());
  compare_partitions(trial, "components of tetrahedra", component_classes(trial.twin),
                     trial.kernel.component_of_tetrahedron());
}

void judge_fan(Trial& trial, const SplitFan& fan, std::span<const Step> steps) {
  if (trial.checks.first || !trial.kernel.fan) return;
  ++trial.times.fans;
  // One name for both sides of a face.
  const auto face = [&trial](FaceSide side) {
    const HalfFaceId f = half_face_of(trial.twin, side);
    return std::min(f, trial.twin.glued[f.index()]).value;  // none() is the largest
  };
  std::vector<std::uint32_t> expected, answered;
  for (const Step& step : steps) expected.push_back(face(step.a));
  for (const FaceSide side : trial.kernel.fan(std::get<CornerAt>(fan.vertex), fan.normal)) {
    answered.push_back(face(side));
  }
  const auto [tetrahedron, point] = std::get<CornerAt>(fan.vertex);
  compare_fans(trial,
               fmt::format("fan at point {} of tetrahedron {} for normal {:.17g}", point,
                           tetrahedron, fmt::join(fan.normal, " ")),
               std::move(expected), std::move(answered));
}

void judge_break(Trial& trial, const BreakPoint& broken, std::span<const Step> steps) {
  if (trial.checks.first || !trial.kernel.crack_fan) return;
  ++trial.times.fans;
  compare_sides(trial, fmt::format("fan of labels at all copies of point {}", broken.point), steps,
                trial.kernel.crack_fan(broken.point, broken.sides));
}

void judge_plane(Trial& trial, const CuttingPlane& plane, std::span<const Step> steps) {
  if (trial.checks.first || !trial.kernel.plane) return;
  ++trial.times.sections;
  compare_sides(trial,
                fmt::format("section of the plane of normal {:.17g}, offset {:.17g}",
                            fmt::join(plane.normal, " "), plane.offset),
                steps, trial.kernel.plane(plane));
}

void judge_faults(Trial& trial) {
  if (trial.checks.first || !trial.kernel.own_faults) return;
  ++trial.times.faults;
  const std::vector<std::string> faults = trial.kernel.own_faults();
  if (!same(trial.checks, true, faults.empty())) {
    differ(trial.checks, "the kernel's own faults", "none", faults.front());
  }
}

void judge_homology(Trial& trial) {
  if (trial.checks.first) return;
  ++trial.times.homologies;
  const CellCounts counts = trial.kernel.counts();
  const OrbitComplex complex = orbit_complex(trial.twin);
  compare(trial.checks, "vertices of the complex", complex.cells[0], counts.vertices);
  compare(trial.checks, "edges of the complex", complex.cells[1], counts.edges);
  compare(trial.checks, "faces of the complex", complex.cells[2], counts.faces);
  const BettiNumbers betti = betti_numbers(complex, 2);
  compare(trial.checks, "b0 as components", betti[0], counts.components);
  if (trial.sheets_tell_betti) {
    compare(trial.checks, "over GF(2), by sheets", betti, betti_from_sheets(counts, trial.closed));
  }
  const IntegerHomology homology = integer_homology(complex);
  compare(trial.checks, "over GF(2), by universal coefficients", betti, mod_2(homology));
  if (trial.kernel.homology) {
    if (const auto answered = trial.kernel.homology()) compare(trial.checks, homology, *answered);
  }
  if (trial.kernel.orientable) {
    const auto answered = trial.kernel.orientable();
    if (answered && !same(trial.checks, is_orientable(trial.twin), *answered)) {
      differ(trial.checks, "orientable", *answered ? "no" : "yes", *answered ? "yes" : "no");
    }
  }
}

void judge_where_due(Trial& trial) {
  const std::size_t cost = trial.body.tetrahedra.size();
  if (due(trial.whole_pace, cost)) judge_whole(trial);
  if (due(trial.fault_pace, cost)) judge_faults(trial);
}

}  // namespace sunder::suite
