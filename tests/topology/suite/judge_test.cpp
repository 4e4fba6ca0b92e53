// SPDX-License-Identifier: MIT
// The judge on trial: kernels that lie about one number, fixtures that expect a wrong one, and
// kernels with a known difference.
#include <catch2/catch.hpp>

#include <functional>
#include <memory>
#include <stdexcept>

#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/judge/judge.hpp"

using namespace sunder;
using namespace sunder::suite;

namespace {

/// The questions to a kernel since it was loaded.
struct Asked {
  std::size_t splits = 0;
  FaceSide last;
};

/// The twin with one thing changed; `change` gets the questions so far.
JudgedKernel changed(const std::function<void(JudgedKernel&, const Asked&)>& change) {
  const auto asked = std::make_shared<Asked>();
  JudgedKernel twin = twin_kernel();
  JudgedKernel kernel = twin;
  kernel.name = "changed";
  kernel.load = [asked, twin](const TetMesh& mesh) {
    *asked = {};
    return twin.load(mesh);
  };
  kernel.split = [asked, twin](FaceSide side) {
    const SplitAnswer answer = twin.split(side);
    asked->splits += answer.did ? 1 : 0;
    asked->last = side;
    return answer;
  };
  change(kernel, *asked);
  return kernel;
}

/// Figure 5's body, a fan and a plane: 13 faces and more.
Fixture figure_5() {
  Fixture fixture{.name = "figure-5", .body = kuhn_box({2, 2, 2})};
  for (const std::array<std::uint32_t, 3>& face :
       {std::array{1U, 4U, 14U}, {4U, 14U, 17U}, {4U, 7U, 17U}}) {
    fixture.operations.push_back({SplitFace{face}, {}});
  }
  fixture.operations.push_back({SplitFan{13U, {0, 0, 1}}, {}});
  fixture.operations.push_back({GlueFace{std::array{1U, 4U, 14U}}, {}});
  fixture.operations.push_back({Shatter{}, {}});
  return fixture;
}

Mismatch mismatch_of(const Fixture& fixture, JudgedKernel kernel) {
  const Verdict verdict = judge(fixture, kernel);
  REQUIRE(verdict.mismatch);
  UNSCOPED_INFO("operation " << verdict.mismatch->operation << ", step " << verdict.mismatch->step
                             << ", " << verdict.mismatch->what << ": expected "
                             << verdict.mismatch->expected << ", answered "
                             << verdict.mismatch->answered);
  return *verdict.mismatch;
}

}  // namespace

TEST_CASE("a right kernel has no mismatch, and every answer was compared", "[suite][judge]") {
  for (JudgedKernel kernel : {twin_kernel(), volume_map_kernel(), nested_kernel(), cgal_kernel()}) {
    const Verdict verdict = judge(figure_5(), kernel);
    INFO(kernel.name);
    CHECK_FALSE(verdict.mismatch);
    CHECK(verdict.kernel == kernel.name);
    CHECK(verdict.tetrahedra == 48);
    CHECK(verdict.operations == 6);
    CHECK(verdict.steps == 74);  // 3, 6 of the fan, a glue, all 72 less 8
    // A split's answer and seven counts with two partitions each time, at least.
    CHECK(verdict.checks > 73 + 74 * 9);
    CHECK(verdict.kernel_us > 0);
  }
}

TEST_CASE("one wrong number is caught where it begins, with the fewest steps", "[suite][judge]") {
  struct Lie {
    const char* what;
    const char* expected;
    const char* answered;
    std::size_t step, fewest;
    std::function<void(JudgedKernel&, const Asked&)> change;
  };
  const auto count = [](std::size_t CellCounts::*number, std::size_t from) {
    return [=](JudgedKernel& k, const Asked& asked) {
      k.counts = [=, honest = k.counts, &asked] {
        CellCounts c = honest();
        c.*number += asked.splits >= from ? 1 : 0;
        return c;
      };
    };
  };
  const auto split = [](const std::function<void(SplitAnswer&)>& lie, std::size_t at) {
    return [=](JudgedKernel& k, const Asked& asked) {
      k.split = [=, honest = k.split, &asked](FaceSide side) {
        SplitAnswer answer = honest(side);
        if (asked.splits == at) lie(answer);
        return answer;
      };
    };
  };
  const std::vector<Lie> lies = {
      {"vertices", "27", "28", 0, 0, count(&CellCounts::vertices, 0)},
      {"edges", "104", "105", 3, 3, count(&CellCounts::edges, 3)},
      {"faces", "121", "122", 1, 1, count(&CellCounts::faces, 1)},
      {"tetrahedra", "48", "49", 2, 2, count(&CellCounts::tetrahedra, 2)},
      {"components", "1", "2", 4, 4, count(&CellCounts::components, 4)},
      {"boundary faces", "52", "53", 2, 2, count(&CellCounts::boundary_faces, 2)},
      {"boundary sheets", "1", "2", 1, 1, count(&CellCounts::boundary_sheets, 1)},
      {"split vertices of face 4 7 17", "4 7 17", "4 7", 3, 3,
       split([](SplitAnswer& a) { a.vertices.pop_back(); }, 3)},
      {"split edges of face 1 4 14", "1-4", "none", 1, 1,
       split([](SplitAnswer& a) { a.edges.clear(); }, 1)},
      {"separation by face 4 14 17", "one", "two components", 2, 2,
       split([](SplitAnswer& a) { a.separated = true; }, 2)},
      {"splitting face 1 4 14", "a split", "a boundary face", 1, 1,
       split([](SplitAnswer& a) { a = {}; }, 1)},
  };
  for (const Lie& lie : lies) {
    const Mismatch m = mismatch_of(figure_5(), changed(lie.change));
    CHECK(m.what == lie.what);
    CHECK(m.expected == lie.expected);
    CHECK(m.answered == lie.answered);
    CHECK(m.step == lie.step);
    CHECK(m.operation == std::min<std::size_t>(lie.step, 4));
    CHECK(m.steps.size() == lie.fewest);
  }
}

TEST_CASE("a mismatch seen at the end of an operation is traced to its step", "[suite][judge]") {
  // Above 64 tetrahedra a shatter is looked at when it is done.
  Fixture fixture{.name = "box", .body = kuhn_box({3, 3, 3})};
  fixture.operations = {{SplitFace{std::array{0U, 1U, 21U}}, {}}, {Shatter{}, {}}};
  const auto lie = [](JudgedKernel& k, const Asked& asked) {
    k.counts = [honest = k.counts, &asked] {
      CellCounts c = honest();
      c.edges += asked.splits >= 20 ? 1 : 0;
      return c;
    };
  };
  const Mismatch m = mismatch_of(fixture, changed(lie));
  CHECK(m.what == "edges");
  CHECK(m.operation == 2);
  CHECK(m.step == 20);
  CHECK(m.steps.size() == 20);
}

TEST_CASE("a lie that needs two certain faces is shown with just these", "[suite][judge]") {
  // Wrong once face 4 of the fan was split after figure 5's b.
  const auto lie = [](JudgedKernel& k, const Asked&) {
    const auto seen = std::make_shared<int>(0);
    k.load = [seen, honest = k.load](const TetMesh& mesh) {
      *seen = 0;
      return honest(mesh);
    };
    k.split = [seen, honest = k.split](FaceSide side) {
      if (side.tetrahedron == 19 && *seen == 0) *seen = 1;
      if (side.tetrahedron == 32 && *seen == 1) *seen = 2;
      return honest(side);
    };
    k.counts = [seen, honest = k.counts] {
      CellCounts c = honest();
      c.edges -= *seen == 2 ? 1 : 0;
      return c;
    };
  };
  const Mismatch m = mismatch_of(figure_5(), changed(lie));
  CHECK(m.what == "edges");
  CHECK(m.step == 6);
  REQUIRE(m.steps.size() == 2);
  CHECK(m.steps[0].a.tetrahedron == 19);
  CHECK(m.steps[1].a.tetrahedron == 32);
}

TEST_CASE("orbits and components are compared as partitions", "[suite][judge]") {
  const auto shifted = [](JudgedKernel& k, const Asked&) {
    k.vertex_of_corner = [honest = k.vertex_of_corner] {
      std::vector<std::uint32_t> rows = honest();
      for (std::uint32_t& r : rows) r = 4000000000U - 3 * r;  // other numbers, same partition
      return rows;
    };
  };
  JudgedKernel kernel = changed(shifted);
  CHECK_FALSE(judge(figure_5(), kernel).mismatch);

  const auto joined = [](JudgedKernel& k, const Asked&) {
    k.vertex_of_corner = [honest = k.vertex_of_corner] {
      std::vector<std::uint32_t> rows = honest();
      for (std::uint32_t& r : rows) r = r == rows[5] ? rows[0] : r;
      return rows;
    };
  };
  Mismatch m = mismatch_of(figure_5(), changed(joined));
  CHECK(m.what.substr(0, 10) == "vertices: ");
  CHECK(m.expected == "two");
  CHECK(m.answered == "one");

  const auto torn = [](JudgedKernel& k, const Asked& asked) {
    k.component_of_tetrahedron = [honest = k.component_of_tetrahedron, &asked] {
      std::vector<std::uint32_t> rows = honest();
      if (asked.splits >= 2) rows[7] = 999999;
      return rows;
    };
  };
  m = mismatch_of(figure_5(), changed(torn));
  CHECK(m.what == "components: tetrahedron 0 and tetrahedron 7");
  CHECK(m.expected == "one");
  CHECK(m.step == 2);

  const auto short_list = [](JudgedKernel& k, const Asked&) {
    k.component_of_tetrahedron = [] { return std::vector<std::uint32_t>(47, 0); };
  };
  m = mismatch_of(figure_5(), changed(short_list));
  CHECK(m.what == "length of components");
}

TEST_CASE("after a split on a boundary face nothing may have changed", "[suite][judge]") {
  Fixture fixture = figure_5();
  fixture.operations = {{SplitFace{std::array{1U, 4U, 14U}}, {}},
                        {SplitFace{std::array{1U, 4U, 14U}}, {}}};
  const auto lie = [](JudgedKernel& k, const Asked&) {
    const auto extra = std::make_shared<std::size_t>(0);
    k.load = [extra, honest = k.load](const TetMesh& mesh) {
      *extra = 0;
      return honest(mesh);
    };
    k.split = [extra, honest = k.split](FaceSide side) {
      const SplitAnswer answer = honest(side);
      *extra += answer.did ? 0 : 1;
      return answer;
    };
    k.counts = [extra, honest = k.counts] {
      CellCounts c = honest();
      c.vertices += *extra;
      return c;
    };
  };
  const Mismatch m = mismatch_of(fixture, changed(lie));
  CHECK(m.what == "vertices");
  CHECK(m.step == 2);
}

TEST_CASE("fans, glues, faults, homology and orientability are judged where a kernel has them",
          "[suite][judge]") {
  Fixture fixture = figure_5();
  fixture.built.homology = IntegerHomology{{1, 0, 0, 0}, {}};
  fixture.built.orientable = true;
  fixture.operations[1].after.betti_mod[2] = {1, 1, 0, 0};
  JudgedKernel silent = changed([](JudgedKernel& k, const Asked&) {
    k.orientable = {};
    k.homology = {};
    k.glue = {};
  });
  const Verdict verdict = judge(fixture, silent);
  CHECK_FALSE(verdict.mismatch);
  // Findings, orientability, homology twice, the fan, and the two operations from the glue on.
  CHECK(verdict.not_asked == 7);

  const auto fan = [](JudgedKernel& k, const Asked&) {
    JudgedKernel honest = volume_map_kernel();
    honest.load(kuhn_box({2, 2, 2}));
    k.fan = [honest](CornerAt c, Point n) {
      std::vector<FaceSide> faces = honest.fan(c, n);
      faces.pop_back();
      return faces;
    };
  };
  CHECK(mismatch_of(fixture, changed(fan)).what == "fan at point 13");
  const auto glue = [](JudgedKernel& k, const Asked&) {
    k.glue = [](FaceSide, FaceSide) { return false; };
  };
  const Mismatch m = mismatch_of(fixture, changed(glue));
  CHECK(m.what == "gluing face 1 4 14");
  CHECK(m.answered == "refused");
  CHECK(m.steps.size() == 2);  // the split and the glue
  const auto faults = [](JudgedKernel& k, const Asked& asked) {
    k.own_faults = [&asked] {
      return asked.splits < 5 ? std::vector<std::string>{} : std::vector<std::string>{"row 7"};
    };
  };
  CHECK(mismatch_of(fixture, changed(faults)).answered == "row 7");
  CHECK(mismatch_of(fixture, changed(faults)).step == 5);
  const auto torsion = [](JudgedKernel& k, const Asked& asked) {
    k.homology = [&asked] {
      IntegerHomology h{{1, asked.splits == 2 ? 1U : 0U, 0, 0}, {}};
      if (asked.splits == 2) h.torsion[1] = {2};
      return std::optional(h);
    };
  };
  CHECK(mismatch_of(fixture, changed(torsion)).what == "torsion in dimension 1");
  CHECK(mismatch_of(fixture, changed(torsion)).answered == "[2]");
  const auto twisted = [](JudgedKernel& k, const Asked&) {
    k.orientable = [] { return std::optional<bool>(false); };
  };
  CHECK(mismatch_of(fixture, changed(twisted)).what == "orientable");
}

TEST_CASE("the section of a plane is judged, each face from its positive side", "[suite][judge]") {
  Fixture fixture{.name = "box", .body = kuhn_box({2, 2, 2})};
  fixture.operations = {{SplitPlane{{{0, 0, 1}, 1}}, {}}};
  using Lie = std::function<void(std::vector<FaceSide>&)>;
  const auto planes = [&fixture](const Lie& lie) {
    return changed([&fixture, lie](JudgedKernel& k, const Asked&) {
      JudgedKernel honest = volume_map_kernel();
      honest.load(fixture.body);
      k.plane = [honest, lie](const CuttingPlane& plane) {
        std::vector<FaceSide> faces = honest.plane(plane);
        lie(faces);
        return faces;
      };
    });
  };
  JudgedKernel honest = planes([](std::vector<FaceSide>& faces) { CHECK(faces.size() == 8); });
  const Verdict verdict = judge(fixture, honest);
  CHECK_FALSE(verdict.mismatch);
  JudgedKernel silent = changed([](JudgedKernel&, const Asked&) {});
  CHECK(judge(fixture, silent).not_asked == verdict.not_asked + 1);
  const GlueTwin intact = glue_twin(fixture.body.tetrahedra, fixture.body.points.size());
  for (const Lie& lie : {Lie([](auto& faces) { faces.pop_back(); }),
                         Lie([](auto& faces) { faces.push_back(faces[0]); }), Lie([&](auto& faces) {
                           const HalfFaceId f = half_face_of(intact, faces[0]);
                           faces[0] = side_of(intact, intact.glued[f.index()]);
                         })}) {
    const Mismatch m = mismatch_of(fixture, planes(lie));
    CHECK(m.what == "section of a plane");
    CHECK(m.operation == 1);
    CHECK(m.step == 0);
  }
}

TEST_CASE("a kernel that throws has a mismatch, and the steps up to there", "[suite][judge]") {
  const auto thrower = [](JudgedKernel& k, const Asked& asked) {
    k.counts = [honest = k.counts, &asked] {
      if (asked.splits == 4) throw KernelLost("gone for lunch");
      return honest();
    };
  };
  JudgedKernel kernel = changed(thrower);
  const Verdict verdict = judge(figure_5(), kernel);
  REQUIRE(verdict.mismatch);
  CHECK(verdict.lost);
  CHECK(verdict.mismatch->answered == "gone for lunch");
  CHECK(verdict.mismatch->steps.size() == 4);
}

TEST_CASE("a kernel that gives no answer in its time is told from one that is lost otherwise",
          "[suite][judge]") {
  const auto silent = [](JudgedKernel& k, const Asked& asked) {
    k.counts = [honest = k.counts, &asked] {
      if (asked.splits == 4) throw KernelSilent("asleep");
      return honest();
    };
  };
  JudgedKernel kernel = changed(silent);
  const Verdict verdict = judge(figure_5(), kernel);
  REQUIRE(verdict.mismatch);
  CHECK(verdict.lost);
  CHECK(verdict.silent);
  CHECK(verdict.mismatch->answered == "asleep");
  // Where a mismatch is only narrowed down, silence is one more way to fail.
  std::vector<Step> four = verdict.mismatch->steps;
  const auto again = first_mismatch(figure_5().body, four, kernel);
  REQUIRE(again);
  CHECK(again->answered == "asleep");
}

TEST_CASE("a wrong kernel that falls silent while its steps are shrunk is asked no more",
          "[suite][judge]") {
  const auto loads = std::make_shared<int>(0);
  const auto lie = [loads](JudgedKernel& k, const Asked& asked) {
    k.load = [loads, honest = k.load](const TetMesh& mesh) {
      ++*loads;
      return honest(mesh);
    };
    k.counts = [loads, honest = k.counts, &asked] {
      if (*loads > 1) throw KernelSilent("asleep");
      CellCounts c = honest();
      c.edges += asked.splits >= 3 ? 1 : 0;
      return c;
    };
  };
  JudgedKernel kernel = changed(lie);
  const Verdict verdict = judge(figure_5(), kernel);
  REQUIRE(verdict.mismatch);
  CHECK_FALSE(verdict.lost);
  CHECK(verdict.mismatch->what == "edges");
  CHECK(verdict.mismatch->steps.size() == 3);
  CHECK(*loads == 2);
}

TEST_CASE("refusals and findings are judged", "[suite][judge]") {
  Fixture bad{.name = "bad", .body = two_tetrahedra(), .findings = {"repeated_vertex"}};
  bad.refused = true;
  bad.body.tetrahedra.push_back({0, 1, 1, 4});
  JudgedKernel twin = twin_kernel(), map = volume_map_kernel();
  CHECK_FALSE(judge(bad, twin).mismatch);
  CHECK_FALSE(judge(bad, map).mismatch);
  bad.findings = {"repeated_vertex", "unused_point"};
  CHECK(judge(bad, map).mismatch->what == "findings");
  CHECK_FALSE(judge(bad, twin).mismatch);  // it does not name notes
  bad.refused = false;
  CHECK(judge(bad, twin).mismatch->what == "loading");
  Fixture good{.name = "good", .body = two_tetrahedra()};
  good.refused = true;
  const Mismatch m = mismatch_of(good, twin);
  CHECK(m.expected == "refused");
  CHECK(m.answered == "accepted");
}

TEST_CASE("what a fixture expects is held against union-find", "[suite][judge]") {
  const auto said = [](const std::function<void(Fixture&)>& change) {
    Fixture fixture = figure_5();
    change(fixture);
    const Truth truth = truth_of(fixture);
    return truth.checks.first ? truth.checks.first->what : std::string("nothing");
  };
  CHECK(said([](Fixture&) {}) == "nothing");
  CHECK(said([](Fixture& f) { f.file_cells = {27, 98, 121}; }) == "faces of the file");
  CHECK(said([](Fixture& f) { f.file_cells = {27, 98, 120}; }) == "nothing");
  CHECK(said([](Fixture& f) { f.built.euler_characteristic = 2; }) == "Euler characteristic");
  CHECK(said([](Fixture& f) { f.built.counts = CellCounts{27, 98, 120, 48, 2, 48, 1}; }) ==
        "components");
  CHECK(said([](Fixture& f) { f.built.betti_mod[3] = {1, 1, 0, 0}; }) == "b1 over GF(3)");
  CHECK(said([](Fixture& f) {
          f.built.homology = IntegerHomology{{1, 0, 1, 0}, {}};
        }) == "b2 over Z");
  CHECK(said([](Fixture& f) { f.built.orientable = false; }) == "orientable");
  const auto after = [&said](const std::function<void(Expected&)>& change) {
    return said([&change](Fixture& f) { change(f.operations[2].after); });
  };
  CHECK(after([](Expected& e) { e.splits.emplace(); }) == "faces of the operation");
  CHECK(after([](Expected& e) {
          e.splits = {{true, {4, 7}, {}, false}};
        }) == "split vertices of face 4 7 17");
  CHECK(after([](Expected& e) { e.tally = {{{2, 3}, 1}}; }) == "splits of kind (2, 3)");
  CHECK(after([](Expected& e) { e.tally.emplace(); }) == "splits of kind (3, 3)");
  CHECK(after([](Expected& e) { e.tally = {{{3, 3}, 1}}; }) == "nothing");
  CHECK(after([](Expected& e) { e.predicted = 0; }) == "faces at which the oracle says yes");
  CHECK(after([](Expected& e) { e.separations = 1; }) == "separations");
  CHECK(said([](Fixture& f) {
          f.operations.push_back({SplitFan{0U, {1, 0, 0}}, {}});
        }) == "fan at point 0");  // eight vertices there after the shatter
}

TEST_CASE("a known difference is told with its reason, and missed when it is gone",
          "[suite][judge]") {
  Fixture fixture = figure_5();
  const auto odd = [](JudgedKernel& k, const Asked&) {
    k.name = "odd";
    k.counts = [honest = k.counts] {
      CellCounts c = honest();
      ++c.edges;
      return c;
    };
  };
  JudgedKernel kernel = changed(odd), twin = twin_kernel();
  fixture.known_differences = {
      {"odd", "counts the box's hinge", CellCounts{27, 99, 120, 48, 1, 48, 1}}};
  Verdict verdict = judge(fixture, kernel);
  CHECK_FALSE(verdict.mismatch);
  CHECK(verdict.known_difference == "counts the box's hinge");
  CHECK_FALSE(judge(fixture, twin).mismatch);
  CHECK(judge(fixture, twin).known_difference.empty());
  // The kernel was mended, or is wrong otherwise.
  twin.name = "odd";
  CHECK(judge(fixture, twin).mismatch->what == "known difference");
  fixture.known_differences[0].counts->edges = 100;
  CHECK(judge(fixture, kernel).mismatch->what == "known difference");
  // It is said to refuse, and does not.
  fixture.known_differences[0].counts.reset();
  CHECK(judge(fixture, kernel).mismatch->expected == "refused");
  const auto shy = [](JudgedKernel& k, const Asked&) {
    k.name = "odd";
    k.load = [](const TetMesh&) { return std::vector<Finding>{{.code = "shy"}}; };
  };
  kernel = changed(shy);
  CHECK(judge(fixture, kernel).known_difference == "counts the box's hinge");
  // A body that should be refused, and that this kernel takes.
  fixture = {.name = "bad", .body = two_tetrahedra(), .refused = true};
  fixture.known_differences = {{"odd", "looks at nothing", CellCounts{5, 10, 7, 2, 1, 6, 1}}};
  kernel = changed(odd);
  CHECK(judge(fixture, kernel).known_difference == "looks at nothing");
}

TEST_CASE("steps on a body are judged without a fixture", "[suite][judge]") {
  const std::vector<Step> steps = {{Step::Kind::split, {0, 3}, {}},
                                   {Step::Kind::split, {1, 4}, {}},
                                   {Step::Kind::glue, {0, 3}, {1, 4}},
                                   {Step::Kind::glue, {0, 3}, {1, 4}}};
  for (JudgedKernel kernel : {twin_kernel(), volume_map_kernel(), nested_kernel(), cgal_kernel()}) {
    INFO(kernel.name);
    CHECK_FALSE(first_mismatch(two_tetrahedra(), steps, kernel));
  }
  JudgedKernel liar = changed([](JudgedKernel& k, const Asked& asked) {
    k.counts = [honest = k.counts, &asked] {
      CellCounts c = honest();
      c.faces += asked.splits;
      return c;
    };
  });
  CHECK(first_mismatch(two_tetrahedra(), steps, liar)->step == 1);
  TetMesh bad = two_tetrahedra();
  bad.tetrahedra.push_back({0, 0, 0, 0});
  CHECK_FALSE(first_mismatch(bad, steps, liar));
}
