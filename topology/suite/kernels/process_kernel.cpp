// SPDX-License-Identifier: MIT
// The suite's side of the protocol of docs/reference/suite.md: questions as lines, answers parsed
// strictly.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "topology/suite/kernels/judged_kernel.hpp"
#include "topology/suite/kernels/process_kernel_child.hpp"

namespace sunder::suite {
namespace {

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> list;
  for (std::size_t at = 0; (at = line.find_first_not_of(' ', at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    list.push_back(line.substr(at, end - at));
    at = end;
  }
  return list;
}

/// The words of one answer, taken from front to back; whatever does not fit is `KernelLost`.
class Answer {
 public:
  struct Context {
    std::string command, question, expected;
  };
  Answer(std::string line, Context context)
      : line_(std::move(line)), context_(std::move(context)), words_(words(line_)) {}
  Answer(const Answer&) = delete;  // words point into the line
  Answer& operator=(const Answer&) = delete;

  std::string_view word() {
    if (at_ == words_.size()) refuse();
    return words_[at_++];
  }
  /// A word of printable ASCII: it stands in tables, JSON and XML.
  std::string name() {
    const std::string_view w = word();
    for (const char c : w) {
      if (c < '!' || c > '~') refuse();
    }
    return std::string(w);
  }
  std::uint64_t number() {
    const std::string_view w = word();
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
    if (error != std::errc() || end != w.data() + w.size()) refuse();
    return value;
  }
  std::uint32_t row() {
    const std::uint64_t n = number();
    if (n > 0xffffffffU) refuse();
    return static_cast<std::uint32_t>(n);
  }
  std::size_t number_at_most(std::size_t most) {
    const std::uint64_t n = number();
    if (n > most) refuse();
    return n;
  }
  bool flag() { return number_at_most(1) == 1; }
  void keyword(std::string_view expected) {
    if (word() != expected) refuse();
  }
  /// Takes the word when it is the next one.
  bool skip(std::string_view w) {
    if (at_ == words_.size() || words_[at_] != w) return false;
    ++at_;
    return true;
  }
  void end() const {
    if (at_ != words_.size()) refuse();
  }
  bool at_end() const { return at_ == words_.size(); }
  std::string rest() const {
    return at_end() ? "" : line_.substr(words_[at_].data() - line_.data());
  }

 private:
  [[noreturn]] void refuse() const {
    throw KernelLost(fmt::format("kernel \"{}\", asked \"{}\": expected \"{}\", got {}",
                                 context_.command, context_.question, context_.expected,
                                 in_quotes(line_)));
  }

  std::string line_;
  Context context_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

struct Speaker {
  std::string command;
  double seconds = default_answer_seconds;
  std::string name;
  bool glues = false, has_homology = false, tells_orientable = false;
  std::unique_ptr<Child> child;
  std::size_t tetrahedra = 0;

  /// `text`: the question's line without its end, or a whole mesh. Ends the process when the answer
  /// is none; an `Answer` that will not parse ends it through `ask`.
  template <class Parse>
  auto ask(const std::string& text, const std::string& expected, Parse parse) {
    const std::string question = text.substr(0, text.find('\n'));
    try {
      if (child == nullptr) throw KernelLost(fmt::format("kernel \"{}\" is gone", command));
      const Child::Limits limits{.seconds = seconds * (1 + static_cast<double>(tetrahedra) / 10000),
                                 .longest_answer = 65536 + 64 * tetrahedra};
      Answer answer(child->ask(text + "\n", limits), {command, question, expected});
      auto parsed = parse(answer);
      answer.end();
      return parsed;
    } catch (const KernelLost&) {
      if (child != nullptr) child->give_up();
      child.reset();
      throw;
    }
  }

  void start() {
    tetrahedra = 0;
    child = std::make_unique<Child>(command);
    ask("hello 1", "hello 1 NAME [glue] [homology] [orientable]", [this](Answer& a) {
      a.keyword("hello");
      a.keyword("1");
      name = a.name();
      glues = has_homology = tells_orientable = false;
      for (bool known = true; known && !a.at_end();) {
        known = false;
        if (a.skip("glue")) glues = known = true;
        if (a.skip("homology")) has_homology = known = true;
        if (a.skip("orientable")) tells_orientable = known = true;
      }
      return true;
    });
  }
};

std::vector<Finding> load(Speaker& speaker, const TetMesh& mesh) {
  if (speaker.child == nullptr) speaker.start();
  speaker.tetrahedra = mesh.tetrahedra.size();
  std::string text = fmt::format("mesh {} {}", mesh.points.size(), mesh.tetrahedra.size());
  auto out = std::back_inserter(text);
  for (const Point& p : mesh.points) fmt::format_to(out, "\n{} {} {}", p[0], p[1], p[2]);
  for (const auto& t : mesh.tetrahedra) {
    fmt::format_to(out, "\n{} {} {} {}", t[0], t[1], t[2], t[3]);
  }
  return speaker.ask(text, "ok | refused REASON", [](Answer& a) -> std::vector<Finding> {
    if (a.skip("ok")) return {};
    a.keyword("refused");
    Finding finding;
    finding.code = "refused";
    finding.text = a.rest();
    // It stands in tables and on terminals.
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; };
    std::ranges::replace_if(finding.text, is_control, '?');
    while (!a.at_end()) a.word();
    return {finding};
  });
}

SplitAnswer split(Speaker& speaker, FaceSide side) {
  const std::string text = fmt::format("split {} {}", side.tetrahedron, side.opposite);
  return speaker.ask(text, "boundary | split N p... M a b... S", [](Answer& a) {
    SplitAnswer answer;
    if (a.skip("boundary")) return answer;
    a.keyword("split");
    answer.did = true;
    for (std::size_t n = a.number_at_most(3); n > 0; --n) answer.vertices.push_back(a.row());
    for (std::size_t n = a.number_at_most(3); n > 0; --n) {
      const std::uint32_t p = a.row(), q = a.row();
      answer.edges.push_back({std::min(p, q), std::max(p, q)});
    }
    answer.separated = a.flag();
    std::sort(answer.vertices.begin(), answer.vertices.end());
    std::sort(answer.edges.begin(), answer.edges.end());
    return answer;
  });
}

bool glue(Speaker& speaker, FaceSide a, FaceSide b) {
  const std::string text =
      fmt::format("glue {} {} {} {}", a.tetrahedron, a.opposite, b.tetrahedron, b.opposite);
  return speaker.ask(text, "ok | refused", [](Answer& answer) {
    if (answer.skip("ok")) return true;
    answer.keyword("refused");
    return false;
  });
}

CellCounts counts(Speaker& speaker) {
  return speaker.ask("counts", "counts V E F T C BF BS", [](Answer& a) {
    a.keyword("counts");
    CellCounts c;
    for (std::size_t* n : {&c.vertices, &c.edges, &c.faces, &c.tetrahedra, &c.components,
                           &c.boundary_faces, &c.boundary_sheets}) {
      *n = a.number();
    }
    return c;
  });
}

std::vector<std::uint32_t> numbers(Speaker& speaker, const std::string& question, std::size_t n) {
  const std::string expected = fmt::format("{} and {} numbers", question, n);
  return speaker.ask(question, expected, [&](Answer& a) {
    a.keyword(question);
    std::vector<std::uint32_t> list(n);
    for (std::uint32_t& number : list) number = a.row();
    return list;
  });
}

std::optional<IntegerHomology> homology(Speaker& speaker) {
  const std::string expected = "homology none | homology b0 b1 b2 b3 and 4 x (N torsion...)";
  return speaker.ask("homology", expected, [](Answer& a) -> std::optional<IntegerHomology> {
    a.keyword("homology");
    if (a.skip("none")) return std::nullopt;
    IntegerHomology h;
    for (std::size_t& b : h.betti) b = a.number();
    for (auto& torsion : h.torsion) {
      for (std::uint64_t n = a.number(); n > 0; --n) torsion.push_back(a.number());
    }
    return h;
  });
}

}  // namespace

JudgedKernel process_kernel(const std::string& command, double seconds) {
  const auto speaker = std::make_shared<Speaker>();
  speaker->command = command;
  speaker->seconds = seconds;
  speaker->start();
  JudgedKernel kernel;
  kernel.name = speaker->name;
  kernel.load = [speaker](const TetMesh& mesh) { return load(*speaker, mesh); };
  kernel.split = [speaker](FaceSide side) { return split(*speaker, side); };
  kernel.counts = [speaker] { return counts(*speaker); };
  kernel.vertex_of_corner = [speaker] {
    return numbers(*speaker, "vertices", 4 * speaker->tetrahedra);
  };
  kernel.component_of_tetrahedron = [speaker] {
    return numbers(*speaker, "components", speaker->tetrahedra);
  };
  if (speaker->glues) {
    kernel.glue = [speaker](FaceSide a, FaceSide b) { return glue(*speaker, a, b); };
  }
  if (speaker->has_homology) {
    kernel.homology = [speaker] { return homology(*speaker); };
  }
  if (speaker->tells_orientable) {
    kernel.orientable = [speaker] {
      return speaker->ask("orientable", "orientable 1|0", [](Answer& a) {
        a.keyword("orientable");
        return std::optional<bool>(a.flag());
      });
    };
  }
  return kernel;
}

}  // namespace sunder::suite
