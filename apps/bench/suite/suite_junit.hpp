// SPDX-License-Identifier: MIT
// Results of `sunder suite` as JUnit XML, which continuous integration reads.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/suite/suite_report.hpp"

namespace sunder {

/// A testsuite for each kernel with a testcase for each fixture: classname the kernel and the
/// fixture's family, name its case. failure: a wrong answer, with all that the table would say;
/// error: a kernel that was lost; skipped: a known difference, with its reason.
/// Leaves: ASCII that both schemas in common use accept, xunit-plugin's and windyroad's.
std::string suite_junit(const SuiteTable& table, const std::vector<SuiteRow>& rows);

}  // namespace sunder
