// SPDX-License-Identifier: MIT
// Boundary faces and boundary vertices that lie on each other without being joined: hanging
// vertices, points that miss each other by a rounding, faces in one place; faces that go through
// each other.
#include <algorithm>
#include <cmath>
#include <limits>

#include "topology/base/point_math.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/base/union_find.hpp"
#include "topology/kernel/kernel.hpp"
#include "topology/mesh/box_tree.hpp"
#include "topology/mesh/survey.hpp"

namespace sunder {
namespace {

using detail::cross, detail::difference, detail::dot, detail::length;

constexpr FindingWords hanging_vertex = {
    "hanging_vertex", Severity::warning,
    "% [point lies|points lie] inside a boundary face or edge of a tetrahedron that does not have "
    "them: the "
    "mesh is not conforming there",
    "refine the coarser side, or mesh the parts together; parts that only touch may stay so"};
constexpr FindingWords close_points = {
    "close_points", Severity::warning,
    "% boundary [point misses|points miss] an earlier one by less than a millionth of an edge",
    "merge them if the parts are meant to hang together: sunder convert FILE NEW --merge-points "
    "DISTANCE"};
constexpr FindingWords coincident_faces = {
    "coincident_faces", Severity::note,
    "% boundary [face lies|faces lie] where an earlier one lies, with points of their own (ids: "
    "the three "
    "points of each)",
    "nothing to do if a crack is meant there; otherwise merge the points: sunder convert FILE NEW "
    "--merge-points 0"};
constexpr FindingWords contact_unfinished = {
    "contact_unfinished", Severity::warning,
    "% boundary [point was|points were] not held against all faces near them: too many faces "
    "overlap",
    "repair the other findings first; the list of hanging vertices may be incomplete"};
constexpr FindingWords overlapping_faces = {
    "overlapping_faces", Severity::warning,
    "% boundary [face goes|faces go] through others: parts of the body, or bodies, overlap there",
    "cut one part out of the other, or move them apart"};
constexpr FindingWords overlap_unfinished = {
    "overlap_unfinished", Severity::warning,
    "% boundary [face was|faces were] not held against all faces near them: too many overlap",
    "mend the other findings first; what is told of overlapping faces may not be all"};

/// Looks at boxes for each boundary point and face. Ordinary meshes need about 20, also when they
/// are cut along every face; without a bound n faces through each other would take n^2.
constexpr std::size_t looks_each = 50;
/// The same for each boundary face compared with others: ordinary meshes need about 60.
constexpr std::size_t looks_of_faces = 400;

/// The boundary of a mesh by places in space: points with the same coordinates are one place.
struct Contact {
  Survey& survey;
  std::vector<std::uint32_t> faces;  // half-faces
  /// Boundary points by their place: first[k] to first[k + 1].
  std::vector<std::uint32_t> points;
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> place_of_point;
  /// Coordinates of each place, scaled by a power of two so that the largest is near 1.
  std::vector<Point> at;
  /// Smallest distance that counts as more than none.
  double rounding = 0;
  /// Places that are near to each other.
  UnionFind near;
};

std::array<std::uint32_t, 3> points_of(const Contact& c, std::uint32_t face) {
  return corners_of_face(c.survey.mesh.tetrahedra[face / 4], HalfFaceId{face});
}

std::array<Point, 3> corners_of(const Contact& c, std::uint32_t face) {
  std::array<Point, 3> corners;
  const auto points = points_of(c, face);
  for (int k = 0; k < 3; ++k) corners[k] = c.at[c.place_of_point[points[k]]];
  return corners;
}

void find_boundary(Contact& c) {
  const Survey& s = c.survey;
  const auto is_finite = [&s](std::uint32_t p) {
    const Point& x = s.mesh.points[p];
    return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
  };
  std::vector<char> met(s.mesh.points.size(), 0);
  for (std::uint32_t f = 0; f < 4 * s.mesh.tetrahedra.size(); ++f) {
    const auto& t = s.mesh.tetrahedra[f / 4];
    if (!s.usable[f / 4] || !s.neighbours[f / 4][f % 4].is_none()) continue;
    if (!std::all_of(t.begin(), t.end(), is_finite)) continue;
    c.faces.push_back(f);
    // All four: whether a face's tetrahedron has a place is asked of each.
    for (const std::uint32_t p : t) {
      if (!met[p]) c.points.push_back(p);
      met[p] = 1;
    }
  }
}

void find_places(Contact& c) {
  const auto& x = c.survey.mesh.points;
  std::sort(c.points.begin(), c.points.end(),
            [&x](std::uint32_t a, std::uint32_t b) { return x[a] != x[b] ? x[a] < x[b] : a < b; });
  double largest = 0;
  for (const std::uint32_t p : c.points) {
    for (const double value : x[p]) largest = std::max(largest, std::abs(value));
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  c.rounding = 8 * std::numeric_limits<double>::epsilon() * std::ldexp(largest, -exponent);
  c.place_of_point.assign(x.size(), 0);
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    const Point& here = x[c.points[i]];
    if (i == 0 || here != x[c.points[i - 1]]) {
      c.first.push_back(i);
      Point& scaled = c.at.emplace_back(here);
      for (double& value : scaled) value = std::ldexp(value, -exponent);
    }
    c.place_of_point[c.points[i]] = static_cast<std::uint32_t>(c.at.size() - 1);
  }
  c.first.push_back(c.points.size());
  c.near = UnionFind(c.at.size());
}

/// Edge k of a face runs from its corner k to the next one.
std::array<double, 3> edge_lengths(const std::array<Point, 3>& corners) {
  return {length(difference(corners[1], corners[0])), length(difference(corners[2], corners[1])),
          length(difference(corners[0], corners[2]))};
}

double tolerance_for(const Contact& c, double edge) {
  return std::max(contact_tolerance * edge, c.rounding);
}

BoundingBox box_of(const Contact& c, std::uint32_t face) {
  const auto corners = corners_of(c, face);
  const auto edges = edge_lengths(corners);
  const double margin = tolerance_for(c, std::max({edges[0], edges[1], edges[2]}));
  BoundingBox box{corners[0], corners[0]};
  for (const Point& x : corners) extend(box, x);
  for (int k = 0; k < 3; ++k) {
    box.low[k] -= margin;
    box.high[k] += margin;
  }
  return box;
}

/// Whether `x` lies on the face away from its corners: on the inside of an edge or of the face.
bool lies_inside(const Contact& c, const std::array<Point, 3>& corners,
                 const std::array<double, 3>& edges, const Point& x) {
  const Point normal =
      cross(difference(corners[1], corners[0]), difference(corners[2], corners[0]));
  bool is_left_of_all = true;
  for (int k = 0; k < 3; ++k) {
    const Point along = difference(corners[(k + 1) % 3], corners[k]);
    const Point to_x = difference(x, corners[k]);
    const double place = dot(to_x, along), squared = dot(along, along);
    const Point across = cross(along, to_x);
    if (place > 0 && place < squared && length(across) <= tolerance_for(c, edges[k]) * edges[k]) {
      return true;
    }
    is_left_of_all = is_left_of_all && dot(across, normal) > 0;
  }
  const double margin = tolerance_for(c, std::max({edges[0], edges[1], edges[2]}));
  return is_left_of_all &&
         std::abs(dot(normal, difference(x, corners[0]))) <= margin * length(normal);
}

/// Compares a place with a face: joins it to a corner near it, or returns that it hangs.
bool hangs_on(Contact& c, std::uint32_t place, std::uint32_t face) {
  const auto& t = c.survey.mesh.tetrahedra[face / 4];
  for (const std::uint32_t p : t) {
    if (c.place_of_point[p] == place) return false;
  }
  const auto corners = corners_of(c, face);
  const auto edges = edge_lengths(corners);
  const double margin = tolerance_for(c, std::min({edges[0], edges[1], edges[2]}));
  const auto points = points_of(c, face);
  bool is_near = false;
  for (int k = 0; k < 3; ++k) {
    if (length(difference(c.at[place], corners[k])) > margin) continue;
    is_near = true;
    c.near.join(place, c.place_of_point[points[k]]);
  }
  return !is_near && lies_inside(c, corners, edges, c.at[place]);
}

/// Keeps faces as further places of a finding, where there are any.
void show_faces(Contact& c, const char* code, std::vector<std::uint32_t> faces) {
  if (faces.empty()) return;
  sort_unique(faces);
  FindingPlaces places{code, PlaceKind::faces, {}};
  for (const std::uint32_t face : faces) {
    const auto points = points_of(c, face);
    places.rows.insert(places.rows.end(), points.begin(), points.end());
  }
  c.survey.places.push_back(std::move(places));
}

BoxTree tree_of_faces(const Contact& c) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(c.faces.size());
  for (const std::uint32_t face : c.faces) boxes.push_back(box_of(c, face));
  return box_tree(std::move(boxes));
}

void find_hanging(Contact& c, const BoxTree& tree) {
  std::vector<std::uint32_t> hanging, unfinished, hung_in;
  std::size_t looks_left = looks_each * (c.at.size() + c.faces.size());
  for (std::uint32_t place = 0; place < c.at.size(); ++place) {
    bool hangs = false;
    const bool is_left_out = looks_left == 0;
    if (!is_left_out) {
      const std::size_t looks = for_each_box_at(tree, c.at[place], [&](std::uint32_t row) {
        if (!hangs_on(c, place, c.faces[row])) return;
        hangs = true;
        if (c.survey.keeps_places) hung_in.push_back(c.faces[row]);
      });
      looks_left -= std::min(looks, looks_left);
    }
    auto& list = is_left_out ? unfinished : hanging;
    if (!hangs && !is_left_out) continue;
    for (std::size_t i = c.first[place]; i < c.first[place + 1]; ++i) list.push_back(c.points[i]);
  }
  std::sort(hanging.begin(), hanging.end());
  std::sort(unfinished.begin(), unfinished.end());
  Places hung(PlaceKind::points, c.survey.keeps_places), left = hung;
  for (const std::uint32_t p : hanging) hung.add(p);
  for (const std::uint32_t p : unfinished) left.add(p);
  report(c.survey, hanging_vertex, hung);
  show_faces(c, hanging_vertex.code, std::move(hung_in));
  report(c.survey, contact_unfinished, left);
}

void report_close(Contact& c) {
  std::vector<std::uint32_t> close;
  for (std::uint32_t place = 0; place < c.at.size(); ++place) {
    if (c.near.root(place) == place) continue;
    for (std::size_t i = c.first[place]; i < c.first[place + 1]; ++i) close.push_back(c.points[i]);
  }
  std::sort(close.begin(), close.end());
  Places places(PlaceKind::points, c.survey.keeps_places);
  for (const std::uint32_t p : close) places.add(p);
  report(c.survey, close_points, places);
}

void report_coincident(Contact& c) {
  struct PlacedFace {
    std::array<std::uint32_t, 3> places, points;
    auto operator<=>(const PlacedFace&) const = default;
  };
  std::vector<PlacedFace> faces;
  for (const std::uint32_t f : c.faces) {
    PlacedFace face{{}, points_of(c, f)};
    std::sort(face.points.begin(), face.points.end());
    for (int k = 0; k < 3; ++k) face.places[k] = c.near.root(c.place_of_point[face.points[k]]);
    std::sort(face.places.begin(), face.places.end());
    const bool has_area = face.places[0] != face.places[1] && face.places[1] != face.places[2];
    if (has_area) faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end());
  std::vector<std::array<std::uint32_t, 3>> later;
  for (std::size_t i = 1; i < faces.size(); ++i) {
    // Those with the same points are an overfull face, which is another finding.
    const bool is_later =
        faces[i].places == faces[i - 1].places && faces[i].points != faces[i - 1].points;
    if (is_later) later.push_back(faces[i].points);
  }
  std::sort(later.begin(), later.end());
  Places places(PlaceKind::faces, c.survey.keeps_places);
  for (const auto& points : later) places.add(points);
  report(c.survey, coincident_faces, places);
}

/// Whether the segment passes through the inside of the face, with its ends and the face's edges
/// farther from there than the touching distance. An end at a corner is not farther away.
bool goes_through(const Contact& c, const Point& from, const Point& to,
                  const std::array<Point, 3>& face) {
  const Point normal = cross(difference(face[1], face[0]), difference(face[2], face[0]));
  const double begin = dot(normal, difference(from, face[0]));
  const double end = dot(normal, difference(to, face[0]));
  if ((begin > 0) == (end > 0)) return false;
  const auto edges = edge_lengths(face);
  const Point way = difference(to, from);
  const double margin =
      length(normal) * tolerance_for(c, std::max({edges[0], edges[1], edges[2], length(way)}));
  if (std::min(std::abs(begin), std::abs(end)) <= margin) return false;
  Point x = from;
  for (std::size_t k = 0; k < 3; ++k) x[k] += begin / (begin - end) * way[k];
  for (std::size_t k = 0; k < 3; ++k) {
    const Point along = difference(face[(k + 1) % 3], face[k]);
    if (dot(normal, cross(along, difference(x, face[k]))) <= margin * edges[k]) return false;
  }
  return true;
}

/// Whether an edge of `a` goes through `b`.
bool pierces(const Contact& c, const std::array<std::uint32_t, 3>& a,
             const std::array<std::uint32_t, 3>& b) {
  const std::array<Point, 3> face{c.at[b[0]], c.at[b[1]], c.at[b[2]]};
  for (std::size_t k = 0; k < 3; ++k) {
    if (goes_through(c, c.at[a[k]], c.at[a[(k + 1) % 3]], face)) return true;
  }
  return false;
}

void find_overlaps(Contact& c, const BoxTree& tree) {
  const auto places_of = [&c](std::uint32_t face) {
    auto places = points_of(c, face);
    for (std::uint32_t& p : places) p = c.near.root(c.place_of_point[p]);
    return places;
  };
  std::vector<char> overlaps(c.faces.size(), 0);
  std::size_t looks_left = looks_of_faces * c.faces.size(), row = 0;
  for (; row < c.faces.size() && looks_left > 0; ++row) {
    const auto face = places_of(c.faces[row]);
    const std::size_t looks = for_each_box(
        tree, [&](const BoundingBox& box) { return overlap(box, tree.boxes[row]); },
        [&](std::uint32_t other) {
          if (pierces(c, face, places_of(c.faces[other]))) overlaps[row] = overlaps[other] = 1;
        });
    looks_left -= std::min(looks, looks_left);
  }
  Places through(PlaceKind::faces, c.survey.keeps_places), left = through;
  for (std::size_t f = 0; f < c.faces.size(); ++f) {
    if (overlaps[f]) through.add(points_of(c, c.faces[f]));
    if (f >= row) left.add(points_of(c, c.faces[f]));
  }
  report(c.survey, overlapping_faces, through);
  report(c.survey, overlap_unfinished, left);
}

}  // namespace

void survey_contact(Survey& s) {
  Contact contact{s};
  find_boundary(contact);
  find_places(contact);
  const BoxTree tree = tree_of_faces(contact);
  find_hanging(contact, tree);
  report_close(contact);
  report_coincident(contact);
  find_overlaps(contact, tree);
}

}  // namespace sunder
