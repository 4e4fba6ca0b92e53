// SPDX-License-Identifier: MIT
// $NodeData and $ElementData of MSH: columns of numbers, each row under the number of its cell.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "topology/base/counted.hpp"
#include "topology/io/msh/msh_reader.hpp"

namespace sunder::io {
namespace {

/// The head before the rows, as text in binary files too.
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
    const std::size_t at = s.at;
    const std::string_view line = rest_of_line(s);
    if (i > 0) add_skipped(r.draft, "further strings of data", line, at);
    if (i > 0) continue;
    const bool quoted = line.size() >= 2 && line.front() == '"' && line.back() == '"';
    head.name = quoted ? line.substr(1, line.size() - 2) : line;
  }
  const std::size_t reals = read_count(s, "real tags", 2);
  skip_blanks(s);
  const std::size_t time_at = s.at;
  const double time = reals > 0 ? read_number<double>(s, "a time") : 0;
  skip_words(s, reals - (reals > 0), "a real tag");
  if (reals > 1) add_skipped(r.draft, "further numbers of data", head.name, time_at, reals - 1);
  const std::size_t at = s.at;
  const std::size_t integers = read_count(s, "integer tags", 2);
  if (integers < 3) {
    fail(s.text, at,
         {.code = "wrong_count",
          .text = fmt::format("{} integer tags: step, components and rows were expected", integers),
          .remedy = "write the section again"});
  }
  const auto step = read_number<std::int64_t>(s, "a time step");
  if (time != 0 || step != 0) {
    add_skipped(r.draft, "times of data",
                fmt::format("{} of step {}, time {}", head.name, step, time), time_at);
  }
  head.components = read_count(s, "components", 1);
  head.rows = read_count(s, "rows", 4);
  for (std::size_t i = 3; i < integers; ++i) {
    const auto tag = read_number<std::int64_t>(s, "an integer tag");
    if (tag != 0) add_skipped(r.draft, "partitions of data", head.name, time_at);
  }
  check_count(s, s.at, static_cast<std::int64_t>(head.components), "components", 2);
  if (r.in.is_binary) rest_of_line(s);
  return head;
}

/// One column for each kind of cells (or for the points), made when the first row of it comes.
struct Target {
  const NumberIndex* index = nullptr;
  std::size_t rows = 0;
  std::vector<DataColumn>* columns = nullptr;
  std::vector<double> values;
};

std::vector<Target> targets_of(MshReader& r, bool of_nodes) {
  FileMesh& mesh = r.draft.mesh;
  std::vector<Target> targets;
  if (of_nodes) {
    targets.push_back({&r.nodes, mesh.points.size(), &mesh.point_data, {}});
    return targets;
  }
  const bool is_first = !r.cells;
  if (is_first) r.cells.emplace();
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t rows = rows_of(mesh, kind).count;
    if (rows == 0) continue;
    CellColumns& cells = columns_of(mesh, kind);
    NumberIndex& index = (*r.cells)[index_of(kind)];
    std::array<std::int64_t, 2> twice;
    // Of equal numbers the first takes the rows.
    if (is_first) index_numbers(index, cells.source_id, twice);
    targets.push_back({&index, rows, &cells.data, {}});
  }
  return targets;
}

/// Rows that the section leaves out are no numbers. So a few bytes could ask for a column of all
/// rows, again and again: all columns together are bounded by the file's size. Columns that are
/// given in full stay below two thirds of the bound, whatever they hold.
void make_column(MshReader& r, const DataHead& head, Target& target) {
  const std::size_t most = r.in.s.text.size() * 6 / sizeof(double) - r.data_numbers;
  if (head.components > most / target.rows) {
    fail(r.in.s.text, r.in.s.at,
         {.code = "count_too_big",
          .text = fmt::format("{} components for {} rows: with the data before they are more than "
                              "a file of {} bytes should ask for",
                              head.components, target.rows, r.in.s.text.size()),
          .remedy = "correct the count, give the data of all rows, or split the file"});
  }
  r.data_numbers += target.rows * head.components;
  target.values.assign(target.rows * head.components, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void read_msh_data(MshReader& r, bool of_nodes) {
  const DataHead head = read_head(r);
  std::vector<Target> targets = targets_of(r, of_nodes);
  std::size_t strays = 0;
  for (std::size_t i = 0; i < head.rows; ++i) {
    const std::int64_t number = read_int(r, "the number of a row");
    double* out = nullptr;
    for (Target& target : targets) {
      const std::int64_t row = row_of(*target.index, number);
      if (row < 0) continue;
      if (target.values.empty()) make_column(r, head, target);
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
    // Not-a-number means that nothing is given.
    if (std::ranges::all_of(target.values, [](double x) { return x != x; })) continue;
    target.columns->push_back(
        {head.name, head.components, NumberType::float64, std::move(target.values)});
  }
  if (strays == 0) return;
  add_counted(r.draft, "stray_data", [&] {
    return Finding{
        .severity = Severity::warning,
        .text = fmt::format("{} of the data {} {} to no {} that is kept", counted(strays, "row"),
                            in_quotes(head.name), for_count(strays, "belongs", "belong"),
                            of_nodes ? "point" : "cell"),
        .remedy = "nothing to do, if those cells are not needed"};
  });
}

}  // namespace sunder::io
