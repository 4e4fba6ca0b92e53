// SPDX-License-Identifier: MIT
// Writing VTU, raw data straight from the columns' memory, and PVD lists.
#include "topology/io/vtu/vtu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <deque>
#include <iterator>
#include <optional>

#include "topology/io/files/output_file.hpp"
#include "topology/io/vtk/vtk_cells.hpp"
#include "topology/io/vtu/vtu_encode.hpp"
#include "topology/io/vtu/vtu_read.hpp"

namespace sunder {
namespace {

std::string escaped(std::string_view text) {
  std::string out = io::in_xml(text);
  for (char& c : out) c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return out;
}

constexpr NumberType type_of(double) { return NumberType::float64; }
constexpr NumberType type_of(float) { return NumberType::float32; }
constexpr NumberType type_of(std::int32_t) { return NumberType::int32; }
constexpr NumberType type_of(std::uint32_t) { return NumberType::uint32; }
constexpr NumberType type_of(std::int64_t) { return NumberType::int64; }
constexpr NumberType type_of(std::uint8_t) { return NumberType::uint8; }

/// The XML part as it grows, and the raw data that will follow it.
struct VtuWriter {
  Encoding encoding = Encoding::binary;
  bool pack = false;
  std::string xml;
  /// The type that the file declares.
  std::string_view type;
  /// Raw data behind the XML: the caller's columns, and headers and packed arrays of our own.
  std::vector<std::string_view> appended;
  std::deque<std::string> own;
  std::size_t appended_bytes = 0;
};

void append(VtuWriter& out, std::string_view bytes) {
  out.appended.push_back(bytes);
  out.appended_bytes += bytes.size();
}

void append_own(VtuWriter& out, std::string bytes) {
  append(out, out.own.emplace_back(std::move(bytes)));
}

std::string header_of(std::string_view bytes) {
  const std::uint64_t size = bytes.size();
  return {reinterpret_cast<const char*>(&size), sizeof size};
}

void append_array(VtuWriter& out, std::string_view bytes) {
  if (!out.pack) {
    append_own(out, header_of(bytes));
    append(out, bytes);
    return;
  }
  io::PackedArray array = io::packed(bytes);
  append_own(out, std::move(array.header));
  append_own(out, std::move(array.blocks));
}

/// Header and data are one stream of base64, but two where they are packed.
std::string inline_array(const VtuWriter& out, std::string_view bytes) {
  if (!out.pack) return io::in_base64(header_of(bytes) + std::string(bytes));
  const io::PackedArray array = io::packed(bytes);
  return io::in_base64(array.header) + io::in_base64(array.blocks);
}

void add_array(VtuWriter& out, NumberType type, std::string_view name, std::size_t components,
               std::string_view bytes) {
  fmt::format_to(std::back_inserter(out.xml),
                 "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" ",
                 io::vtu_types[static_cast<std::size_t>(type)], escaped(name), components);
  if (out.encoding == Encoding::binary) {
    fmt::format_to(std::back_inserter(out.xml), "format=\"appended\" offset=\"{}\"/>\n",
                   out.appended_bytes);
    return append_array(out, bytes);
  }
  const bool is_text = out.encoding == Encoding::text;
  out.xml += is_text ? "format=\"ascii\">\n" : "format=\"binary\">\n";
  out.xml += is_text ? io::in_digits(type, components, bytes) : inline_array(out, bytes) + '\n';
  out.xml += "</DataArray>\n";
}

template <class Value>
std::string_view bytes_of(std::span<const Value> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

void add_array(VtuWriter& out, const NamedColumn& column) {
  std::visit(
      [&](const auto values) {
        add_array(out, type_of(std::remove_cv_t<typename decltype(values)::element_type>{}),
                  column.name, column.components, bytes_of(values));
      },
      column.values);
}

std::size_t length_of(const NamedColumn& column) {
  return std::visit([](const auto values) { return values.size(); }, column.values);
}

void check_columns(std::span<const NamedColumn> columns, std::size_t rows, std::string_view cells,
                   std::vector<Finding>& findings) {
  for (const NamedColumn& column : columns) {
    if (column.components > 0 && length_of(column) == rows * column.components) continue;
    findings.push_back(
        {.code = "bad_column",
         .text = fmt::format("column '{}' has {} numbers: {} were expected, {} for each of {} {}",
                             column.name, length_of(column), rows * column.components,
                             column.components, rows, cells),
         .remedy = fmt::format("give {} number(s) for each of the {}", column.components, cells)});
  }
}

/// The mesh's own column, unless the caller gives one of that name or the mesh has none.
template <class Value>
void add_own(VtuWriter& out, std::string_view name, const std::vector<Value>& values,
             std::span<const NamedColumn> given) {
  const bool taken =
      std::any_of(given.begin(), given.end(), [&](const auto& c) { return c.name == name; });
  if (!values.empty() && !taken) add_array(out, {name, std::span<const Value>(values)});
}

/// Where cells stand: Offset is the type of `offsets`.
template <class Offset>
void add_mesh(VtuWriter& out, const std::vector<Point>& points,
              std::span<const std::int32_t> connectivity, std::span<const Offset> offsets,
              std::span<const std::uint8_t> types) {
  out.xml += "<Points>\n";
  add_array(out, vector_column("Points", points));
  out.xml += "</Points>\n<Cells>\n";
  add_array(out, {"connectivity", connectivity});
  add_array(out, {"offsets", offsets});
  add_array(out, {"types", types});
  out.xml += "</Cells>\n";
}

/// `counts`: the attributes of the piece with the numbers of cells.
void begin_file(VtuWriter& out, std::string_view type, std::size_t points,
                std::string_view counts) {
  out.type = type;
  out.xml = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" "
      "byte_order=\"{1}\" header_type=\"UInt64\"{2}>\n<{0}>\n"
      "<Piece NumberOfPoints=\"{3}\" {4}>\n",
      type, std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian",
      out.pack ? " compressor=\"vtkZLibDataCompressor\"" : "", points, counts);
}

void begin_grid(VtuWriter& out, std::size_t points, std::size_t cells) {
  begin_file(out, "UnstructuredGrid", points, fmt::format("NumberOfCells=\"{}\"", cells));
}

/// Ends the XML and writes it with all appended data behind it.
std::optional<Finding> end_file(VtuWriter& out, const std::filesystem::path& path) {
  out.xml += fmt::format("</Piece>\n</{}>\n", out.type);
  if (out.appended.empty()) {
    out.xml += "</VTKFile>\n";
    return write_file(path, out.xml);
  }
  out.xml += "<AppendedData encoding=\"raw\">\n_";
  std::vector<std::string_view> parts{out.xml};
  parts.insert(parts.end(), out.appended.begin(), out.appended.end());
  parts.emplace_back("\n</AppendedData>\n</VTKFile>\n");
  return write_file(path, parts);
}

template <class Stored, class Value>
std::string stored_as(const std::vector<Value>& values) {
  std::string bytes(values.size() * sizeof(Stored), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto stored = number_cast<Stored>(values[i]);
    std::memcpy(bytes.data() + i * sizeof(Stored), &stored, sizeof(Stored));
  }
  return bytes;
}

/// A column's values in its own type.
std::string in_own_type(const DataColumn& column) {
  return io::with_stored(column.type, [&]<class Stored>(Stored) {
    return std::visit([](const auto& v) { return stored_as<Stored>(v); }, column.values);
  });
}

}  // namespace

std::vector<Finding> write_vtu(const std::filesystem::path& path, const TetMesh& mesh,
                               std::span<const NamedColumn> point_data,
                               std::span<const NamedColumn> cell_data) {
  std::vector<Finding> findings;
  check_columns(point_data, mesh.points.size(), "points", findings);
  check_columns(cell_data, mesh.tetrahedra.size(), "tetrahedra", findings);
  if (!findings.empty()) return findings;

  std::vector<std::int32_t> offsets(mesh.tetrahedra.size());
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    offsets[i] = static_cast<std::int32_t>(4 * i + 4);
  }
  const std::vector<std::uint8_t> types(mesh.tetrahedra.size(), 10);

  VtuWriter out;
  begin_grid(out, mesh.points.size(), mesh.tetrahedra.size());
  out.xml += "<PointData>\n";
  for (const NamedColumn& column : point_data) add_array(out, column);
  add_own(out, "source_point_id", mesh.source_point_id, point_data);
  out.xml += "</PointData>\n<CellData>\n";
  for (const NamedColumn& column : cell_data) add_array(out, column);
  add_own(out, "region", mesh.region, cell_data);
  add_own(out, "source_tetrahedron_id", mesh.source_tetrahedron_id, cell_data);
  out.xml += "</CellData>\n";
  // VTK's ids are signed; the bits are the same below 2^31.
  const auto* const ids = reinterpret_cast<const std::int32_t*>(mesh.tetrahedra.data());
  add_mesh(out, mesh.points, std::span(ids, 4 * mesh.tetrahedra.size()),
           std::span<const std::int32_t>(offsets), types);
  if (auto failure = end_file(out, path)) findings.push_back(*failure);
  return findings;
}

namespace {

/// The data of points and cells; `stored` keeps the bytes that `out` refers to.
void add_data(VtuWriter& out, const io::VtkGrid& grid, std::deque<std::string>& stored) {
  const auto add = [&](const DataColumn& column) {
    add_array(out, column.type, column.name, column.components,
              stored.emplace_back(in_own_type(column)));
  };
  out.xml += "<PointData>\n";
  for (const DataColumn& column : grid.point_data) add(column);
  out.xml += "</PointData>\n<CellData>\n";
  for (const DataColumn& column : grid.cell_data) add(column);
  out.xml += "</CellData>\n";
}

}  // namespace

std::optional<Finding> io::write_vtu(const std::filesystem::path& path, const FileMesh& mesh,
                                     const FileEncoding& how) {
  const VtkGrid grid = vtk_grid(mesh);
  VtuWriter out{.encoding = how.encoding, .pack = how.pack};
  begin_grid(out, mesh.points.size(), grid.types.size());
  std::deque<std::string> stored;
  add_data(out, grid, stored);
  add_mesh(out, mesh.points, grid.connectivity, std::span<const std::int64_t>(grid.ends),
           grid.types);
  return end_file(out, path);
}

std::optional<Finding> io::write_vtp(const std::filesystem::path& path, const FileMesh& mesh,
                                     const FileEncoding& how) {
  // Vertices, edges and faces stand in this order in the grid, and so do their data.
  const VtkGrid grid = vtk_grid(mesh);
  const std::size_t vertices = mesh.vertices.corners.size(), edges = mesh.edges.corners.size();
  const std::array<std::size_t, 3> counts = {vertices, edges, grid.types.size() - vertices - edges};
  VtuWriter out{.encoding = how.encoding, .pack = how.pack};
  begin_file(out, "PolyData", mesh.points.size(),
             fmt::format("NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                         "NumberOfPolys=\"{}\"",
                         counts[0], counts[1], counts[2]));
  std::deque<std::string> stored;
  add_data(out, grid, stored);
  out.xml += "<Points>\n";
  add_array(out, vector_column("Points", mesh.points));
  out.xml += "</Points>\n";
  std::deque<std::vector<std::int64_t>> ends;
  constexpr std::string_view tags[] = {"Verts", "Lines", "Polys"};
  std::size_t cell = 0, point = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::size_t first = point;
    std::vector<std::int64_t>& own = ends.emplace_back();
    for (const std::size_t end = cell + counts[i]; cell < end; ++cell) {
      point = static_cast<std::size_t>(grid.ends[cell]);
      own.push_back(static_cast<std::int64_t>(point - first));
    }
    out.xml += fmt::format("<{}>\n", tags[i]);
    add_array(out, {"connectivity", std::span(grid.connectivity).subspan(first, point - first)});
    add_array(out, {"offsets", std::span<const std::int64_t>(own)});
    out.xml += fmt::format("</{}>\n", tags[i]);
  }
  return end_file(out, path);
}

std::vector<Finding> write_pvd(const std::filesystem::path& path,
                               std::span<const PvdFrame> frames) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const PvdFrame& frame : frames) {
    fmt::format_to(std::back_inserter(xml),
                   "<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", frame.time,
                   escaped(frame.file));
  }
  xml += "</Collection>\n</VTKFile>\n";
  if (auto failure = write_file(path, xml)) return {*failure};
  return {};
}

}  // namespace sunder
