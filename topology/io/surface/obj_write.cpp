// SPDX-License-Identifier: MIT
// OBJ written: points, then cells, a group for each run of a region.
#include <fmt/format.h>

#include "topology/io/regions/named_regions.hpp"
#include "topology/io/surface/obj.hpp"
#include "topology/io/text/number_sink.hpp"

namespace sunder::io {

std::string write_obj(const FileMesh& mesh) {
  constexpr std::string_view letters[] = {"p", "l", "f"};
  const RegionNames words = region_words(mesh.region_name);
  NumberSink out;
  out.bytes.reserve(64 + 60 * mesh.points.size() + 24 * cell_count(mesh));
  put_text(out, "# OBJ written by sunder\n");
  for (const Point& p : mesh.points) {
    put_text(out, "v");
    for (const double x : p) {
      out.bytes += ' ';
      put_text(out, x);
    }
    out.bytes += '\n';
  }
  const auto put_cells = [&](CellKind kind) {
    const CellRows rows = rows_of(mesh, kind);
    const int dimension = traits_of(kind).dimension;
    const std::vector<std::int32_t>& label = label_of(columns_of(mesh, kind));
    for (std::size_t i = 0; i < rows.count; ++i) {
      if (!label.empty() && (i == 0 || label[i] != label[i - 1])) {
        put_text(out, fmt::format("g {}\n", word_of_region(words, dimension, label[i])));
      }
      put_text(out, letters[dimension]);
      for (const std::uint32_t corner : rows[i]) {
        out.bytes += ' ';
        put_text(out, corner + 1L);
      }
      out.bytes += '\n';
    }
  };
  constexpr CellKind kinds[] = {CellKind::vertex, CellKind::edge, CellKind::triangle,
                                CellKind::quad4, CellKind::polygon};
  // Cells without a region first: a group does not end but with the next.
  for (const bool has_regions : {false, true}) {
    for (const CellKind kind : kinds) {
      if (label_of(columns_of(mesh, kind)).empty() != has_regions) put_cells(kind);
    }
  }
  return std::move(out.bytes);
}

}  // namespace sunder::io
