// SPDX-License-Identifier: MIT
// Findings and counts as the program prints them: plain lines, and JSON for machines.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/kernel/counts.hpp"

namespace sunder {

/// Two lines per finding: "FILE:LINE: error: text [code, COUNT times: ids]", then its remedy.
/// Warnings and notes with one code about several bodies or obstacles of a scene are one: the text
/// of the first, the places of three more, the count of all. O(findings x kinds).
std::string finding_lines(const std::vector<Finding>& findings, bool coloured = false);

/// [{code, severity, count, ids, text, remedy, file, line}].
nlohmann::ordered_json findings_json(const std::vector<Finding>& findings);

/// {file_vertices, vertices, edges, faces, tetrahedra, components, boundary_faces,
/// boundary_sheets}.
nlohmann::ordered_json cell_counts_json(std::size_t file_vertices, const Counts& counts);

/// {euler_characteristic, betti, volume}; betti is null where it is not defined.
nlohmann::ordered_json invariants_json(const Counts& counts);

/// "b0 b1 b2"; "-" where they are not defined.
std::string betti_text(const Counts& counts);

/// The numbers of a comma-separated list; none when a part is no number or the list has another
/// length.
std::optional<std::vector<double>> numbers_of(std::string_view list, std::size_t length);

/// Why the value of an option `--plane` is not four numbers "NX,NY,NZ,D"; empty where it is.
std::string check_plane(const std::string& list);

/// "yes" or "no".
std::string_view yes_or_no(bool is_so);

}  // namespace sunder
