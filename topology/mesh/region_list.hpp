// SPDX-License-Identifier: MIT
// The regions of a mesh in words, for messages.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sunder {

/// "the regions are 1 (matrix), 2": the numbers that occur in `regions`, ascending, at most twelve,
/// with their names where there are any. Where `regions` is empty: that there are none.
std::string region_list(std::vector<std::int32_t> regions,
                        const std::map<std::int32_t, std::string>& names);

}  // namespace sunder
