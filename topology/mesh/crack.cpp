// SPDX-License-Identifier: MIT
// Points as orbits: the parts of their stars that hang together across faces that are not cut.
#include "topology/mesh/crack.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "topology/base/assert.hpp"
#include "topology/base/star_parts.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder {
namespace {

/// Tetrahedra around the points that cut faces have, by point: first[i] to first[i + 1].
struct Stars {
  std::vector<std::uint32_t> points;
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> tetrahedra;
};

Stars stars_of(const FileMesh& mesh, const CutFaces& faces) {
  const auto& corners = mesh.tetrahedra.corners;
  std::vector<std::uint32_t> place(mesh.points.size(), FaceLinks::none);
  Stars stars;
  for (const std::uint32_t face : faces) {
    for (const std::uint32_t point : corners_of_face(corners[face / 4], HalfFaceId{face})) {
      if (place[point] == FaceLinks::none) stars.points.push_back(point);
      place[point] = 0;
    }
  }
  std::ranges::sort(stars.points);
  for (std::uint32_t i = 0; i < stars.points.size(); ++i) place[stars.points[i]] = i;
  stars.first.assign(stars.points.size() + 1, 0);
  const auto for_each_corner = [&](auto work) {
    for (std::uint32_t t = 0; t < corners.size(); ++t) {
      for (const std::uint32_t point : corners[t]) {
        if (place[point] != FaceLinks::none) work(place[point], t);
      }
    }
  };
  for_each_corner([&](std::uint32_t i, std::uint32_t) { ++stars.first[i + 1]; });
  std::partial_sum(stars.first.begin(), stars.first.end(), stars.first.begin());
  stars.tetrahedra.resize(stars.first.back());
  std::vector<std::uint32_t> next = stars.first;
  for_each_corner([&](std::uint32_t i, std::uint32_t t) { stars.tetrahedra[next[i]++] = t; });
  return stars;
}

/// The parts of a star across faces that are not cut: for each of its tetrahedra the place of the
/// first of its part.
std::vector<std::uint32_t> parts_of(std::span<const std::uint32_t> star, const FaceLinks& links,
                                    const std::vector<std::uint8_t>* cut) {
  return star_parts(star, [&](std::uint32_t t, int p) -> std::optional<std::uint32_t> {
    const std::uint32_t across = links.across[t][static_cast<std::size_t>(p)];
    if (across == FaceLinks::none) return std::nullopt;
    if (cut != nullptr && ((*cut)[t] >> p & 1) != 0) return std::nullopt;
    return across / 4;
  });
}

/// Gives the corners of a star their copies; `copies` grows.
void part_star(FileMesh& mesh, std::uint32_t point, std::span<const std::uint32_t> star,
               const std::array<std::vector<std::uint32_t>, 2>& parts, Crack& crack) {
  const auto& [before, after] = parts;
  std::vector<std::uint32_t> row(star.size(), point);
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    if (after[i] == before[i]) continue;
    if (after[i] == i) {
      row[i] = static_cast<std::uint32_t>(mesh.points.size() + crack.copies.size());
      crack.copies.push_back({point, row[i]});
    } else {
      row[i] = row[after[i]];
    }
    std::ranges::replace(mesh.tetrahedra.corners[star[i]], point, row[i]);
  }
}

template <class Value>
void append_copies(std::vector<Value>& column, const Crack& crack, std::size_t components = 1) {
  if (column.empty()) return;
  column.reserve(column.size() + crack.copies.size() * components);
  for (const auto& [point, copy] : crack.copies) {
    for (std::size_t k = 0; k < components; ++k) {
      column.push_back(Value(column[point * components + k]));
    }
  }
}

void append_points(FileMesh& mesh, const Crack& crack) {
  append_copies(mesh.points, crack);
  append_copies(mesh.source_point_id, crack);
  append_copies(mesh.point_region, crack);
  for (DataColumn& column : mesh.point_data) {
    std::visit([&](auto& values) { append_copies(values, crack, column.components); },
               column.values);
  }
}

template <std::size_t N>
std::array<std::uint32_t, N> sorted(std::array<std::uint32_t, N> points) {
  std::ranges::sort(points);
  return points;
}

/// Calls `work` with the places of N of the four corners, in every way to choose them.
template <std::size_t N, class Work>
void for_each_choice(Work work) {
  for (unsigned bits = 1; bits < 16; ++bits) {
    std::array<std::size_t, N> places{};
    std::size_t n = 0, all = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if ((bits >> k & 1) == 0) continue;
      if (all++ < N) places[n++] = k;
    }
    if (all == N) work(places);
  }
}

/// Cells of lower dimension follow the tetrahedron of lowest row that they belong to. `before`: the
/// corners of tetrahedra before the cut; `is_apart`: of points, whether they have copies.
template <std::size_t N>
void move_cells(CellList<N>& cells, const FileMesh& mesh,
                const std::vector<std::array<std::uint32_t, 4>>& before,
                const std::vector<char>& is_apart) {
  const auto touches = [&](const auto& corners) {
    return std::ranges::any_of(corners, [&](std::uint32_t p) { return is_apart[p] != 0; });
  };
  std::map<std::array<std::uint32_t, N>, std::optional<std::array<std::uint32_t, N>>> moved;
  for (const auto& corners : cells.corners) {
    if (touches(corners)) moved.try_emplace(sorted(corners));
  }
  if (moved.empty()) return;
  for (std::size_t t = 0; t < before.size(); ++t) {
    if (!touches(before[t])) continue;
    for_each_choice<N>([&](const std::array<std::size_t, N>& places) {
      std::array<std::array<std::uint32_t, 2>, N> rows;  // before and after, sorted by before
      std::array<std::uint32_t, N> key, to;
      for (std::size_t k = 0; k < N; ++k) {
        rows[k] = {before[t][places[k]], mesh.tetrahedra.corners[t][places[k]]};
      }
      std::ranges::sort(rows);
      for (std::size_t k = 0; k < N; ++k) key[k] = rows[k][0], to[k] = rows[k][1];
      const auto found = moved.find(key);
      if (found != moved.end() && !found->second) found->second = to;
    });
  }
  for (auto& corners : cells.corners) {
    if (!touches(corners)) continue;
    const auto& [key, to] = *moved.find(sorted(corners));
    if (!to) continue;
    for (std::uint32_t& corner : corners) {
      corner = (*to)[static_cast<std::size_t>(std::ranges::find(key, corner) - key.begin())];
    }
  }
}

CrackFace crack_face(const FileMesh& mesh, const FaceLinks& links,
                     const std::vector<std::array<std::uint32_t, 4>>& before, std::uint32_t face) {
  const std::uint32_t other = links.across[face / 4][face % 4] / 4;
  CrackFace sides{{face / 4, other}, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto place = static_cast<std::size_t>(dart_order::face_corners[face % 4][k]);
    const std::uint32_t point = before[face / 4][place];
    const auto opposite =
        static_cast<std::size_t>(std::ranges::find(before[other], point) - before[other].begin());
    sides.points[0][k] = mesh.tetrahedra.corners[face / 4][place];
    sides.points[1][k] = mesh.tetrahedra.corners[other][opposite];
  }
  return sides;
}

std::size_t triangles_on(const FileMesh& mesh, const CutFaces& faces) {
  std::vector<std::array<std::uint32_t, 3>> cut;
  for (const std::uint32_t face : faces) {
    cut.push_back(sorted(corners_of_face(mesh.tetrahedra.corners[face / 4], HalfFaceId{face})));
  }
  std::ranges::sort(cut);
  return static_cast<std::size_t>(std::ranges::count_if(mesh.triangles.corners, [&](const auto& t) {
    return std::ranges::binary_search(cut, sorted(t));
  }));
}

}  // namespace

Crack open_crack(FileMesh& mesh, const FaceLinks& links, const CutFaces& faces) {
  SUNDER_ASSERT(links.across.size() == mesh.tetrahedra.corners.size(), "links of this mesh");
  Crack crack;
  crack.triangles_on_it = triangles_on(mesh, faces);
  // A star asks each face of the tetrahedron of lower row, which is the side that is given.
  std::vector<std::uint8_t> cut(links.across.size(), 0);
  for (const std::uint32_t face : faces) {
    SUNDER_ASSERT(links.across[face / 4][face % 4] != FaceLinks::none,
                  "a cut face lies between two tetrahedra");
    cut[face / 4] = static_cast<std::uint8_t>(cut[face / 4] | 1U << face % 4);
  }
  const auto before = mesh.tetrahedra.corners;
  const Stars stars = stars_of(mesh, faces);
  std::vector<char> is_apart(mesh.points.size(), 0);
  for (std::size_t i = 0; i < stars.points.size(); ++i) {
    const std::span star(stars.tetrahedra.data() + stars.first[i],
                         stars.first[i + 1] - stars.first[i]);
    const std::size_t copies = crack.copies.size();
    part_star(mesh, stars.points[i], star,
              {parts_of(star, links, nullptr), parts_of(star, links, &cut)}, crack);
    is_apart[stars.points[i]] = crack.copies.size() > copies;
  }
  append_points(mesh, crack);
  // Vertices stay: the tetrahedron of lowest row at a point keeps the point.
  move_cells(mesh.edges, mesh, before, is_apart);
  move_cells(mesh.triangles, mesh, before, is_apart);
  for (const std::uint32_t face : faces) {
    crack.faces.push_back(crack_face(mesh, links, before, face));
    crack.closed_faces += crack.faces.back().points[0] == crack.faces.back().points[1];
  }
  return crack;
}

}  // namespace sunder
