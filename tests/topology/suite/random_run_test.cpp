// SPDX-License-Identifier: MIT
// Random runs: right kernels pass, each kind of wrong one is caught, and the shrunk run of a
// failure fails again when it is read as a fixture.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "topology/suite/judge/crack_formula.hpp"
#include "topology/suite/judge/judge.hpp"
#include "topology/suite/random/random_run.hpp"
#include "topology/suite/random/random_run_bodies.hpp"
#include "topology/suite/random/random_run_labels.hpp"

using namespace sunder;
using namespace sunder::suite;

namespace {

/// A change of a right kernel into a wrong one.
using Lie = std::function<void(JudgedKernel&)>;

std::function<JudgedKernel()> lying(const Lie& lie) {
  return [lie] {
    JudgedKernel kernel = twin_kernel();
    lie(kernel);
    return kernel;
  };
}

RandomReport run(const std::function<JudgedKernel()>& kernel, std::size_t fans,
                 std::size_t largest) {
  return run_random({.fans = fans, .seed = 20261121, .largest = largest}, kernel);
}

/// The first failure of a run.
const RandomFailure* failure_of(const RandomReport& report) {
  for (const FamilyReport& family : report.families) {
    if (family.failure) return &*family.failure;
  }
  return nullptr;
}

void check_all_fine(const RandomReport& report) {
  for (const FamilyReport& family : report.families) {
    INFO("seed 20261121, family " << family.name);
    if (family.failure) {
      const Mismatch& m = family.failure->first;
      FAIL_CHECK(m.what << ": expected " << m.expected << ", answered " << m.answered << "\n"
                        << family.failure->fixture);
    }
    CHECK(family.counts.missed == 0);
    CHECK(family.counts.separations <= family.counts.alarms);
    CHECK(family.counts.separations > 0);
    CHECK(family.without_sheet_law == 0);
  }
}

/// Judges the fixture that a failure was printed as.
std::optional<Mismatch> judged_again(const RandomFailure& failure,
                                     const std::function<JudgedKernel()>& kernel) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("sunder_random_" + std::to_string(std::rand()) + ".json");
  std::ofstream(file) << failure.fixture;
  const Result<std::vector<Fixture>> fixtures = read_fixtures(file);
  std::filesystem::remove(file);
  REQUIRE(fixtures.value.has_value());
  REQUIRE(fixtures->size() == 1);
  JudgedKernel judged = kernel();
  const Verdict verdict = judge(fixtures->front(), judged);
  JudgedKernel twin = twin_kernel();
  CHECK_FALSE(judge(fixtures->front(), twin).mismatch);
  return verdict.mismatch;
}

std::vector<BreakPoint> at_all_points(const TetMesh& body, const CrackSides& sides) {
  std::vector<BreakPoint> breaks;
  for (std::uint32_t p = 0; p < body.points.size(); ++p) breaks.push_back({p, sides});
  return breaks;
}

/// Wraps a kernel's split so that `change` sees the face and the answer, after the split.
template <class Change>
void change_splits(JudgedKernel& kernel, Change change) {
  const auto right = kernel.split;
  kernel.split = [right, change](FaceSide side) {
    SplitAnswer answer = right(side);
    change(side, answer);
    return answer;
  };
}

}  // namespace

TEST_CASE("our kernel makes no mistake in random fans on bodies of every family",
          "[suite][random]") {
  const RandomReport report = run(volume_map_kernel, 700, 1300);
  CHECK(report.families.size() == 12);
  check_all_fine(report);
  std::size_t fans = 0;
  TearCounts done;
  CheckCounts checks;
  for (const FamilyReport& family : report.families) {
    fans += family.counts.fans;
    done.planes += family.counts.planes;
    done.labelled_fans += family.counts.labelled_fans;
    done.empty_labelled_fans += family.counts.empty_labelled_fans;
    done.fans_in_other_orders += family.counts.fans_in_other_orders;
    done.single_faces += family.counts.single_faces;
    done.glues += family.counts.glues;
    done.vain += family.counts.vain;
    done.orders += family.counts.orders;
    done.replays += family.counts.replays;
    checks.betti_changes += family.checks.betti_changes;
    checks.faults += family.checks.faults;
    checks.fans += family.checks.fans;
    checks.sections += family.checks.sections;
    checks.homologies += family.checks.homologies;
    CHECK(family.checks.wholes > family.bodies);
  }
  CHECK(fans == 700);
  // No kind of operation and no check was forgotten.
  for (const std::size_t n :
       {done.labelled_fans, done.empty_labelled_fans, done.fans_in_other_orders, done.planes,
        done.single_faces, done.glues, done.vain, done.orders, done.replays, checks.betti_changes,
        checks.faults, checks.fans, checks.sections, checks.homologies}) {
    CHECK(n > 0);
  }
}

TEST_CASE("the twin and CGAL's own map make no mistake either", "[suite][random]") {
  check_all_fine(run(twin_kernel, 500, 400));
  for (const auto& kernel : {cgal_kernel, nested_kernel}) check_all_fine(run(kernel, 300, 400));
}

TEST_CASE("the same seed gives the same run whatever the kernel, another seed another run",
          "[suite][random]") {
  const auto faces = [](const RandomReport& report) {
    std::vector<std::size_t> numbers;
    for (const FamilyReport& family : report.families) {
      numbers.insert(numbers.end(), {family.bodies, family.counts.faces, family.counts.vertices,
                                     family.counts.alarms, family.comparisons});
    }
    return numbers;
  };
  const auto first = faces(run(twin_kernel, 100, 100));
  CHECK(faces(run(twin_kernel, 100, 100)) == first);
  CHECK(faces(run_random({.fans = 100, .seed = 1, .largest = 100}, twin_kernel)) != first);
}

TEST_CASE("labels are of many kinds, and most breaks drawn by them cut faces", "[suite][random]") {
  std::mt19937_64 random(6);
  const TetMesh body = kuhn_box({3, 3, 3});
  const GlueTwin intact = glue_twin(body.tetrahedra, body.points.size());
  std::size_t parting = 0, undecided = 0, breaks = 0, cutting = 0, again = 0;
  for (int i = 0; i < 100; ++i) {
    const CrackSides sides = any_labels(body, intact, random);
    REQUIRE(sides.size() == body.tetrahedra.size());
    parting += crack_faces(intact, at_all_points(body, sides)).empty() ? 0 : 1;
    undecided += std::ranges::count(sides, CrackSide::none) > 0 ? 1 : 0;
    std::set<std::pair<std::uint32_t, CrackSides>> met;
    for (const BreakPoint& broken : any_breaks(body, intact, random)) {
      ++breaks;
      cutting += crack_faces(intact, std::span(&broken, 1)).empty() ? 0 : 1;
      again += met.emplace(broken.point, broken.sides).second ? 0 : 1;
    }
  }
  INFO("seed 6: " << parting << " " << undecided << " " << breaks << " " << cutting << " "
                  << again);
  CHECK(parting > 80);
  CHECK((undecided > 15 && undecided < 60));
  CHECK((cutting > breaks / 2 && cutting < breaks));
  CHECK(again > 0);
}

TEST_CASE("families draw the bodies they promise, all of which can be built", "[suite][random]") {
  std::mt19937_64 random(5);
  for (const BodyFamily& family : body_families(600)) {
    INFO("seed 5, family " << family.name);
    std::set<std::size_t> sizes;
    for (int i = 0; i < 20; ++i) {
      const TetMesh body = family.draw(random);
      sizes.insert(body.tetrahedra.size());
      CHECK(body.tetrahedra.size() <= 600);
      CHECK_FALSE(has_error(volume_map_kernel().load(body)));
    }
    CHECK(sizes.size() > 2);
  }
  CHECK(body_families(10000).size() == 15);
}

TEST_CASE("a mesh that is given becomes a family of its own", "[suite][random]") {
  RandomOptions options;
  options.fans = 200;
  options.largest = 0;
  options.meshes = {{"a ring", ring({3, 3, 1})}, {"one tetrahedron", one_tetrahedron()}};
  const RandomReport report = run_random(options, volume_map_kernel);
  REQUIRE(report.families.size() == 2);
  CHECK(report.families[0].name == "a ring");
  CHECK(report.families[0].counts.fans == 100);
  CHECK(report.families[0].fewest == 48);
  CHECK_FALSE(report.families[0].failure);
  // Nothing can be split there: the family ends instead of looking for ever.
  CHECK(report.families[1].counts.fans == 0);
}

TEST_CASE("wrong answers are caught, shrunk to little, and fail again as the fixture printed",
          "[suite][random]") {
  const std::vector<std::pair<std::string, Lie>> lies = {
      {"forgets a vertex of two",
       [](JudgedKernel& kernel) {
         change_splits(kernel, [](FaceSide, SplitAnswer& answer) {
           if (answer.vertices.size() == 2) answer.vertices.pop_back();
         });
       }},
      {"tells an edge too many",
       [](JudgedKernel& kernel) {
         change_splits(kernel, [](FaceSide side, SplitAnswer& answer) {
           if (answer.edges.size() == 1) answer.edges.push_back({side.opposite, side.opposite});
         });
       }},
      {"overlooks separations that three vertices do not show alone",
       [](JudgedKernel& kernel) {
         change_splits(kernel, [](FaceSide side, SplitAnswer& answer) {
           if (side.tetrahedron % 3 == 1) answer.separated = false;
         });
       }},
      {"believes its oracle",
       [](JudgedKernel& kernel) {
         change_splits(kernel, [](FaceSide, SplitAnswer& answer) {
           answer.separated = oracle_says_new(answer);
         });
       }},
      {"takes a boundary face for an interior one",
       [](JudgedKernel& kernel) {
         change_splits(kernel, [](FaceSide, SplitAnswer& answer) { answer.did = true; });
       }},
      {"glues what is whole",
       [](JudgedKernel& kernel) {
         const auto right = kernel.glue;
         kernel.glue = [right](FaceSide a, FaceSide b) { return right(a, b) || true; };
       }},
      {"forgets to glue",
       [](JudgedKernel& kernel) { kernel.glue = [](FaceSide, FaceSide) { return true; }; }},
      {"counts an edge twice after a separation",
       [](JudgedKernel& kernel) {
         const auto right = kernel.counts;
         kernel.counts = [right] {
           CellCounts counts = right();
           if (counts.components == 3) ++counts.edges;
           return counts;
         };
       }},
      {"joins two sheets",
       [](JudgedKernel& kernel) {
         const auto right = kernel.counts;
         kernel.counts = [right] {
           CellCounts counts = right();
           if (counts.boundary_sheets > counts.components) --counts.boundary_sheets;
           return counts;
         };
       }},
      {"gives two vertices one number",
       [](JudgedKernel& kernel) {
         const auto right = kernel.vertex_of_corner;
         kernel.vertex_of_corner = [right] {
           std::vector<std::uint32_t> numbers = right();
           if (numbers.size() > 20) numbers.back() = numbers[numbers.size() - 2];
           return numbers;
         };
       }},
      {"loses a tetrahedron from its component",
       [](JudgedKernel& kernel) {
         const auto right = kernel.component_of_tetrahedron;
         kernel.component_of_tetrahedron = [right] {
           std::vector<std::uint32_t> numbers = right();
           if (numbers.size() > 1) numbers[1] = 77777;
           return numbers;
         };
       }},
      {"finds fault with itself",
       [](JudgedKernel& kernel) {
         const auto counts = kernel.counts;
         kernel.own_faults = [counts] {
           const bool torn = counts().components > 2;
           return torn ? std::vector<std::string>{"a dart is lost"} : std::vector<std::string>{};
         };
       }},
      {"dies",
       [](JudgedKernel& kernel) {
         change_splits(kernel, [](FaceSide, const SplitAnswer& answer) {
           if (answer.edges.empty()) throw KernelLost("no answer to split");
         });
       }},
  };
  for (const auto& [name, lie] : lies) {
    INFO("seed 20261121, a kernel that " << name);
    const RandomReport report = run(lying(lie), 300, 200);
    const RandomFailure* failure = failure_of(report);
    REQUIRE(failure != nullptr);
    INFO(failure->first.what << ": expected " << failure->first.expected << ", answered "
                             << failure->first.answered << "\n"
                             << failure->fixture);
    CHECK(failure->last.has_value());
    CHECK(failure->shrunk.body.tetrahedra.size() <= 12);
    CHECK(failure->shrunk.steps.size() <= 8);
    CHECK(judged_again(*failure, lying(lie)).has_value());
  }
}

TEST_CASE("wrong answers that no single step shows are caught too", "[suite][random]") {
  const std::vector<std::pair<std::string, Lie>> lies = {
      {"fan",
       [](JudgedKernel& kernel) {
         kernel.fan = [](CornerAt, Point) { return std::vector<FaceSide>{}; };
       }},
      {"fan of labels",
       [](JudgedKernel& kernel) {
         kernel.crack_fan = [](std::uint32_t, const CrackSides&) {
           return std::vector<FaceSide>{};
         };
       }},
      {"section",
       [](JudgedKernel& kernel) {
         kernel.plane = [](const CuttingPlane&) { return std::vector<FaceSide>{}; };
       }},
      {"torsion",
       [](JudgedKernel& kernel) {
         kernel.homology = [] {
           IntegerHomology homology;
           homology.torsion[1] = {2};
           return std::optional(homology);
         };
       }},
      {"orientable",
       [](JudgedKernel& kernel) { kernel.orientable = [] { return std::optional(false); }; }}};
  for (const auto& [what, lie] : lies) {
    INFO(what);
    const RandomReport report = run(lying(lie), 600, 100);
    const RandomFailure* failure = failure_of(report);
    REQUIRE(failure != nullptr);
    CHECK_FALSE(failure->last.has_value());
    CHECK(failure->fixture.find("operations") != std::string::npos);
  }
}

TEST_CASE("a kernel that no longer lies when asked again is reported all the same",
          "[suite][random]") {
  const auto splits = std::make_shared<std::size_t>(0);
  const auto kernel = lying([splits](JudgedKernel& k) {
    change_splits(k, [splits](FaceSide, SplitAnswer& answer) {
      if (++*splits == 500) answer.vertices.push_back(4000000);
    });
  });
  const RandomReport report = run(kernel, 600, 200);
  const RandomFailure* failure = failure_of(report);
  REQUIRE(failure != nullptr);
  CHECK_FALSE(failure->last.has_value());
  CHECK(failure->first.what.find("split vertices") != std::string::npos);
  CHECK(failure->found.steps.size() == failure->shrunk.steps.size());
}
