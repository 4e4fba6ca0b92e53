// SPDX-License-Identifier: MIT
// The kernel's algorithms for the maps that everyone uses.
#include "topology/kernel/components_impl.hpp"
#include "topology/kernel/dense_map.hpp"
#include "topology/kernel/edges_impl.hpp"
#include "topology/kernel/fan_impl.hpp"
#include "topology/kernel/map_answers.hpp"
#include "topology/kernel/split_face_impl.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

template FaceSplit split_face<VolumeMap>(VolumeMap&, HalfFaceId);
template FaceGlue glue_face<VolumeMap>(VolumeMap&, HalfFaceId, HalfFaceId);
template FaceSplit split_face<DenseMap>(DenseMap&, HalfFaceId);
template FaceGlue glue_face<DenseMap>(DenseMap&, HalfFaceId, HalfFaceId);
template Components label_components<VolumeMap>(const VolumeMap&);
template ComponentUpdate update_components<VolumeMap>(const VolumeMap&, std::span<const FaceSplit>,
                                                      Detection, Components&, ComponentScratch&);
template Components label_components<DenseMap>(const DenseMap&);
template ComponentUpdate update_components<DenseMap>(const DenseMap&, std::span<const FaceSplit>,
                                                     Detection, Components&, ComponentScratch&);
template std::vector<CellEdge> edge_ring<VolumeMap>(const VolumeMap&, CellEdge);
template std::vector<CellEdge> edge_ring<DenseMap>(const DenseMap&, CellEdge);
template EdgeRows edge_rows<VolumeMap>(const VolumeMap&);
template EdgeRows edge_rows<DenseMap>(const DenseMap&);
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
