// SPDX-License-Identifier: MIT
// Fans and sections for the map that everyone uses.
#include "topology/kernel/fan_impl.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

std::optional<Point> canonical_direction(const Point& normal) {
  int largest = 0;
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(normal[i])) return std::nullopt;
    if (std::abs(normal[i]) > std::abs(normal[largest])) largest = i;
  }
  const double scale = normal[largest];
  if (scale == 0) return std::nullopt;
  // Divided by its largest component (now 1), so that no square over- or underflows.
  return Point{normal[0] / scale, normal[1] / scale, normal[2] / scale};
}

template std::vector<TetId> star<VolumeMap>(const VolumeMap&, VertexId);
template std::vector<HalfFaceId> fan_faces<VolumeMap>(const VolumeMap&, VertexId,
                                                      std::span<const TetId>,
                                                      std::span<const char>);
template Result<std::vector<HalfFaceId>> fan_faces<VolumeMap>(const VolumeMap&, VertexId,
                                                              const Point&);
template Result<std::vector<HalfFaceId>> plane_faces<VolumeMap>(const VolumeMap&,
                                                                const CuttingPlane&);
template void order_faces<VolumeMap>(const VolumeMap&, FaceOrder, std::vector<HalfFaceId>&);
template std::vector<HalfFaceId> find_faces<VolumeMap>(const VolumeMap&,
                                                       std::span<const detail::PointTriple>);

}  // namespace sunder
