// SPDX-License-Identifier: MIT
// Writing legacy VTK, versions 4.2 and 5.1, text or big-endian.
#include <fmt/format.h>

#include <bit>
#include <iterator>

#include "topology/io/text/number_sink.hpp"
#include "topology/io/text/number_source.hpp"
#include "topology/io/vtk/vtk.hpp"
#include "topology/io/vtk/vtk_cells.hpp"

namespace sunder::io {
namespace {

/// Raw numbers are big-endian.
template <class Stored, class Number>
void put_vtk(NumberSink& out, Number number, char after) {
  if (!out.is_binary) return put<Stored>(out, number_cast<Stored>(number), after);
  const auto stored = number_cast<Stored>(number);
  put_raw<Stored>(out, std::endian::native == std::endian::little ? byte_swapped(stored) : stored);
}

/// Characters that would end or confuse a name are written as %20.
std::string encoded(std::string_view name) {
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte <= 0x20 || byte >= 0x7f || c == '%' || c == '"') {
      fmt::format_to(std::back_inserter(text), "%{:02X}", byte);
    } else {
      text += c;
    }
  }
  return text;
}

template <class Stored>
void put_values(NumberSink& out, const DataColumn& column) {
  std::visit(
      [&](const auto& values) {
        for (std::size_t i = 0; i < values.size(); ++i) {
          put_vtk<Stored>(out, values[i], (i + 1) % column.components == 0 ? '\n' : ' ');
        }
      },
      column.values);
  if (out.is_binary) out.bytes += '\n';
}

/// VTK's words for the types, in the order of NumberType. meshio 5.0 does not know all of them.
constexpr std::string_view type_words[] = {
    "double",         "float", "signed_char",  "unsigned_char", "short",
    "unsigned_short", "int",   "unsigned_int", "vtktypeint64",  "vtktypeuint64"};

void put_column(NumberSink& out, const DataColumn& column, std::size_t rows) {
  const auto place = static_cast<std::size_t>(column.type);
  fmt::format_to(std::back_inserter(out.bytes), "{} {} {} {}\n", encoded(column.name),
                 column.components, rows, type_words[place]);
  with_stored(column.type, [&]<class Stored>(Stored) { put_values<Stored>(out, column); });
}

void put_cells_42(NumberSink& out, const VtkGrid& grid) {
  fmt::format_to(std::back_inserter(out.bytes), "CELLS {} {}\n", grid.types.size(),
                 grid.connectivity.size() + grid.types.size());
  std::size_t begin = 0;
  for (const std::int64_t end : grid.ends) {
    const auto last = static_cast<std::size_t>(end);
    put_vtk<std::int32_t>(out, last - begin, ' ');
    for (; begin < last; ++begin) {
      put_vtk<std::int32_t>(out, grid.connectivity[begin], begin + 1 == last ? '\n' : ' ');
    }
  }
  if (out.is_binary) out.bytes += '\n';
}

void put_cells_51(NumberSink& out, const VtkGrid& grid) {
  fmt::format_to(std::back_inserter(out.bytes), "CELLS {} {}\nOFFSETS vtktypeint64\n",
                 grid.types.size() + 1, grid.connectivity.size());
  put_vtk<std::int64_t>(out, 0, '\n');
  for (const std::int64_t end : grid.ends) put_vtk<std::int64_t>(out, end, '\n');
  if (out.is_binary) out.bytes += '\n';
  put_text(out, "CONNECTIVITY vtktypeint64\n");
  for (const std::int32_t point : grid.connectivity) put_vtk<std::int64_t>(out, point, '\n');
  if (out.is_binary) out.bytes += '\n';
}

void put_fields(NumberSink& out, std::string_view section, const std::vector<DataColumn>& columns,
                std::size_t rows) {
  if (columns.empty()) return;
  fmt::format_to(std::back_inserter(out.bytes), "{} {}\nFIELD FieldData {}\n", section, rows,
                 columns.size());
  for (const DataColumn& column : columns) put_column(out, column, rows);
}

}  // namespace

std::string write_vtk(const FileMesh& mesh, int version, bool is_binary) {
  const VtkGrid grid = vtk_grid(mesh);
  NumberSink out{.is_binary = is_binary};
  out.bytes.reserve(64 * mesh.points.size() + 48 * grid.types.size());
  fmt::format_to(std::back_inserter(out.bytes),
                 "# vtk DataFile Version {}\nSunder mesh\n{}\nDATASET UNSTRUCTURED_GRID\n"
                 "POINTS {} double\n",
                 version == 51 ? "5.1" : "4.2", is_binary ? "BINARY" : "ASCII", mesh.points.size());
  for (const Point& p : mesh.points) {
    put_vtk<double>(out, p[0], ' '), put_vtk<double>(out, p[1], ' ');
    put_vtk<double>(out, p[2], '\n');
  }
  if (is_binary) out.bytes += '\n';
  version == 51 ? put_cells_51(out, grid) : put_cells_42(out, grid);
  fmt::format_to(std::back_inserter(out.bytes), "CELL_TYPES {}\n", grid.types.size());
  for (const std::uint8_t type : grid.types) put_vtk<std::int32_t>(out, type, '\n');
  if (is_binary) out.bytes += '\n';
  put_fields(out, "CELL_DATA", grid.cell_data, grid.types.size());
  put_fields(out, "POINT_DATA", grid.point_data, mesh.points.size());
  return std::move(out.bytes);
}

}  // namespace sunder::io
