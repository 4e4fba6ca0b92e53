// SPDX-License-Identifier: MIT
// Meshes: files in and out, arrays in and out, checks.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <optional>
#include <string>

#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/findings.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/check.hpp"
#include "topology/mesh/solids/solids.hpp"

namespace sunder::python {
namespace {

using Path = std::filesystem::path;

/// Notes cells with rows that do not exist or repeat, as `check_mesh` names them.
template <std::size_t Corners>
void check_rows(const CellList<Corners>& cells, std::size_t points, const char* kind,
                std::vector<Finding>& findings) {
  Finding outside{.code = "index_out_of_range",
                  .count = 0,
                  .text = std::string("rows of points that do not exist, in ") + kind,
                  .remedy = "count rows of points from 0"};
  Finding repeated{.code = "repeated_vertex",
                   .count = 0,
                   .text = std::string("the same point twice, in ") + kind,
                   .remedy = "give different corners"};
  const auto note = [](Finding& f, std::size_t row) {
    if (f.count++ < Finding::max_ids) f.ids.push_back(static_cast<std::int64_t>(row));
  };
  for (std::size_t row = 0; row < cells.corners.size(); ++row) {
    auto corners = cells.corners[row];
    std::ranges::sort(corners);
    if (corners.back() >= points) note(outside, row);
    if (std::ranges::adjacent_find(corners) != corners.end()) note(repeated, row);
  }
  for (Finding& f : {std::ref(outside), std::ref(repeated)}) {
    if (f.count > 0) findings.push_back(f);
  }
}

std::vector<Finding> check_contents(const FileMesh& mesh) {
  std::vector<Finding> findings;
  check_rows(mesh.tetrahedra, mesh.points.size(), "tetrahedra", findings);
  check_rows(mesh.triangles, mesh.points.size(), "triangles", findings);
  Finding bad{.code = "nan_coordinate",
              .count = 0,
              .text = "points with a coordinate that is not finite",
              .remedy = "give finite coordinates in m"};
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (std::ranges::all_of(mesh.points[i], [](double x) { return std::isfinite(x); })) continue;
    if (bad.count++ < Finding::max_ids) bad.ids.push_back(static_cast<std::int64_t>(i));
  }
  if (bad.count > 0) findings.push_back(bad);
  return findings;
}

/// Copies rows of cells. Throws ValueError for rows that no cast may hide.
template <std::size_t Corners>
void fill(CellList<Corners>& cells, const py::object& given, const char* name) {
  if (given.is_none()) return;
  const Array<std::int64_t> array = integers(given, name);
  const std::int64_t* from = rows_of(array, Corners, name);
  cells.corners.resize(static_cast<std::size_t>(array.shape(0)));
  for (auto& corners : cells.corners) {
    for (std::uint32_t& corner : corners) {
      if (*from < 0 || *from > 0xfffffffeLL) {
        throw py::value_error(std::string(name) + " has a row of points below 0 or too large");
      }
      corner = static_cast<std::uint32_t>(*from++);
    }
  }
}

void fill_regions(CellList<4>& cells, const py::object& given) {
  if (given.is_none()) return;
  const Array<std::int64_t> array = integers(given, "regions");
  if (array.ndim() != 1 || static_cast<std::size_t>(array.size()) != cells.corners.size()) {
    throw py::value_error("regions must have one number per tetrahedron");
  }
  for (py::ssize_t t = 0; t < array.size(); ++t) {
    const auto region = static_cast<std::int32_t>(array.data()[t]);
    if (region != array.data()[t]) throw py::value_error("a region has more than 32 bits");
    cells.region.push_back(region);
  }
}

Mesh of_arrays(const Array<double>& points, const py::object& tetrahedra,
               const py::object& triangles, const py::object& regions) {
  Mesh result;
  FileMesh& mesh = result.mesh;
  const double* from = rows_of(points, 3, "points");
  mesh.points.resize(static_cast<std::size_t>(points.shape(0)));
  static_assert(sizeof(Point) == 3 * sizeof(double));
  if (!mesh.points.empty()) {
    std::memcpy(mesh.points.data(), from, mesh.points.size() * sizeof(Point));
  }
  fill(mesh.tetrahedra, tetrahedra, "tetrahedra");
  fill(mesh.triangles, triangles, "triangles");
  fill_regions(mesh.tetrahedra, regions);
  refuse_errors(check_contents(mesh));
  return result;
}

Mesh read(const Path& path) {
  return unlocked([&] {
    Result<FileMesh> file = read_file_mesh(path);
    Mesh mesh{{}, file.findings};
    mesh.mesh = value_of(std::move(file));
    return mesh;
  });
}

/// The names that `sunder convert` has for formats and encodings.
WriteOptions options_of(const std::optional<std::string>& format, const std::string& version,
                        const std::optional<std::string>& encoding, bool pack) {
  WriteOptions options{.version = version, .pack = pack};
  if (format) {
    options.format = format_of_name("mesh." + *format);
    if (!options.format) throw py::value_error("there is no format " + *format);
  }
  if (encoding) {
    if (*encoding == "text") options.encoding = Encoding::text;
    if (*encoding == "binary") options.encoding = Encoding::binary;
    if (*encoding == "base64") options.encoding = Encoding::base64;
    if (!options.encoding) throw py::value_error("an encoding is text, binary or base64");
  }
  return options;
}

std::vector<Finding> write_mesh_file(const Path& path, const FileMesh& mesh,
                                     const WriteOptions& options, bool strict) {
  WriteOptions whole = options;
  if (!whole.format) whole.format = format_of_name(path);
  if (strict && whole.format) {
    std::vector<Finding> lost = lost_on_writing(mesh, whole);
    if (!lost.empty()) throw Refused{std::move(lost)};
  }
  std::vector<Finding> findings = write_file_mesh(path, mesh, whole);
  refuse_errors(findings);
  return findings;
}

std::vector<Finding> write(const Path& path, const Mesh& mesh,
                           const std::optional<std::string>& format, const std::string& version,
                           const std::optional<std::string>& encoding, bool pack, bool strict) {
  const WriteOptions options = options_of(format, version, encoding, pack);
  return unlocked([&] { return write_mesh_file(path, mesh.mesh, options, strict); });
}

std::vector<Finding> convert(const Path& source, const Path& target,
                             const std::optional<std::string>& format, const std::string& version,
                             const std::optional<std::string>& encoding, bool pack, bool strict) {
  const WriteOptions options = options_of(format, version, encoding, pack);
  return unlocked([&] {
    Result<FileMesh> file = read_file_mesh(source);
    std::vector<Finding> findings = file.findings;
    const bool loses = std::ranges::any_of(
        findings, [](const Finding& f) { return f.severity == Severity::warning; });
    const FileMesh mesh = value_of(std::move(file));
    if (strict && loses) throw Refused{std::move(findings)};
    if (loses && cell_count(mesh) == 0) {
      findings.push_back({.code = "nothing_left",
                          .text = "no cell is left to write",
                          .remedy = "look at the warnings",
                          .file = source.string()});
      throw Refused{std::move(findings)};
    }
    std::ranges::move(write_mesh_file(target, mesh, options, strict), std::back_inserter(findings));
    return findings;
  });
}

py::object quality_dict(const std::optional<Quality>& q) {
  if (!q) return py::none();
  py::dict quality;
  const auto add = [&](const char* name, const Quality::Extreme& e) {
    quality[name] = py::make_tuple(e.value, e.tetrahedron);
  };
  add("smallest_dihedral", q->smallest_dihedral);
  add("largest_dihedral", q->largest_dihedral);
  add("smallest_radius_ratio", q->smallest_radius_ratio);
  add("smallest_volume", q->smallest_volume);
  add("largest_volume", q->largest_volume);
  add("shortest_edge", q->shortest_edge);
  add("longest_edge", q->longest_edge);
  quality["mean_radius_ratio"] = q->mean_radius_ratio;
  return quality;
}

py::dict point_data(const FileMesh& mesh) {
  py::dict columns;
  for (const DataColumn& column : mesh.point_data) {
    const std::size_t width = column.components == 1 ? 0 : column.components;
    if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
      columns[py::str(column.name)] = copied<double>(std::span(*numbers), width);
    } else {
      columns[py::str(column.name)] = copied<std::int64_t>(
          std::span(std::get<std::vector<std::int64_t>>(column.values)), width);
    }
  }
  return columns;
}

/// Throws ValueError for lengths that are not above 0 and counts that are out of range.
void check_solid(std::initializer_list<double> lengths, std::initializer_list<double> counts,
                 double tetrahedra) {
  for (const double length : lengths) {
    if (!std::isfinite(length) || !(length > 0)) throw py::value_error("a length must be above 0");
  }
  for (const double count : counts) {
    if (count < 1) throw py::value_error("a number of cells must be 1 or more");
  }
  if (tetrahedra > 1e8) throw py::value_error("more than 100 million tetrahedra");
}

Mesh of_solid(const TetMesh& mesh) { return {file_mesh_of(mesh), {}}; }

void bind_solids(py::module_& module) {
  module.def(
      "box",
      [](const std::array<double, 3>& size, const std::array<std::uint32_t, 3>& cells) {
        const auto [x, y, z] = size;
        const auto [i, j, k] = cells;
        check_solid({x, y, z}, {1. * i, 1. * j, 1. * k}, 6. * i * j * k);
        return of_solid(box_solid(size, cells));
      },
      py::arg("size"), py::arg("cells"),
      "A box with its middle at the origin: size (3,) in m, cells (3,), six tetrahedra per cell.");
  module.def(
      "ball",
      [](double radius, std::uint32_t shells) {
        check_solid({radius}, {1. * shells}, 20. * shells * shells * shells);
        return of_solid(ball_solid(radius, shells));
      },
      py::arg("radius"), py::arg("shells"),
      "A ball with its middle at the origin: radius in m, 20 shells^3 tetrahedra.");
  module.def(
      "cylinder",
      [](double radius, double height, std::uint32_t rings, std::uint32_t layers) {
        check_solid({radius, height}, {1. * rings, 1. * layers}, 18. * rings * rings * layers);
        return of_solid(cylinder_solid(radius, height, rings, layers));
      },
      py::arg("radius"), py::arg("height"), py::arg("rings"), py::arg("layers"),
      "A cylinder about the z axis, its middle at the origin: radius and height in m, 18 rings^2 "
      "tetrahedra per layer.");
}

void bind_check(py::module_& module) {
  py::class_<MeshCheck>(module, "Check", "Result of a check of a mesh.")
      .def_readonly("findings", &MeshCheck::findings, "List of Finding, errors first.")
      .def_property_readonly(
          "ok", [](const MeshCheck& c) { return !has_error(c.findings); }, "True without an error.")
      .def_property_readonly(
          "counts",
          [](const MeshCheck& c) {
            return c.counts ? py::object(counts_dict(*c.counts)) : py::object(py::none());
          },
          "Numbers of cells, Euler characteristic, Betti numbers, volume (m^3), or None.")
      .def_property_readonly(
          "quality", [](const MeshCheck& c) { return quality_dict(c.quality); },
          "Shapes of tetrahedra as (value, row): angles in degrees, lengths in m, volumes in m^3, "
          "or None.");
  module.def(
      "check",
      [](const Mesh& mesh) {
        return unlocked([&] {
          MeshCheck result = check_file_mesh(mesh.mesh);
          result.findings.insert(result.findings.begin(), mesh.findings.begin(),
                                 mesh.findings.end());
          return result;
        });
      },
      py::arg("mesh"), "Checks a mesh and returns a Check.");
}

}  // namespace

py::dict counts_dict(const Counts& c) {
  py::dict counts;
  counts["vertices"] = c.vertices;
  counts["edges"] = c.edges;
  counts["faces"] = c.faces;
  counts["tetrahedra"] = c.tetrahedra;
  counts["components"] = c.components;
  counts["boundary_faces"] = c.boundary_faces;
  counts["boundary_sheets"] = c.boundary_sheets;
  counts["euler_characteristic"] = c.euler_characteristic;
  counts["betti"] = c.betti
                        ? py::object(py::make_tuple((*c.betti)[0], (*c.betti)[1], (*c.betti)[2]))
                        : py::object(py::none());
  counts["volume"] = c.volume;
  return counts;
}

void bind_mesh(py::module_& module) {
  py::class_<Mesh, std::shared_ptr<Mesh>>(
      module, "Mesh", "Points with tetrahedra and triangles. It does not change after it was made.")
      .def(py::init(&of_arrays), py::arg("points"), py::arg("tetrahedra") = py::none(),
           py::arg("triangles") = py::none(), py::arg("regions") = py::none(),
           "Copies arrays: points (n, 3) in m, tetrahedra (t, 4) and triangles (f, 3) as rows of "
           "points from 0, regions (t,).")
      .def_property_readonly(
          "points",
          [](const py::object& self) {
            return view<double>(std::span(self.cast<const Mesh&>().mesh.points), 3, self);
          },
          "float64 (n, 3), m. A view that cannot be written to.")
      .def_property_readonly(
          "tetrahedra",
          [](const py::object& self) {
            const auto& corners = self.cast<const Mesh&>().mesh.tetrahedra.corners;
            return view<std::uint32_t>(std::span(corners), 4, self);
          },
          "uint32 (t, 4), rows of points. A view that cannot be written to.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            const auto& corners = self.cast<const Mesh&>().mesh.triangles.corners;
            return view<std::uint32_t>(std::span(corners), 3, self);
          },
          "uint32 (f, 3), rows of points. A view that cannot be written to.")
      .def_property_readonly(
          "regions",
          [](const py::object& self) {
            const auto& region = self.cast<const Mesh&>().mesh.tetrahedra.region;
            return view<std::int32_t>(std::span(region), 0, self);
          },
          "int32 (t,), or empty. A view that cannot be written to.")
      .def_property_readonly(
          "point_data", [](const Mesh& mesh) { return point_data(mesh.mesh); },
          "Columns of the file's point data by name, (n,) or (n, k). Copies.")
      .def_readonly("findings", &Mesh::findings, "Remarks of the reader: a list of Finding.")
      .def("__repr__", [](const Mesh& mesh) {
        return "<sunder.Mesh of " + std::to_string(mesh.mesh.points.size()) + " points, " +
               std::to_string(mesh.mesh.tetrahedra.corners.size()) + " tetrahedra, " +
               std::to_string(mesh.mesh.triangles.corners.size()) + " triangles>";
      });
  module.def("read", &read, py::arg("path"),
             "Reads a mesh file in any format that `sunder convert` reads. Raises Error.");
  module.def("write", &write, py::arg("path"), py::arg("mesh"), py::kw_only(),
             py::arg("format") = py::none(), py::arg("version") = "",
             py::arg("encoding") = py::none(), py::arg("pack") = false, py::arg("strict") = false,
             "Writes a mesh file and returns the losses as a list of Finding. Raises Error; with "
             "`strict` also where something would be lost.");
  module.def("convert", &convert, py::arg("source"), py::arg("target"), py::kw_only(),
             py::arg("format") = py::none(), py::arg("version") = "",
             py::arg("encoding") = py::none(), py::arg("pack") = false, py::arg("strict") = false,
             "Converts a mesh file as `sunder convert` does, to the same bytes. Returns the "
             "findings. Raises Error.");
  bind_solids(module);
  bind_check(module);
}

}  // namespace sunder::python
