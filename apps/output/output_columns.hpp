// SPDX-License-Identifier: MIT
// The files of a run: each column and key with its unit and meaning.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sunder {

/// A column of a table, an array of a frame, or a key of a JSON file.
struct OutputColumn {
  /// Keys of nested objects with dots, and [] for the elements of a list: "warnings[].code".
  std::string_view name;
  std::string_view unit;     ///< SI; empty for counts, words and ratios
  std::string_view meaning;  ///< one sentence
  std::string_view when;     ///< scenes that have it; empty: every run
};

/// The columns of one table, frame or JSON file.
struct OutputFile {
  std::string_view file;  ///< "frames/*.vtu"
  std::string_view part;  ///< "points", "one line per fan"; empty where a file has one kind of part
  std::string_view meaning;
  std::span<const OutputColumn> columns;  ///< in the order of the file
};

/// Columns of the tables of a run. `fragments_csv` and its like write their headings from these.
std::span<const OutputColumn> fragment_columns();
std::span<const OutputColumn> crack_columns();
std::span<const OutputColumn> obstacle_columns();

/// Columns of history.csv. B, L, H and K in names stand for rows of the scene's lists.
std::span<const OutputColumn> history_columns();

/// Keys of report.json, and of each kind of line of events.jsonl.
std::span<const OutputColumn> report_keys();
std::span<const OutputColumn> event_head_keys();
std::span<const OutputColumn> event_fan_keys();
std::span<const OutputColumn> event_release_keys();
std::span<const OutputColumn> event_end_keys();

/// Every file that `sunder run` writes.
std::vector<OutputFile> output_files();

/// The names, separated by commas, with the end of a CSV line.
std::string csv_heading(std::span<const OutputColumn> columns);

}  // namespace sunder
