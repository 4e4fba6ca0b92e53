// SPDX-License-Identifier: MIT
// Compares the darts of a map with its rows, and checks both by the rules of a 3-map.
#include "topology/kernel/dart_map.hpp"
#include "topology/kernel/split_face_impl.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {
namespace {

/// Counts broken rules by their words; keeps the first places of each.
class Damage {
 public:
  void unless(bool holds, const char* rule, std::size_t id) {
    if (holds) return;
    for (Finding& f : findings_) {
      if (f.text != rule) continue;
      if (f.ids.size() < Finding::max_ids) f.ids.push_back(static_cast<std::int64_t>(id));
      ++f.count;
      return;
    }
    Finding finding;
    finding.code = "map_damaged";
    finding.text = rule;
    finding.remedy = "report this: no call of the library leaves a map like this";
    finding.ids = {static_cast<std::int64_t>(id)};
    findings_.push_back(std::move(finding));
  }
  std::vector<Finding> take() { return std::move(findings_); }

 private:
  std::vector<Finding> findings_;
};

void check_darts(const VolumeMap& map, TetId t, Damage& damage) {
  const DartMap& darts = map.darts();
  const auto to_dart = [&darts](DartId d) {
    return darts.dart_at(TetId{d.index() / 12}, static_cast<int>(d.index() % 12));
  };
  for (int k = 0; k < 12; ++k) {
    const DartId id{12 * t.index() + static_cast<std::size_t>(k)};
    const auto d = to_dart(id);
    const std::size_t row = id.index();
    damage.unless(darts.id(d) == id, "a dart carries its own row", row);
    damage.unless(darts.beta1(d) == to_dart(map.beta1(id)), "beta1 is the next of the face", row);
    damage.unless(darts.beta0(d) == to_dart(map.beta0(id)), "beta0 is the inverse of beta1", row);
    damage.unless(darts.beta2(d) == to_dart(map.beta2(id)), "beta2 crosses the edge", row);
    damage.unless(darts.is_free(d) == map.is_free(id), "boundary of darts equals that of rows",
                  row);
    damage.unless(darts.vertex(d) == map.vertex(id), "row in the 0-attribute equals the corner's",
                  row);
    damage.unless(darts.tetrahedron(d) == t, "row in the 3-attribute equals the tetrahedron's",
                  row);
    if (darts.is_free(d) || map.is_free(id)) continue;
    const auto across = darts.beta3(d);
    damage.unless(across == to_dart(map.beta3(id)), "beta3 equals the neighbour of the rows", row);
    damage.unless(across != d && darts.beta3(across) == d, "beta3 is an involution", row);
    damage.unless(darts.beta3(darts.beta1(d)) == darts.beta0(across),
                  "beta1 beta3 is an involution", row);
  }
}

void check_rows(const VolumeMap& map, TetId t, Damage& damage) {
  const auto& corners = map.corners(t);
  for (int i = 0; i < 4; ++i) {
    const VertexId v = corners[i];
    damage.unless(v.index() < map.vertices(), "rows of corners are in range", t.index());
    if (v.index() >= map.vertices()) return;
    for (int j = 0; j < i; ++j) {
      damage.unless(map.point_of_vertex(v) != map.point_of_vertex(corners[j]),
                    "the corners of a tetrahedron have different points", t.index());
    }
    const HalfFaceId f = half_face(t, i), across = map.neighbour(f);
    if (across.is_none()) continue;
    damage.unless(across.index() < 4 * map.tetrahedra(), "neighbours are in range", f.index());
    if (across.index() >= 4 * map.tetrahedra()) continue;
    damage.unless(map.neighbour(across) == f, "neighbours name each other", f.index());
    for (int j = 0; j < 4; ++j) {
      if (j == i) continue;
      const int there = place_of_vertex(map.corners(tetrahedron_of(across)), corners[j]);
      damage.unless(there < 4 && there != place_of(across),
                    "the rows of a face are the same on both sides", f.index());
    }
  }
}

/// Each row is one orbit: the orbit reached from the incident tetrahedron holds all its corners.
void check_orbits(const VolumeMap& map, Damage& damage) {
  std::vector<std::size_t> corners(map.vertices(), 0);
  for (const auto& row : map.corners()) {
    for (const VertexId v : row) ++corners[v.index()];
  }
  const DartComplex& complex = map.darts().complex();
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    const TetId t = map.incident_tetrahedron(VertexId{v});
    damage.unless(t.is_none() == (corners[v] == 0), "only retired rows have no tetrahedron", v);
    const bool has_darts = !map.darts().incident_tetrahedron(VertexId{v}).is_none();
    damage.unless(has_darts == (corners[v] > 0), "darts and rows agree on which rows are in use",
                  v);
    damage.unless(!map.is_node(VertexId{v}) || corners[v] == 0, "no corner has the row of a node",
                  v);
    if (t.is_none() || !has_darts) continue;
    const int place = place_of_vertex(map.corners(t), VertexId{v});
    damage.unless(place < 4, "the incident tetrahedron has the vertex", v);
    if (place == 4) continue;
    const auto orbit = detail::orbit_corners(map, VertexId{v}, corner(t, place));
    damage.unless(orbit.size() == corners[v], "each row is one vertex orbit", v);
    const auto d = map.darts().dart_at(t, dart_order::dart_from((place + 1) % 4, place));
    const auto attribute = complex.attribute<0>(d);
    damage.unless(complex.get_attribute_ref_counting<0>(attribute) == 3 * corners[v],
                  "each vertex orbit has one 0-attribute", v);
    damage.unless(complex.attribute<0>(complex.dart_of_attribute<0>(attribute)) == attribute,
                  "the dart of a 0-attribute has that attribute", v);
    damage.unless(map.darts().point_of_vertex(VertexId{v}) == map.point_of_vertex(VertexId{v}),
                  "the file's point in the 0-attribute equals the row's", v);
    damage.unless(map.darts().point(VertexId{v}) == map.point(VertexId{v}),
                  "the point of the 0-attribute equals the row's", v);
  }
  if (map.vertices() == 0) return;
  const VertexId last{map.vertices() - 1};
  damage.unless(map.is_node(last) || !map.incident_tetrahedron(last).is_none(),
                "the last row is not a retired one", map.vertices());
}

}  // namespace

std::vector<Finding> check(const VolumeMap& map) {
  Damage damage;
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) check_rows(map, TetId{t}, damage);
  std::vector<Finding> findings = damage.take();
  if (!findings.empty()) return findings;  // darts and walks would follow rows that lead nowhere
  if (map.kernel() == MapKernel::dense) {
    VolumeMap witness = map;
    witness.set_kernel(MapKernel::lcc);
    return check(witness);
  }
  damage.unless(map.darts().tetrahedra() == map.tetrahedra(), "as many tetrahedra as rows", 0);
  damage.unless(map.darts().vertices() == map.vertices(), "as many 0-attributes as rows", 0);
  if (map.darts().tetrahedra() != map.tetrahedra() || map.darts().vertices() != map.vertices()) {
    return damage.take();  // the checks below use rows that both have
  }
  const DartComplex& complex = map.darts().complex();
  damage.unless(complex.number_of_darts() == 12 * map.tetrahedra(), "12 darts a tetrahedron", 0);
  damage.unless(complex.number_of_attributes<3>() == map.tetrahedra(),
                "one 3-attribute a tetrahedron", 0);
  std::size_t used = 0;
  for (std::size_t v = 0; v < map.darts().vertices(); ++v) {
    used += map.darts().incident_tetrahedron(VertexId{v}).is_none() ? 0 : 1;
  }
  damage.unless(complex.number_of_attributes<0>() == used, "one 0-attribute a row in use", 0);
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) check_darts(map, TetId{t}, damage);
  check_orbits(map, damage);
  return damage.take();
}

}  // namespace sunder
