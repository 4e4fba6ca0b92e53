// SPDX-License-Identifier: MIT
// A grid of tetrahedra, exact axes, sums over corners.
#include "tests/experiments/rubble/overlap_judge.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <variant>

#include <Eigen/Geometry>

#include "mechanics/rubble/manifold.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder::test {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct Box {
  Vec3 low, high;
};

std::array<Vec3, 4> corners_of(const JudgedFrame& frame, std::size_t t) {
  std::array<Vec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = frame.points[frame.tetrahedra[t][k]];
  return corners;
}

double volume(const std::array<Vec3, 4>& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]) / 6;
}

Polytope solid_of(const JudgedFrame& frame, std::size_t t) {
  std::array<Vec3, 4> corners = corners_of(frame, t);
  if (volume(corners) < 0) std::swap(corners[2], corners[3]);
  return make_tetrahedron(corners);
}

Box box_of(const JudgedFrame& frame, std::size_t t) {
  const std::array<Vec3, 4> c = corners_of(frame, t);
  return {c[0].cwiseMin(c[1]).cwiseMin(c[2].cwiseMin(c[3])),
          c[0].cwiseMax(c[1]).cwiseMax(c[2].cwiseMax(c[3]))};
}

bool overlap(const Box& a, const Box& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

double mean_edge_of(const JudgedFrame& frame) {
  double sum = 0;
  for (std::size_t t = 0; t < frame.tetrahedra.size(); ++t) {
    const std::array<Vec3, 4> c = corners_of(frame, t);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) sum += (c[a] - c[b]).norm();
    }
  }
  return sum / (6 * std::max<double>(1, static_cast<double>(frame.tetrahedra.size())));
}

Cell cell_of(const Vec3& at, double size) {
  return {static_cast<std::int64_t>(std::floor(at[0] / size)),
          static_cast<std::int64_t>(std::floor(at[1] / size)),
          static_cast<std::int64_t>(std::floor(at[2] / size))};
}

/// Calls `look(a, b)` for pairs whose boxes overlap, each once: in the lowest cell both are in.
template <class Look>
void for_each_near_pair(const std::vector<Box>& boxes, double size, Look look) {
  std::vector<std::pair<Cell, std::uint32_t>> entries;
  for (std::uint32_t t = 0; t < boxes.size(); ++t) {
    const Cell low = cell_of(boxes[t].low, size), high = cell_of(boxes[t].high, size);
    Cell at;
    for (at[0] = low[0]; at[0] <= high[0]; ++at[0]) {
      for (at[1] = low[1]; at[1] <= high[1]; ++at[1]) {
        for (at[2] = low[2]; at[2] <= high[2]; ++at[2]) entries.emplace_back(at, t);
      }
    }
  }
  std::ranges::sort(entries);
  for (std::size_t first = 0, end = 0; first < entries.size(); first = end) {
    while (end < entries.size() && entries[end].first == entries[first].first) ++end;
    for (std::size_t i = first; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        const Box &a = boxes[entries[i].second], &b = boxes[entries[j].second];
        if (!overlap(a, b)) continue;
        if (cell_of(a.low.cwiseMax(b.low), size) != entries[first].first) continue;
        look(entries[i].second, entries[j].second);
      }
    }
  }
}

/// Adds one pair; `sum` of depths, m.
void look_at(Verdict& v, double& sum, const JudgedFrame& frame, std::uint32_t a, std::uint32_t b) {
  if (frame.piece[a] == frame.piece[b]) return;
  const double depth = -separation_by_all_axes(solid_of(frame, a), solid_of(frame, b));
  if (!(depth > 1e-6 * v.mean_edge)) return;
  ++v.pairs;
  sum += depth;
  if (depth / v.mean_edge <= v.deepest) return;
  v.deepest = depth / v.mean_edge;
  v.where = {a, b};
}

void judge_floor(Verdict& v, const JudgedFrame& frame, double floor) {
  for (const Vec3& p : frame.points) {
    v.lowest = std::max(v.lowest, (floor - p[2]) / v.mean_edge);
    v.below += floor - p[2] > 1e-3 * v.mean_edge;
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

/// All but the pairs.
Verdict begin_verdict(const JudgedFrame& frame, double floor) {
  Verdict v;
  v.mean_edge = mean_edge_of(frame);
  judge_floor(v, frame, floor);
  add_motion(v, frame);
  return v;
}

void end_verdict(Verdict& v, double sum) {
  if (v.pairs > 0) v.mean = sum / (v.mean_edge * static_cast<double>(v.pairs));
}

/// A column of so many numbers a row, as doubles; empty where there is none of that name.
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

Verdict judge_frame(const JudgedFrame& frame, double floor) {
  Verdict v = begin_verdict(frame, floor);
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < frame.tetrahedra.size(); ++t) boxes.push_back(box_of(frame, t));
  double sum = 0;
  for_each_near_pair(boxes, v.mean_edge, [&](std::uint32_t a, std::uint32_t b) {
    look_at(v, sum, frame, std::min(a, b), std::max(a, b));
  });
  end_verdict(v, sum);
  return v;
}

Verdict judge_frame_slowly(const JudgedFrame& frame, double floor) {
  Verdict v = begin_verdict(frame, floor);
  double sum = 0;
  for (std::uint32_t a = 0; a < frame.tetrahedra.size(); ++a) {
    for (std::uint32_t b = a + 1; b < frame.tetrahedra.size(); ++b) look_at(v, sum, frame, a, b);
  }
  end_verdict(v, sum);
  return v;
}

Result<JudgedFrame> read_judged_frame(const std::string& path) {
  Result<FileMesh> file = read_file_mesh(path);
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
