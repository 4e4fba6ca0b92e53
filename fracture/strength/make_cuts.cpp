// SPDX-License-Identifier: MIT
// From a body's cuts to half-faces of the map, and their unsewing.
#include "fracture/strength/make_cuts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "topology/kernel/fan.hpp"
#include "topology/kernel/split_face.hpp"

namespace sunder {
namespace {

bool contains(const CutSettings& cut, const Vec3& p) {
  if (cut.box && !Eigen::AlignedBox3d(cut.box->minimum, cut.box->maximum).contains(p)) return false;
  return !cut.ball || (p - cut.ball->center).norm() <= cut.ball->radius;
}

/// Whether the three vertices of a face lie where the cut is allowed.
bool contains(const CutSettings& cut, const VolumeMap& map, HalfFaceId face) {
  for (const VertexId v : corners_of_face(map.corners(tetrahedron_of(face)), face)) {
    const Point& p = map.point(v);
    if (!contains(cut, Vec3(p[0], p[1], p[2]))) return false;
  }
  return true;
}

/// One cut of one body at work.
struct Cut {
  const CutSettings& settings;
  const BodyRows& rows;
  std::string place;
  std::vector<Finding>& findings;

  void add(const std::string& code, const std::string& text, const std::string& remedy) const {
    findings.push_back(
        {.code = code, .text = fmt::format("{}: {}", place, text), .remedy = remedy});
  }
};

std::vector<HalfFaceId> faces_of(const Cut& cut, const VolumeMap& map, const CutPlane& plane) {
  const Vec3& n = plane.normal;
  Result<std::vector<HalfFaceId>> faces =
      plane_faces(map, CuttingPlane{{n[0], n[1], n[2]}, n.dot(plane.point)});
  if (!faces) {  // an offset beyond all doubles
    const Finding& f = faces.findings.front();
    cut.add(f.code, f.text, f.remedy);
    return {};
  }
  std::erase_if(*faces, [&](HalfFaceId f) {
    const std::size_t t = tetrahedron_of(f).index();
    return t < cut.rows.first_tetrahedron || t >= cut.rows.end_tetrahedron;
  });
  return std::move(*faces);
}

std::vector<HalfFaceId> faces_of(const Cut& cut, const VolumeMap& map, const FaceList& list) {
  std::vector<std::array<std::uint32_t, 3>> points = list.points;
  const auto count = static_cast<std::uint32_t>(cut.rows.end_point - cut.rows.first_point);
  std::vector<HalfFaceId> faces;
  bool in_range = true;
  for (auto& face : points) {
    for (std::uint32_t& p : face) {
      in_range &= p < count;
      p += static_cast<std::uint32_t>(cut.rows.first_point);
    }
  }
  if (in_range) faces = find_faces(map, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (in_range && !faces[i].is_none() && !map.neighbour(faces[i]).is_none()) continue;
    const auto& p = list.points[i];
    if (!in_range && std::ranges::all_of(p, [&](auto row) { return row < count; })) continue;
    cut.add("not_interior",
            fmt::format("{} {} {} is no interior face of the mesh", p[0], p[1], p[2]),
            "name faces between two tetrahedra by rows of the mesh's points, counted from 0");
    return {};
  }
  return faces;
}

std::vector<HalfFaceId> faces_of(const Cut& cut, const VolumeMap& map) {
  const std::size_t before = cut.findings.size();
  std::vector<HalfFaceId> faces =
      std::visit([&](const auto& what) { return faces_of(cut, map, what); }, cut.settings.faces);
  std::erase_if(faces, [&](HalfFaceId f) { return !contains(cut.settings, map, f); });
  if (faces.empty() && cut.findings.size() == before) {
    cut.add("nothing_cut", "no face inside the body lies in it",
            "give plane, box and ball in the mesh's own coordinates, m; a face is cut when its "
            "three vertices lie in box and ball");
  }
  return faces;
}

CutFaces both_sides(const CutSettings& settings, const VolumeMap& map,
                    std::span<const HalfFaceId> faces) {
  CutFaces cut;
  for (const HalfFaceId face : faces) {
    cut.faces.push_back({face, map.neighbour(face)});
    const Vec3 area = rest_area_vector(map, face);
    cut.normal += area.dot(cut.normal) < 0 ? Vec3(-area) : area;
  }
  if (const auto* plane = std::get_if<CutPlane>(&settings.faces)) {
    cut.normal = plane->normal;
    cut.plane = *plane;
  }
  return cut;
}

/// The rows on the two sides of a face that was split, corner by corner.
std::array<std::array<VertexId, 2>, 3> facing_rows(const VolumeMap& map, HalfFaceId face,
                                                   HalfFaceId opposite) {
  std::array<std::array<VertexId, 2>, 3> rows;
  const auto own = corners_of_face(map.corners(tetrahedron_of(face)), face);
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i][0] = own[i];
    for (const VertexId v : corners_of_face(map.corners(tetrahedron_of(opposite)), opposite)) {
      if (map.point_of_vertex(v) == map.point_of_vertex(own[i])) rows[i][1] = v;
    }
  }
  return rows;
}

}  // namespace

std::vector<Finding> make_cuts(VolumeMap& map, std::span<const BodySettings> bodies,
                               std::span<const BodyRows> rows, std::vector<CutFaces>& made) {
  std::vector<Finding> findings;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (std::size_t i = 0; i < bodies[b].cuts.size(); ++i) {
      const Cut cut{bodies[b].cuts[i], rows[b], fmt::format("bodies.{}.cuts.{}", b, i), findings};
      // All are chosen on the intact map.
      made.push_back(both_sides(cut.settings, map, faces_of(cut, map)));
    }
  }
  if (has_error(findings)) return findings;
  for (const CutFaces& cut : made) {
    for (const auto& face : cut.faces) split_face(map, face[0]);  // the second time refuses
  }
  return findings;
}

void label_cuts(Cells& cells, std::span<const CutFaces> cuts) {
  for (const CutFaces& cut : cuts) {
    const CrackId crack = add_crack(cells.cracks, cells.map.tetrahedra());
    std::map<std::array<VertexId, 2>, Vec3> normals;  // of rows that face each other
    for (const auto& [face, opposite] : cut.faces) {
      const bool points_back = rest_area_vector(cells.map, face).dot(cut.normal) < 0;
      for (const HalfFaceId f : {face, opposite}) {
        const TetId t = tetrahedron_of(f);
        cells.cracks.of_face[f.index()] = crack;
        if (side_of(cells.cracks, crack, t) != Side::undecided) continue;
        add_label(cells.cracks, crack, t, (f == face) == points_back);
      }
      const Vec3 area = (points_back ? -1 : 1) * rest_area_vector(cells.map, face);
      for (const auto& rows : facing_rows(cells.map, face, opposite)) {
        normals.try_emplace(rows, Vec3::Zero()).first->second += area;
      }
    }
    for (const auto& [rows, normal] : normals) {
      const Vec3 at(cells.map.point(rows[0]).data());
      const VertexId copy = rows[0] == rows[1] ? VertexId::none() : rows[1];
      CrackAnchor anchor{crack, rows[0], copy, at, normal.normalized()};
      if (cut.plane) {
        anchor.normal = cut.plane->normal.normalized();
        anchor.at = at - anchor.normal.dot(at - cut.plane->point) * anchor.normal;
      }
      add_anchor(cells.cracks, anchor);
    }
  }
}

}  // namespace sunder
