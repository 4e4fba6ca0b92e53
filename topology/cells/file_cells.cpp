// SPDX-License-Identifier: MIT
// Points, cells and data of a file's mesh after an operation on cells.
#include "topology/cells/file_cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace sunder {
namespace {

/// The middle of an edge between two points of the file.
struct Middle {
  std::uint32_t point;
  std::array<std::uint32_t, 2> ends;
  double weight;
};
using Middles = std::map<std::pair<std::uint32_t, std::uint32_t>, Middle>;

Middles middles_of(const VolumeMap& map, const CellEdit& edit) {
  Middles middles;
  for (const auto& [vertex, ends, weight] : edit.vertices) {
    const std::uint32_t a = map.point_of_vertex(ends[0]), b = map.point_of_vertex(ends[1]);
    middles.try_emplace(std::minmax(a, b), Middle{map.point_of_vertex(vertex), {a, b}, weight});
  }
  return middles;
}

/// Rows of points, `components` numbers each, with those of the new points appended.
template <class T>
void append_between(std::vector<T>& values, std::size_t components, std::size_t points,
                    const Middles& middles) {
  values.resize(points * components);
  for (const auto& [pair, middle] : middles) {
    const auto [a, b] = middle.ends;
    for (std::size_t k = 0; k < components; ++k) {
      const T x = values[a * components + k], y = values[b * components + k];
      T& value = values[middle.point * components + k];
      if constexpr (std::floating_point<T>) {
        value = (1 - middle.weight) * x + middle.weight * y;
      } else {
        value = middle.weight <= 0.5 ? x : y;
      }
    }
  }
}

/// Numbers of the file for rows that it does not have, behind its highest.
std::size_t number_rows(std::vector<std::int64_t>& numbers, std::size_t rows) {
  if (numbers.empty()) return 0;
  const std::size_t had = numbers.size();
  std::int64_t highest = *std::ranges::max_element(numbers);
  while (numbers.size() < rows) numbers.push_back(++highest);
  return rows - had;
}

void append_points(FileMesh& mesh, const VolumeMap& map, const Middles& middles,
                   DividedFile& report) {
  const std::size_t had = mesh.points.size(), points = had + middles.size();
  const auto fresh = map.points().subspan(had, middles.size());
  mesh.points.insert(mesh.points.end(), fresh.begin(), fresh.end());
  report.numbers_added += number_rows(mesh.source_point_id, points);
  for (DataColumn& column : mesh.point_data) {
    std::visit([&](auto& v) { append_between(v, column.components, points, middles); },
               column.values);
  }
  if (mesh.point_region.empty()) return;
  mesh.point_region.resize(points);
  for (const auto& [pair, middle] : middles) {
    const std::int32_t a = mesh.point_region[middle.ends[0]], b = mesh.point_region[middle.ends[1]];
    mesh.point_region[middle.point] = a == b ? a : 0;
  }
}

/// Rows of cells that are their parents' again: `parent[i]` of the i-th appended row.
template <class T>
void append_copies(std::vector<T>& values, const std::vector<std::size_t>& parents,
                   std::size_t components = 1) {
  if (values.empty()) return;
  for (const std::size_t parent : parents) {
    for (std::size_t k = 0; k < components; ++k) {
      values.push_back(values[parent * components + k]);
    }
  }
}

/// All columns of cells but their corners, for rows appended.
template <std::size_t N>
void append_cells(CellList<N>& cells, const std::vector<std::size_t>& parents,
                  DividedFile& report) {
  append_copies(cells.region, parents);
  append_copies(cells.entity, parents);
  for (DataColumn& column : cells.data) {
    std::visit([&](auto& v) { append_copies(v, parents, column.components); }, column.values);
  }
  report.numbers_added += number_rows(cells.source_id, cells.corners.size());
}

/// All but the corners, which the map has.
void divide_tetrahedra(FileMesh& mesh, const CellEdit& edit, const std::set<std::string>& shared,
                       DividedFile& report) {
  CellList<4>& cells = mesh.tetrahedra;
  std::vector<std::size_t> parents;
  for (const ChildCell& child : edit.cells) {  // appended rows rise
    if (child.tetrahedron == child.parent) {
      ++report.divided[3];
    } else {
      parents.push_back(child.parent.index());
    }
  }
  cells.corners.resize(cells.corners.size() + parents.size());
  append_cells(cells, parents, report);
  for (DataColumn& column : cells.data) {
    auto* numbers = std::get_if<std::vector<double>>(&column.values);
    if (numbers == nullptr || !shared.contains(column.name)) continue;
    for (const ChildCell& child : edit.cells) {
      for (std::size_t k = 0; k < column.components; ++k) {
        (*numbers)[child.tetrahedron.index() * column.components + k] *= child.share;
      }
    }
  }
}

using Triangle = std::array<std::uint32_t, 3>;

/// The parts of a triangle, turned as it is: four, or each divided edge in its turn.
std::vector<Triangle> parts_of(const Triangle& t, const Middles& middles) {
  const auto middle = [&](std::size_t a, std::size_t b) {
    const auto at = middles.find(std::minmax(t[a], t[b]));
    return at == middles.end() ? nullptr : &at->second;
  };
  const Middle *ab = middle(0, 1), *bc = middle(1, 2), *ca = middle(2, 0);
  if (ab != nullptr && bc != nullptr && ca != nullptr) {
    return {{t[0], ab->point, ca->point},
            {ab->point, t[1], bc->point},
            {ca->point, bc->point, t[2]},
            {ab->point, bc->point, ca->point}};
  }
  std::vector<const Middle*> turns;
  for (const Middle* m : {ab, bc, ca}) {
    if (m != nullptr) turns.push_back(m);
  }
  std::ranges::sort(turns, {}, [](const Middle* m) { return m->point; });
  std::vector<Triangle> parts{t};
  for (const Middle* m : turns) {
    for (std::size_t i = 0, n = parts.size(); i < n; ++i) {
      const auto a = std::ranges::find(parts[i], m->ends[0]);
      const auto b = std::ranges::find(parts[i], m->ends[1]);
      if (a == parts[i].end() || b == parts[i].end()) continue;
      Triangle other = parts[i];
      other[static_cast<std::size_t>(a - parts[i].begin())] = m->point;
      *b = m->point;
      parts.push_back(other);
    }
  }
  return parts;
}

std::vector<std::array<std::uint32_t, 2>> parts_of(const std::array<std::uint32_t, 2>& e,
                                                   const Middles& middles) {
  const auto at = middles.find(std::minmax(e[0], e[1]));
  if (at == middles.end()) return {e};
  return {{e[0], at->second.point}, {at->second.point, e[1]}};
}

template <std::size_t N>
void divide_cells(CellList<N>& cells, const Middles& middles, DividedFile& report) {
  std::vector<std::size_t> parents;
  for (std::size_t c = 0, n = cells.corners.size(); c < n; ++c) {
    const auto parts = parts_of(cells.corners[c], middles);
    report.divided[N - 1] += parts.size() > 1;
    cells.corners[c] = parts[0];
    for (std::size_t i = 1; i < parts.size(); ++i) {
      cells.corners.push_back(parts[i]);
      parents.push_back(c);
    }
  }
  append_cells(cells, parents, report);
}

}  // namespace

DividedFile divide_file(FileMesh& mesh, const VolumeMap& map, std::span<const CellEdit> edits,
                        const std::set<std::string>& shared) {
  DividedFile report;
  for (const CellEdit& edit : edits) {
    const Middles middles = middles_of(map, edit);
    append_points(mesh, map, middles, report);
    divide_tetrahedra(mesh, edit, shared, report);
    divide_cells(mesh.triangles, middles, report);
    divide_cells(mesh.edges, middles, report);
  }
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    for (std::size_t i = 0; i < 4; ++i) {
      mesh.tetrahedra.corners[t][i] = map.point_of_vertex(map.corners(TetId{t})[i]);
    }
  }
  return report;
}

}  // namespace sunder
