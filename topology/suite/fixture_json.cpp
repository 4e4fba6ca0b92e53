// SPDX-License-Identifier: MIT
// Places in JSON, and the values that fixtures are made of.
#include "topology/suite/fixture_json.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace sunder::suite {
namespace {

using nlohmann::json;

std::string token(std::string_view key) {
  std::string out;
  for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return out;
}

std::string shown(const json& value) {
  constexpr std::size_t longest = 60;
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  std::string text = value.dump();
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

/// Whole numbers from `low` to `high`.
template <class T>
bool read_whole(const JsonAt& at, std::string_view what, T& value) {
  const json& v = *at.value;
  if (v.is_number_unsigned()) {
    const auto number = v.get<std::uint64_t>();
    if (number > static_cast<std::uint64_t>(std::numeric_limits<T>::max())) return expect(at, what);
    value = static_cast<T>(number);
    return true;
  }
  if (!v.is_number_integer() || !std::numeric_limits<T>::is_signed) return expect(at, what);
  const auto number = v.get<std::int64_t>();
  if (number < static_cast<std::int64_t>(std::numeric_limits<T>::min())) return expect(at, what);
  value = static_cast<T>(number);
  return true;
}

/// The prime of "GF(p)"; 0 when it is none that Betti numbers can be had for.
int field_of(std::string_view key) {
  if (key.size() < 5 || key.substr(0, 3) != "GF(" || key.back() != ')') return 0;
  int prime = 0;
  const char* const end = key.data() + key.size() - 1;
  const auto [stop, reason] = std::from_chars(key.data() + 3, end, prime);
  if (reason != std::errc{} || stop != end || prime < 2 || prime >= 1 << 15) return 0;
  for (int d = 2; d * d <= prime; ++d) {
    if (prime % d == 0) return 0;
  }
  return prime;
}

bool read_fields(const JsonAt& at, std::map<int, BettiNumbers>& betti) {
  if (!at.value->is_object()) return expect(at, "an object of Betti numbers by field");
  bool fine = true;
  for (const auto& [key, value] : at.value->items()) {
    const JsonAt place{&value, at.file, &at, key};
    const int prime = field_of(key);
    if (prime == 0) {
      fine = complain(place, "is not a field GF(p) with a prime p below 32768");
    } else {
      fine = read(place, betti[prime]) && fine;
    }
  }
  return fine;
}

/// "s_v,s_e" as a key of a tally.
bool read_tally(const JsonAt& at, std::map<std::array<int, 2>, std::size_t>& tally) {
  if (!at.value->is_object()) return expect(at, "an object of numbers by \"s_v,s_e\"");
  bool fine = true;
  for (const auto& [key, value] : at.value->items()) {
    const JsonAt place{&value, at.file, &at, key};
    const bool known = key.size() == 3 && key[1] == ',' && key[0] >= '0' && key[0] <= '3' &&
                       key[2] >= '0' && key[2] <= '3';
    if (!known) {
      fine = complain(place, "is not \"s_v,s_e\" with numbers from 0 to 3");
    } else {
      fine = read(place, tally[{key[0] - '0', key[2] - '0'}]) && fine;
    }
  }
  return fine;
}

}  // namespace

std::string pointer_of(const JsonAt& at) {
  if (at.around == nullptr) return "";
  const std::string last = at.around->value->is_array() ? std::to_string(at.row) : token(at.key);
  return pointer_of(*at.around) + "/" + last;
}

bool complain(const JsonAt& at, const std::string& text) {
  const std::string pointer = pointer_of(at);
  at.file->findings.push_back({.code = "bad_fixture",
                               .ids = {},
                               .text = (pointer.empty() ? "the document" : pointer) + " " + text,
                               .remedy = "see docs/suite.md for what a fixture holds",
                               .file = at.file->path.string()});
  return false;
}

bool expect(const JsonAt& at, std::string_view what) {
  return complain(at, "is " + shown(*at.value) + "; " + std::string(what) + " was expected");
}

bool is_object_of(const JsonAt& at, std::initializer_list<std::string_view> required,
                  std::initializer_list<std::string_view> optional) {
  if (!at.value->is_object()) return expect(at, "an object");
  bool fine = true;
  for (const std::string_view key : required) {
    if (!at.value->contains(key)) fine = complain(at, "lacks \"" + std::string(key) + "\"");
  }
  for (const auto& [key, value] : at.value->items()) {
    const auto is_key = [&k = key](std::string_view known) { return known == k; };
    if (std::any_of(required.begin(), required.end(), is_key) ||
        std::any_of(optional.begin(), optional.end(), is_key)) {
      continue;
    }
    std::string known;
    for (const auto& list : {required, optional}) {
      for (const std::string_view k : list) known += (known.empty() ? "" : ", ") + std::string(k);
    }
    fine = complain({&value, at.file, &at, key}, "is not a known key; known here: " + known);
  }
  return fine;
}

std::optional<JsonAt> member(const JsonAt& at, std::string_view key) {
  const auto found = at.value->find(key);
  if (found == at.value->end()) return std::nullopt;
  return JsonAt{&*found, at.file, &at, key};
}

JsonAt element(const JsonAt& at, std::size_t row) {
  return {&(*at.value)[row], at.file, &at, {}, row};
}

bool read(const JsonAt& at, bool& value) {
  if (!at.value->is_boolean()) return expect(at, "true or false");
  value = at.value->get<bool>();
  return true;
}

bool read(const JsonAt& at, std::uint64_t& value) {
  return read_whole(at, "a whole number from 0", value);
}
bool read(const JsonAt& at, std::uint32_t& value) {
  return read_whole(at, "a row counted from 0", value);
}
bool read(const JsonAt& at, int& value) { return read_whole(at, "a whole number", value); }
bool read(const JsonAt& at, std::ptrdiff_t& value) {
  return read_whole(at, "a whole number", value);
}

bool read(const JsonAt& at, double& value) {
  if (!at.value->is_number() && !at.value->is_null()) return expect(at, "a number");
  value = at.value->is_null() ? std::numeric_limits<double>::quiet_NaN() : at.value->get<double>();
  return true;
}

bool read(const JsonAt& at, std::string& value) {
  if (!at.value->is_string()) return expect(at, "a text");
  value = at.value->get<std::string>();
  return true;
}

bool read(const JsonAt& at, CellCounts& counts) {
  return is_object_of(at, {"vertices", "edges", "faces", "tetrahedra", "components",
                           "boundary_faces", "boundary_sheets"}) &&
         read_member(at, "vertices", counts.vertices) && read_member(at, "edges", counts.edges) &&
         read_member(at, "faces", counts.faces) &&
         read_member(at, "tetrahedra", counts.tetrahedra) &&
         read_member(at, "components", counts.components) &&
         read_member(at, "boundary_faces", counts.boundary_faces) &&
         read_member(at, "boundary_sheets", counts.boundary_sheets);
}

bool read(const JsonAt& at, IntegerHomology& homology) {
  return is_object_of(at, {"betti", "torsion"}) && read_member(at, "betti", homology.betti) &&
         read_member(at, "torsion", homology.torsion);
}

bool read(const JsonAt& at, SplitAnswer& answer) {
  if (at.value->is_object() && at.value->contains("refused")) {
    bool refused = false;
    if (!is_object_of(at, {"refused"}) || !read_member(at, "refused", refused)) return false;
    return refused || complain(at, "is refused, or has vertices, edges and separated");
  }
  answer.did = true;
  const bool fine = is_object_of(at, {"vertices", "edges", "separated"}) &&
                    read_member(at, "vertices", answer.vertices) &&
                    read_member(at, "edges", answer.edges) &&
                    read_member(at, "separated", answer.separated);
  std::sort(answer.vertices.begin(), answer.vertices.end());
  for (auto& edge : answer.edges) std::sort(edge.begin(), edge.end());
  std::sort(answer.edges.begin(), answer.edges.end());
  return fine;
}

bool read(const JsonAt& at, Expected& expected) {
  if (!is_object_of(at, {},
                    {"counts", "euler_characteristic", "betti", "homology", "orientable", "splits",
                     "tally", "predicted", "separations"})) {
    return false;
  }
  bool fine = read_member(at, "counts", expected.counts) &&
              read_member(at, "euler_characteristic", expected.euler_characteristic);
  fine = read_member(at, "homology", expected.homology) && fine;
  fine = read_member(at, "orientable", expected.orientable) && fine;
  fine = read_member(at, "splits", expected.splits) && fine;
  fine = read_member(at, "predicted", expected.predicted) && fine;
  fine = read_member(at, "separations", expected.separations) && fine;
  if (const auto betti = member(at, "betti"))
    fine = read_fields(*betti, expected.betti_mod) && fine;
  if (const auto tally = member(at, "tally")) {
    fine = read_tally(*tally, expected.tally.emplace()) && fine;
  }
  return fine;
}

bool read(const JsonAt& at, KnownDifference& difference) {
  return is_object_of(at, {"kernel", "why"}, {"counts"}) &&
         read_member(at, "kernel", difference.kernel) && read_member(at, "why", difference.why) &&
         read_member(at, "counts", difference.counts);
}

}  // namespace sunder::suite
