// SPDX-License-Identifier: MIT
// Component labels for the map that everyone uses.
#include "topology/kernel/components_impl.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

template Components label_components<VolumeMap>(const VolumeMap&);
template ComponentUpdate update_components<VolumeMap>(const VolumeMap&, std::span<const FaceSplit>,
                                                      Detection, Components&, ComponentScratch&);

}  // namespace sunder
