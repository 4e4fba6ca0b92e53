// SPDX-License-Identifier: MIT
// Writing MSH 1, 2.2, 4.0 and 4.1, in text and binary; rows keep their order.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "topology/io/msh/msh.hpp"
#include "topology/io/msh/msh_elements.hpp"
#include "topology/io/msh/msh_entities.hpp"
#include "topology/io/text/number_sink.hpp"
#include "topology/mesh/kinds/column_order.hpp"

namespace sunder::io {
namespace {

/// Numbers of points or of all cells: the file's own where MSH can hold them, else rows from 1.
struct Numbers {
  bool is_own = false;
  std::int64_t low = 0;
  std::int64_t high = 0;
};

struct MshWriter {
  NumberSink out;
  const FileMesh& mesh;
  /// 10, 22, 40 or 41.
  int version;
  Numbers points;
  Numbers cells;
  /// Entity of each cell by kind, and physical group of each entity by dimension.
  std::array<std::vector<std::int32_t>, cell_kinds> entity;
  std::array<std::map<std::int32_t, std::int32_t>, 4> physical;
};

std::int32_t region_of(const CellColumns& cells, std::size_t row) {
  return cells.region.empty() ? 0 : cells.region[row];
}

void find_entities(MshWriter& w) {
  w.entity = msh_entities(w.mesh, w.version).of;
  for (const CellKind kind : all_cell_kinds) {
    const std::vector<std::int32_t>& entity = w.entity[index_of(kind)];
    auto& physical = w.physical[static_cast<std::size_t>(traits_of(kind).dimension)];
    for (std::size_t i = 0; i < entity.size(); ++i) {
      physical.emplace(entity[i], region_of(columns_of(w.mesh, kind), i));
    }
  }
}

using NumberLists = std::vector<std::span<const std::int64_t>>;

/// The numbers of the cells of each kind that has cells.
NumberLists cell_numbers(const FileMesh& mesh) {
  NumberLists lists;
  for (const CellKind kind : all_cell_kinds) {
    if (rows_of(mesh, kind).count > 0) lists.emplace_back(columns_of(mesh, kind).source_id);
  }
  return lists;
}

/// All numbers, rising.
std::vector<std::int64_t> sorted(const NumberLists& lists) {
  std::vector<std::int64_t> all;
  for (const auto list : lists) all.insert(all.end(), list.begin(), list.end());
  std::sort(all.begin(), all.end());
  return all;
}

bool holds(const NumberLists& lists, std::size_t rows, int version) {
  const std::vector<std::int64_t> all = sorted(lists);
  const std::int64_t most = version == 41 ? std::numeric_limits<std::int64_t>::max()
                                          : std::numeric_limits<std::int32_t>::max();
  return rows > 0 && all.size() == rows && all.front() >= 1 && all.back() <= most &&
         std::adjacent_find(all.begin(), all.end()) == all.end();
}

Numbers numbers_of(bool is_own, const NumberLists& lists, std::size_t rows) {
  const auto count = static_cast<std::int64_t>(rows);
  if (!is_own) return {false, std::min<std::int64_t>(1, count), count};
  const std::vector<std::int64_t> all = sorted(lists);
  return {true, all.front(), all.back()};
}

std::int64_t point_number(const MshWriter& w, std::size_t row) {
  return w.points.is_own ? w.mesh.source_point_id[row] : static_cast<std::int64_t>(row) + 1;
}

/// Numbers of points and cells: 8 bytes in version 4.1, 4 before it.
void put_number(MshWriter& w, std::int64_t number, char after = ' ') {
  if (w.version == 41) return put<std::int64_t>(w.out, number, after);
  put<std::int32_t>(w.out, number, after);
}

void put_size(MshWriter& w, std::size_t size, char after = ' ') {
  put<std::uint64_t>(w.out, size, after);
}

/// Ends a section's raw data with a line end: text has its own.
void end_section(MshWriter& w, std::string_view name) {
  if (w.out.is_binary) w.out.bytes += '\n';
  put_text(w.out, name);
  w.out.bytes += '\n';
}

void write_names(MshWriter& w) {
  const std::size_t names = name_count(w.mesh);
  if (names == 0 || w.version == 10) return;
  put_text(w.out, "$PhysicalNames\n");
  put_text(w.out, names);
  w.out.bytes += '\n';
  for (std::size_t d = 0; d < 4; ++d) {
    for (const auto& [region, name] : w.mesh.region_name[d]) {
      put_text(w.out, d);
      w.out.bytes += ' ';
      put_text(w.out, region);
      w.out.bytes += " \"" + name + "\"\n";
    }
  }
  put_text(w.out, "$EndPhysicalNames\n");
}

void write_box(MshWriter& w, std::size_t numbers) {
  Point low{}, high{};
  if (!w.mesh.points.empty()) low = high = w.mesh.points.front();
  for (const Point& p : w.mesh.points) {
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  for (const double x : low) put<double>(w.out, x);
  if (numbers == 3) return;
  for (const double x : high) put<double>(w.out, x);
}

void write_entities(MshWriter& w) {
  put_text(w.out, "$Entities\n");
  for (std::size_t d = 0; d < 4; ++d) put_size(w, w.physical[d].size(), d == 3 ? '\n' : ' ');
  for (std::size_t d = 0; d < 4; ++d) {
    for (const auto& [entity, group] : w.physical[d]) {
      put<std::int32_t>(w.out, entity);
      write_box(w, d == 0 && w.version == 41 ? 3 : 6);
      put_size(w, group == 0 ? 0 : 1);
      if (group != 0) put<std::int32_t>(w.out, group);
      if (d > 0) put_size(w, 0);
      if (!w.out.is_binary) w.out.bytes.back() = '\n';
    }
  }
  end_section(w, "$EndEntities");
}

/// All points belong to one entity, of the highest dimension there is.
void write_nodes_4(MshWriter& w) {
  const std::size_t n = w.mesh.points.size();
  int dimension = 3;
  while (dimension > 0 && w.physical[static_cast<std::size_t>(dimension)].empty()) --dimension;
  const auto& entities = w.physical[static_cast<std::size_t>(dimension)];
  const std::int32_t entity = entities.empty() ? 1 : entities.begin()->first;
  put_text(w.out, "$Nodes\n");
  put_size(w, 1);
  put_size(w, n, w.version == 41 ? ' ' : '\n');
  if (w.version == 41) {
    put_size(w, static_cast<std::size_t>(w.points.low));
    put_size(w, static_cast<std::size_t>(w.points.high), '\n');
    put<std::int32_t>(w.out, dimension);
  }
  put<std::int32_t>(w.out, entity);
  if (w.version == 40) put<std::int32_t>(w.out, dimension);
  put<std::int32_t>(w.out, 0);
  put_size(w, n, '\n');
  for (std::size_t i = 0; w.version == 41 && i < n; ++i) put_number(w, point_number(w, i), '\n');
  for (std::size_t i = 0; i < n; ++i) {
    if (w.version == 40) put_number(w, point_number(w, i));
    const Point& p = w.mesh.points[i];
    put<double>(w.out, p[0]), put<double>(w.out, p[1]), put<double>(w.out, p[2], '\n');
  }
  end_section(w, "$EndNodes");
}

void write_nodes_2(MshWriter& w) {
  put_text(w.out, w.version == 10 ? "$NOD\n" : "$Nodes\n");
  put_text(w.out, w.mesh.points.size());
  w.out.bytes += '\n';
  for (std::size_t i = 0; i < w.mesh.points.size(); ++i) {
    put_number(w, point_number(w, i));
    const Point& p = w.mesh.points[i];
    put<double>(w.out, p[0]), put<double>(w.out, p[1]), put<double>(w.out, p[2], '\n');
  }
  end_section(w, w.version == 10 ? "$ENDNOD" : "$EndNodes");
}

/// The nodes of a cell in Gmsh's order; the line ends.
void put_nodes(MshWriter& w, CellKind kind, std::span<const std::uint32_t> nodes) {
  const std::span<const std::uint8_t> order = msh_order(kind);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    put_number(w, point_number(w, nodes[order.empty() ? k : order[k]]));
  }
  if (!w.out.is_binary) w.out.bytes.back() = '\n';
}

/// Numbers, tags and nodes of the cells of a kind in the layout of versions 1 and 2; `row`: how
/// many cells stand before.
void write_kind_2(MshWriter& w, CellKind kind, std::int64_t row) {
  const CellRows rows = rows_of(w.mesh, kind);
  const CellColumns& cells = columns_of(w.mesh, kind);
  const int type = element_type_of(kind)->number;
  for (std::size_t i = 0; i < rows.count; ++i) {
    put_number(w, w.cells.is_own ? cells.source_id[i] : ++row);
    if (!w.out.is_binary) put<std::int32_t>(w.out, type);
    if (!w.out.is_binary && w.version != 10) put<std::int32_t>(w.out, 2);
    put<std::int32_t>(w.out, region_of(cells, i));
    put<std::int32_t>(w.out, w.entity[index_of(kind)][i]);
    if (w.version == 10) put<std::int32_t>(w.out, rows.nodes);
    put_nodes(w, kind, rows[i]);
  }
}

void write_elements_2(MshWriter& w) {
  put_text(w.out, w.version == 10 ? "$ELM\n" : "$Elements\n");
  put_text(w.out, cell_count(w.mesh));
  w.out.bytes += '\n';
  std::int64_t row = 0;
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t rows = rows_of(w.mesh, kind).count;
    if (rows == 0) continue;
    if (w.out.is_binary) {
      put<std::int32_t>(w.out, element_type_of(kind)->number);
      put<std::int32_t>(w.out, rows);
      put<std::int32_t>(w.out, 2);
    }
    write_kind_2(w, kind, row);
    row += static_cast<std::int64_t>(rows);
  }
  end_section(w, w.version == 10 ? "$ENDELM" : "$EndElements");
}

/// Rows where a run of cells of one entity begins, and the end: an entity may have several blocks.
std::vector<std::size_t> block_begins(const std::vector<std::int32_t>& entity) {
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < entity.size(); ++i) {
    if (i == 0 || entity[i] != entity[i - 1]) begins.push_back(i);
  }
  begins.push_back(entity.size());
  return begins;
}

void write_elements_4(MshWriter& w) {
  std::size_t blocks = 0;
  for (const auto& entity : w.entity) blocks += block_begins(entity).size() - 1;
  put_text(w.out, "$Elements\n");
  put_size(w, blocks);
  put_size(w, cell_count(w.mesh), w.version == 41 ? ' ' : '\n');
  if (w.version == 41) {
    put_size(w, static_cast<std::size_t>(w.cells.low));
    put_size(w, static_cast<std::size_t>(w.cells.high), '\n');
  }
  std::int64_t row = 0;
  for (const CellKind kind : all_cell_kinds) {
    const auto& entity = w.entity[index_of(kind)];
    const CellRows rows = rows_of(w.mesh, kind);
    const CellColumns& cells = columns_of(w.mesh, kind);
    const int d = traits_of(kind).dimension;
    const std::vector<std::size_t> begins = block_begins(entity);
    for (std::size_t b = 0; b + 1 < begins.size(); ++b) {
      if (w.version == 41) put<std::int32_t>(w.out, d);
      put<std::int32_t>(w.out, entity[begins[b]]);
      if (w.version == 40) put<std::int32_t>(w.out, d);
      put<std::int32_t>(w.out, element_type_of(kind)->number);
      put_size(w, begins[b + 1] - begins[b], '\n');
      for (std::size_t i = begins[b]; i < begins[b + 1]; ++i) {
        ++row;
        put_number(w, w.cells.is_own ? cells.source_id[i] : row);
        put_nodes(w, kind, rows[i]);
      }
    }
  }
  end_section(w, "$EndElements");
}

/// A value of a column as a double.
double value_of(const DataColumn& column, std::size_t i) {
  return std::visit([&](const auto& v) { return static_cast<double>(v[i]); }, column.values);
}

/// Rows with a number in them: those without were left out where they came from.
std::vector<std::size_t> told_rows(const DataColumn& column, std::size_t rows) {
  std::vector<std::size_t> told;
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t k = 0; k < column.components; ++k) {
      if (std::isnan(value_of(column, i * column.components + k))) continue;
      told.push_back(i);
      break;
    }
  }
  return told;
}

void write_data_head(MshWriter& w, std::string_view section, const DataColumn& column,
                     std::size_t rows) {
  put_text(w.out, section);
  w.out.bytes += "\n1\n\"" + column.name + "\"\n1\n0\n3\n0\n";
  put_text(w.out, column.components);
  w.out.bytes += '\n';
  put_text(w.out, rows);
  w.out.bytes += '\n';
}

template <class NumberOf>
void write_data_rows(MshWriter& w, const DataColumn& column, const std::vector<std::size_t>& rows,
                     NumberOf number_of) {
  for (const std::size_t i : rows) {
    put<std::int32_t>(w.out, number_of(i));
    for (std::size_t k = 0; k < column.components; ++k) {
      put<double>(w.out, value_of(column, i * column.components + k),
                  k + 1 == column.components ? '\n' : ' ');
    }
  }
}

/// The column of a kind of cells that has this name, and its rows with a number in them.
struct DataPart {
  const DataColumn* column = nullptr;
  std::vector<std::size_t> rows;
};

void write_cell_data(MshWriter& w, const std::string& name) {
  std::array<DataPart, cell_kinds> parts;
  std::size_t rows = 0;
  const DataColumn* any = nullptr;
  for (const CellKind kind : all_cell_kinds) {
    for (const DataColumn& column : columns_of(w.mesh, kind).data) {
      if (column.name != name) continue;
      parts[index_of(kind)] = {&column, told_rows(column, rows_of(w.mesh, kind).count)};
      any = &column;
    }
    rows += parts[index_of(kind)].rows.size();
  }
  write_data_head(w, "$ElementData", *any, rows);
  std::size_t first = 1;
  for (const CellKind kind : all_cell_kinds) {
    const DataPart& part = parts[index_of(kind)];
    if (part.column != nullptr) {
      write_data_rows(w, *part.column, part.rows, [&](std::size_t i) {
        return w.cells.is_own ? columns_of(w.mesh, kind).source_id[i]
                              : static_cast<std::int64_t>(first + i);
      });
    }
    first += rows_of(w.mesh, kind).count;
  }
  end_section(w, "$EndElementData");
}

void write_data(MshWriter& w) {
  for (const DataColumn& column : w.mesh.point_data) {
    const std::vector<std::size_t> rows = told_rows(column, w.mesh.points.size());
    write_data_head(w, "$NodeData", column, rows.size());
    write_data_rows(w, column, rows, [&](std::size_t i) { return point_number(w, i); });
    end_section(w, "$EndNodeData");
  }
  // Columns of one name are one section, whatever the kind of their cells.
  for (const DataColumn* const column : ordered_cell_columns(w.mesh)) {
    write_cell_data(w, column->name);
  }
}

}  // namespace

HeldNumbers msh_holds(const FileMesh& mesh, int version) {
  return {holds({mesh.source_point_id}, mesh.points.size(), version),
          holds(cell_numbers(mesh), cell_count(mesh), version)};
}

std::string write_msh(const FileMesh& mesh, int version, bool is_binary) {
  MshWriter w{.out = {.is_binary = is_binary}, .mesh = mesh, .version = version};
  const HeldNumbers own = msh_holds(mesh, version);
  w.points = numbers_of(own.points, {mesh.source_point_id}, mesh.points.size());
  w.cells = numbers_of(own.cells, cell_numbers(mesh), cell_count(mesh));
  find_entities(w);
  w.out.bytes.reserve(64 * mesh.points.size() + 40 * cell_count(mesh));
  if (version != 10) {
    const char* const word = version == 22 ? "2.2" : version == 40 ? "4" : "4.1";
    w.out.bytes += std::string("$MeshFormat\n") + word + (is_binary ? " 1 8\n" : " 0 8\n");
    if (is_binary) put_raw<std::int32_t>(w.out, 1);
    end_section(w, "$EndMeshFormat");
  }
  write_names(w);
  if (version >= 40) write_entities(w);
  version >= 40 ? write_nodes_4(w) : write_nodes_2(w);
  version >= 40 ? write_elements_4(w) : write_elements_2(w);
  if (version != 10) write_data(w);
  return std::move(w.out.bytes);
}

}  // namespace sunder::io
