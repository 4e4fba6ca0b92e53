// SPDX-License-Identifier: MIT
// $NodeData and $ElementData of MSH: columns of numbers, each row under the number of its cell.
#include <fmt/format.h>

#include <limits>

#include "topology/io/msh_reader.hpp"

namespace sunder::io {
namespace {

/// What stands before the rows, as text in binary files too.
struct DataHead {
  std::string name;
  std::size_t components = 0;
  std::size_t rows = 0;
};

DataHead read_head(MshReader& r) {
  Scanner& s = r.in.s;
  DataHead head;
  const std::size_t strings = read_count(s, "string tags", 2);
  rest_of_line(s);
  for (std::size_t i = 0; i < strings; ++i) {
    const std::string_view line = rest_of_line(s);
    if (i > 0) continue;
    const bool quoted = line.size() >= 2 && line.front() == '"' && line.back() == '"';
    head.name = quoted ? line.substr(1, line.size() - 2) : line;
  }
  skip_words(s, read_count(s, "real tags", 2), "a real tag");
  const std::size_t at = s.at;
  const std::size_t integers = read_count(s, "integer tags", 2);
  if (integers < 3) {
    fail(s.text, at,
         {.code = "wrong_count",
          .text = fmt::format("{} integer tags: step, components and rows were expected", integers),
          .remedy = "write the section again"});
  }
  skip_words(s, 1, "a time step");
  head.components = read_count(s, "components", 1);
  head.rows = read_count(s, "rows", 4);
  skip_words(s, integers - 3, "an integer tag");
  check_count(s, s.at, static_cast<std::int64_t>(head.components), "components", 2);
  if (r.in.is_binary) rest_of_line(s);
  return head;
}

/// One column for each kind of cells (or for the points), made when the first row of it comes.
struct Target {
  NumberIndex index;
  std::size_t rows = 0;
  std::vector<DataColumn>* columns = nullptr;
  std::vector<double> values;
};

/// Rows by number, of points or of cells of one dimension.
Target target_of(const std::vector<std::int64_t>& numbers, std::vector<DataColumn>& columns) {
  Target target{.rows = numbers.size(), .columns = &columns};
  std::array<std::int64_t, 2> twice;
  index_numbers(target.index, numbers, twice);  // of equal numbers the first takes the rows
  return target;
}

/// Rows that the section leaves out are no numbers. What a hostile file can ask for is bounded by
/// its size: more than a tensor a row only where the bytes to fill it are there.
void make_room(const MshReader& r, const DataHead& head, Target& target) {
  const std::size_t bytes = r.in.s.text.size();
  if (head.components > 9 && head.components > bytes / target.rows) {
    fail(r.in.s.text, r.in.s.at,
         {.code = "count_too_big",
          .text = fmt::format("{} components for {} rows, more than {} bytes hold", head.components,
                              target.rows, bytes),
          .remedy = "correct the count, or give the data of all rows"});
  }
  target.values.assign(target.rows * head.components, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void read_msh_data(MshReader& r, bool of_nodes) {
  FileMesh& mesh = r.draft.mesh;
  const DataHead head = read_head(r);
  std::vector<Target> targets;
  if (of_nodes) {
    targets.push_back(target_of(mesh.source_point_id, mesh.point_data));
  } else {
    for_each_cell_list(
        mesh, [&](auto& cells, int) { targets.push_back(target_of(cells.source_id, cells.data)); });
  }
  std::size_t strays = 0;
  for (std::size_t i = 0; i < head.rows; ++i) {
    const std::int64_t number = read_int(r, "the number of a row");
    double* out = nullptr;
    for (Target& target : targets) {
      const std::int64_t row = row_of(target.index, number);
      if (row < 0) continue;
      if (target.values.empty()) make_room(r, head, target);
      out = target.values.data() + static_cast<std::size_t>(row) * head.components;
      break;
    }
    strays += out == nullptr;
    for (std::size_t k = 0; k < head.components; ++k) {
      const double value = read_next<double>(r.in, "a value");
      if (out != nullptr) out[k] = value;
    }
  }
  for (Target& target : targets) {
    if (target.values.empty()) continue;
    target.columns->push_back(
        {head.name, head.components, NumberType::float64, std::move(target.values)});
  }
  if (strays > 0) {
    r.draft.findings.push_back(
        {.code = "stray_data",
         .severity = Severity::warning,
         .count = strays,
         .text = fmt::format("{} rows of the data {} belong to no {} that is kept", strays,
                             in_quotes(head.name), of_nodes ? "point" : "cell"),
         .remedy = "nothing to do, if those cells are not needed"});
  }
}

}  // namespace sunder::io
