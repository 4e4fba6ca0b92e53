// SPDX-License-Identifier: MIT
// From file rows to half-faces and back.
#include "apps/sunder/mesh/split_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "topology/io/face_list.hpp"

namespace sunder {
namespace {

/// Rows of the file's points of a half-face, in rising order.
std::array<std::uint32_t, 3> points_of(const VolumeMap& map, HalfFaceId face) {
  const auto& corners = map.corners(tetrahedron_of(face));
  std::array<std::uint32_t, 3> points;
  for (int k = 0, n = 0; k < 4; ++k) {
    if (k != place_of(face)) points[n++] = map.point_of_vertex(corners[k]);
  }
  std::sort(points.begin(), points.end());
  return points;
}

std::vector<FaceRequest> requests_of(const VolumeMap& map, std::span<const HalfFaceId> faces) {
  std::vector<FaceRequest> requests;
  for (const HalfFaceId face : faces) requests.push_back({points_of(map, face), face});
  return requests;
}

}  // namespace

Result<std::vector<FaceRequest>> faces_of_file(const VolumeMap& map,
                                               const std::filesystem::path& path) {
  const auto listed = read_face_list(path);
  if (!listed) {
    Result<std::vector<FaceRequest>> refused;
    refused.findings = listed.findings;
    return refused;
  }
  const std::vector<std::array<std::uint32_t, 3>>& triples = *listed;
  const std::vector<HalfFaceId> faces = find_faces(map, triples);
  std::vector<FaceRequest> requests;
  for (std::size_t i = 0; i < triples.size(); ++i) requests.push_back({triples[i], faces[i]});
  return requests;
}

Result<std::vector<FaceRequest>> faces_of_fan(const VolumeMap& map, std::uint32_t point,
                                              const Point& normal) {
  std::vector<HalfFaceId> faces;
  bool found = false;
  for (std::size_t row = 0; row < map.vertices(); ++row) {
    if (map.point_of_vertex(VertexId{row}) != point) continue;
    found = true;
    const Result<std::vector<HalfFaceId>> fan = fan_faces(map, VertexId{row}, normal);
    if (!fan) {
      Result<std::vector<FaceRequest>> refused;
      refused.findings = fan.findings;
      return refused;
    }
    faces.insert(faces.end(), fan->begin(), fan->end());
  }
  if (!found) {
    return Finding{.code = "no_such_vertex",
                   .ids = {point},
                   .text = fmt::format("point {} belongs to no tetrahedron of the mesh", point),
                   .remedy = "give the row, counted from 0, of a point that tetrahedra use"};
  }
  return requests_of(map, faces);
}

Result<std::vector<FaceRequest>> faces_of_plane(const VolumeMap& map, const CuttingPlane& plane) {
  const Result<std::vector<HalfFaceId>> faces = plane_faces(map, plane);
  if (faces) return requests_of(map, *faces);
  Result<std::vector<FaceRequest>> refused;
  refused.findings = faces.findings;
  return refused;
}

void order_requests(const VolumeMap& map, FaceOrder order, std::vector<FaceRequest>& requests) {
  if (order == FaceOrder::given) return;
  std::vector<HalfFaceId> faces;
  for (const FaceRequest& request : requests) {
    if (refusal_of(map, request).empty()) faces.push_back(request.face);
  }
  order_faces(map, order, faces);
  std::unordered_map<HalfFaceId, std::size_t> place;
  for (const HalfFaceId face : faces) place.emplace(face, place.size());
  const auto place_of_request = [&](const FaceRequest& request) {
    const auto found = place.find(request.face);
    return found == place.end() ? place.size() : found->second;
  };
  std::stable_sort(requests.begin(), requests.end(), [&](const auto& a, const auto& b) {
    return place_of_request(a) < place_of_request(b);
  });
}

std::string refusal_of(const VolumeMap& map, const FaceRequest& request) {
  if (request.face.is_none()) return "no tetrahedron has a face on these points";
  if (map.neighbour(request.face).is_none()) {
    return "not an interior face: only one tetrahedron has it, or it was split before";
  }
  return {};
}

}  // namespace sunder
