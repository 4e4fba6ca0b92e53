// SPDX-License-Identifier: MIT
// JUnit XML, written by hand: five elements.
#include "apps/bench/suite/suite_junit.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <string_view>

#include "topology/io/vtu/vtu_encode.hpp"

namespace sunder {
namespace {

using suite::Verdict;

/// Text as an attribute or content may have it. Characters outside printable ASCII become '?': XML
/// 1.0 has no way to write most control characters.
std::string in_xml(std::string_view text) {
  std::string out = io::in_xml(text);
  for (char& c : out) c = (c >= ' ' && c <= '~') || c == '\n' ? c : '?';
  return out;
}

std::string host_name() {
  std::array<char, 256> name = {};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] != 0 ? name.data() : "localhost";
}

/// The content of a testcase; empty when all is as expected.
std::string outcome(const Verdict& v, const std::vector<std::string>& steps) {
  if (!v.known_difference.empty()) {
    return fmt::format("<skipped message=\"{}\"/>",
                       in_xml("known difference: " + v.known_difference));
  }
  if (!v.mismatch) return "";
  const char* const kind = v.lost ? "error" : "failure";
  const suite::Mismatch& m = *v.mismatch;
  const std::string message =
      fmt::format("{}: expected {}, answered {}", m.what, m.expected, m.answered);
  return fmt::format("<{0} type=\"{1}\" message=\"{2}\">{3}</{0}>", kind,
                     v.lost ? "lost" : "mismatch", in_xml(message),
                     in_xml(verdict_details(v, steps)));
}

std::string testcase(const std::string& kernel, const SuiteRow& row, std::size_t k) {
  const std::size_t slash = row.fixture.find('/');
  const Verdict& v = row.verdicts[k];
  return fmt::format(
      "    <testcase classname=\"{}.{}\" name=\"{}\" time=\"{:.6f}\">{}</testcase>\n",
      in_xml(kernel), in_xml(row.fixture.substr(0, slash)),
      in_xml(row.fixture.substr(slash == std::string::npos ? 0 : slash + 1)), v.kernel_us * 1e-6,
      outcome(v, row.steps_in_words[k]));
}

std::string testsuite(const SuiteTable& table, const std::vector<SuiteRow>& rows, std::size_t k) {
  std::size_t failures = 0, errors = 0, skipped = 0;
  double seconds = 0;
  std::string cases;
  for (const SuiteRow& row : rows) {
    const Verdict& v = row.verdicts[k];
    skipped += v.known_difference.empty() ? 0 : 1;
    errors += is_wrong(v) && v.lost ? 1 : 0;
    failures += is_wrong(v) && !v.lost ? 1 : 0;
    seconds += v.kernel_us * 1e-6;
    cases += testcase(table.kernels[k], row, k);
  }
  return fmt::format(
      "  <testsuite name=\"{}\" package=\"sunder.suite\" id=\"{}\" "
      "timestamp=\"{:%Y-%m-%dT%H:%M:%S}\" "
      "hostname=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n"
      "    <properties/>\n{}    <system-out/>\n    <system-err/>\n  </testsuite>\n",
      in_xml(table.kernels[k]), k, fmt::gmtime(std::chrono::system_clock::to_time_t(table.started)),
      in_xml(host_name()), rows.size(), failures, errors, skipped, seconds, cases);
}

}  // namespace

std::string suite_junit(const SuiteTable& table, const std::vector<SuiteRow>& rows) {
  std::string suites;
  for (std::size_t k = 0; k < table.kernels.size(); ++k) suites += testsuite(table, rows, k);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" + suites + "</testsuites>\n";
}

}  // namespace sunder
