// SPDX-License-Identifier: MIT
// Names, units and words of the quantities.
#include "apps/bench/bench_figures.hpp"
#include "topology/base/counted.hpp"
#include "topology/base/split_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <fstream>
#include <thread>

namespace sunder {
namespace {

constexpr std::array<BenchGroup, 5> groups = {{
    {"memory, bytes a tetrahedron", "capacities of everything the map holds; heap: glibc's count"},
    {"time, microseconds",
     "faces in random order, each from a random side; first faces: a fifth of all, at most 40 000"},
    {"a fan that parts nothing, median",
     "at random vertices two cells or more from the surface, one direction; healed after each"},
    {"component search a fan, mean",
     "random fans until the largest component is half the body; all four ways on the same fans"},
    {"the oracle",
     "random fans to total shatter; yes: all three vertices of a face split; % of yes that "
     "is true"},
}};

constexpr auto quantities = std::to_array<BenchQuantity>({
    {"bytes_intact", "byte", "intact", 0, 1},
    {"bytes_intact_darts", "byte", "  darts", 0, 1},
    {"bytes_intact_attributes", "byte", "  attributes of vertices and tetrahedra", 0, 1},
    {"bytes_intact_adjacency", "byte", "  dense adjacency", 0, 1},
    {"bytes_intact_handles", "byte", "  handles from rows to darts", 0, 1},
    {"bytes_intact_vertex_columns", "byte", "  vertex columns and points", 0, 1},
    {"heap_intact", "byte", "  heap in use", 0, 1},
    {"bytes_shattered", "byte", "after total shatter", 0, 1},
    {"bytes_shattered_darts", "byte", "  darts", 0, 1},
    {"bytes_shattered_attributes", "byte", "  attributes of vertices and tetrahedra", 0, 1},
    {"bytes_shattered_adjacency", "byte", "  dense adjacency", 0, 1},
    {"bytes_shattered_handles", "byte", "  handles from rows to darts", 0, 1},
    {"bytes_shattered_vertex_columns", "byte", "  vertex columns and points", 0, 1},
    {"heap_shattered", "byte", "  heap in use", 0, 1},

    {"build", "us", "build with all findings, a tetrahedron", 1, 2},
    {"split_first", "us", "split_face, first faces", 1, 2},
    {"unsew_first", "us", "  of it unsewing darts and rows", 1, 2},
    {"star_test", "us", "  of it star test and new rows", 1, 2},
    {"managed_unsew", "us", "CGAL's managed unsew<3>, first faces", 1, 2},
    {"managed_ratio", "1", "  times split_face", 1, 1},
    {"split_all", "us", "split_face, to total shatter", 1, 2},
    {"split_components", "us", "  with exact components", 1, 2},

    {"quiet_faces", "1", "faces of the fan", 2, 1},
    {"quiet_visited", "1", "tetrahedra visited", 2, 1},
    {"quiet_find", "us", "star, signs and faces, us", 2, 2},
    {"quiet_split", "us", "splitting, us", 2, 2},
    {"quiet_components", "us", "exact components, us", 2, 2},
    {"quiet_total", "us", "splitting and components, us", 2, 2},

    {"search_kept_fans", "1", "fans measured without a new component", 3, 0},
    {"search_kept_us_walk", "us", "  full walk, us", 3, 2},
    {"search_kept_us_dirty_counter", "us", "  dirty counter, us", 3, 2},
    {"search_kept_us_oracle", "us", "  bare oracle, us", 3, 2},
    {"search_kept_us_exact", "us", "  lockstep, us", 3, 2},
    {"search_kept_visited_walk", "1", "  full walk, tetrahedra visited", 3, 1},
    {"search_kept_visited_dirty_counter", "1", "  dirty counter, tetrahedra visited", 3, 1},
    {"search_kept_visited_oracle", "1", "  bare oracle, tetrahedra visited", 3, 1},
    {"search_kept_visited_exact", "1", "  lockstep, tetrahedra visited", 3, 1},
    {"search_parted_fans", "1", "fans measured with a new component", 3, 0},
    {"search_parted_us_walk", "us", "  full walk, us", 3, 2},
    {"search_parted_us_dirty_counter", "us", "  dirty counter, us", 3, 2},
    {"search_parted_us_oracle", "us", "  bare oracle, us", 3, 2},
    {"search_parted_us_exact", "us", "  lockstep, us", 3, 2},
    {"search_parted_visited_walk", "1", "  full walk, tetrahedra visited", 3, 1},
    {"search_parted_visited_dirty_counter", "1", "  dirty counter, tetrahedra visited", 3, 1},
    {"search_parted_visited_oracle", "1", "  bare oracle, tetrahedra visited", 3, 1},
    {"search_parted_visited_exact", "1", "  lockstep, tetrahedra visited", 3, 1},

    {"oracle_betti_1", "1", "handles of the body (b1)", 4, 0},
    {"oracle_given_fans", "1", "faces by rising tetrahedron: fans", 4, 0},
    {"oracle_given_fans_parting", "1", "  fans that part a component", 4, 0},
    {"oracle_given_fans_yes", "1", "  fans with a yes", 4, 0},
    {"oracle_given_fan_efficiency", "%", "  true a fan, %", 4, 1},
    {"oracle_given_fan_efficiency_early", "%", "  true a fan, first tenth of the faces, %", 4, 1},
    {"oracle_given_fan_efficiency_55", "%", "  true a fan, while 55 % of the fans part, %", 4, 1},
    {"oracle_given_faces_yes", "1", "  faces with a yes", 4, 0},
    {"oracle_given_faces_false", "1", "  of them false: handles cut", 4, 0},
    {"oracle_given_face_efficiency", "%", "  true a face, %", 4, 1},
    {"oracle_given_face_efficiency_early", "%", "  true a face, first tenth of the faces, %", 4, 1},
    {"oracle_paper_fans", "1", "faces at the surface first: fans", 4, 0},
    {"oracle_paper_fans_parting", "1", "  fans that part a component", 4, 0},
    {"oracle_paper_fans_yes", "1", "  fans with a yes", 4, 0},
    {"oracle_paper_fan_efficiency", "%", "  true a fan, %", 4, 1},
    {"oracle_paper_fan_efficiency_early", "%", "  true a fan, first tenth of the faces, %", 4, 1},
    {"oracle_paper_fan_efficiency_55", "%", "  true a fan, while 55 % of the fans part, %", 4, 1},
    {"oracle_paper_faces_yes", "1", "  faces with a yes", 4, 0},
    {"oracle_paper_faces_false", "1", "  of them false: handles cut", 4, 0},
    {"oracle_paper_face_efficiency", "%", "  true a face, %", 4, 1},
    {"oracle_paper_face_efficiency_early", "%", "  true a face, first tenth of the faces, %", 4, 1},
});

}  // namespace

std::span<const BenchGroup> kernel_groups() { return groups; }
std::span<const BenchQuantity> kernel_quantities() { return quantities; }

std::optional<double> figure_of(const KernelBench& bench, std::string_view body,
                                std::string_view quantity) {
  for (const BenchFigure& f : bench.figures) {
    if (f.body == body && f.quantity == quantity) return f.value;
  }
  return std::nullopt;
}

std::vector<std::string> bodies_of(const KernelBench& bench) {
  std::vector<std::string> bodies;
  for (const BenchFigure& f : bench.figures) {
    if (std::find(bodies.begin(), bodies.end(), f.body) == bodies.end()) bodies.push_back(f.body);
  }
  return bodies;
}

std::string machine_name() {
  std::string model = "unknown processor";
  std::ifstream in("/proc/cpuinfo");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const std::string_view line : lines_of(text)) {
    if (!line.starts_with("model name")) continue;
    model = line.substr(line.find(':') + 2);
    break;
  }
  return fmt::format("{}, {}", model, counted(std::thread::hardware_concurrency(), "core"));
}

}  // namespace sunder
