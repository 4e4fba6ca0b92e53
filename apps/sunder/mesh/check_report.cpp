// SPDX-License-Identifier: MIT
// Prints the results of a check: a table, or JSON.
#include "apps/sunder/mesh/check_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "apps/scene/words.hpp"
#include "apps/sunder/telling.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

using Json = nlohmann::ordered_json;

Json extreme_json(const Quality::Extreme& e) {
  return {{"value", e.value}, {"tetrahedron", e.tetrahedron}};
}

/// Arctangents differ in the last digit from machine to machine; a billionth of a degree does not.
Quality::Extreme rounded(Quality::Extreme angle) {
  angle.value = std::round(angle.value * 1e9) / 1e9;
  return angle;
}

double volume_ratio(const Quality& q) { return q.largest_volume.value / q.smallest_volume.value; }

Json quality_json(const Quality& q) {
  Json json{
      {"dihedral_angle",
       {{"smallest", extreme_json(rounded(q.smallest_dihedral))},
        {"largest", extreme_json(rounded(q.largest_dihedral))}}},
      {"radius_ratio",
       {{"smallest", extreme_json(q.smallest_radius_ratio)}, {"mean", q.mean_radius_ratio}}},
      {"volume",
       {{"smallest", extreme_json(q.smallest_volume)},
        {"largest", extreme_json(q.largest_volume)},
        {"ratio", nullptr}}},
      {"edge",
       {{"shortest", extreme_json(q.shortest_edge)}, {"longest", extreme_json(q.longest_edge)}}}};
  if (std::isfinite(volume_ratio(q))) json["volume"]["ratio"] = volume_ratio(q);
  return json;
}

/// "Z^2 + Z/3" of one dimension; "0" for nothing.
std::string group_text(const suite::IntegerHomology& homology, std::size_t dimension) {
  std::string text;
  const auto add = [&text](const std::string& part) {
    if (!text.empty()) text += " + ";
    text += part;
  };
  const std::size_t rank = homology.betti[dimension];
  if (rank > 0) add(rank == 1 ? "Z" : fmt::format("Z^{}", rank));
  for (const std::uint64_t n : homology.torsion[dimension]) add(fmt::format("Z/{}", n));
  return text.empty() ? "0" : text;
}

void print_homology(const suite::IntegerHomology& homology) {
  print("homology            ");
  for (std::size_t d = 0; d < 4; ++d) print(" H{} = {}", d, group_text(homology, d));
  print("\n");
}

void print_counts(const Counts& c) {
  print("vertices            {:>10}\nedges               {:>10}\nfaces               {:>10}\n",
        c.vertices, c.edges, c.faces);
  print("components          {:>10}\nboundary faces      {:>10}\nboundary sheets     {:>10}\n",
        c.components, c.boundary_faces, c.boundary_sheets);
  print("Euler characteristic{:>10}\nBetti numbers       {:>10}\nvolume, m^3         {:>10.6g}\n",
        c.euler_characteristic, betti_text(c), c.volume);
}

void print_range(const char* name, const Quality::Extreme& from, const Quality::Extreme& to) {
  print("{:<20}{:>10.4g} to {:.4g}  [{} {}]\n", name, from.value, to.value, from.tetrahedron,
        to.tetrahedron);
}

void print_quality(const Quality& q) {
  print_range("dihedral angles, deg", q.smallest_dihedral, q.largest_dihedral);
  print("radius ratios       {:>10.4g} at least, {:.4g} on average  [{}]\n",
        q.smallest_radius_ratio.value, q.mean_radius_ratio, q.smallest_radius_ratio.tetrahedron);
  print_range("volumes, m^3", q.smallest_volume, q.largest_volume);
  if (std::isfinite(volume_ratio(q))) {
    print("volume ratio        {:>10.4g}\n", volume_ratio(q));
  }
  print_range("edges, m", q.shortest_edge, q.longest_edge);
}

Json extent_json(const Extent& extent) {
  return {{"box", {{"low", extent.box.low}, {"high", extent.box.high}}}, {"centre", extent.centre}};
}

void print_extent(const Extent& extent) {
  const auto& [low, high] = extent.box;
  print("bounding box, m      ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})\n", low[0],
        low[1], low[2], high[0], high[1], high[2]);
  print("centre, m            ({:.6g}, {:.6g}, {:.6g})\n", extent.centre[0], extent.centre[1],
        extent.centre[2]);
}

/// kg; none without a density or a volume.
std::optional<double> mass_of(const CheckReport& report) {
  if (!report.density) return std::nullopt;
  if (report.counts) return *report.density * report.counts->volume;
  if (report.surface && report.surface->volume) {
    return *report.density * std::abs(*report.surface->volume);
  }
  return std::nullopt;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json surface_json(const CheckReport& report) {
  const SurfaceCheck& s = *report.surface;
  Json json{{"counts",
             {{"file_vertices", report.points},
              {"vertices", s.vertices},
              {"edges", s.edges},
              {"triangles", s.triangles},
              {"quadrilaterals", s.quadrilaterals},
              {"polygons", s.polygons},
              {"components", s.components},
              {"boundary_edges", s.boundary_edges}}},
            {"euler_characteristic", s.euler_characteristic},
            {"closed", s.is_closed},
            {"manifold", s.is_manifold},
            {"oriented", s.is_oriented},
            {"self_intersecting", or_null(s.crosses_itself)},
            {"area", s.area},
            {"volume", or_null(s.volume)}};
  json.update(extent_json(s.extent));
  return json;
}

void print_surface(const CheckReport& report) {
  const SurfaceCheck& s = *report.surface;
  const auto count = [](std::string_view name, std::size_t n) { print("{:<20}{:>10}\n", name, n); };
  count("points in the file", report.points);
  count("triangles", s.triangles);
  count("quadrilaterals", s.quadrilaterals);
  count("polygons", s.polygons);
  count("vertices", s.vertices);
  count("edges", s.edges);
  count("components", s.components);
  count("boundary edges", s.boundary_edges);
  print("Euler characteristic{:>10}\n", s.euler_characteristic);
  const auto answer = [](std::string_view name, std::string_view is_so) {
    print("{:<20}{:>10}\n", name, is_so);
  };
  answer("closed", yes_or_no(s.is_closed));
  answer("manifold", yes_or_no(s.is_manifold));
  answer("oriented", yes_or_no(s.is_oriented));
  answer("crosses itself", s.crosses_itself ? yes_or_no(*s.crosses_itself) : "-");
  print("area, m^2           {:>10.6g}\n", s.area);
  if (s.volume) print("volume, m^3         {:>10.6g}\n", *s.volume);
  print_extent(s.extent);
}

}  // namespace

Json report_json(const CheckReport& report) {
  Json json = Json::object();
  if (report.surface) {
    json = surface_json(report);
    if (report.density) json["mass"] = or_null(mass_of(report));
    json["findings"] = findings_json(report.findings);
    json["valid"] = !has_error(report.findings);
    return json;
  }
  Counts unknown;
  unknown.tetrahedra = report.tetrahedra;
  json["counts"] = cell_counts_json(report.points, report.counts ? *report.counts : unknown);
  json.update(invariants_json(report.counts ? *report.counts : unknown));
  if (!report.counts) {
    // Nothing is claimed that was not counted.
    for (auto& [key, value] : json["counts"].items()) {
      const bool known = report.is_read && (key == "file_vertices" || key == "tetrahedra");
      if (!known) value = nullptr;
    }
    for (const char* key : {"euler_characteristic", "betti", "volume"}) json[key] = nullptr;
  }
  if (report.homology) {
    json["homology"] = {{"betti", report.homology->betti}, {"torsion", report.homology->torsion}};
  }
  if (report.extent) json.update(extent_json(*report.extent));
  if (report.density) json["mass"] = or_null(mass_of(report));
  json["quality"] = report.quality ? quality_json(*report.quality) : Json(nullptr);
  if (!report.findings_file.empty()) {
    json["findings_file"] = {{"cells", report.cells_written}, {"path", nullptr}};
    if (report.cells_written > 0) json["findings_file"]["path"] = report.findings_file.string();
  }
  json["findings"] = findings_json(report.findings);
  json["valid"] = !has_error(report.findings);
  return json;
}

void print_table(const CheckReport& report) {
  if (report.surface) {
    print_surface(report);
  } else if (report.is_read) {
    print("points in the file  {:>10}\ntetrahedra          {:>10}\n", report.points,
          report.tetrahedra);
  }
  if (report.counts) print_counts(*report.counts);
  if (report.homology) print_homology(*report.homology);
  if (report.extent) print_extent(*report.extent);
  if (const auto mass = mass_of(report)) print("mass, kg            {:>10.6g}\n", *mass);
  if (report.quality) print_quality(*report.quality);
  write_text(stdout, finding_lines(report.findings, shows_colours(STDOUT_FILENO)));
  if (report.cells_written > 0) {
    print("{}: {} that findings name\n", report.findings_file.string(),
          counted(report.cells_written, "cell"));
  } else if (!report.findings_file.empty()) {
    print("no finding names a cell: nothing is written\n");
  }
  print("{}\n", has_error(report.findings) ? "not valid" : "valid");
}

}  // namespace sunder
