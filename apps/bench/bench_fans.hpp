// SPDX-License-Identifier: MIT
// Measurements of fans: those that part nothing, the searches for components, and the oracle.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "topology/base/ids.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// Takes a figure by the name of its quantity (bench_figures.hpp).
using FigureSink = std::function<void(const std::string&, double)>;

/// Interior faces in a random order, each once, from a random side.
std::vector<HalfFaceId> random_faces(const VolumeMap& map, std::uint64_t seed);

/// quiet_*: the same fan at inner vertices of a cube of `cells` cells along each edge, glued again
/// after each, so that every one meets an intact body; medians of 200.
/// Needs: cells >= 4.
void measure_quiet_fans(VolumeMap map, int cells, std::uint64_t seed, const FigureSink& add);

/// search_*: random fans one after the other until the largest component is half the body; at some
/// of them, evenly spread, each way of `Detection` is timed on labels of its own. Means over fans
/// of the median over runs; apart for fans with and without a new component (0 where none was met).
void measure_searches(const VolumeMap& map, int runs, std::uint64_t seed, const FigureSink& add);

/// oracle_*: random fans to total shatter, components exact after every face.
void measure_oracle(const VolumeMap& map, std::uint64_t seed, const FigureSink& add);

}  // namespace sunder
