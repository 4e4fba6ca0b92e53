// SPDX-License-Identifier: MIT
// One kernel asked everything about one fixture.
#include "topology/suite/judge/judge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "topology/suite/judge/shrink.hpp"

namespace sunder::suite {
namespace {

std::vector<std::string> codes_of(const std::vector<Finding>& findings) {
  std::vector<std::string> codes;
  for (const Finding& f : findings) codes.push_back(f.code);
  std::sort(codes.begin(), codes.end());
  return codes;
}

std::string list_of(const std::vector<std::string>& words) {
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

std::string face_text(const GlueTwin& twin, FaceSide side) {
  return fmt::format("{}", fmt::join(points_of(twin, side), " "));
}

/// A kernel while it is judged.
struct Trial {
  const Fixture& fixture;
  const Truth& truth;
  JudgedKernel& kernel;
  Checks checks = {};
  /// Which of the truth's operations are run.
  const std::vector<TrueOperation>* running = &truth.operations;
  std::size_t not_asked = 0;
  double kernel_us = 0;
  std::string known_difference = {};

  bool failed() const { return checks.first.has_value(); }

  /// Calls the kernel and takes the time, also that until it was lost.
  template <class Call>
  auto timed(const Call& call) {
    struct Watch {
      double& us;
      std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
      ~Watch() {
        us += std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
                  .count();
      }
    } const watch{kernel_us};
    return call();
  }

  void check_partition(const std::string& what, const std::vector<std::uint32_t>& expected,
                       const std::vector<std::uint32_t>& answered) {
    compare(checks, "length of " + what, expected.size(), answered.size());
    if (failed()) return;
    ++checks.made;
    const auto wrong = partition_difference(expected, first_places(answered));
    if (!wrong) return;
    const bool corners = expected.size() != fixture.body.tetrahedra.size();
    const auto name = [&](std::size_t i) {
      if (!corners) return fmt::format("tetrahedron {}", i);
      return fmt::format("point {} of tetrahedron {}", fixture.body.tetrahedra[i / 4][i % 4],
                         i / 4);
    };
    differ(checks, fmt::format("{}: {} and {}", what, name(wrong->earlier), name(wrong->place)),
           wrong->together ? "one" : "two", wrong->together ? "two" : "one");
  }

  void look(const Moment& moment) {
    compare(checks, moment.counts, timed(kernel.counts));
    if (failed()) return;
    check_partition("vertices", moment.vertex_of_corner, timed(kernel.vertex_of_corner));
    check_partition("components", moment.component_of_tetrahedron,
                    timed(kernel.component_of_tetrahedron));
    if (!kernel.own_faults) return;
    const std::vector<std::string> faults = timed(kernel.own_faults);
    if (!same(checks, true, faults.empty())) {
      differ(checks, "the kernel's own check", "no fault", list_of(faults));
    }
  }

  void check_homology(const Expected& expected, const std::optional<IntegerHomology>& homology) {
    if (homology) {
      const auto answer = kernel.homology ? timed(kernel.homology) : std::nullopt;
      not_asked += answer ? 0 : 1;
      if (answer) compare(checks, *homology, *answer);
    }
    if (!expected.orientable) return;
    const auto answer = kernel.orientable ? timed(kernel.orientable) : std::nullopt;
    not_asked += answer ? 0 : 1;
    if (answer && !same(checks, *expected.orientable, *answer)) {
      differ(checks, "orientable", *answer ? "no" : "yes", *answer ? "yes" : "no");
    }
  }

  /// Compares the kernel's own fan with the faces about to be split.
  void check_fan(const SplitFan& fan, const std::vector<TrueStep>& steps) {
    if (!kernel.fan) {
      ++not_asked;
      return;
    }
    const CornerAt corner = corner_of(truth.intact, fan.vertex);
    std::map<FaceSide, FaceSide> from_positive;
    std::vector<FaceSide> expected, answered;
    for (const TrueStep& s : steps) {
      from_positive[s.across] = s.step.a;
      expected.push_back(s.step.a);
    }
    for (const FaceSide& side : timed([&] { return kernel.fan(corner, fan.normal); })) {
      const auto found = from_positive.find(side);
      answered.push_back(found == from_positive.end() ? side : found->second);
    }
    compare_faces(fmt::format("fan at point {}", corner.point), std::move(expected),
                  std::move(answered));
  }

  /// The same for a break; its faces have to be seen from their positive sides.
  void check_break(const BreakPoint& broken, const std::vector<TrueStep>& steps) {
    if (!kernel.crack_fan) {
      ++not_asked;
      return;
    }
    compare_faces(fmt::format("fan at point {}", broken.point), sides_of(steps),
                  timed([&] { return kernel.crack_fan(broken.point, broken.sides); }));
  }

  /// And for the section of a plane.
  void check_plane(const CuttingPlane& plane, const std::vector<TrueStep>& steps) {
    if (!kernel.plane) {
      ++not_asked;
      return;
    }
    compare_faces("section of a plane", sides_of(steps),
                  timed([&] { return kernel.plane(plane); }));
  }

  static std::vector<FaceSide> sides_of(const std::vector<TrueStep>& steps) {
    std::vector<FaceSide> sides;
    for (const TrueStep& s : steps) sides.push_back(s.step.a);
    return sides;
  }

  void compare_faces(const std::string& what, std::vector<FaceSide> expected,
                     std::vector<FaceSide> answered) {
    std::sort(expected.begin(), expected.end());
    std::sort(answered.begin(), answered.end());
    if (same(checks, expected, answered)) return;
    const auto text = [this](const std::vector<FaceSide>& faces) {
      std::string out;
      for (const FaceSide& f : faces) {
        out += fmt::format("{}{} from tetrahedron {}", out.empty() ? "" : ", ",
                           face_text(truth.intact, f), f.tetrahedron);
      }
      return out.empty() ? "no face" : out;
    };
    differ(checks, what, text(expected), text(answered));
  }

  /// False when the kernel cannot go on.
  bool take(const TrueStep& step) {
    if (step.step.kind == Step::Kind::split) {
      const SplitAnswer answer = timed([&] { return kernel.split(step.step.a); });
      if (!same(checks, step.split, answer)) {
        compare(checks, face_text(truth.intact, step.step.a), step.split, answer);
      }
      return true;
    }
    if (!kernel.glue) return false;
    const bool glued = timed([&] { return kernel.glue(step.step.a, step.step.b); });
    if (!same(checks, step.glued, glued)) {
      differ(checks, "gluing face " + face_text(truth.intact, step.step.a),
             step.glued ? "glued" : "refused", glued ? "glued" : "refused");
    }
    return true;
  }

  /// Whether loading went as expected and there is something to go on with.
  bool load(bool judged) {
    const std::vector<Finding> findings = timed([&] { return kernel.load(fixture.body); });
    const bool refused = has_error(findings);
    if (!judged) return !refused;
    for (const KnownDifference& known : fixture.known_differences) {
      if (known.kernel == kernel.name) return meet(known, refused);
    }
    if (!same(checks, fixture.refused, refused)) {
      differ(checks, "loading", fixture.refused ? "refused" : "accepted",
             refused ? "refused: " + list_of(codes_of(findings)) : "accepted");
    }
    if (!kernel.names_findings) {
      ++not_asked;
    } else if (!same(checks, fixture.findings, codes_of(findings))) {
      differ(checks, "findings", list_of(fixture.findings), list_of(codes_of(findings)));
    }
    return !refused && !failed();
  }

  /// Compares the answers with a known difference; nothing else is judged then.
  bool meet(const KnownDifference& known, bool refused) {
    const CellCounts counts = refused ? CellCounts{} : timed(kernel.counts);
    const bool differs =
        known.counts ? fixture.refused || *known.counts != truth.built.counts : !fixture.refused;
    const bool met = refused ? !known.counts : known.counts && *known.counts == counts;
    if (same(checks, true, differs && met)) {
      known_difference = known.why;
    } else {
      const std::string seen = refused ? "refused" : "accepted with " + text_of(counts);
      differ(checks, "known difference",
             known.counts ? "accepted with " + text_of(*known.counts) : "refused", seen);
    }
    return false;
  }

  static std::string text_of(const CellCounts& c) {
    return fmt::format("V {} E {} F {} T {} C {} BF {} BS {}", c.vertices, c.edges, c.faces,
                       c.tetrahedra, c.components, c.boundary_faces, c.boundary_sheets);
  }

  void run(bool judged) {
    if (!load(judged) || !truth.is_body) return;
    look(truth.built);
    if (!failed()) check_homology(fixture.built, truth.homology);
    for (std::size_t row = 0; row < truth.operations.size() && !failed(); ++row) {
      checks.operation = row + 1;
      if (!run(truth.operations[row], fixture.operations[row])) {
        not_asked += truth.operations.size() - row;
        return;
      }
    }
    if (!failed() && !truth.backwards.empty()) run_backwards();
  }

  /// Breaks once more from the beginning, last first: the map at the end is the same.
  void run_backwards() {
    timed([this] { return kernel.load(fixture.body); });
    running = &truth.backwards;
    checks.step = 0;
    for (std::size_t row = 0; row < truth.backwards.size() && !failed(); ++row) {
      const ExpectedOperation& asked = fixture.operations[truth.backwards.size() - 1 - row];
      checks.operation = row + 1;
      run(truth.backwards[row], {asked.operation, {}});
    }
    if (failed()) checks.first->what += " (breaks in reverse order)";
  }

  /// False when the kernel cannot go on.
  bool run(const TrueOperation& operation, const ExpectedOperation& asked) {
    if (const auto* fan = std::get_if<SplitFan>(&asked.operation)) {
      check_fan(*fan, operation.steps);
    } else if (const auto* broken = std::get_if<BreakPoint>(&asked.operation)) {
      check_break(*broken, operation.steps);
    } else if (const auto* section = std::get_if<SplitPlane>(&asked.operation)) {
      check_plane(section->plane, operation.steps);
    }
    if (failed()) return true;
    for (const TrueStep& step : operation.steps) {
      ++checks.step;
      if (!take(step)) return false;
      if (!failed() && step.after) look(*step.after);
      if (failed()) return true;
    }
    if (operation.after) look(*operation.after);
    if (!failed()) check_homology(asked.after, operation.homology);
    return true;
  }
};

/// The steps up to the one where a mismatch showed.
std::vector<Step> steps_until(const std::vector<TrueOperation>& operations, std::size_t end) {
  std::vector<Step> steps;
  for (const TrueOperation& operation : operations) {
    for (const TrueStep& s : operation.steps) {
      if (steps.size() < end) steps.push_back(s.step);
    }
  }
  return steps;
}

/// Counted from 1.
std::size_t operation_of_step(const std::vector<TrueOperation>& operations, std::size_t step) {
  std::size_t operation = 0, end = 0;
  while (end < step) end += operations[operation++].steps.size();
  return operation;
}

/// As `first_mismatch`, but throws KernelSilent: a kernel that has once exceeded its time is not
/// asked again and again.
std::optional<Mismatch> mismatch_of(const TetMesh& body, std::span<const Step> steps,
                                    JudgedKernel& kernel) {
  Fixture fixture{.name = "steps", .body = body};
  for (const Step& step : steps) fixture.operations.push_back({operation_of(step), {}});
  const Truth truth = truth_of(fixture);
  if (!truth.is_body) return std::nullopt;
  Trial trial{fixture, truth, kernel};
  try {
    trial.run(false);
  } catch (const KernelSilent&) {
    throw;
  } catch (const std::exception& error) {
    differ(trial.checks, "the kernel", "an answer", error.what());
  }
  return std::move(trial.checks.first);
}

/// Takes the fixture's operations apart into steps, to see at which one the mismatch really begins
/// and which of them it needs. Throws KernelSilent.
void narrow_down(Mismatch& mismatch, const Fixture& fixture,
                 const std::vector<TrueOperation>& operations, JudgedKernel& kernel) {
  const auto begins = mismatch_of(fixture.body, mismatch.steps, kernel);
  if (!begins) return;
  if (begins->step < mismatch.step) {
    std::vector<Step> steps = std::move(mismatch.steps);
    steps.resize(begins->step);
    mismatch = *begins;
    mismatch.operation = operation_of_step(operations, begins->step);
    mismatch.steps = std::move(steps);
  }
  const auto fails = [&kernel](const TetMesh& body, std::span<const Step> steps) {
    return mismatch_of(body, steps, kernel).has_value();
  };
  // Some seconds for a kernel that talks through a pipe.
  const ShrinkLimits limits{.body = false, .work = 1500000};
  mismatch.steps = shrink(fixture.body, mismatch.steps, fails, limits).steps;
}

}  // namespace

std::optional<Mismatch> first_mismatch(const TetMesh& body, std::span<const Step> steps,
                                       JudgedKernel& kernel) {
  try {
    return mismatch_of(body, steps, kernel);
  } catch (const KernelSilent& silent) {
    return Mismatch{.what = "the kernel", .expected = "an answer", .answered = silent.what()};
  }
}

Verdict judge(const Fixture& fixture, JudgedKernel& kernel) {
  return judge(fixture, truth_of(fixture), kernel);
}

Verdict judge(const Fixture& fixture, const Truth& truth, JudgedKernel& kernel, bool narrows) {
  Verdict verdict{.fixture = fixture.name,
                  .kernel = kernel.name,
                  .tetrahedra = fixture.body.tetrahedra.size(),
                  .operations = fixture.operations.size()};
  for (const TrueOperation& operation : truth.operations) verdict.steps += operation.steps.size();
  Trial trial{fixture, truth, kernel};
  try {
    trial.run(true);
  } catch (const std::exception& error) {
    verdict.lost = true;
    verdict.silent = dynamic_cast<const KernelSilent*>(&error) != nullptr;
    differ(trial.checks, "the kernel", "an answer", error.what());
  }
  verdict.checks = trial.checks.made;
  verdict.not_asked = trial.not_asked;
  verdict.known_difference = std::move(trial.known_difference);
  verdict.kernel_us = trial.kernel_us;
  verdict.mismatch = std::move(trial.checks.first);
  if (verdict.mismatch) {
    verdict.mismatch->steps = steps_until(*trial.running, verdict.mismatch->step);
    // A kernel that hangs would do so in every trial.
    try {
      if (narrows && !verdict.lost) narrow_down(*verdict.mismatch, fixture, *trial.running, kernel);
    } catch (const KernelSilent&) {
    }
  } else if (truth.checks.first) {
    verdict.mismatch = truth.checks.first;
    verdict.mismatch->what += " (the fixture against union-find)";
    verdict.mismatch->steps = steps_until(truth.operations, verdict.mismatch->step);
  }
  return verdict;
}

}  // namespace sunder::suite
