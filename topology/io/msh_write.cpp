// SPDX-License-Identifier: MIT
// Writing MSH 4.1 in ASCII: doubles in their shortest exact form, rows in their order.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "topology/io/msh.hpp"
#include "topology/io/output_file.hpp"

namespace sunder::io {
namespace {

struct MshNumbers {
  const std::vector<std::int64_t>& numbers;
  bool usable;
  std::size_t rows;

  std::int64_t operator[](std::size_t row) const {
    return usable ? numbers[row] : static_cast<std::int64_t>(row) + 1;
  }
  std::int64_t lowest() const {
    return usable ? *std::min_element(numbers.begin(), numbers.end())
                  : std::min<std::int64_t>(1, rows);
  }
  std::int64_t highest() const {
    return usable ? *std::max_element(numbers.begin(), numbers.end()) : rows;
  }
};

MshNumbers numbers_of(const std::vector<std::int64_t>& source, std::size_t rows) {
  return {source, !source.empty() && source.size() == rows && are_msh_numbers(source), rows};
}

std::int32_t region_of(const TetMesh& mesh, std::size_t row) {
  return mesh.region.empty() ? 1 : mesh.region[row];
}

using Buffer = fmt::memory_buffer;

void write_names_and_entities(Buffer& out, const TetMesh& mesh) {
  const auto end = std::back_inserter(out);
  if (!mesh.region_name.empty()) {
    fmt::format_to(end, "$PhysicalNames\n{}\n", mesh.region_name.size());
    for (const auto& [region, name] : mesh.region_name) {
      fmt::format_to(end, "3 {} \"{}\"\n", region, name);
    }
    fmt::format_to(end, "$EndPhysicalNames\n");
  }
  std::set<std::int32_t> regions(mesh.region.begin(), mesh.region.end());
  if (mesh.region.empty()) regions.insert(1);
  Point low{}, high{};
  if (!mesh.points.empty()) low = high = mesh.points.front();
  for (const Point& p : mesh.points) {
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  fmt::format_to(end, "$Entities\n0 0 0 {}\n", regions.size());
  for (const std::int32_t region : regions) {
    fmt::format_to(end, "{} {} {} {} {} {} {} ", region, low[0], low[1], low[2], high[0], high[1],
                   high[2]);
    mesh.region.empty() ? fmt::format_to(end, "0 0\n") : fmt::format_to(end, "1 {} 0\n", region);
  }
  fmt::format_to(end, "$EndEntities\n");
}

void write_nodes(Buffer& out, const TetMesh& mesh) {
  const auto end = std::back_inserter(out);
  const std::size_t n = mesh.points.size();
  const MshNumbers number = numbers_of(mesh.source_point_id, n);
  fmt::format_to(end, "$Nodes\n1 {} {} {}\n3 {} 0 {}\n", n, number.lowest(), number.highest(),
                 region_of(mesh, 0), n);
  for (std::size_t i = 0; i < n; ++i) fmt::format_to(end, "{}\n", number[i]);
  for (const Point& p : mesh.points) fmt::format_to(end, "{} {} {}\n", p[0], p[1], p[2]);
  fmt::format_to(end, "$EndNodes\n");
}

void write_elements(Buffer& out, const TetMesh& mesh) {
  const auto end = std::back_inserter(out);
  const std::size_t n = mesh.tetrahedra.size();
  const MshNumbers number = numbers_of(mesh.source_tetrahedron_id, n);
  const MshNumbers node = numbers_of(mesh.source_point_id, mesh.points.size());
  // Rows keep their order: a region may have several blocks.
  std::vector<std::size_t> block_begin{0};
  for (std::size_t i = 1; i < n; ++i) {
    if (region_of(mesh, i) != region_of(mesh, i - 1)) block_begin.push_back(i);
  }
  fmt::format_to(end, "$Elements\n{} {} {} {}\n", block_begin.size(), n, number.lowest(),
                 number.highest());
  block_begin.push_back(n);
  for (std::size_t b = 0; b + 1 < block_begin.size(); ++b) {
    fmt::format_to(end, "3 {} 4 {}\n", region_of(mesh, block_begin[b]),
                   block_begin[b + 1] - block_begin[b]);
    for (std::size_t i = block_begin[b]; i < block_begin[b + 1]; ++i) {
      const auto& t = mesh.tetrahedra[i];
      fmt::format_to(end, "{} {} {} {} {}\n", number[i], node[t[0]], node[t[1]], node[t[2]],
                     node[t[3]]);
    }
  }
  fmt::format_to(end, "$EndElements\n");
}

}  // namespace

bool are_msh_numbers(const std::vector<std::int64_t>& numbers) {
  std::vector<std::int64_t> sorted = numbers;
  std::sort(sorted.begin(), sorted.end());
  return (sorted.empty() || sorted.front() >= 1) &&
         std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

std::vector<Finding> write_msh(const std::filesystem::path& path, const TetMesh& mesh) {
  Buffer out;
  fmt::format_to(std::back_inserter(out), "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
  write_names_and_entities(out, mesh);
  write_nodes(out, mesh);
  write_elements(out, mesh);
  if (auto failure = write_file(path, std::string_view(out.data(), out.size()))) return {*failure};
  return {};
}

}  // namespace sunder::io
