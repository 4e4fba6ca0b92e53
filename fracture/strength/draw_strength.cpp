// SPDX-License-Identifier: MIT
// Checks of strength settings, and the columns they become.
#include "fracture/strength/draw_strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "topology/kernel/fan.hpp"
#include "topology/mesh/region_list.hpp"

namespace sunder {
namespace {

/// One step of splitmix64 from the state `x`.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

constexpr double ln2 = 0.693147180559945309417;

// Those of the C library round differently from machine to machine; these use + - * / alone.
double plain_log(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  const double t = (m - 1) / (m + 1), square = t * t;
  double series = 0;
  for (int k = 14; k >= 0; --k) series = series * square + 1.0 / (2 * k + 1);
  return 2 * t * series + exponent * ln2;
}
double plain_exp(double x) {
  const double n = std::floor(x / ln2 + 0.5);
  const double r = x - n * ln2;
  double series = 1;
  for (int k = 18; k >= 1; --k) series = 1 + series * r / k;
  return std::ldexp(series, static_cast<int>(n));
}

std::int32_t region_of(const TetMesh& mesh, std::size_t t) {
  return mesh.region.empty() ? 0 : mesh.region[t];
}

void add_unknown_region(fields::SettingsCheck& to, const std::string& where, const RegionName& name,
                        const TetMesh& mesh) {
  to.add("unknown_region", where,
         fmt::format("is '{}': no tetrahedron of the mesh has it", name.text),
         region_list(mesh.region, mesh.region_name));
}

void check_regions(fields::SettingsCheck& to, const BodySettings& body) {
  std::vector<std::int32_t> seen;
  for (std::size_t i = 0; i < body.strength.regions.size(); ++i) {
    const RegionStrength& r = body.strength.regions[i];
    const std::string where = fmt::format("strength.regions.{}", i);
    const auto region = find_region(body.mesh, r.region);
    if (!region) {
      add_unknown_region(to, where + ".region", r.region, body.mesh);
      continue;
    }
    if (std::ranges::find(seen, *region) != seen.end()) {
      to.add("repeated_region", where, fmt::format("names region {} again", *region),
             "give each region one entry");
    }
    seen.push_back(*region);
  }
}

void check_painted(fields::SettingsCheck& to, const BodySettings& body) {
  const std::vector<double>& painted = body.strength.painted;
  if (painted.empty()) return;
  if (painted.size() != body.mesh.points.size()) {
    to.add("painted_strength", "strength.painted",
           fmt::format("has {} numbers for {} points", painted.size(), body.mesh.points.size()),
           "give one strength in Pa a point");
    return;
  }
  for (const auto& corners : body.mesh.tetrahedra) {
    for (const std::uint32_t p : corners) {
      // Indices of a bad mesh are its own findings.
      if (p >= painted.size() || (painted[p] > 0 && std::isfinite(painted[p]))) continue;
      to.add("painted_strength", "strength.field", fmt::format("is {} at point {}", painted[p], p),
             "paint strengths above 0, Pa, on every point that tetrahedra use");
      return;
    }
  }
}

void check_unbreakable(fields::SettingsCheck& to, const BodySettings& body) {
  for (std::size_t i = 0; i < body.unbreakable.size(); ++i) {
    const std::string where = fmt::format("unbreakable.{}", i);
    const auto* name = std::get_if<RegionName>(&body.unbreakable[i].where);
    if (name != nullptr && !find_region(body.mesh, *name)) {
      add_unknown_region(to, where + ".region", *name, body.mesh);
    }
  }
}

/// m^3 of every point of the map's file: a quarter of the tetrahedra there.
std::vector<double> point_volumes(const Cells& cells, const MechanicsState& mechanics) {
  std::vector<double> volume(cells.map.points().size(), 0);
  for (std::size_t t = 0; t < mechanics.elements.size(); ++t) {
    for (const VertexId v : cells.map.corners(TetId{t})) {
      volume[cells.map.point_of_vertex(v)] += mechanics.elements.rest_volume[t] / 4;
    }
  }
  return volume;
}

void mark_unbreakable(Cells& cells, const BodySettings& body, const BodyRows& rows) {
  for (const UnbreakablePart& part : body.unbreakable) {
    const auto* name = std::get_if<RegionName>(&part.where);
    const auto* box = std::get_if<RestBox>(&part.where);
    const std::int32_t region = name != nullptr ? find_region(body.mesh, *name).value_or(0) : 0;
    for (std::size_t t = rows.first_tetrahedron; t < rows.end_tetrahedron; ++t) {
      for (const VertexId v : cells.map.corners(TetId{t})) {
        const Point& p = cells.map.point(v);
        const bool marked =
            box != nullptr
                ? Eigen::AlignedBox3d(box->minimum, box->maximum).contains(Vec3(p[0], p[1], p[2]))
                : region_of(body.mesh, t - rows.first_tetrahedron) == region;
        if (marked) cells.unbreakable[v.index()] = 1;
      }
    }
  }
}

}  // namespace

double weibull_factor(const WeibullSettings& settings, const DrawPlace& place) {
  const std::uint64_t bits = mixed(mixed(mixed(settings.seed) ^ place.body) ^ place.point);
  const double uniform = (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;  // never 0, never 1
  const double hazard = -plain_log(uniform) * settings.reference_volume / place.volume;
  return plain_exp(plain_log(hazard) / settings.modulus);
}

std::optional<std::int32_t> find_region(const TetMesh& mesh, const RegionName& name) {
  std::int32_t region = 0;
  const auto named = std::ranges::find_if(
      mesh.region_name, [&](const auto& entry) { return entry.second == name.text; });
  if (named != mesh.region_name.end()) {
    region = named->first;
  } else {
    const char* const end = name.text.data() + name.text.size();
    const auto [stop, reason] = std::from_chars(name.text.data(), end, region);
    if (reason != std::errc{} || stop != end) return std::nullopt;
  }
  const bool used = mesh.region.empty()
                        ? region == 0
                        : std::ranges::find(mesh.region, region) != mesh.region.end();
  if (!used) return std::nullopt;
  return region;
}

void check_strength(fields::SettingsCheck& check, const BodySettings& body) {
  check_regions(check, body);
  check_painted(check, body);
  check_unbreakable(check, body);
}

BodyMaterials materials_of(const BodySettings& body) {
  BodyMaterials result;
  result.materials.push_back(body.material);
  result.of_tetrahedron.assign(body.mesh.tetrahedra.size(), 0);
  for (const RegionStrength& r : body.strength.regions) {
    const auto row = static_cast<std::uint32_t>(result.materials.size());
    Material material = body.material;
    if (r.tensile_strength) material.tensile_strength = *r.tensile_strength;
    if (r.toughness) material.toughness = r.toughness;
    result.materials.push_back(material);
    const std::int32_t region = find_region(body.mesh, r.region).value_or(0);
    for (std::size_t t = 0; t < result.of_tetrahedron.size(); ++t) {
      if (region_of(body.mesh, t) == region) result.of_tetrahedron[t] = row;
    }
  }
  return result;
}

void draw_strengths(Cells& cells, const MechanicsState& mechanics,
                    std::span<const BodySettings> bodies, std::span<const BodyRows> rows) {
  const std::vector<double> volume = point_volumes(cells, mechanics);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    mark_unbreakable(cells, bodies[b], rows[b]);
    const StrengthSettings& settings = bodies[b].strength;
    for (std::size_t v = 0; v < cells.map.vertices(); ++v) {
      const std::uint32_t point = cells.map.point_of_vertex(VertexId{v});
      if (point < rows[b].first_point || point >= rows[b].end_point) continue;
      const std::size_t own = point - rows[b].first_point;
      if (!settings.painted.empty()) cells.painted[v] = settings.painted[own];
      if (settings.weibull) {
        cells.flaw[v] = weibull_factor(*settings.weibull, {b, own, volume[point]});
      }
    }
  }
  for (std::size_t v = 0; v < cells.map.vertices(); ++v) {
    cells.strength[v] =
        vertex_strength(cells, mechanics, VertexId{v}, star(cells.map, VertexId{v}));
  }
}

}  // namespace sunder
