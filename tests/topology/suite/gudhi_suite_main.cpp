// SPDX-License-Identifier: MIT
// Every fixture's homology, three times: as the fixture says, as ours, and as GUDHI's.
#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <chrono>
#include <limits>

#include "tests/topology/suite/gudhi_homology.hpp"
#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/fixtures/steps.hpp"
#include "topology/suite/judge/judge_truth.hpp"

namespace {

using namespace sunder;
using namespace sunder::suite;

struct Options {
  std::string folder;
  /// Up to how many tetrahedra GUDHI is asked after every operation, and at the end.
  std::size_t every_operation = 2000;
  std::size_t at_end = 10000;
  /// Fixtures of more tetrahedra are left out.
  std::size_t largest = std::numeric_limits<std::uint32_t>::max();
};

/// One fixture's course.
struct Report {
  std::size_t tetrahedra = 0, moments = 0, by_gudhi = 0, comparisons = 0;
  std::vector<std::string> mismatches;
};

void compare(Report& report, const std::string& what, const BettiNumbers& expected,
             const BettiNumbers& answered) {
  ++report.comparisons;
  if (expected == answered) return;
  report.mismatches.push_back(fmt::format("moment {}: {}: expected {}, answered {}", report.moments,
                                          what, fmt::join(expected, " "),
                                          fmt::join(answered, " ")));
}

void compare(Report& report, const IntegerHomology& expected, const IntegerHomology& ours) {
  compare(report, "over Z, ours", expected.betti, ours.betti);
  for (std::size_t d = 0; d < 4; ++d) {
    ++report.comparisons;
    if (expected.torsion[d] == ours.torsion[d]) continue;
    report.mismatches.push_back(fmt::format("moment {}: torsion {}: expected {}, ours {}",
                                            report.moments, d, fmt::join(expected.torsion[d], " "),
                                            fmt::join(ours.torsion[d], " ")));
  }
}

/// Checks the conditions of one moment. GUDHI takes the cells themselves where they are a
/// simplicial complex, at any size, and the barycentric subdivision up to `largest` tetrahedra.
void look(Report& report, const Expected& expected, const GlueTwin& now, std::size_t largest) {
  const OrbitComplex complex = orbit_complex(now);
  const bool directly = test::is_simplicial(complex);
  const bool subdivided = now.tetrahedra.size() <= largest;
  for (const int prime : {2, 3}) {
    const BettiNumbers ours = betti_numbers(complex, prime);
    const auto name = [prime](const char* whose) {
      return fmt::format("GF({}), {}", prime, whose);
    };
    if (const auto said = expected.betti_mod.find(prime); said != expected.betti_mod.end()) {
      compare(report, name("ours"), said->second, ours);
    }
    if (directly) compare(report, name("GUDHI"), ours, test::gudhi_betti(complex, prime));
    if (subdivided) {
      compare(report, name("GUDHI, subdivided"), ours,
              test::gudhi_betti_of_subdivision(complex, prime));
    }
  }
  if (expected.homology) compare(report, *expected.homology, integer_homology(complex));
  if (expected.orientable && *expected.orientable != is_orientable(now)) {
    report.mismatches.push_back(fmt::format("moment {}: orientable", report.moments));
  }
  ++report.moments;
  report.by_gudhi += directly || subdivided ? 1 : 0;
}

void take(GlueTwin& now, const Step& step) {
  const HalfFaceId face = half_face_of(now, step.a), across = now.glued[face.index()];
  if (step.kind == Step::Kind::glue) {
    const HalfFaceId other = half_face_of(now, step.b);
    if (across.is_none() && now.glued[other.index()].is_none()) glue_again(now, face, other);
  } else if (!across.is_none()) {
    now.glued[face.index()] = now.glued[across.index()] = HalfFaceId::none();
  }
}

Report run(const Fixture& fixture, const Options& options) {
  Report report;
  report.tetrahedra = fixture.body.tetrahedra.size();
  if (!is_body(fixture.body)) return report;
  const GlueTwin intact = glue_twin(fixture.body.tetrahedra, fixture.body.points.size());
  GlueTwin now = intact;
  look(report, fixture.built, now,
       fixture.operations.empty() ? options.at_end : options.every_operation);
  for (const ExpectedOperation& operation : fixture.operations) {
    for (const Step& step : steps_of(operation.operation, intact, now, fixture.body)) {
      take(now, step);
    }
    const bool last = &operation == &fixture.operations.back();
    look(report, operation.after, now, last ? options.at_end : options.every_operation);
  }
  return report;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Homology over GF(2) and GF(3) of every fixture of a folder, after loading and after every "
      "operation: what the fixture says, ours and GUDHI's.");
  app.add_option("folder", options.folder, "folder of fixtures, as meshes/suite")->required();
  app.add_option("--every-operation", options.every_operation,
                 "subdivided for GUDHI after every operation up to so many tetrahedra")
      ->capture_default_str();
  app.add_option("--at-end", options.at_end, "and after the last up to so many")
      ->capture_default_str();
  app.add_option("--largest", options.largest, "leave out fixtures of more tetrahedra");
  CLI11_PARSE(app, argc, argv);
  const auto fixtures = read_fixture_folder(options.folder);
  for (const Finding& finding : fixtures.findings) fmt::print("{}\n", finding.text);
  if (!fixtures) return 1;
  fmt::print("{:<44} {:>6} {:>7} {:>8} {:>11} {:>5} {:>8}\n", "fixture", "tets", "moments",
             "by GUDHI", "comparisons", "wrong", "s");
  Report total;
  std::size_t fixtures_run = 0;
  for (const Fixture& fixture : *fixtures) {
    if (fixture.body.tetrahedra.size() > options.largest) continue;
    ++fixtures_run;
    const auto start = std::chrono::steady_clock::now();
    const Report r = run(fixture, options);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    fmt::print("{:<44} {:>6} {:>7} {:>8} {:>11} {:>5} {:>8.3f}\n", fixture.name, r.tetrahedra,
               r.moments, r.by_gudhi, r.comparisons, r.mismatches.size(), time.count());
    for (const std::string& mismatch : r.mismatches) fmt::print("  {}\n", mismatch);
    total.moments += r.moments;
    total.by_gudhi += r.by_gudhi;
    total.comparisons += r.comparisons;
    total.mismatches.insert(total.mismatches.end(), r.mismatches.begin(), r.mismatches.end());
  }
  fmt::print("{} fixtures, {} moments, {} by GUDHI, {} comparisons, {} mismatches\n", fixtures_run,
             total.moments, total.by_gudhi, total.comparisons, total.mismatches.size());
  return total.mismatches.empty() ? 0 : 1;
}
