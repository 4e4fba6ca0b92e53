// SPDX-License-Identifier: MIT
#include "tests/experiments/rubble/frame_judge.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <variant>

#include <Eigen/Geometry>

#include "mechanics/contact/shapes/manifold.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder::test {
namespace {

std::array<Vec3, 4> corners_of(const JudgedFrame& frame, std::size_t t) {
  std::array<Vec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = frame.points[frame.tetrahedra[t][k]];
  return corners;
}

double volume(const std::array<Vec3, 4>& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]) / 6;
}

void judge_floor(Verdict& v, const JudgedFrame& frame, double floor) {
  for (const Vec3& p : frame.points) {
    v.lowest = std::max(v.lowest, floor - p[2]);
    v.below += floor - p[2] > 1e-3 * v.overlaps.edge;
  }
  std::map<std::uint32_t, std::pair<double, double>> middle;  // of each piece: volume, its moment
  for (std::size_t t = 0; t < frame.tetrahedra.size(); ++t) {
    const std::array<Vec3, 4> c = corners_of(frame, t);
    auto& [whole, moment] = middle[frame.piece[t]];
    const double size = std::abs(volume(c));
    whole += size;
    moment += size * 0.25 * (c[0] + c[1] + c[2] + c[3])[2];
  }
  v.pieces = middle.size();
  for (const auto& [piece, sums] : middle) v.through += sums.second < floor * sums.first;
}

void add_motion(Verdict& v, const JudgedFrame& frame) {
  if (frame.velocity.empty()) return;
  for (const std::array<std::uint32_t, 4>& rows : frame.tetrahedra) {
    std::array<Vec3, 4> rest;
    for (std::size_t k = 0; k < 4; ++k) {
      rest[k] = frame.points[rows[k]];
      if (!frame.shift.empty()) rest[k] -= frame.shift[rows[k]];
    }
    const double share = std::abs(volume(rest)) / 4;
    for (const std::uint32_t p : rows) {
      const Vec3& u = frame.velocity[p];
      v.momentum += share * u;
      v.angular += share * frame.points[p].cross(u);
      v.kinetic += 0.5 * share * u.squaredNorm();
      v.fastest = std::max(v.fastest, u.norm());
    }
  }
}

/// A column of so many numbers per row, as doubles; empty where there is none of that name.
std::vector<double> numbers(const std::vector<DataColumn>& columns, const std::string& name) {
  for (const DataColumn& column : columns) {
    if (column.name != name) continue;
    return std::visit([](const auto& v) { return std::vector<double>(v.begin(), v.end()); },
                      column.values);
  }
  return {};
}

std::vector<Vec3> vectors(const std::vector<DataColumn>& columns, const std::string& name) {
  const std::vector<double> flat = numbers(columns, name);
  std::vector<Vec3> rows;
  for (std::size_t k = 0; k + 2 < flat.size(); k += 3) {
    rows.emplace_back(flat[k], flat[k + 1], flat[k + 2]);
  }
  return rows;
}

}  // namespace

std::vector<SeenPart> parts_of(const JudgedFrame& frame) {
  std::vector<SeenPart> parts;
  for (std::size_t t = 0; t < frame.tetrahedra.size(); ++t) {
    std::array<Vec3, 4> corners = corners_of(frame, t);
    if (volume(corners) < 0) std::swap(corners[2], corners[3]);
    parts.push_back({make_tetrahedron(corners), frame.piece[t]});
  }
  return parts;
}

Verdict judge_frame(const JudgedFrame& frame, double floor) {
  Verdict v;
  v.overlaps = see_overlaps(parts_of(frame));
  judge_floor(v, frame, floor);
  add_motion(v, frame);
  return v;
}

Result<JudgedFrame> read_judged_frame(const std::string& path) {
  Result<FileMesh> file = read_file_mesh(path, {.simplices = true});
  Result<JudgedFrame> result;
  result.findings = std::move(file.findings);
  if (!file) return result;
  JudgedFrame frame;
  for (const Point& p : file->points) frame.points.emplace_back(p[0], p[1], p[2]);
  frame.velocity = vectors(file->point_data, "velocity");
  frame.shift = vectors(file->point_data, "displacement");
  frame.tetrahedra = file->tetrahedra.corners;
  for (const double c : numbers(file->tetrahedra.data, "component")) {
    frame.piece.push_back(static_cast<std::uint32_t>(c));
  }
  if (frame.piece.size() != frame.tetrahedra.size()) {
    result.findings.push_back(
        {.code = "no_pieces",
         .text = path + ": no cell data `component` that says whose piece each tetrahedron is",
         .remedy = "give frames of `sunder run`"});
    return result;
  }
  result.value = std::move(frame);
  return result;
}

}  // namespace sunder::test
