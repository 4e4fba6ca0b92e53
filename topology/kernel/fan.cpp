// SPDX-License-Identifier: MIT
// Fans and sections for the map that everyone uses.
#include "topology/kernel/fan_impl.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

template VertexStar vertex_star<VolumeMap>(const VolumeMap&, VertexId);
template std::vector<TetId> star<VolumeMap>(const VolumeMap&, VertexId);
template std::vector<char> plane_signs<VolumeMap>(const VolumeMap&, const VertexStar&,
                                                  const Point&);
template std::vector<HalfFaceId> fan_faces<VolumeMap>(const VolumeMap&, const VertexStar&,
                                                      std::span<const char>);
template Result<std::vector<HalfFaceId>> fan_faces<VolumeMap>(const VolumeMap&, VertexId,
                                                              const Point&);
template Result<std::vector<HalfFaceId>> plane_faces<VolumeMap>(const VolumeMap&,
                                                                const CuttingPlane&);
template void order_faces<VolumeMap>(const VolumeMap&, FaceOrder, std::vector<HalfFaceId>&);
template std::vector<HalfFaceId> find_faces<VolumeMap>(const VolumeMap&,
                                                       std::span<const detail::PointTriple>);

}  // namespace sunder
