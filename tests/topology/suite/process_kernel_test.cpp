// SPDX-License-Identifier: MIT
// Kernels in other processes: one that is right, and many ways to be none.
#include <sys/wait.h>

#include <cerrno>
#include <chrono>

#include "tests/topology/suite/kernels_support.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

std::string adapter(const std::string& call) {
  return "exec " SUNDER_PYTHON " " SUNDER_ADAPTERS "/" + call;
}

/// A process that says hello as it should, and then runs these shell commands.
std::string after_hello(const std::string& commands) {
  return "read q; echo hello 1 stub; " + commands;
}

std::string lost_message(const std::function<void()>& question) {
  try {
    question();
  } catch (const KernelLost& lost) {
    return lost.what();
  }
  return "";
}

std::string load_message(const std::string& commands, double seconds = 60) {
  JudgedKernel kernel = process_kernel(after_hello(commands), seconds);
  return lost_message([&] { kernel.load(two_tetrahedra()); });
}

bool contains(const std::string& text, const std::string& part) {
  INFO(text);
  return text.find(part) != std::string::npos;
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST_CASE("a kernel in another process answers as the twin does", "[suite][process_kernel]") {
  JudgedKernel kernel = process_kernel(adapter("minimal.py"));
  CHECK(kernel.name == "minimal");
  CHECK(kernel.glue);
  CHECK(kernel.orientable);
  CHECK_FALSE(kernel.homology);
  CHECK_FALSE(kernel.own_faults);
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    const std::size_t steps = std::min<std::size_t>(2 * shape.mesh.tetrahedra.size(), 60);
    walk_beside_twin(kernel, shape.mesh, {.steps = steps, .every = 30, .seed = 5});
  }
}

TEST_CASE("a process may refuse a body, and take the next", "[suite][process_kernel]") {
  JudgedKernel kernel = process_kernel(adapter("minimal.py"));
  const std::vector<Finding> findings = kernel.load(joined_ring(4, true));
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].code == "refused");
  CHECK(findings[0].text == "no common orientation");
  CHECK(has_error(findings));
  CHECK(kernel.load(one_tetrahedron()).empty());
  CHECK(kernel.counts() == CellCounts{4, 6, 4, 1, 1, 4, 1});
}

TEST_CASE("pipes that are full both ways do not lock", "[suite][process_kernel]") {
  // 5 MB of body go out while the process, of which it has read one line, fills its own output.
  const TetMesh mesh = kuhn_box({30, 30, 30});
  const std::string much =
      after_hello("read q; head -c 3000000 /dev/zero | tr '\\0' ' '; echo ok; cat > /dev/null");
  JudgedKernel kernel = process_kernel(much, 60);
  CHECK(kernel.load(mesh).empty());
}

TEST_CASE("answers of any length come through whole", "[suite][process_kernel]") {
  JudgedKernel kernel = process_kernel(adapter("minimal.py"));
  const TetMesh mesh = kuhn_box({8, 8, 8});
  REQUIRE(kernel.load(mesh).empty());
  CHECK(kernel.vertex_of_corner().size() == 4 * mesh.tetrahedra.size());
}

TEST_CASE("a process that dies is reported with the question and how it ended",
          "[suite][process_kernel]") {
  CHECK(contains(lost_message([] { process_kernel("exit 7"); }), "ended with exit code 7"));
  CHECK(contains(lost_message([] { process_kernel("no-such-command-at-all 2>/dev/null"); }),
                 "ended with exit code 127"));
  CHECK(contains(load_message("kill -SEGV $$"), "ended by signal 11"));
  const std::string message = load_message("read q; exit 3");
  CHECK(contains(message, "asked \"mesh 5 2\""));
  CHECK(contains(message, "ended with exit code 3"));
  CHECK(contains(load_message("exec 1>&-; sleep 1000"), "closed its output"));
}

TEST_CASE("a process that reads no more does not end ours", "[suite][process_kernel]") {
  // Without care the write into the closed pipe would be SIGPIPE.
  JudgedKernel kernel = process_kernel(after_hello("exec 0<&-; sleep 0.3; exit 4"));
  const std::string message = lost_message([&] { kernel.load(kuhn_box({20, 20, 20})); });
  CHECK(contains(message, "ended with exit code 4"));
}

TEST_CASE("a process that hangs is given up after its time and killed with its children",
          "[suite][process_kernel]") {
  std::string message;
  const double seconds =
      seconds_of([&] { message = load_message("(trap '' TERM; sleep 1000) & wait", 0.3); });
  CHECK(contains(message, "no answer within 0.3 s"));
  CHECK(seconds < 100);  // not the 1 000 that it sleeps
  // Nothing is left to be reaped, nor running.
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
  CHECK(errno == ECHILD);
}

TEST_CASE("the time for an answer grows with the body", "[suite][process_kernel]") {
  // 6 000 tetrahedra: 1.6 times as long; the name has the plain time.
  JudgedKernel kernel = process_kernel(after_hello("sleep 1000"), 1);
  const std::string message = lost_message([&] { kernel.load(kuhn_box({10, 10, 10})); });
  CHECK(contains(message, "no answer within 1.6 s"));
  CHECK(contains(lost_message([] { process_kernel("sleep 1000", 0.2); }),
                 "asked \"hello 1\": no answer within 0.2 s"));
}

TEST_CASE("silence is told from other losses", "[suite][process_kernel]") {
  JudgedKernel kernel = process_kernel(after_hello("sleep 1000"), 1);
  CHECK_THROWS_AS(kernel.load(two_tetrahedra()), KernelSilent);
  JudgedKernel gone = process_kernel(after_hello("read q; exit 3"));
  bool silent = false;
  try {
    gone.load(two_tetrahedra());
  } catch (const KernelSilent&) {
    silent = true;
  } catch (const KernelLost&) {
  }
  CHECK_FALSE(silent);
}

TEST_CASE("a process that stops itself, or reads no more and says nothing, is given up",
          "[suite][process_kernel]") {
  CHECK(contains(load_message("kill -STOP $$", 1), "no answer within 1 s"));
  CHECK(contains(load_message("exec 0<&-; exec sleep 1000", 1), "no answer within 1 s"));
  CHECK(contains(load_message("trap '' TERM HUP INT; while :; do sleep 1; done", 1),
                 "no answer within 1 s"));
}

TEST_CASE("a process that leaves its output to another one is not waited for",
          "[suite][process_kernel]") {
  std::string message;
  const double seconds = seconds_of([&] { message = load_message("sleep 1000 & exit 3"); });
  CHECK(contains(message, "it ended with exit code 3 and left its output to another process"));
  CHECK(seconds < 60);
}

TEST_CASE("an answer that a process gave before it ended counts", "[suite][process_kernel]") {
  JudgedKernel kernel = process_kernel(
      after_hello("cat > /dev/null & while read q; do case $q in '1 0'*) break;; esac; "
                  "done; echo ok; sleep 1000 & exit 0"));
  CHECK(kernel.load(two_tetrahedra()).empty());
  CHECK(contains(lost_message([&] { kernel.counts(); }), "ended with exit code 0"));
}

TEST_CASE("two lines where one was asked for are no answer, however they come",
          "[suite][process_kernel]") {
  CHECK(contains(load_message("read q; printf 'ok\\nok\\n'; cat > /dev/null"),
                 "another line, \"ok\""));
  CHECK(contains(load_message("read q; printf 'ok\\nand more'; cat > /dev/null"), "and more"));
  CHECK(contains(load_message("read q; yes ok"), "another line"));
  // Said late: the next question finds it.
  JudgedKernel kernel = process_kernel(after_hello(
      "for i in 1 2 3 4 5 6 7 8; do read q; done; echo ok; sleep 0.1; echo so; read q; read q"));
  try {
    kernel.load(two_tetrahedra());
    CHECK_THROWS_AS(kernel.counts(), KernelLost);
  } catch (const KernelLost&) {  // or this one did, on a slow machine
  }
}

TEST_CASE("what a process says is quoted in printable ASCII", "[suite][process_kernel]") {
  const std::string message =
      load_message("read q; printf '\\033[2J\\377\\000 hi\\n'; cat > /dev/null");
  CHECK(contains(message, "got \"\\x1b[2J\\xff\\x00 hi\""));
  CHECK(contains(lost_message([] { process_kernel("read q; printf 'hello 1 n\\351e\\n'"); }),
                 "got \"hello 1 n\\xe9e\""));
}

TEST_CASE("nonsense is reported with what was expected", "[suite][process_kernel]") {
  CHECK(contains(lost_message([] { process_kernel("read q; echo good morning"); }),
                 "expected \"hello 1 NAME [glue] [homology] [orientable]\", got \"good morning\""));
  CHECK(contains(lost_message([] { process_kernel("read q; echo hello 2 late"); }), "expected"));
  CHECK(contains(load_message("read q; echo unknown; cat >/dev/null"),
                 "expected \"ok | refused REASON\", got \"unknown\""));
  CHECK(contains(load_message("yes | tr -d '\\n'"), "its answer is longer than"));
}

TEST_CASE("each question's answer is parsed to its last word", "[suite][process_kernel]") {
  const auto asked = [](const std::string& answer,
                        const std::function<void(JudgedKernel&)>& question) {
    // Nine lines are the body of two tetrahedra; the next is the question.
    JudgedKernel kernel = process_kernel(
        after_hello("for i in 1 2 3 4 5 6 7 8; do read q; done; echo ok; read q; echo '" + answer +
                    "'; read q"));
    kernel.load(two_tetrahedra());
    return lost_message([&] { question(kernel); });
  };
  const auto split = [](JudgedKernel& k) { k.split({0, 3}); };
  const auto counts = [](JudgedKernel& k) { k.counts(); };
  const auto vertices = [](JudgedKernel& k) { k.vertex_of_corner(); };
  const auto components = [](JudgedKernel& k) { k.component_of_tetrahedron(); };
  CHECK(asked("split 1 0 2 0 1 0 2 0", split).empty());
  CHECK(asked("boundary", split).empty());
  for (const char* bad :
       {"split", "split 1", "split 4 0 1 2 3 0 0", "split 0 0 2", "split 0 0 0 0", "split -1 0 0",
        "split 0 0 1.5", "split 1 4294967296 0 0", "boundary 1", "", "splitting 0 0 0"}) {
    INFO(bad);
    CHECK(contains(asked(bad, split), "asked \"split 0 3\": expected"));
  }
  CHECK(asked("counts 5 9 7 2 1 6 1", counts).empty());
  CHECK_FALSE(asked("counts 5 9 7 2 1 6", counts).empty());
  CHECK_FALSE(asked("counts 5 9 7 2 1 6 1 1", counts).empty());
  CHECK_FALSE(asked("counts 5 9 7 2 1 6 18446744073709551616", counts).empty());
  CHECK_FALSE(asked("counts 5 9 7 2 1 6 -1", counts).empty());
  CHECK_FALSE(asked("counts 5 9 7 2 1 6 1e0", counts).empty());
  CHECK(asked("vertices 0 1 2 3 1 0 2 4", vertices).empty());
  CHECK_FALSE(asked("vertices 0 1 2 3 1 0 2", vertices).empty());
  CHECK_FALSE(asked("vertices 0 1 2 3 1 0 2 4294967296", vertices).empty());
  CHECK(asked("components 0 0", components).empty());
  CHECK_FALSE(asked("components 0 0 0", components).empty());
}

TEST_CASE("homology over Z is read with its torsion", "[suite][process_kernel]") {
  const auto answered = [](const std::string& answer) {
    JudgedKernel kernel = process_kernel(
        "read q; echo hello 1 stub homology orientable; read q; "
        "echo '" +
        answer + "'; read q");
    REQUIRE(kernel.homology);
    REQUIRE(kernel.orientable);
    return kernel.homology();
  };
  const auto h = answered("homology 1 0 0 0 0 2 2 6 0 0");
  REQUIRE(h);
  CHECK(h->betti == BettiNumbers{1, 0, 0, 0});
  CHECK(h->torsion[1] == std::vector<std::uint64_t>{2, 6});
  CHECK_FALSE(answered("homology none"));
  CHECK_THROWS_AS(answered("homology 1 0 0 0 0 2 2"), KernelLost);
}

TEST_CASE("a liar is a mismatch or is lost, never believed", "[suite][process_kernel]") {
  const auto third_split = [](const std::string& lie) {
    JudgedKernel kernel = process_kernel(adapter("liar.py " + lie + " 2")), twin = twin_kernel();
    kernel.load(octahedron_star());
    twin.load(octahedron_star());
    for (const FaceSide side : {FaceSide{0, 5}, FaceSide{1, 5}}) {
      CHECK(kernel.split(side) == twin.split(side));
    }
    const bool same = kernel.split({2, 5}) == twin.split({2, 5});
    return same && kernel.counts() == twin.counts();
  };
  CHECK(third_split("never"));
  for (const char* lie : {"forgets-a-vertex", "miscounts"}) {
    INFO(lie);
    CHECK_FALSE(third_split(lie));
  }
  for (const char* lie : {"dies", "babbles", "says-twice", "never-ends"}) {
    INFO(lie);
    CHECK_THROWS_AS(third_split(lie), KernelLost);
  }
}

TEST_CASE("after a loss the next body starts the process anew", "[suite][process_kernel]") {
  JudgedKernel kernel = process_kernel(adapter("liar.py dies 0"));
  for (int i = 0; i < 2; ++i) {
    REQUIRE(kernel.load(two_tetrahedra()).empty());
    CHECK_THROWS_AS(kernel.split({0, 3}), KernelLost);
    CHECK_THROWS_AS(kernel.counts(), KernelLost);
  }
}
