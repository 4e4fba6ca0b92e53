// SPDX-License-Identifier: MIT
// Random splits, and after each one: what the twin says, what the laws say, what a full walk says.
#include "tests/topology/random_splits.hpp"

#include <algorithm>
#include <map>

#include "topology/suite/glue_twin.hpp"
#include "topology/suite/shapes.hpp"
#include "topology/build_map.hpp"
#include "topology/components.hpp"
#include "topology/invariants.hpp"
#include "topology/split_face.hpp"

using namespace sunder::suite;

namespace sunder::test {
namespace {

TwinCounts as_twin(const Counts& c) {
  return {c.vertices,   c.edges,          c.faces,          c.tetrahedra,
          c.components, c.boundary_faces, c.boundary_sheets};
}

/// One body while it is taken apart.
struct Body {
  VolumeMap map;
  GlueTwin twin;
  Components labels;
  ComponentScratch scratch;
  /// Running counts: cells from the twin's local truths, sheets from a walk over the map.
  Counts counts;
  std::vector<HalfFaceId> faces;  // still whole

  Body(VolumeMap m, std::size_t points) : map(std::move(m)), counts(count_cells(map)) {
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;
    for (const auto& corners : map.corners()) {
      auto& t = tetrahedra.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) t[i] = map.point_of_vertex(corners[i]);
    }
    twin = glue_twin(tetrahedra, points);
    labels = label_components(map);
    for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
      const HalfFaceId f{i}, across = map.neighbour(f);
      if (!across.is_none() && f < across) faces.push_back(f);
    }
  }
};

/// Notes what does not agree, with the place in the run where it happened.
class Judge {
 public:
  explicit Judge(BodyReport& report) : report_(report) {}
  void expect(bool holds, const std::string& what) {
    if (holds || report_.mismatches.size() >= 20) return;
    report_.mismatches.push_back("split " + std::to_string(report_.splits) + ": " + what);
  }
  void expect_none(const std::vector<Finding>& findings) {
    for (const Finding& f : findings) expect(false, f.code + ": " + f.text);
  }

 private:
  BodyReport& report_;
};

/// What the split says of its vertices and edges against the twin's truth, point by point.
void judge_cells(const Body& body, const FaceSplit& split, const LocalTruth& truth, Judge& judge) {
  const auto point = [&body](VertexId v) { return body.map.point_of_vertex(v); };
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t a = point(split.vertices[i]), b = point(split.vertices[(i + 1) % 3]);
    const auto place = [&truth](std::uint32_t p) {
      return std::find(truth.points.begin(), truth.points.end(), p) - truth.points.begin();
    };
    judge.expect(place(a) < 3 && place(b) < 3, "the split's face is not the twin's");
    if (place(a) == 3 || place(b) == 3) return;
    bool vertex_split = false;
    for (int k = 0; k < split.vertex_count; ++k) {
      vertex_split |= split.split_vertices[k].old_row == split.vertices[i];
    }
    judge.expect(vertex_split == truth.vertex_split[static_cast<std::size_t>(place(a))],
                 "vertex at point " + std::to_string(a) + " against union-find");
    // Edge i of the twin joins points i and i + 1: it is the one that leaves out point i + 2.
    const auto left_out = 3 - place(a) - place(b);
    const bool edge_split = (split.split_edges >> i & 1) != 0;
    judge.expect(
        edge_split == truth.edge_split[static_cast<std::size_t>((left_out + 1) % 3)],
        "edge at points " + std::to_string(a) + ", " + std::to_string(b) + " against union-find");
  }
  judge.expect(!truth.separated || oracle_says_new(split), "the oracle missed a separation");
}

/// The side that was passed keeps its rows; the other has new rows exactly where a vertex split.
void judge_rows(const Body& body, const FaceSplit& split, std::size_t rows_before, Judge& judge) {
  const auto& kept = body.map.corners(tetrahedron_of(split.face));
  const auto& other = body.map.corners(tetrahedron_of(split.opposite));
  for (const VertexId v : split.vertices) {
    judge.expect(place_of_vertex(kept, v) < 4, "the passed side lost a row");
  }
  for (int i = 0; i < split.vertex_count; ++i) {
    const auto [old_row, new_row] = split.split_vertices[i];
    judge.expect(new_row.index() == rows_before + static_cast<std::size_t>(i),
                 "rows are appended in order");
    judge.expect(place_of_vertex(other, new_row) < 4 && place_of_vertex(other, old_row) == 4,
                 "the other side has the new row");
    judge.expect(body.map.point(old_row) == body.map.point(new_row), "a copy keeps its position");
  }
  judge.expect(body.map.vertices() == rows_before + static_cast<std::size_t>(split.vertex_count),
               "as many rows as vertices");
}

/// Running counts after a split, by the twin's word; sheets by a walk over the map.
Counts next_counts(const Body& body, const LocalTruth& truth) {
  Counts next = body.counts;
  for (const bool split : truth.vertex_split) next.vertices += split ? 1 : 0;
  for (const bool split : truth.edge_split) next.edges += split ? 1 : 0;
  next.faces += 1;
  next.boundary_faces += 2;
  next.components += truth.separated ? 1 : 0;
  next.boundary_sheets = count_boundary_sheets(body.map);
  const auto number = [](std::size_t n) { return static_cast<std::ptrdiff_t>(n); };
  next.euler_characteristic =
      number(next.vertices) - number(next.edges) + number(next.faces) - number(next.tetrahedra);
  const std::ptrdiff_t b2 = number(next.boundary_sheets) - number(next.components);
  next.betti = {number(next.components), number(next.components) + b2 - next.euler_characteristic,
                b2};
  return next;
}

/// Labels against a full walk: the same partition, sizes right, and ids that never were reused.
void judge_labels(const Body& body, Judge& judge) {
  const Components walked = label_components(body.map);
  const Components& labels = body.labels;
  std::vector<ComponentId> of(walked.size.size());
  std::size_t members = 0;
  for (std::size_t t = 0; t < labels.of_tetrahedron.size(); ++t) {
    ComponentId& id = of[walked.of_tetrahedron[t].index()];
    if (id.is_none()) {
      id = labels.of_tetrahedron[t];
      judge.expect(labels.size[id.index()] == walked.size[walked.of_tetrahedron[t].index()],
                   "size of a component against a full walk");
      members += labels.size[id.index()];
    }
    judge.expect(id == labels.of_tetrahedron[t], "component of a tetrahedron against a full walk");
  }
  for (std::size_t v = 0; v < body.map.vertices(); ++v) {
    judge.expect(labels.of_vertex[v] == of[walked.of_vertex[v].index()],
                 "component of a vertex against a full walk");
  }
  judge.expect(members == body.map.tetrahedra(), "two components share an id");
}

void judge_fully(Body& body, BodyReport& report, Judge& judge) {
  ++report.full_counts;
  const Counts counted = count_cells(body.map);
  judge.expect(as_twin(counted) == as_twin(body.counts), "orbits against the running counts");
  judge.expect(as_twin(counted) == union_find_counts(body.twin), "orbits against union-find");
  judge.expect(counted.betti == body.counts.betti, "Betti numbers against the running ones");
  judge.expect_none(check(body.map));
}

void split_one(Body& body, HalfFaceId face, BodyReport& report, Judge& judge) {
  ++report.splits;
  const std::size_t rows_before = body.map.vertices();
  const FaceSplit split = split_face(body.map, face);
  const LocalTruth truth = unglue(body.twin, face);
  judge.expect(split.did, "an interior face was refused");
  judge_cells(body, split, truth, judge);
  judge_rows(body, split, rows_before, judge);
  const Counts after = next_counts(body, truth);
  judge.expect_none(check_split_laws(body.counts, after, split));
  body.counts = after;
  const std::size_t ids = body.labels.size.size();
  const ComponentUpdate update = update_components(body.map, std::span(&split, 1), Detection::exact,
                                                   body.labels, body.scratch);
  judge.expect(update.created == (truth.separated ? 1U : 0U), "separation against the twin's walk");
  judge.expect(body.labels.size.size() == ids + update.created, "ids grow by what was created");
  judge_labels(body, judge);
  report.vertices_split += static_cast<std::size_t>(split.vertex_count);
  report.edges_split += static_cast<std::size_t>(edge_count(split));
  report.alarms += update.predicted;
  report.separations += truth.separated ? 1 : 0;
  report.missed += truth.separated && !oracle_says_new(split) ? 1 : 0;
}

std::vector<NamedMesh> bodies(std::size_t largest) {
  std::vector<NamedMesh> all = {{"cube 10 x 10 x 10", kuhn_box({10, 10, 10})},
                                {"jittered cube 6 x 6 x 6", jittered(kuhn_box({6, 6, 6}), 0.1, 7)},
                                {"ring 8 x 8 x 2", ring({8, 8, 2})},
                                {"shell 5 x 5 x 5", shell({5, 5, 5})},
                                {"crossing channels", crossing_channels()},
                                {"fan of 60", closed_fan(60)},
                                {"joined ring of 40", joined_ring(40, false)},
                                {"bar of 60 pinched", bent_bar(60, {{0, 0}, {0, 1}})}};
  std::erase_if(all, [largest](const NamedMesh& b) { return b.mesh.tetrahedra.size() > largest; });
  return all;
}

BodyReport split_body(const NamedMesh& named, std::size_t splits, std::mt19937_64& random,
                      std::size_t full_every) {
  BodyReport report;
  report.name = named.name;
  report.tetrahedra = named.mesh.tetrahedra.size();
  Judge judge(report);
  while (report.splits < splits) {
    Result<VolumeMap> map = build_map(named.mesh);
    judge.expect(map.value.has_value(), "the body cannot be built");
    if (!map) return report;
    Body body(std::move(*map), named.mesh.points.size());
    while (!body.faces.empty() && report.splits < splits) {
      const std::size_t chosen = below(random, body.faces.size());
      HalfFaceId face = body.faces[chosen];
      body.faces[chosen] = body.faces.back();
      body.faces.pop_back();
      if (below(random, 2) == 1) face = body.map.neighbour(face);
      split_one(body, face, report, judge);
      if (report.splits % full_every == 0) judge_fully(body, report, judge);
    }
    judge_fully(body, report, judge);
  }
  return report;
}

}  // namespace

std::vector<BodyReport> run_random_splits(const RandomSplitOptions& options) {
  std::mt19937_64 random(options.seed);
  std::vector<BodyReport> reports;
  const std::vector<NamedMesh> all = bodies(options.largest);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t share =
        options.splits * (i + 1) / all.size() - options.splits * i / all.size();
    reports.push_back(split_body(all[i], share, random, options.full_every));
  }
  return reports;
}

}  // namespace sunder::test
