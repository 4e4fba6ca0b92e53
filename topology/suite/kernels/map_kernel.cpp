// SPDX-License-Identifier: MIT
// `VolumeMap` under judgement: its answers in the file's numbers, and its faults by its own checks.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "topology/kernel/components.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/kernels/map_answers.hpp"

namespace sunder::suite {
namespace {

constexpr std::array<Detection, 4> all_detections = {Detection::walk, Detection::dirty_counter,
                                                     Detection::oracle, Detection::exact};
constexpr std::array<const char*, 4> detection_names = {"walks", "the dirty counter",
                                                        "the bare oracle", "lockstep"};

struct Body {
  std::optional<VolumeMap> map;
  std::vector<std::array<std::uint32_t, 4>> file;
  /// Updated after every split, which reports whether it separated.
  Components labels;
  /// Updated by each way of detection with all splits since the last look at the faults.
  std::array<Components, all_detections.size()> batched;
  std::vector<FaceSplit> batch;
  /// Gluing makes labels void; they are computed again at the next question.
  bool labels_are_void = true;
  ComponentScratch scratch;
  /// No tetrahedron is flat or folded against its neighbours: Betti numbers follow from the
  /// boundary.
  bool in_space = false;
  /// Cells as they are now, where they were counted after the last change.
  std::optional<Counts> counts;
  std::size_t splits = 0;
  std::vector<std::string> faults;
};

FaceSide side_of(const Body& body, HalfFaceId f) {
  const VertexId v = body.map->corners(tetrahedron_of(f))[place_of(f)];
  return {tetrahedron_of(f).value, body.map->point_of_vertex(v)};
}

void label_anew(Body& body) {
  if (!body.labels_are_void) return;
  body.labels = label_components(*body.map);
  body.batched.fill(body.labels);
  body.batch.clear();
  body.labels_are_void = false;
}

std::vector<Finding> load(Body& body, const TetMesh& mesh, MapKernel kernel) {
  Result<VolumeMap> built = build_map(mesh, Severity::warning, kernel);
  body = {};
  body.file = mesh.tetrahedra;
  body.map = std::move(built.value);
  body.in_space = std::none_of(built.findings.begin(), built.findings.end(), [](const Finding& f) {
    return f.code == "folded_tetrahedron" || f.code == "flat_tetrahedron";
  });
  return built.findings;
}

void note(Body& body, const std::vector<Finding>& findings) {
  for (const Finding& f : findings) {
    body.faults.push_back("after split " + std::to_string(body.splits) + ": " + f.code + ": " +
                          f.text);
  }
}

/// The cells, for the laws; without Betti numbers where the body cannot lie in space, for there
/// b2 = sheets - components does not hold: a product of circle and sphere has b2 = 1 and no sheet.
Counts counted_for_laws(const Body& body) {
  Counts counts = count_cells(*body.map);
  if (!body.in_space) counts.betti.reset();
  return counts;
}

/// Splits a face and checks the changed counts of all cells against the laws: always on small
/// bodies, else often enough to cost about 20 us per split.
FaceSplit split_by_law(Body& body, HalfFaceId face) {
  const std::size_t tetrahedra = body.map->tetrahedra();
  const bool counted = tetrahedra <= 100 || body.splits % (tetrahedra / 20) == 0;
  ++body.splits;
  if (counted && !body.counts) body.counts = counted_for_laws(body);
  const std::optional<Counts> before = std::exchange(body.counts, std::nullopt);
  const FaceSplit split = split_face(*body.map, face);
  if (!counted) return split;
  body.counts = counted_for_laws(body);
  note(body, check_split_laws(*before, *body.counts, split));
  return split;
}

/// The contract of rows: the passed side keeps its own, the other has the copies. The oracle says
/// yes exactly when all three differ now. The reported cost of the split is a possible one.
void judge_rows(Body& body, const FaceSplit& did) {
  int different = 0;
  std::size_t least = 0;
  std::vector<std::size_t> stars;  // of the three vertices before the split
  for (const VertexId v : did.vertices) {
    const std::uint32_t point = body.map->point_of_vertex(v);
    const VertexId kept = row_at(*body.map, tetrahedron_of(did.face), point);
    const VertexId other = row_at(*body.map, tetrahedron_of(did.opposite), point);
    different += kept != other ? 1 : 0;
    if (kept != v) body.faults.emplace_back("the side that was passed did not keep its row");
    const std::size_t stays = star(*body.map, kept).size();
    const std::size_t leaves = kept != other ? star(*body.map, other).size() : 0;
    least = std::max(least, leaves);
    stars.push_back(stays + leaves);
  }
  // The leaving side is searched whole; no walk round an edge, no search of a star repeats any.
  std::sort(stars.begin(), stars.end());
  if (did.visited < least || did.visited > 3 * stars[0] + 2 * stars[1] + stars[2]) {
    body.faults.emplace_back("a split tells of fewer or more tetrahedra visited than it had to");
  }
  if (oracle_says_new(did) != (different == 3)) {
    body.faults.emplace_back("the oracle does not say whether all three vertices split");
  }
}

SplitAnswer split(Body& body, FaceSide side) {
  const HalfFaceId face = half_face_at(*body.map, side);
  if (body.map->neighbour(face).is_none())
    return in_file_points(*body.map, split_face(*body.map, face));
  label_anew(body);
  const FaceSplit did = split_by_law(body, face);
  judge_rows(body, did);
  const ComponentUpdate update =
      update_components(*body.map, std::span(&did, 1), Detection::exact, body.labels, body.scratch);
  if (update.created > 1) body.faults.emplace_back("one split made several components");
  if (update.predicted != (oracle_says_new(did) ? 1U : 0U)) {
    body.faults.emplace_back("the update does not predict what the oracle says");
  }
  body.batch.push_back(did);
  SplitAnswer answer = in_file_points(*body.map, did);
  answer.separated = update.created > 0;
  return answer;
}

bool glue(Body& body, FaceSide a, FaceSide b) {
  const HalfFaceId f = half_face_at(*body.map, a), g = half_face_at(*body.map, b);
  const auto before = body.map->corners(tetrahedron_of(f));
  std::array<VertexId, 4> lower = before;
  for (VertexId& row : lower) {
    const VertexId other = row_at(*body.map, tetrahedron_of(g), body.map->point_of_vertex(row));
    if (!other.is_none()) row = std::min(row, other);
  }
  lower[place_of(f)] = before[place_of(f)];
  if (glue_face(*body.map, f, g).refusal != GlueRefusal::none) return false;
  if (body.map->corners(tetrahedron_of(f)) != lower) {
    body.faults.emplace_back("gluing did not keep the lower rows");
  }
  body.labels_are_void = true;
  body.counts.reset();
  return true;
}

/// Whether two labellings part the same rows; none() pairs with none() only.
template <class Row>
bool same_partition(const std::vector<Row>& a, const std::vector<Row>& b) {
  if (a.size() != b.size()) return false;
  std::unordered_map<std::uint32_t, std::uint32_t> there, back;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].is_none() != b[i].is_none()) return false;
    if (there.emplace(a[i].value, b[i].value).first->second != b[i].value) return false;
    if (back.emplace(b[i].value, a[i].value).first->second != a[i].value) return false;
  }
  return true;
}

void judge_labels(Body& body) {
  const auto expect = [&body](bool holds, const std::string& what) {
    if (!holds) body.faults.push_back("after split " + std::to_string(body.splits) + ": " + what);
  };
  label_anew(body);
  for (std::size_t i = 0; i < all_detections.size(); ++i) {
    update_components(*body.map, body.batch, all_detections[i], body.batched[i], body.scratch);
  }
  body.batch.clear();
  for (std::size_t i = 1; i < all_detections.size(); ++i) {
    const Components &a = body.batched[0], &b = body.batched[i];
    expect(a.of_tetrahedron == b.of_tetrahedron && a.of_vertex == b.of_vertex && a.size == b.size &&
               a.parent == b.parent,
           std::string("labels by ") + detection_names[i] + " are not those by walks");
  }
  const Components walked = label_components(*body.map);
  for (const Components* labels : {&body.labels, &body.batched[0]}) {
    expect(same_partition(labels->of_tetrahedron, walked.of_tetrahedron),
           "components of tetrahedra are not those of a full walk");
    expect(same_partition(labels->of_vertex, walked.of_vertex),
           "components of vertices are not those of a full walk");
    std::vector<std::size_t> size(labels->size.size(), 0);
    for (const ComponentId c : labels->of_tetrahedron) ++size[c.index()];
    expect(size == labels->size, "sizes of components are not those of their labels");
  }
}

std::vector<std::string> own_faults(Body& body) {
  judge_labels(body);
  note(body, check(*body.map));
  return std::exchange(body.faults, {});
}

std::vector<FaceSide> fan(Body& body, CornerAt at, const Point& normal) {
  const auto& rows = body.map->corners(TetId{at.tetrahedron});
  const auto row = std::find_if(rows.begin(), rows.end(), [&](VertexId v) {
    return body.map->point_of_vertex(v) == at.point;
  });
  const Result<std::vector<HalfFaceId>> faces = fan_faces(*body.map, *row, normal);
  note(body, faces.findings);
  std::vector<FaceSide> sides;
  if (!faces) return sides;
  for (const HalfFaceId f : *faces) sides.push_back(side_of(body, f));
  return sides;
}

/// The fan of one copy of a point. A face of it is one whichever side tetrahedra without a label
/// are counted on: then one of its own two is positive, the other negative.
std::vector<HalfFaceId> crack_fan(Body& body, const VertexStar& star, const CrackSides& sides) {
  std::vector<char> positive, not_negative;
  for (const CornerId c : star.corners) {
    const CrackSide side = sides[tetrahedron_of(c).index()];
    positive.push_back(side == CrackSide::positive ? 1 : 0);
    not_negative.push_back(side == CrackSide::negative ? 0 : 1);
  }
  const std::vector<HalfFaceId> with = fan_faces(*body.map, star, not_negative);
  std::vector<HalfFaceId> fan = fan_faces(*body.map, star, positive);
  if (!std::is_sorted(fan.begin(), fan.end())) {
    body.faults.emplace_back("the faces of a fan are not in rising order");
  }
  std::erase_if(
      fan, [&with](HalfFaceId f) { return std::find(with.begin(), with.end(), f) == with.end(); });
  return fan;
}

std::vector<FaceSide> crack_fan(Body& body, std::uint32_t point, const CrackSides& sides) {
  std::vector<FaceSide> faces;
  for (std::size_t v = 0; v < body.map->vertices(); ++v) {
    if (body.map->point_of_vertex(VertexId{v}) != point) continue;
    const VertexStar star = vertex_star(*body.map, VertexId{v});
    for (const HalfFaceId f : crack_fan(body, star, sides)) faces.push_back(side_of(body, f));
  }
  return faces;
}

std::vector<FaceSide> plane(Body& body, const CuttingPlane& plane) {
  const Result<std::vector<HalfFaceId>> faces = plane_faces(*body.map, plane);
  note(body, faces.findings);
  std::vector<FaceSide> sides;
  if (!faces) return sides;
  if (!std::is_sorted(faces->begin(), faces->end())) {
    body.faults.emplace_back("the faces of a section are not in rising order");
  }
  for (const HalfFaceId f : *faces) sides.push_back(side_of(body, f));
  return sides;
}

JudgedKernel judged(MapKernel answers, const char* name) {
  const auto body = std::make_shared<Body>();
  JudgedKernel kernel;
  kernel.name = name;
  kernel.names_findings = true;
  kernel.load = [body, answers](const TetMesh& mesh) { return load(*body, mesh, answers); };
  kernel.split = [body](FaceSide side) { return split(*body, side); };
  kernel.glue = [body](FaceSide a, FaceSide b) { return glue(*body, a, b); };
  kernel.counts = [body] { return cell_counts(*body->map); };
  kernel.vertex_of_corner = [body] { return vertex_of_corner(*body->map, body->file); };
  kernel.component_of_tetrahedron = [body] {
    label_anew(*body);
    std::vector<std::uint32_t> labels;
    for (const ComponentId c : body->labels.of_tetrahedron) labels.push_back(c.value);
    return labels;
  };
  kernel.own_faults = [body] { return own_faults(*body); };
  kernel.fan = [body](CornerAt at, Point normal) { return fan(*body, at, normal); };
  kernel.crack_fan = [body](std::uint32_t point, const CrackSides& sides) {
    return crack_fan(*body, point, sides);
  };
  kernel.plane = [body](const CuttingPlane& section) { return plane(*body, section); };
  return kernel;
}

}  // namespace

JudgedKernel volume_map_kernel() { return judged(MapKernel::lcc, "sunder"); }
JudgedKernel dense_map_kernel() { return judged(MapKernel::dense, "dense"); }

}  // namespace sunder::suite
