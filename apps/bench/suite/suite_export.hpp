// SPDX-License-Identifier: MIT
// `sunder suite --export`: everything that judges a kernel without Sunder, as one archive.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/sunder/exit_code.hpp"
#include "topology/suite/fixtures/fixture.hpp"

namespace sunder {

/// Writes `archive` (.tar.gz): a folder sunder-suite with README.md, the protocol, judge.py,
/// minimal.py, fixtures/ (each case as FAMILY.CASE.json with every step and answer, and the schema)
/// and SHA256SUMS. The bytes follow from the fixtures and the source tree alone. bad_input: the
/// page or a program is not in the source tree; not_written; problems: a fixture has expectations
/// that are not true of its body, and nothing is written.
ExitCode export_suite(const std::vector<suite::Fixture>& fixtures,
                      const std::filesystem::path& archive);

}  // namespace sunder
