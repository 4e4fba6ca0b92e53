// SPDX-License-Identifier: MIT
// The operations on cells for the maps that everyone uses.
#include "topology/cells/columns_impl.hpp"
#include "topology/cells/journal_impl.hpp"
#include "topology/cells/plane_cut_impl.hpp"
#include "topology/cells/refine_impl.hpp"
#include "topology/cells/subdivide_impl.hpp"
#include "topology/kernel/map_answers.hpp"

namespace sunder {

template CellEdit divide_edges<VolumeMap>(VolumeMap&, std::span<const EdgeMark>,
                                          std::span<const char>);
template CellEdit divide_edges<DenseMap>(DenseMap&, std::span<const EdgeMark>,
                                         std::span<const char>);
template CellEdit insert_vertex<VolumeMap>(VolumeMap&, CellEdge, double);
template CellEdit insert_vertex<DenseMap>(DenseMap&, CellEdge, double);
template RefinedLevel refine_marked<VolumeMap>(VolumeMap&, std::span<const TetId>,
                                               std::span<const char>);
template RefinedLevel refine_marked<DenseMap>(DenseMap&, std::span<const TetId>,
                                              std::span<const char>);
template Result<PlaneCut> cut_cells<VolumeMap>(VolumeMap&, const CuttingPlane&, double);
template Result<PlaneCut> cut_cells<DenseMap>(DenseMap&, const CuttingPlane&, double);
template std::array<double, 3> parted_shares<VolumeMap>(const VolumeMap&, const FaceSplit&);
template std::array<double, 3> parted_shares<DenseMap>(const DenseMap&, const FaceSplit&);
template FaceSplit split_face<VolumeMap>(VolumeMap&, HalfFaceId, Journal&);
template FaceSplit split_face<DenseMap>(DenseMap&, HalfFaceId, Journal&);

}  // namespace sunder
