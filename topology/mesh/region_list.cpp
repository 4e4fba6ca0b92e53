// SPDX-License-Identifier: MIT
// Regions in words.
#include "topology/mesh/region_list.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "topology/base/sort_unique.hpp"

namespace sunder {

std::string region_list(std::vector<std::int32_t> regions,
                        const std::map<std::int32_t, std::string>& names) {
  if (regions.empty()) return "the tetrahedra have no regions: choose otherwise";
  sort_unique(regions);
  constexpr std::size_t most = 12;
  std::string list = "the regions are ";
  for (std::size_t i = 0; i < std::min(regions.size(), most); ++i) {
    const auto name = names.find(regions[i]);
    list += fmt::format("{}{}{}", i == 0 ? "" : ", ", regions[i],
                        name == names.end() ? "" : " (" + name->second + ")");
  }
  return regions.size() > most ? list + ", ..." : list;
}

}  // namespace sunder
