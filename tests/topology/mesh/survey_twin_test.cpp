// SPDX-License-Identifier: MIT
// All findings of a survey in careless meshes and in heaps of random tetrahedra, compared with the
// definitions: sets of points, and orbits by repeated union.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "tests/support/random_meshes.hpp"
#include "topology/base/point_math.hpp"
#include "topology/mesh/survey.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Row = std::uint32_t;
using Corners = std::array<Row, 4>;
using Found = std::map<std::string, std::vector<Row>>;  // places by the code of their finding

/// Labels joined where asked; every set is named by its lowest.
struct Sets {
  explicit Sets(std::size_t n) : low(n) { std::iota(low.begin(), low.end(), 0U); }
  void join(std::size_t a, std::size_t b) {
    const Row from = std::max(low[a], low[b]), to = std::min(low[a], low[b]);
    if (from != to) std::ranges::replace(low, from, to);
  }
  std::vector<Row> low;
};

bool is_odd(const Corners& t) {
  int inversions = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) inversions += t[i] > t[j];
  }
  return inversions % 2 == 1;
}

std::set<Row> face_of(const Corners& t, std::size_t p) {
  std::set<Row> face(t.begin(), t.end());
  face.erase(t[p]);
  return face;
}

constexpr std::array<std::array<std::size_t, 2>, 6> edge_places = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

struct Twin {
  explicit Twin(const TetMesh& given) : mesh(given), across(given.tetrahedra.size()) {
    find_entries();
    sew();
    orient();
    find_orbits();
    find_points();
  }

  const TetMesh& mesh;
  Found found;
  std::vector<Row> overfull_ids;
  std::vector<bool> usable;
  std::vector<int> sign;
  std::vector<std::array<std::optional<Row>, 4>> across;
  std::vector<char> flipped;
  std::size_t components = 0, closed = 0, edges = 0;
  std::vector<Corners> rows;
  std::vector<Row> point_of_row, edges_at_row;

  bool is_finite(Row p) const { return test::is_finite(mesh.points[p]); }

  void find_entries() {
    for (Row p = 0; p < mesh.points.size(); ++p) {
      if (!is_finite(p)) found["nan_coordinate"].push_back(p);
    }
    for (Row i = 0; i < mesh.tetrahedra.size(); ++i) {
      const Corners& t = mesh.tetrahedra[i];
      const bool in_range = std::ranges::all_of(t, [&](Row p) { return p < mesh.points.size(); });
      const bool repeats = std::set(t.begin(), t.end()).size() < 4;
      if (!in_range) found["index_out_of_range"].push_back(i);
      if (repeats) found["repeated_vertex"].push_back(i);
      usable.push_back(in_range && !repeats);
      sign.push_back(0);
      if (!usable.back()) continue;
      if (!std::ranges::all_of(t, [&](Row p) { return is_finite(p); })) continue;
      long double most = 0, length = 0;
      long double e[3][3];
      for (int k = 0; k < 4; ++k) {
        for (int d = 0; d < 3; ++d) {
          const double x = mesh.points[t[k]][d], from = mesh.points[t[0]][d];
          most = std::max<long double>(most, std::abs(x));
          length = std::max<long double>(length, std::abs(x - from));
          if (k > 0) e[k - 1][d] = static_cast<long double>(x) - from;
        }
      }
      long double det = 0;
      for (int d = 0; d < 3; ++d) {
        det += e[0][d] *
               (e[1][(d + 1) % 3] * e[2][(d + 2) % 3] - e[1][(d + 2) % 3] * e[2][(d + 1) % 3]);
      }
      const long double least = 18 * 0x1p-52L * std::max(most, length) * length * length;
      if (std::abs(det) > least && least < 1e300L) sign.back() = det > 0 ? 1 : -1;
      if (sign.back() == 0) found["flat_tetrahedron"].push_back(i);
    }
  }

  void sew() {
    std::map<std::set<Row>, Row> known;
    for (Row i = 0; i < usable.size(); ++i) {
      if (!usable[i]) continue;
      const Corners& t = mesh.tetrahedra[i];
      const auto [first, is_new] = known.emplace(std::set(t.begin(), t.end()), i);
      if (is_new) continue;
      usable[i] = false;
      const bool alike = is_odd(t) == is_odd(mesh.tetrahedra[first->second]);
      found[alike ? "duplicate_tetrahedron" : "mirrored_tetrahedron"].push_back(i);
    }
    std::map<std::set<Row>, std::vector<Row>> sides;
    for (Row i = 0; i < usable.size(); ++i) {
      for (Row p = 0; usable[i] && p < 4; ++p) {
        sides[face_of(mesh.tetrahedra[i], p)].push_back(4 * i + p);
      }
    }
    for (const auto& [face, f] : sides) {
      if (f.size() == 2) {
        across[f[0] / 4][f[0] % 4] = f[1];
        across[f[1] / 4][f[1] % 4] = f[0];
      } else if (f.size() > 2) {
        auto& places = found["overfull_face"];
        places.insert(places.end(), face.begin(), face.end());
        if (places.size() > 3) continue;
        overfull_ids.assign(face.begin(), face.end());
        for (const Row side : f) {
          if (overfull_ids.size() < Finding::max_ids) overfull_ids.push_back(side / 4);
        }
      }
    }
  }

  /// Whether tetrahedron t and that across its face p run alike, as they are numbered.
  bool is_alike(Row t, Row p) const {
    const Row g = *across[t][p];
    // Exchanging the fourth points makes one of the other: one exchange more.
    Corners mirrored = mesh.tetrahedra[t];
    mirrored[p] = mesh.tetrahedra[g / 4][g % 4];
    return is_odd(mirrored) != is_odd(mesh.tetrahedra[g / 4]);
  }

  void orient() {
    flipped.assign(usable.size(), 0);
    std::vector<char> met(usable.size(), 0);
    std::vector<Row> conflicts, inverted, folded;
    for (Row start = 0; start < usable.size(); ++start) {
      if (!usable[start] || met[start]) continue;
      std::vector<Row> members = {start};
      met[start] = 1;
      bool has_boundary = false;
      for (std::size_t i = 0; i < members.size(); ++i) {
        const Row t = members[i];
        bool conflict = false;
        for (Row p = 0; p < 4; ++p) {
          has_boundary = has_boundary || !across[t][p];
          if (!across[t][p]) continue;
          const Row u = *across[t][p] / 4;
          const char wanted = is_alike(t, p) ? flipped[t] : !flipped[t];
          if (!met[u]) members.push_back(u), met[u] = 1, flipped[u] = wanted;
          conflict = conflict || flipped[u] != wanted;
        }
        if (conflict) conflicts.push_back(t);
      }
      ++components;
      if (!has_boundary) ++closed;
      int right = 0;
      std::ranges::sort(members);
      for (const Row t : members) right += flipped[t] ? -sign[t] : sign[t];
      const auto decider = std::ranges::find_if(members, [&](Row t) { return sign[t] != 0; });
      const bool turn = decider != members.end() && (sign[*decider] < 0) != flipped[*decider];
      if (right < 0 || (right == 0 && turn)) {
        for (const Row t : members) flipped[t] = !flipped[t];
      }
    }
    for (Row t = 0; t < usable.size(); ++t) {
      if (!usable[t]) continue;
      if (flipped[t]) inverted.push_back(t);
      if (sign[t] != 0 && (sign[t] < 0) != flipped[t]) folded.push_back(t);
    }
    std::ranges::copy(conflicts, std::back_inserter(found["non_orientable"]));
    if (!conflicts.empty()) return;
    found["inverted_tetrahedron"] = inverted;
    found["folded_tetrahedron"] = folded;
  }

  void find_orbits() {
    const std::size_t n = usable.size();
    Sets corner_sets(4 * n), edge_sets(6 * n);
    const auto place = [&](Row t, Row point) {
      return static_cast<std::size_t>(std::ranges::find(mesh.tetrahedra[t], point) -
                                      mesh.tetrahedra[t].begin());
    };
    const auto edge_at = [](std::size_t i, std::size_t j) {
      return static_cast<std::size_t>(
          std::ranges::find(edge_places, std::array{std::min(i, j), std::max(i, j)}) -
          edge_places.begin());
    };
    for (Row t = 0; t < n; ++t) {
      for (std::size_t p = 0; p < 4; ++p) {
        if (!across[t][p]) continue;
        const Row u = *across[t][p] / 4;
        const Corners& c = mesh.tetrahedra[t];
        for (std::size_t i = 0; i < 4; ++i) {
          if (i != p) corner_sets.join(4 * t + i, 4 * u + place(u, c[i]));
          for (std::size_t j = i + 1; j < 4; ++j) {
            if (i == p || j == p) continue;
            edge_sets.join(6 * t + edge_at(i, j), 6 * u + edge_at(place(u, c[i]), place(u, c[j])));
          }
        }
      }
    }
    // Orbits of each point, by their lowest corner: the first has its row in the order of points.
    std::map<Row, std::set<Row>> orbits;
    std::map<std::pair<Row, Row>, std::set<Row>> edge_orbits;
    for (Row c = 0; c < 4 * n; ++c) {
      if (usable[c / 4]) orbits[mesh.tetrahedra[c / 4][c % 4]].insert(corner_sets.low[c]);
    }
    std::map<Row, Row> row_of;
    std::set<std::tuple<Row, Row, Row>> further;
    for (const auto& [point, starts] : orbits) {
      if (starts.size() > 1) found["pinched_vertex"].push_back(point);
      row_of[*starts.begin()] = static_cast<Row>(point_of_row.size());
      point_of_row.push_back(point);
      for (const Row c : starts) {
        if (c != *starts.begin()) further.emplace(c / 4, point, c);
      }
    }
    for (const auto& [t, point, c] : further) {
      row_of[c] = static_cast<Row>(point_of_row.size());
      point_of_row.push_back(point);
    }
    edges_at_row.assign(point_of_row.size(), 0);
    rows.assign(n, {0xffffffffU, 0xffffffffU, 0xffffffffU, 0xffffffffU});
    for (Row t = 0; t < n; ++t) {
      for (std::size_t i = 0; usable[t] && i < 4; ++i)
        rows[t][i] = row_of[corner_sets.low[4 * t + i]];
    }
    for (Row e = 0; e < 6 * n; ++e) {
      if (!usable[e / 6]) continue;
      const auto [i, j] = edge_places[e % 6];
      const Corners& c = mesh.tetrahedra[e / 6];
      edge_orbits[std::minmax(c[i], c[j])].insert(edge_sets.low[e]);
      if (edge_sets.low[e] != e) continue;
      ++edges;
      ++edges_at_row[rows[e / 6][i]];
      ++edges_at_row[rows[e / 6][j]];
    }
    for (const auto& [ends, met] : edge_orbits) {
      if (met.size() < 2) continue;
      found["pinched_edge"].push_back(ends.first);
      found["pinched_edge"].push_back(ends.second);
    }
  }

  void find_points() {
    std::set<Row> used;
    std::set<Point> places;
    for (const Corners& t : mesh.tetrahedra) used.insert(t.begin(), t.end());
    for (Row p = 0; p < mesh.points.size(); ++p) {
      if (!used.contains(p)) found["unused_point"].push_back(p);
      if (is_finite(p) && !places.insert(mesh.points[p]).second) {
        found["coincident_points"].push_back(p);
      }
    }
  }

  /// Of a file's check: vertices with a link that is neither a disc nor a sphere.
  std::vector<Row> touching() const {
    std::vector<std::size_t> triangles(point_of_row.size(), 0), rim(point_of_row.size(), 0);
    for (std::size_t t = 0; t < rows.size(); ++t) {
      for (std::size_t i = 0; i < 4; ++i) {
        ++triangles[rows[t][i]];
        for (std::size_t p = 0; p < 4; ++p) rim[rows[t][i]] += p != i && !across[t][p];
      }
    }
    std::set<Row> points;
    for (std::size_t r = 0; r < point_of_row.size(); ++r) {
      // Vertices less edges plus triangles; every triangle has three edges, two share an inner one.
      const long euler = static_cast<long>(edges_at_row[r]) -
                         static_cast<long>(rim[r] + (3 * triangles[r] - rim[r]) / 2) +
                         static_cast<long>(triangles[r]);
      if (euler != (rim[r] == 0 ? 2 : 1)) points.insert(point_of_row[r]);
    }
    return {points.begin(), points.end()};
  }
};

/// Few points, many tetrahedra: copies, overfull faces, twists.
TetMesh heap(Random& random) {
  TetMesh mesh;
  const std::size_t points = 5 + below(random, 5);
  for (std::size_t p = 0; p < points; ++p) {
    mesh.points.push_back({static_cast<double>(below(random, 4)),
                           static_cast<double>(below(random, 4)),
                           static_cast<double>(below(random, 3)) / 7});
  }
  if (below(random, 10) == 0) {
    mesh.points[below(random, points)][below(random, 3)] = below(random, 2) == 0 ? NAN : -INFINITY;
  }
  for (std::size_t i = 1 + below(random, 8); i > 0; --i) {
    Corners t{};
    do {
      for (Row& p : t) p = static_cast<Row>(below(random, points));
    } while (std::set(t.begin(), t.end()).size() < 4 && below(random, 40) != 0);
    mesh.tetrahedra.push_back(t);
  }
  return mesh;
}

void hold(const TetMesh& mesh, std::map<std::string, std::size_t>& seen) {
  const Twin twin(mesh);
  const Survey survey = survey_mesh(mesh, Severity::error, true);
  Found places;
  for (const FindingPlaces& p : survey.places) {
    CHECK(places[p.code].empty());
    places[p.code] = p.rows;
  }
  for (const Finding& f : survey.findings) {
    if (f.code == "no_tetrahedron" || f.code == "empty_mesh") continue;
    INFO(f.code);
    ++seen[f.code];
    const std::size_t size = f.code == "overfull_face" ? 3 : f.code == "pinched_edge" ? 2 : 1;
    REQUIRE(twin.found.contains(f.code));
    std::vector<Row> expected = twin.found.at(f.code);
    CHECK(places[f.code] == expected);
    CHECK(f.count == expected.size() / size);
    CHECK(f.text.find(std::to_string(f.count)) != std::string::npos);
    if (f.code == "overfull_face") expected = twin.overfull_ids;
    if (expected.size() > Finding::max_ids) expected.resize(Finding::max_ids / size * size);
    CHECK(f.ids == std::vector<std::int64_t>(expected.begin(), expected.end()));
  }
  for (const auto& [code, rows] : twin.found) {
    INFO(code);
    CHECK(places.contains(code) == !rows.empty());
  }
  CHECK(std::ranges::is_sorted(survey.findings, std::ranges::greater{}, &Finding::severity));
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    CHECK((survey.usable[t] == 1) == twin.usable[t]);
    for (std::size_t p = 0; p < 4; ++p) {
      const HalfFaceId f = survey.neighbours[t][p];
      CHECK(f.is_none() == !twin.across[t][p].has_value());
      if (twin.across[t][p]) CHECK(f.value == *twin.across[t][p]);
    }
  }
  CHECK(survey.rows == twin.rows);
  CHECK(survey.point_of_row == twin.point_of_row);
  CHECK(survey.edges == twin.edges);
  CHECK(survey.edges_at_row == twin.edges_at_row);
  CHECK(survey.components == twin.components);
  CHECK(survey.closed_components == twin.closed);
  CHECK(survey.flipped == twin.flipped);
  if (has_error(survey.findings)) return;
  std::vector<Row> touching;
  for (const FindingPlaces& p : check_file_mesh(file_mesh_of(mesh), true).places) {
    if (p.code == "nonmanifold_vertex") touching = p.rows;
  }
  CHECK(touching == twin.touching());
  if (!touching.empty()) ++seen["nonmanifold_vertex"];
}

}  // namespace

TEST_CASE("all that is found in careless meshes and heaps is what sets and unions say",
          "[topology][findings]") {
  std::map<std::string, std::size_t> seen;
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    TetMesh mesh = seed % 7 == 0 ? tet_mesh_of(careless(random)) : heap(random);
    if (mesh.tetrahedra.size() > 100) continue;
    hold(mesh, seen);
  }
  for (const char* code :
       {"nan_coordinate", "index_out_of_range", "repeated_vertex", "flat_tetrahedron",
        "duplicate_tetrahedron", "mirrored_tetrahedron", "overfull_face", "non_orientable",
        "inverted_tetrahedron", "folded_tetrahedron", "pinched_vertex", "pinched_edge",
        "unused_point", "coincident_points", "nonmanifold_vertex"}) {
    INFO(code);
    CHECK(seen[code] >= 2);
  }
}
