// SPDX-License-Identifier: MIT
// Sizes of fragments as text, JSON and a script for gnuplot.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/sunder/fragments/fragment_sizes.hpp"

namespace sunder {

/// Lines for people: counts, the control, a table of laws, a verdict; or that a fit would say
/// nothing.
std::string fragments_text(const FragmentSizes& sizes);

/// The same for machines, every parameter by its name.
nlohmann::ordered_json fragments_json(const FragmentSizes& sizes);

/// A picture: how many pieces are at least as large, over their size, both logarithmic; the same of
/// the mesh's own elements, and the laws.
std::string fragments_script(const FragmentSizes& sizes, const std::string& title);

}  // namespace sunder
