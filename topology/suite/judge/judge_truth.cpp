// SPDX-License-Identifier: MIT
// A fixture run on the twin, and its expectations compared with the results.
#include "topology/suite/judge/judge_truth.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "topology/suite/fixtures/steps.hpp"
#include "topology/suite/judge/crack_formula.hpp"
#include "topology/suite/judge/judge_expected.hpp"

namespace sunder::suite {
namespace {

/// Bodies up to this many tetrahedra are looked at after every step, ...
constexpr std::size_t every_step_up_to = 64;
/// ... up to this many after every operation, and larger ones `most_moments` times.
constexpr std::size_t every_operation_up_to = 1000;
constexpr std::size_t most_moments = 64;

Moment moment_of(const GlueTwin& twin) {
  const TwinCounts c = union_find_counts(twin);
  return {.counts = {c.vertices, c.edges, c.faces, c.tetrahedra, c.components, c.boundary_faces,
                     c.boundary_sheets},
          .vertex_of_corner = first_places(corner_classes(twin)),
          .component_of_tetrahedron = first_places(component_classes(twin))};
}

SplitAnswer answer_of(const LocalTruth& truth) {
  SplitAnswer answer{.did = true, .vertices = {}, .edges = {}, .separated = truth.separated};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t p = truth.points[i], q = truth.points[(i + 1) % 3];
    if (truth.vertex_split[i]) answer.vertices.push_back(p);
    if (truth.edge_split[i]) answer.edges.push_back({std::min(p, q), std::max(p, q)});
  }
  std::sort(answer.vertices.begin(), answer.vertices.end());
  std::sort(answer.edges.begin(), answer.edges.end());
  return answer;
}

TrueStep take(GlueTwin& twin, const Step& step) {
  TrueStep done{.step = step};
  const HalfFaceId a = half_face_of(twin, step.a);
  if (step.kind == Step::Kind::glue) {
    const HalfFaceId b = half_face_of(twin, step.b);
    done.glued = twin.glued[a.index()].is_none() && twin.glued[b.index()].is_none();
    if (done.glued) glue_again(twin, a, b);
    return done;
  }
  const HalfFaceId across = twin.glued[a.index()];
  if (across.is_none()) return done;
  done.across = side_of(twin, across);
  done.split = answer_of(unglue(twin, a));
  return done;
}

/// The laws of one split that need no counting (docs/reference/suite.md).
void check_laws(Checks& checks, const GlueTwin& twin, const TrueStep& step) {
  const std::size_t s_v = step.split.vertices.size(), s_e = step.split.edges.size();
  const bool lawful = s_e >= least_split_edges(s_v) && (s_v == 3 || !step.split.separated);
  if (same(checks, true, lawful)) return;
  differ(checks,
         fmt::format("law of a split at face {}", fmt::join(points_of(twin, step.step.a), " ")),
         "s_v = 1 only with s_e >= 2, s_v >= 2 only with s_e = 3, separation only with s_v = 3",
         fmt::format("s_v = {}, s_e = {}{}", s_v, s_e, step.split.separated ? ", separated" : ""));
}

/// dV = s_v, dE = s_e, dF = 1, dC = 1 for a separation, summed over splits since `before`.
CellCounts added(CellCounts before, const std::vector<TrueStep>& splits) {
  for (const TrueStep& s : splits) {
    before.vertices += s.split.vertices.size();
    before.edges += s.split.edges.size();
    before.faces += s.split.did ? 1 : 0;
    before.boundary_faces += s.split.did ? 2 : 0;
    before.components += s.split.separated ? 1 : 0;
  }
  return before;
}

/// Points that are used, edges and faces as distinct tuples of the file's numbers.
std::array<std::size_t, 3> file_cells_of(const TetMesh& mesh) {
  std::set<std::uint32_t> points;
  std::set<std::array<std::uint32_t, 2>> edges;
  std::set<std::array<std::uint32_t, 3>> faces;
  for (std::array<std::uint32_t, 4> t : mesh.tetrahedra) {
    std::sort(t.begin(), t.end());
    points.insert(t.begin(), t.end());
    for (std::size_t i = 0; i < 4; ++i) {
      faces.insert({t[i == 0 ? 1 : 0], t[i <= 1 ? 2 : 1], t[i == 3 ? 2 : 3]});
      for (std::size_t j = i + 1; j < 4; ++j) edges.insert({t[i], t[j]});
    }
  }
  return {points.size(), edges.size(), faces.size()};
}

/// A fan by a point needs that point to be one vertex.
void check_point(Checks& checks, const Operation& operation, const GlueTwin& now) {
  const auto* fan = std::get_if<SplitFan>(&operation);
  if (fan == nullptr || !std::holds_alternative<std::uint32_t>(fan->vertex)) return;
  const CornerAt corner = corner_of(now, fan->vertex);
  if (same(checks, now.around[corner.point].size(), orbit_of(now, corner).size())) return;
  differ(checks, fmt::format("fan at point {}", corner.point), "one vertex there",
         "several: name it by a tetrahedron, too");
}

bool expects_counts(const Expected& e) { return e.counts || e.euler_characteristic; }

/// All operations, where all are breaks; else none.
std::vector<BreakPoint> only_breaks(const Fixture& fixture) {
  std::vector<BreakPoint> breaks;
  for (const ExpectedOperation& operation : fixture.operations) {
    const auto* broken = std::get_if<BreakPoint>(&operation.operation);
    if (broken == nullptr) return {};
    breaks.push_back(*broken);
  }
  return breaks;
}

/// Compares a body after breaks, made one after the other, with the result of the breaks without an
/// order: glued faces, and everything connected by them.
void check_formula(Checks& checks, const GlueTwin& intact, std::span<const BreakPoint> breaks,
                   const GlueTwin& now) {
  const GlueTwin expected = without_faces(intact, crack_faces(intact, breaks));
  if (!same(checks, expected.glued, now.glued)) {
    differ(checks, "faces split by breaks", "the union over the breaks", "others");
  } else if (!same(checks, moment_of(expected), moment_of(now))) {
    differ(checks, "vertices after breaks", "the orbits of what is still glued", "others");
  }
}

/// A run of a fixture on the twin.
struct Course {
  const Fixture& fixture;
  GlueTwin now;
  Truth truth;
  /// Since the last moment: its counts, and the steps after it.
  CellCounts before = {};
  std::vector<TrueStep> since = {};

  void look(std::optional<Moment>& moment) {
    moment = moment_of(now);
    const bool only_splits = std::all_of(since.begin(), since.end(), [](const TrueStep& s) {
      return s.step.kind == Step::Kind::split;
    });
    if (only_splits) {
      CellCounts lawful = added(before, since);
      lawful.boundary_sheets = moment->counts.boundary_sheets;
      compare(truth.checks, lawful, moment->counts);
    }
    before = moment->counts;
    since.clear();
  }

  bool is_looked_at(std::size_t operation) const {
    const std::size_t all = fixture.operations.size();
    if (operation + 1 == all || now.tetrahedra.size() <= every_operation_up_to) return true;
    if (expects_counts(fixture.operations[operation].after)) return true;
    return operation % (all / most_moments + 1) == 0;
  }

  void run(std::size_t row) {
    const ExpectedOperation& asked = fixture.operations[row];
    const std::size_t size = now.tetrahedra.size();
    TrueOperation& operation = truth.operations.emplace_back();
    truth.checks.operation = row + 1;
    check_point(truth.checks, asked.operation, now);
    for (const Step& step : steps_of(asked.operation, truth.intact, now, fixture.body)) {
      ++truth.checks.step;
      TrueStep& done = operation.steps.emplace_back(take(now, step));
      check_laws(truth.checks, now, done);
      since.push_back(done);
      const bool changed = done.split.did || done.glued;
      if (size <= every_step_up_to || (!changed && size <= every_operation_up_to)) look(done.after);
    }
    if (is_looked_at(row)) look(operation.after);
    if (operation.after) check_counts(truth.checks, asked.after, operation.after->counts);
    check_splits(truth.checks, asked.after, operation.steps, now);
    operation.homology = check_homology(truth.checks, asked.after, now);
  }

  /// Breaks in the order of the fixture and in the reverse one, by the formula.
  void run_backwards(std::span<const BreakPoint> breaks) {
    check_formula(truth.checks, truth.intact, breaks, now);
    GlueTwin again = truth.intact;
    for (std::size_t row = breaks.size(); row > 0; --row) {
      TrueOperation& operation = truth.backwards.emplace_back();
      for (const Step& step : steps_of(breaks[row - 1], truth.intact, again, fixture.body)) {
        operation.steps.push_back(take(again, step));
        check_laws(truth.checks, again, operation.steps.back());
      }
    }
    check_formula(truth.checks, truth.intact, breaks, again);
    truth.backwards.back().after = moment_of(again);
  }
};

}  // namespace

bool is_body(const TetMesh& mesh) {
  std::map<std::array<std::uint32_t, 3>, int> sides;
  for (std::array<std::uint32_t, 4> t : mesh.tetrahedra) {
    std::sort(t.begin(), t.end());
    if (t[3] >= mesh.points.size() || std::adjacent_find(t.begin(), t.end()) != t.end()) {
      return false;
    }
    for (const auto& [i, j, k] : {std::tuple{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}) {
      if (++sides[{t[i], t[j], t[k]}] > 2) return false;
    }
  }
  return !mesh.tetrahedra.empty();
}

Truth truth_of(const Fixture& fixture) {
  Truth truth;
  if (fixture.refused) return truth;
  truth.is_body = is_body(fixture.body);
  if (!same(truth.checks, true, truth.is_body)) {
    differ(truth.checks, "body", "tetrahedra that can be glued",
           "a defective body, not \"refused\"");
    return truth;
  }
  if (fixture.file_cells) {
    const auto cells = file_cells_of(fixture.body);
    compare(truth.checks, "vertices of the file", (*fixture.file_cells)[0], cells[0]);
    compare(truth.checks, "edges of the file", (*fixture.file_cells)[1], cells[1]);
    compare(truth.checks, "faces of the file", (*fixture.file_cells)[2], cells[2]);
  }
  truth.intact = glue_twin(fixture.body.tetrahedra, fixture.body.points.size());
  truth.built = moment_of(truth.intact);
  Course course{fixture, truth.intact, std::move(truth)};
  course.before = course.truth.built.counts;
  check_counts(course.truth.checks, fixture.built, course.truth.built.counts);
  course.truth.homology = check_homology(course.truth.checks, fixture.built, course.now);
  for (std::size_t row = 0; row < fixture.operations.size(); ++row) course.run(row);
  const std::vector<BreakPoint> breaks = only_breaks(fixture);
  if (!breaks.empty()) course.run_backwards(breaks);
  return std::move(course.truth);
}

}  // namespace sunder::suite
