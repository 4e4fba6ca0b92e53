// SPDX-License-Identifier: MIT
// Random operations.
#include "topology/suite/random/random_run_tear.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/fixtures/steps.hpp"
#include "topology/suite/judge/crack_formula.hpp"
#include "topology/suite/random/random_run_labels.hpp"

namespace sunder::suite {
namespace {

using Faces = std::vector<HalfFaceId>;

template <class T>
void shuffle(std::vector<T>& list, std::mt19937_64& random) {
  for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(random, i)]);
}

/// Splits a face and keeps the lists of faces.
SplitAnswer part(Tear& tear, HalfFaceId face) {
  const HalfFaceId across = tear.trial.twin.glued[face.index()];
  const SplitAnswer truth = split(tear.trial, face);
  if (!truth.did) return truth;
  tear.whole.erase(std::min(face, across));
  tear.parted.push_back({face, across});
  return truth;
}

/// Glues the two sides that were parted as number `i`.
void rejoin(Tear& tear, std::size_t i) {
  const auto [a, b] = tear.parted[i];
  tear.parted[i] = tear.parted.back();
  tear.parted.pop_back();
  glue(tear.trial, a, b);
  tear.whole.insert(std::min(a, b));
}

/// Directions along axes and diagonals put centres of grids exactly on the plane.
Point any_normal(std::mt19937_64& random) {
  Point normal = {0, 0, 0};
  const std::size_t kind = below(random, 4);
  const double length =
      std::ldexp(below(random, 2) == 0 ? 1.0 : -1.0, static_cast<int>(below(random, 41)) - 20);
  if (kind == 0) {
    normal[below(random, 3)] = length;
    return normal;
  }
  while (normal == Point{0, 0, 0}) {
    for (double& x : normal) {
      x = length * (kind == 1 ? static_cast<double>(below(random, 3)) - 1 : 2 * unit(random) - 1);
    }
  }
  return normal;
}

/// Perpendicular to a face: its plane parts its two tetrahedra, wherever else it goes.
Point normal_of(const TetMesh& body, HalfFaceId face) {
  std::array<Point, 2> edge;
  const auto& t = body.tetrahedra[face.index() / 4];
  const Point& from = body.points[t[(face.index() + 1) % 4]];
  for (std::size_t e = 0; e < 2; ++e) {
    const Point& to = body.points[t[(face.index() + 2 + e) % 4]];
    for (std::size_t i = 0; i < 3; ++i) edge[e][i] = to[i] - from[i];
  }
  const auto& [a, b] = edge;
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// At any vertex for any normal; more often at a vertex of a face that still is whole, and as often
/// as not along that face, or most fans would be empty late.
SplitFan any_fan(const Tear& tear, std::mt19937_64& random) {
  const TetMesh& body = tear.trial.body;
  SplitFan fan{.vertex = CornerAt{}, .normal = any_normal(random)};
  std::size_t t = below(random, body.tetrahedra.size()), place = below(random, 4);
  if (below(random, 4) != 0) {
    const HalfFaceId face = tear.whole[below(random, tear.whole.size())];
    t = face.index() / 4;
    place = (face.index() + 1 + below(random, 3)) % 4;
    const Point along = normal_of(body, face);
    if (below(random, 2) == 0 && along != Point{0, 0, 0}) fan.normal = along;
  }
  fan.vertex = CornerAt{static_cast<std::uint32_t>(t), body.tetrahedra[t][place]};
  return fan;
}

/// Splits faces from either side in any order, or as they stand; and counts the results.
void part_all(TearRun& run, Tear& tear, Faces& faces) {
  if (below(run.random, 2) == 0) {
    shuffle(faces, run.random);
    for (HalfFaceId& f : faces) {
      if (below(run.random, 2) == 0) f = tear.trial.twin.glued[f.index()];
    }
  }
  for (const HalfFaceId f : faces) {
    const SplitAnswer truth = part(tear, f);
    if (tear.trial.checks.first) return;
    TearCounts& counts = run.counts;
    ++counts.faces;
    counts.vertices += truth.vertices.size();
    counts.edges += truth.edges.size();
    counts.alarms += oracle_says_new(truth) ? 1 : 0;
    counts.separations += truth.separated ? 1 : 0;
    counts.missed += truth.separated && !oracle_says_new(truth) ? 1 : 0;
  }
}

/// Undoes the splits of `faces`, the latest, in any order, and does them again as they stand. Each
/// time the map has to be as before.
void redo(TearRun& run, Tear& tear, const Faces& faces) {
  for (std::size_t left = faces.size(); left > 0; --left) {
    if (tear.trial.checks.first) return;
    rejoin(tear, tear.parted.size() - 1 - below(run.random, left));
  }
  judge_whole(tear.trial);
  for (const HalfFaceId f : faces) part(tear, f);
  judge_whole(tear.trial);
}

/// The map after an operation, of which the last `count` splits were, does not depend on the order
/// of its faces, nor on their sides.
void judge_orders(TearRun& run, Tear& tear, std::size_t count) {
  const std::size_t cost = tear.trial.body.tetrahedra.size() + 16 * count;
  if (tear.trial.checks.first || count == 0 || !tear.trial.kernel.glue) return;
  if (!due(tear.order_pace, cost)) return;
  ++run.counts.orders;
  Faces faces;
  for (std::size_t i = tear.parted.size() - count; i < tear.parted.size(); ++i) {
    faces.push_back(tear.parted[i][below(run.random, 2)]);
  }
  if (count == 1 || count > 4 || below(run.random, 4) != 0) {
    shuffle(faces, run.random);
    redo(run, tear, faces);
    return;
  }
  ++run.counts.all_orders;
  std::sort(faces.begin(), faces.end());
  do {
    redo(run, tear, faces);
  } while (!tear.trial.checks.first && std::next_permutation(faces.begin(), faces.end()));
}

Faces faces_of(const Tear& tear, const std::vector<Step>& steps) {
  Faces faces;
  for (const Step& step : steps) faces.push_back(half_face_of(tear.trial.twin, step.a));
  return faces;
}

void tear_fan(TearRun& run, Tear& tear) {
  const SplitFan fan = any_fan(tear, run.random);
  const GlueTwin& twin = tear.trial.twin;
  const std::vector<Step> steps = steps_of(fan, twin, twin, tear.trial.body);
  judge_fan(tear.trial, fan, steps);
  ++(steps.empty() ? run.counts.empty_fans : run.counts.fans);
  Faces faces = faces_of(tear, steps);
  part_all(run, tear, faces);
  judge_orders(run, tear, faces.size());
}

void tear_plane(TearRun& run, Tear& tear) {
  const TetMesh& body = tear.trial.body;
  const Point& x = body.points[body.tetrahedra[below(run.random, body.tetrahedra.size())][0]];
  const Point n = any_normal(run.random);
  const SplitPlane section{{.normal = n, .offset = n[0] * x[0] + n[1] * x[1] + n[2] * x[2]}};
  const GlueTwin& twin = tear.trial.twin;
  ++run.counts.planes;
  const std::vector<Step> steps = steps_of(section, twin, twin, body);
  judge_plane(tear.trial, section.plane, steps);
  Faces faces = faces_of(tear, steps);
  part_all(run, tear, faces);
}

void tear_face(TearRun& run, Tear& tear) {
  ++run.counts.single_faces;
  Faces faces = {tear.whole[below(run.random, tear.whole.size())]};
  part_all(run, tear, faces);
  judge_orders(run, tear, faces.size());
}

/// Glues up to four faces. Mostly splits them again, which has to restore the map, and lets the
/// body come to its end.
void rejoin_some(TearRun& run, Tear& tear) {
  if (tear.parted.empty() || !tear.trial.kernel.glue) return;
  const bool for_good = below(run.random, 4) == 0;
  Faces faces;
  for (std::size_t n = 1 + below(run.random, std::min<std::size_t>(4, tear.parted.size())); n > 0;
       --n) {
    if (tear.trial.checks.first) return;
    const std::size_t i = below(run.random, tear.parted.size());
    faces.push_back(tear.parted[i][below(run.random, 2)]);
    rejoin(tear, i);
    ++run.counts.glues;
  }
  if (for_good) return;
  judge_where_due(tear.trial);
  shuffle(faces, run.random);
  for (const HalfFaceId f : faces) part(tear, f);
}

/// Impossible operations that have to change nothing: splitting a boundary face, gluing a whole
/// one.
void ask_in_vain(TearRun& run, Tear& tear) {
  ++run.counts.vain;
  const std::vector<HalfFaceId>& glued = tear.trial.twin.glued;
  const HalfFaceId any{below(run.random, glued.size())};
  if (glued[any.index()].is_none()) {
    split(tear.trial, any);
  } else if (tear.trial.kernel.glue) {
    glue(tear.trial, any, glued[any.index()]);
  }
}

/// Does something on a second kernel from the beginning, after the first `parted` faces were split
/// in any order and from any sides: the connections are the same then.
template <class Act>
void on_second(TearRun& run, Tear& tear, std::size_t parted, const Act& act) {
  Trial second = begin_trial(tear.trial.body, run.second);
  Faces faces;
  for (std::size_t i = 0; i < parted; ++i) {
    faces.push_back(tear.parted[i][below(run.random, 2)]);
  }
  shuffle(faces, run.random);
  try {
    for (const HalfFaceId f : faces) split(second, f);
    act(second);
    judge_whole(second);
    judge_faults(second);
  } catch (const KernelLost& lost) {
    differ(second.checks, "the kernel", "an answer", lost.what());
  }
  if (!same(second.checks, tear.trial.twin.glued, second.twin.glued)) {
    differ(second.checks, "what is glued", "the same in every order", "something else");
  }
  if (!second.checks.first) return;
  tear.trial.checks.first = second.checks.first;
  tear.trial.steps = second.steps;
}

/// All that is split so far, split in another order.
void replay(TearRun& run, Tear& tear) {
  ++run.counts.replays;
  on_second(run, tear, tear.parted.size(), [](Trial&) {});
}

/// The faces of a break as the suite has them, compared with the kernel's own.
Faces judged_break(Trial& trial, const BreakPoint& broken) {
  const std::vector<Step> steps = steps_of(broken, trial.twin, trial.twin, trial.body);
  judge_break(trial, broken, steps);
  Faces faces;
  for (const Step& step : steps) faces.push_back(half_face_of(trial.twin, step.a));
  return faces;
}

/// Breaks by labels, on the body as it is: they split the union of their faces, in whatever order
/// they and the faces of each are taken.
void tear_cracks(TearRun& run, Tear& tear) {
  std::vector<BreakPoint> breaks = any_breaks(tear.trial.body, tear.trial.twin, run.random);
  const std::set<HalfFaceId> expected = crack_faces(tear.trial.twin, breaks);
  const std::size_t before = tear.parted.size();
  TearCounts& counts = run.counts;
  ++counts.crack_groups;
  std::size_t fans = 0;
  for (const BreakPoint& broken : breaks) {
    Faces faces = judged_break(tear.trial, broken);
    ++(faces.empty() ? counts.empty_labelled_fans : counts.labelled_fans);
    fans += faces.empty() ? 0 : 1;
    part_all(run, tear, faces);
    if (tear.trial.checks.first) return;
  }
  std::set<HalfFaceId> done;
  for (std::size_t i = before; i < tear.parted.size(); ++i) {
    done.insert(std::min(tear.parted[i][0], tear.parted[i][1]));
  }
  if (!same(tear.trial.checks, expected, done)) {
    differ(tear.trial.checks, "faces of cracks", "the union over the breaks", "others");
  }
  judge_orders(run, tear, tear.parted.size() - before);
  const std::size_t cost = tear.trial.body.tetrahedra.size() + 16 * tear.parted.size();
  if (tear.trial.checks.first || fans == 0 || !due(tear.crack_pace, cost)) return;
  ++counts.crack_orders;
  counts.fans_in_other_orders += fans;
  shuffle(breaks, run.random);
  on_second(run, tear, before, [&](Trial& second) {
    for (const BreakPoint& broken : breaks) {
      Faces faces = judged_break(second, broken);
      shuffle(faces, run.random);
      for (const HalfFaceId f : faces) split(second, f);
    }
  });
}

}  // namespace

void FaceSet::insert(HalfFaceId face) {
  at_[face.index()] = static_cast<std::uint32_t>(faces_.size());
  faces_.push_back(face);
}

void FaceSet::erase(HalfFaceId face) {
  const std::uint32_t at = at_[face.index()];
  faces_[at] = faces_.back();
  at_[faces_[at].index()] = at;
  faces_.pop_back();
  at_[face.index()] = absent;
}

Tear begin_tear(Trial trial) {
  const std::size_t half_faces = trial.twin.glued.size();
  Tear tear{.trial = std::move(trial), .whole = FaceSet(half_faces), .parted = {}};
  for (std::size_t f = 0; f < half_faces; ++f) {
    const HalfFaceId across = tear.trial.twin.glued[f];
    if (!across.is_none() && HalfFaceId{f} < across) tear.whole.insert(HalfFaceId{f});
  }
  return tear;
}

void tear_once(TearRun& run, Tear& tear) {
  const std::size_t drawn = below(run.random, 100);
  if (drawn < 2) {
    tear_plane(run, tear);
  } else if (drawn < 12) {
    tear_face(run, tear);
  } else if (drawn < 20) {
    rejoin_some(run, tear);
  } else if (drawn < 22) {
    ask_in_vain(run, tear);
  } else if (drawn < 32) {
    tear_cracks(run, tear);
  } else {
    tear_fan(run, tear);
  }
  ++run.counts.operations;
  Trial& trial = tear.trial;
  judge_where_due(trial);
  if (run.counts.operations % 100 == 0 && trial.body.tetrahedra.size() <= 100) {
    judge_homology(trial);
  }
  const std::size_t cost = trial.body.tetrahedra.size() + 16 * tear.parted.size();
  if (!trial.checks.first && due(tear.replay_pace, cost)) replay(run, tear);
}

}  // namespace sunder::suite
