// SPDX-License-Identifier: MIT
// Tables of pieces and cracks as text.
#pragma once

#include <string>
#include <vector>

#include "apps/output/fragment.hpp"

namespace sunder {

/// The table of fragments as CSV (RFC 4180, one header line, SI units, numbers that read back
/// exactly), largest mass first, ties by id.
std::string fragments_csv(std::vector<Fragment> fragments);

/// What fans gave up (`StepReport::cracks` of all steps), as CSV in the order of the fans: fan
/// (counted from 0 through the run), time (s), area and projected_area (m^2), energy (J),
/// energy_per_area (J/m^2, over the latter).
std::string cracks_csv(std::vector<CrackEnergy> cracks);

}  // namespace sunder
