// SPDX-License-Identifier: MIT
// The 3-map of a body: cells, fans, splits, components, laws.
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>

#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/findings.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/kernel/map_mesh.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/mesh/build_map.hpp"

namespace sunder::python {
namespace {

/// A map with the mesh of its start and labels that follow each split.
struct Map {
  Map(const Mesh& mesh, bool has_darts) : source(tet_mesh_of(FileMesh(mesh.mesh))) {
    Result<VolumeMap> built =
        build_map(source, Severity::warning, has_darts ? MapKernel::lcc : MapKernel::dense);
    findings = built.findings;
    map = std::make_unique<VolumeMap>(value_of(std::move(built)));
    labels = label_components(*map);
  }

  TetMesh source;
  std::vector<Finding> findings;
  std::unique_ptr<VolumeMap> map;
  Components labels;
  ComponentScratch scratch;
  mutable std::atomic<bool> in_use = false;
};

/// One split face with the pieces that came off by it.
struct Split {
  FaceSplit split;
  std::size_t created = 0;
};

/// The map of a call that keeps the interpreter's lock: no other thread can begin to change it.
const VolumeMap& idle(const Map& m) {
  const InUse use(m.in_use);
  return *m.map;
}

HalfFaceId face_of(const Map& m, std::int64_t face) {
  if (face < 0 || face >= static_cast<std::int64_t>(4 * idle(m).tetrahedra())) {
    throw py::index_error("there is no half-face " + std::to_string(face));
  }
  return HalfFaceId{static_cast<std::size_t>(face)};
}

VertexId vertex_of(const Map& m, std::int64_t vertex) {
  if (vertex < 0 || vertex >= static_cast<std::int64_t>(idle(m).vertices())) {
    throw py::index_error("there is no vertex " + std::to_string(vertex));
  }
  return VertexId{static_cast<std::size_t>(vertex)};
}

/// Splits faces one by one; with `check` each split is compared with the laws of a face split.
std::vector<Split> split_faces(Map& m, const py::object& given, bool check) {
  const Array<std::int64_t> faces = integers(given, "faces");
  std::vector<HalfFaceId> list;
  for (py::ssize_t i = 0; i < faces.size(); ++i) list.push_back(face_of(m, faces.data()[i]));
  const InUse use(m.in_use);
  return unlocked([&] {
    std::vector<Split> splits;
    for (const HalfFaceId face : list) {
      const Counts before = check ? count_cells(*m.map) : Counts{};
      Split made{.split = split_face(*m.map, face)};
      made.created = update_components(*m.map, std::span(&made.split, 1), Detection::exact,
                                       m.labels, m.scratch)
                         .created;
      if (check && made.split.did) {
        refuse_errors(check_split_laws(before, count_cells(*m.map), made.split));
      }
      splits.push_back(made);
    }
    return splits;
  });
}

void glue(Map& m, std::int64_t a, std::int64_t b) {
  const HalfFaceId one = face_of(m, a), other = face_of(m, b);
  const InUse use(m.in_use);
  const FaceGlue glued = glue_face(*m.map, one, other);
  if (glued.refusal != GlueRefusal::none) {
    const char* reasons[] = {"", "a face is not on the boundary", "both are the same half-face",
                             "the faces have different points"};
    throw Refused{{{.code = "cannot_glue",
                    .text = reasons[static_cast<int>(glued.refusal)],
                    .remedy = "give the two half-faces that a split separated"}}};
  }
  m.labels = label_components(*m.map);
}

/// (t, 4) half-faces across each face, -1 on the boundary.
py::array_t<std::int64_t> neighbours(const Map& m) {
  const auto rows = idle(m).neighbours();
  py::array_t<std::int64_t> result({static_cast<py::ssize_t>(rows.size()), py::ssize_t{4}});
  std::int64_t* out = result.mutable_data();
  for (const auto& row : rows) {
    for (const HalfFaceId f : row) *out++ = f.is_none() ? -1 : static_cast<std::int64_t>(f.value);
  }
  return result;
}

py::array_t<std::int64_t> find(const Map& m, const py::object& given) {
  const Array<std::int64_t> points = integers(given, "points");
  const std::int64_t* from = rows_of(points, 3, "points");
  std::vector<std::array<std::uint32_t, 3>> triples(static_cast<std::size_t>(points.shape(0)));
  for (auto& triple : triples) {
    // A row that does not exist belongs to no face.
    for (std::uint32_t& p : triple)
      p = static_cast<std::uint32_t>(std::clamp<std::int64_t>(*from++, -1, 0xffffffffLL));
  }
  return ids<HalfFaceId>(find_faces(idle(m), triples));
}

Mesh mesh_of(const Map& m) {
  return {file_mesh_of(mesh_of_map(idle(m), m.source, MeshPoints::vertices)), {}};
}

py::dict counts_of(const Map& m) {
  const InUse use(m.in_use);
  return counts_dict(unlocked([&] { return count_cells(*m.map); }));
}

void bind_split(py::module_& module) {
  py::class_<Split>(module, "FaceSplit", "Result of the split of one face.")
      .def_property_readonly(
          "did", [](const Split& s) { return s.split.did; },
          "False for a face on the boundary: nothing changed.")
      .def_property_readonly(
          "face", [](const Split& s) { return s.split.face.value; },
          "The half-face of the call, whose side keeps the rows.")
      .def_property_readonly(
          "opposite", [](const Split& s) { return s.split.opposite.value; },
          "The half-face that lay on the other side.")
      .def_property_readonly(
          "split_vertices",
          [](const Split& s) {
            py::list copies;
            for (int i = 0; i < s.split.vertex_count; ++i) {
              const VertexCopy& c = s.split.split_vertices[static_cast<std::size_t>(i)];
              copies.append(py::make_tuple(c.old_row.value, c.new_row.value));
            }
            return copies;
          },
          "List of (old row, new row).")
      .def_property_readonly(
          "split_edges", [](const Split& s) { return edge_count(s.split); },
          "Number of edges that came apart, 0 to 3.")
      .def_property_readonly(
          "oracle", [](const Split& s) { return oracle_says_new(s.split); },
          "True where all three vertices split: a new piece is predicted.")
      .def_readonly("created", &Split::created, "Number of pieces that came off.");
}

void bind_queries(py::class_<Map>& map) {
  map.def_property_readonly(
         "counts", [](const Map& m) { return counts_of(m); },
         "Numbers of cells, Euler characteristic, Betti numbers, volume (m^3). O(|T|).")
      .def_property_readonly(
          "betti", [](const Map& m) { return py::object(counts_of(m)["betti"]); },
          "(b0, b1, b2), or None where a component has no boundary. O(|T|).")
      .def_property_readonly(
          "vertex_rows", [](const Map& m) { return idle(m).vertices(); }, "Number of vertex rows.")
      .def_property_readonly(
          "corners", [](const Map& m) { return copied<std::uint32_t>(idle(m).corners(), 4); },
          "uint32 (t, 4): vertex rows of each tetrahedron. A copy, because a split changes rows.")
      .def_property_readonly(
          "neighbours", &neighbours,
          "int64 (t, 4): the half-face across each face, -1 on the boundary. A copy.")
      .def_property_readonly(
          "points", [](const Map& m) { return copied<double>(idle(m).points(), 3); },
          "float64 (n, 3), m: points of the mesh. A copy.")
      .def_property_readonly(
          "point_of_vertex",
          [](const Map& m) { return copied<std::uint32_t>(idle(m).point_of_vertex(), 0); },
          "uint32 (vertex rows,): row of the mesh's point. A copy.")
      .def_property_readonly(
          "components",
          [](const Map& m) {
            idle(m);
            return ids<ComponentId>(m.labels.of_tetrahedron);
          },
          "int64 (t,): the piece of each tetrahedron. A copy.")
      .def_readonly("findings", &Map::findings, "Remarks about the mesh: a list of Finding.")
      .def("find", &find, py::arg("points"),
           "Half-faces on triples of points (k, 3): int64 (k,), -1 where there is none. O(|T|).")
      .def(
          "star",
          [](const Map& m, std::int64_t vertex) {
            return ids<TetId>(star(idle(m), vertex_of(m, vertex)));
          },
          py::arg("vertex"), "Tetrahedra around a vertex row: int64 (k,), ascending.")
      .def(
          "fan",
          [](const Map& m, std::int64_t vertex, const std::array<double, 3>& normal) {
            return ids<HalfFaceId>(value_of(fan_faces(idle(m), vertex_of(m, vertex), normal)));
          },
          py::arg("vertex"), py::arg("normal"),
          "Faces at a vertex that a plane through it separates: half-faces, int64 (k,).")
      .def(
          "plane_faces",
          [](const Map& m, const std::array<double, 3>& normal, double offset) {
            return ids<HalfFaceId>(value_of(plane_faces(idle(m), {normal, offset})));
          },
          py::arg("normal"), py::arg("offset"),
          "Faces between tetrahedra on different sides of normal . x = offset (m): int64 (k,).")
      .def(
          "check",
          [](const Map& m) {
            const InUse use(m.in_use);
            return unlocked([&] { return check(*m.map); });
          },
          "Compares the map with all laws of a 3-map. Returns findings; empty if all hold. O(|T|).")
      .def("mesh", &mesh_of,
           "The mesh with a point per vertex row: splits stay, as far as a mesh can hold them.");
}

}  // namespace

void bind_map(py::module_& module) {
  bind_split(module);
  py::class_<Map> map(module, "Map",
                      "The 3-map of a mesh. Half-face 4 t + i is the face of tetrahedron t "
                      "opposite its corner i. Methods return copies.");
  map.def(py::init([](const Mesh& mesh, const std::string& kernel) {
            if (kernel != "rows" && kernel != "darts") {
              throw py::value_error("a kernel is rows or darts");
            }
            return unlocked([&] { return std::make_unique<Map>(mesh, kernel == "darts"); });
          }),
          py::arg("mesh"), py::arg("kernel") = "rows",
          "Builds the map. `kernel` is \"rows\", or \"darts\" for CGAL's; both give the same "
          "answers. Raises Error.")
      .def("split", &split_faces, py::arg("faces"), py::kw_only(), py::arg("check") = false,
           "Splits half-faces one by one and returns a list of FaceSplit. With `check` each split "
           "is compared with the laws of a face split, and a broken law raises Error.")
      .def("glue", &glue, py::arg("a"), py::arg("b"),
           "Glues two half-faces that a split separated. Raises Error.");
  bind_queries(map);
}

}  // namespace sunder::python
