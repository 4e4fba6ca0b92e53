// SPDX-License-Identifier: MIT
// Which faces a crack cuts, as a user names them: by their points, by a plane, by two regions.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "topology/kernel/kernel.hpp"
#include "topology/mesh/crack.hpp"
#include "topology/mesh/face_table.hpp"
#include "topology/mesh/region_list.hpp"

namespace sunder {
namespace {

/// A listed face by its points in rising order, and its place in the list.
struct ListedFace {
  std::array<std::uint32_t, 3> points;
  std::uint32_t place;
  friend auto operator<=>(const ListedFace&, const ListedFace&) = default;
};

std::array<std::uint32_t, 3> points_of(const FileMesh& mesh, std::uint32_t face) {
  auto points = corners_of_face(mesh.tetrahedra.corners[face / 4], HalfFaceId{face});
  std::ranges::sort(points);
  return points;
}

/// The interior faces that `is_cut(t, other)` chooses, once each.
template <class IsCut>
CutFaces chosen(const FaceLinks& links, IsCut is_cut) {
  CutFaces faces;
  for (std::uint32_t t = 0; t < links.across.size(); ++t) {
    for (std::uint32_t p = 0; p < 4; ++p) {
      const std::uint32_t across = links.across[t][p];
      if (across == FaceLinks::none || across / 4 < t || !is_cut(t, across / 4)) continue;
      faces.push_back(4 * t + p);
    }
  }
  return faces;
}

Result<CutFaces> some(CutFaces faces, std::string text) {
  if (!faces.empty()) return faces;
  return Finding{.code = "no_face",
                 .text = std::move(text),
                 .remedy = "name faces inside the body: `sunder check` prints its size"};
}

}  // namespace

Result<std::int32_t> region_called(const FileMesh& mesh, std::string_view word) {
  std::int32_t number = 0;
  const auto [end, reason] = std::from_chars(word.data(), word.data() + word.size(), number);
  bool is_known = reason == std::errc{} && end == word.data() + word.size();
  for (const auto& [region, name] : mesh.region_name[3]) {
    if (name != word) continue;
    number = region;
    is_known = true;
  }
  std::vector<std::int32_t> known = label_of(mesh.tetrahedra);
  if (is_known && std::ranges::find(known, number) != known.end()) return number;
  return Finding{.code = "unknown_region",
                 .text = fmt::format("no tetrahedron is in a region '{}'", word),
                 .remedy = region_list(std::move(known), mesh.region_name[3])};
}

std::optional<Finding> too_many_to_link(std::size_t tetrahedra) {
  // The highest face of 2^30 would be `none`.
  if (tetrahedra <= FaceLinks::none / 4) return std::nullopt;
  return Finding{
      .code = "too_many_tetrahedra",
      .text = fmt::format("{} tetrahedra: their faces are numbered in 32 bits", tetrahedra),
      .remedy = "give fewer than 2^30"};
}

Result<FaceLinks> face_links(const FileMesh& mesh) {
  const std::size_t n = mesh.tetrahedra.corners.size();
  if (auto finding = too_many_to_link(n)) return *finding;
  FaceLinks links;
  links.across.assign(n, {FaceLinks::none, FaceLinks::none, FaceLinks::none, FaceLinks::none});
  std::optional<Finding> overfull;
  const FaceTable table = face_table(mesh.tetrahedra.corners, mesh.points.size());
  for_each_face(table, [&](const auto& points, std::span<const TableFace> sides) {
    if (sides.size() == 2) {
      const std::uint32_t a = sides[0].half_face, b = sides[1].half_face;
      links.across[a / 4][a % 4] = b;
      links.across[b / 4][b % 4] = a;
    } else if (sides.size() > 2 && !overfull) {
      overfull = Finding{
          .code = "overfull_face",
          .ids = {sides[0].half_face / 4, sides[1].half_face / 4, sides[2].half_face / 4},
          .text = fmt::format("more than two tetrahedra share the face on points {}, {}, {}: a "
                              "crack has two sides",
                              points[0], points[1], points[2]),
          .remedy = "drop the tetrahedra too many (--drop-duplicates drops copies)"};
    }
  });
  if (overfull) return *overfull;
  return links;
}

Result<CutFaces> listed_faces(const FileMesh& mesh, const FaceLinks& links,
                              std::span<const std::array<std::uint32_t, 3>> points) {
  std::vector<ListedFace> wanted;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    auto rising = points[i];
    std::ranges::sort(rising);
    wanted.push_back({rising, i});
  }
  std::ranges::sort(wanted);
  std::vector<char> found(points.size(), 0);
  CutFaces faces = chosen(links, [](std::uint32_t, std::uint32_t) { return true; });
  std::erase_if(faces, [&](std::uint32_t face) {
    const auto rising = points_of(mesh, face);
    const auto first = std::ranges::lower_bound(wanted, rising, {}, &ListedFace::points);
    for (auto it = first; it != wanted.end() && it->points == rising; ++it) found[it->place] = 1;
    return first == wanted.end() || first->points != rising;
  });
  Finding missing{
      .code = "not_interior", .count = 0, .remedy = "list faces that two tetrahedra share"};
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] != 0) continue;
    if (missing.count++ == 0) {
      missing.text = fmt::format("on points {}, {}, {} there is no face of two tetrahedra",
                                 points[i][0], points[i][1], points[i][2]);
    }
    if (missing.ids.size() < Finding::max_ids) missing.ids.push_back(static_cast<std::int64_t>(i));
  }
  if (missing.count > 0) return missing;
  return some(std::move(faces), "the list has no face");
}

Result<CutFaces> section_faces(const FileMesh& mesh, const FaceLinks& links,
                               const CuttingPlane& plane) {
  const std::optional<PlaneThrough> through = read_plane(plane);
  if (!through) {
    return Finding{.code = "not_a_direction",
                   .text = "the normal is zero or not finite (or the plane's offset is not finite)",
                   .remedy = "give a normal of three finite numbers, not all zero"};
  }
  std::vector<char> positive(links.across.size());
  for (std::size_t t = 0; t < positive.size(); ++t) {
    const auto& c = mesh.tetrahedra.corners[t];
    const auto& x = mesh.points;
    positive[t] = is_positive(*through, {x[c[0]], x[c[1]], x[c[2]], x[c[3]]}) ? 1 : 0;
  }
  return some(chosen(links, [&](auto t, auto other) { return positive[t] != positive[other]; }),
              "all tetrahedra have their centres on one side of the plane");
}

Result<CutFaces> interface_faces(const FileMesh& mesh, const FaceLinks& links,
                                 std::array<std::string_view, 2> regions) {
  std::array<std::int32_t, 2> numbers;
  for (std::size_t i = 0; i < 2; ++i) {
    const Result<std::int32_t> number = region_called(mesh, regions[i]);
    if (!number) return number.findings.front();
    numbers[i] = *number;
  }
  const auto& label = label_of(mesh.tetrahedra);
  const auto [a, b] = numbers;
  return some(chosen(links,
                     [&, a = a, b = b](auto t, auto other) {
                       return (label[t] == a && label[other] == b) ||
                              (label[t] == b && label[other] == a);
                     }),
              fmt::format("no tetrahedron of region {} shares a face with one of region {}",
                          regions[0], regions[1]));
}

}  // namespace sunder
