// SPDX-License-Identifier: MIT
#include "apps/host/sunder.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "fracture/simulation/simulation.hpp"
#include "mechanics/state/settings/named_materials.hpp"
#include "tests/apps/host/host_engine.hpp"

using namespace sunder::test;

namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Engine create(const std::string& text, const std::string& mesh, const std::string& bytes,
              const std::vector<const char*>& settings = {}) {
  const sunder_file file{mesh.c_str(), bytes.data(), bytes.size()};
  sunder_scene scene{};
  scene.size = sizeof scene;
  scene.text = text.data();
  scene.text_size = text.size();
  scene.name = "test.json";
  scene.files = &file;
  scene.file_count = 1;
  scene.settings = settings.data();
  scene.setting_count = static_cast<std::uint32_t>(settings.size());
  return {sunder_create(&scene), sunder_destroy};
}

Engine monolith(const std::vector<const char*>& settings = {}) {
  return create(bytes_of(SUNDER_SCENES "/paper/monolith.json"), "../../monolith.msh",
                bytes_of(SUNDER_MESHES "/monolith.msh"), settings);
}

sunder_report report_of(const Engine& engine) {
  sunder_report report{};
  report.size = sizeof report;
  sunder_last_report(engine.get(), &report);
  return report;
}

template <class T>
std::vector<T> column(const Engine& engine, sunder_column kind) {
  sunder_span span{};
  REQUIRE(sunder_read(engine.get(), kind, &span) == 0);
  std::vector<T> values(span.size / sizeof(T));
  std::memcpy(values.data(), span.bytes, span.size);
  return values;
}

sunder_action action_of(sunder_action_kind kind) {
  sunder_action action{};
  action.size = sizeof action;
  action.kind = kind;
  return action;
}

std::string saved(const Engine& engine) {
  sunder_span span{};
  sunder_save(engine.get(), &span);
  return {static_cast<const char*>(span.bytes), span.size};
}

}  // namespace

TEST_CASE("structs of the C functions have the layout that the page reads", "[host]") {
  CHECK(sunder_abi() == SUNDER_ABI);
  CHECK(sizeof(sunder_report) == 168);
  CHECK(offsetof(sunder_report, stage_ms) == 40);
  CHECK(offsetof(sunder_report, fans_total) == 96);
  CHECK(offsetof(sunder_report, cracks) == 160);
  CHECK(sizeof(sunder_action) == 80);
  CHECK(offsetof(sunder_action, mass) == 72);
  CHECK(sizeof(sunder_vertex) == 208);
  CHECK(offsetof(sunder_vertex, threshold) == 160);
}

TEST_CASE("a host's steps are the library's", "[host]") {
  auto file = sunder::read_scene(SUNDER_SCENES "/paper/monolith.json");
  REQUIRE(file);
  auto simulation = sunder::build_simulation(file->scene);
  REQUIRE(simulation);
  const Engine engine = monolith();
  REQUIRE(engine);
  std::uint64_t fans = 0;
  for (int i = 0; i < 260; ++i) {
    fans += sunder::advance(*simulation).fracture.fans.size();
    REQUIRE(sunder_step(engine.get(), nullptr) == 0);
  }
  const sunder_report report = report_of(engine);
  CHECK(report.step == 260);
  CHECK(report.fans_total == fans);
  CHECK(fans > 0);
  CHECK(report.time == sunder::simulated_time(*simulation));
}

TEST_CASE("columns of a body that breaks fit together", "[host]") {
  const Engine engine = monolith();
  REQUIRE(engine);
  for (int i = 0; i < 300; ++i) sunder_step(engine.get(), nullptr);
  const auto position = column<float>(engine, SUNDER_POSITION);
  const auto piece = column<std::uint32_t>(engine, SUNDER_PIECE);
  const auto face = column<std::uint32_t>(engine, SUNDER_FACE);
  const auto is_crack = column<std::uint32_t>(engine, SUNDER_FACE_IS_CRACK);
  CHECK(position.size() == 3 * piece.size());
  CHECK(face.size() == 3 * is_crack.size());
  CHECK(column<float>(engine, SUNDER_STRESS).size() == piece.size());
  CHECK(column<float>(engine, SUNDER_DRAWN_POSE).size() ==
        2 * column<float>(engine, SUNDER_REST_CENTRE).size());
  CHECK(column<double>(engine, SUNDER_OBSTACLE).size() == 3 * 16);
  std::set<std::uint32_t> seen;
  bool one_piece_a_face = true;
  for (std::size_t f = 0; f < is_crack.size(); ++f) {
    seen.insert(piece[face[3 * f]]);
    for (int i = 1; i < 3; ++i) {
      one_piece_a_face = one_piece_a_face && piece[face[3 * f + i]] == piece[face[3 * f]];
    }
  }
  CHECK(one_piece_a_face);
  CHECK(seen.size() == report_of(engine).pieces);
  CHECK(seen.size() > 1);
  sunder_span span{};
  CHECK(sunder_read(engine.get(), SUNDER_COLUMNS, &span) == 1);
}

TEST_CASE("a host reads the material of each body, also of one with a name", "[host]") {
  const std::string text = R"({"bodies": [
    {"shape": {"sphere": {"radius": 0.1}, "tetrahedra": 50}, "material": "glass"},
    {"shape": {"sphere": {"radius": 0.1}, "tetrahedra": 50}, "translation": [1, 0, 0],
     "material": {"young_modulus": 2e9, "poisson_ratio": 0.3, "density": 1000,
                  "tensile_strength": 1e6, "fracture_energy": 7}}]})";
  const Engine engine = create(text, "", "", {"bodies.0.material.tensile_strength=3e7"});
  REQUIRE(engine);
  const sunder::Material glass = sunder::find_material("glass")->material;
  CHECK(column<double>(engine, SUNDER_MATERIAL) ==
        std::vector{glass.young_modulus, glass.poisson_ratio, glass.density, 3e7, *glass.toughness,
                    0.0, 2e9, 0.3, 1000.0, 1e6, 0.0, 7.0});
}

TEST_CASE("a vertex that a host inspects has the stress of the column", "[host]") {
  const Engine engine = monolith();
  REQUIRE(engine);
  for (int i = 0; i < 120; ++i) sunder_step(engine.get(), nullptr);
  const auto stress = column<float>(engine, SUNDER_STRESS);
  const auto ratio = column<float>(engine, SUNDER_LOAD_RATIO);
  for (const std::uint32_t v : {0u, 17u, 80u, 171u}) {
    sunder_vertex vertex{};
    vertex.size = sizeof vertex;
    REQUIRE(sunder_inspect(engine.get(), v, &vertex) == 0);
    const double size = std::abs(vertex.principal[0]) + std::abs(vertex.principal[2]);
    CHECK(std::abs(vertex.principal[0] - stress[v]) <= 1e-6 * size);
    CHECK(std::abs(vertex.principal[0] / vertex.threshold - ratio[v]) <=
          1e-6 * size / vertex.threshold);
    CHECK(vertex.gershgorin >= vertex.principal[0] - 1e-9 * size);
    const double trace = vertex.stress[0] + vertex.stress[1] + vertex.stress[2];
    const double sum = vertex.principal[0] + vertex.principal[1] + vertex.principal[2];
    CHECK(std::abs(trace - sum) <= 1e-9 * size);
  }
  sunder_vertex vertex{};
  vertex.size = sizeof vertex;
  CHECK(sunder_inspect(engine.get(), 1u << 30, &vertex) == 1);
}

TEST_CASE("a saved state of a host goes on to the same bytes", "[host]") {
  const Engine engine = monolith();
  REQUIRE(engine);
  for (int i = 0; i < 150; ++i) sunder_step(engine.get(), nullptr);
  const std::string state = saved(engine);
  const Engine second(sunder_restore(state.data(), state.size()), sunder_destroy);
  REQUIRE(second);
  for (int i = 0; i < 60; ++i) {
    sunder_step(engine.get(), nullptr);
    sunder_step(second.get(), nullptr);
  }
  CHECK(saved(engine) == saved(second));
  CHECK(report_of(second).fans_total == report_of(engine).fans_total);
  CHECK(sunder_restore("no state", 8) == nullptr);
  CHECK(std::string(sunder_error(nullptr)).find("not_a_saved_state") != std::string::npos);
}

TEST_CASE("a host shoots a ball, and the body breaks where it strikes", "[host]") {
  const Engine engine = monolith({"obstacles=[{\"plane\": {\"normal\": [0, 0, 1]}}]"});
  REQUIRE(engine);
  sunder_action shot = action_of(SUNDER_SHOOT);
  shot.point[1] = -0.6;
  shot.point[2] = 1;
  shot.vector[1] = 30;
  shot.radius = 0.1;
  shot.mass = 60;
  REQUIRE(sunder_act(engine.get(), &shot) == 0);
  for (int i = 0; i < 120; ++i) REQUIRE(sunder_step(engine.get(), nullptr) == 0);
  CHECK(report_of(engine).fans_total > 0);
  CHECK(column<double>(engine, SUNDER_OBSTACLE).size() == 2 * 16);
  shot.radius = 0;
  CHECK(sunder_act(engine.get(), &shot) == 1);
  CHECK(std::string(sunder_error(engine.get())).find("bad_action") != std::string::npos);
}

TEST_CASE("a host cuts a body by a plane", "[host]") {
  const Engine engine = monolith({"obstacles=[{\"plane\": {\"normal\": [0, 0, 1]}}]"});
  REQUIRE(engine);
  for (int i = 0; i < 5; ++i) sunder_step(engine.get(), nullptr);
  const std::uint32_t shape = report_of(engine).shape;
  sunder_action plane = action_of(SUNDER_CUT);
  plane.point[2] = 1;
  plane.vector[0] = 0.3;
  plane.vector[2] = 1;
  REQUIRE(sunder_act(engine.get(), &plane) == 0);
  CHECK(report_of(engine).shape == shape + 1);
  REQUIRE(sunder_step(engine.get(), nullptr) == 0);
  const auto fan = column<double>(engine, SUNDER_FAN);
  REQUIRE(fan.size() >= 16);
  CHECK(fan[0] == -1);
  CHECK(fan[5] == 1);
  for (int i = 0; i < 20; ++i) REQUIRE(sunder_step(engine.get(), nullptr) == 0);
  CHECK(report_of(engine).pieces == 2);
  plane.point[2] = 50;
  CHECK(sunder_act(engine.get(), &plane) == 1);
  CHECK(std::string(sunder_error(engine.get())).find("nothing_cut") != std::string::npos);
}

TEST_CASE("a spring pulls a body to its end, and lets go", "[host]") {
  const Engine engine = monolith({"obstacles=[]", "gravity.acceleration=[0,0,0]",
                                  "bodies.0.material.tensile_strength=1e12", "time_step=1e-3"});
  REQUIRE(engine);
  const auto start = column<float>(engine, SUNDER_POSITION);
  sunder_action pull = action_of(SUNDER_PULL);
  pull.vertex = 3;
  for (int i = 0; i < 3; ++i) pull.point[i] = start[9 + i];
  pull.point[0] += 0.5;
  REQUIRE(sunder_act(engine.get(), &pull) == 0);
  for (int i = 0; i < 600; ++i) REQUIRE(sunder_step(engine.get(), nullptr) == 0);
  const auto end = column<float>(engine, SUNDER_POSITION);
  CHECK(end[9] - start[9] == Approx(0.5).margin(0.1));
  const sunder_action release = action_of(SUNDER_RELEASE);
  CHECK(sunder_act(engine.get(), &release) == 0);
  CHECK(sunder_step(engine.get(), nullptr) == 0);
  pull.vertex = 1u << 30;
  CHECK(sunder_act(engine.get(), &pull) == 1);
}

TEST_CASE("the fans of a step tell every face, and what came apart there", "[host]") {
  const Engine engine = monolith();
  REQUIRE(engine);
  constexpr std::uint32_t none = 0xffffffff;
  std::uint64_t fans = 0, pieces = 1;
  std::size_t contacts = 0, faces = 0;
  std::map<std::uint32_t, std::uint32_t> opposite;
  for (int i = 0; i < 300; ++i) {
    const std::size_t rows_before = column<std::uint32_t>(engine, SUNDER_PIECE).size();
    sunder_step(engine.get(), nullptr);
    const auto fan = column<double>(engine, SUNDER_FAN);
    const auto face = column<std::uint32_t>(engine, SUNDER_FAN_FACE);
    REQUIRE(fan.size() % 16 == 0);
    std::vector<double> oracle(fan.size() / 16), counted(fan.size() / 16);
    std::size_t copies = 0;
    for (std::size_t f = 0; f < face.size(); f += 12) {
      oracle.at(face[f + 10]) += face[f + 9];
      counted.at(face[f + 10]) += 1;
      std::uint32_t apart = 0;
      for (int k = 0; k < 3; ++k) apart += face[f + 5 + k] != none;
      copies += apart;
      CHECK((apart == 3) == (face[f + 9] == 1));
      if (face[f + 1] != none) opposite[face[f]] = face[f + 1];
      ++faces;
    }
    CHECK(rows_before + copies == column<std::uint32_t>(engine, SUNDER_PIECE).size());
    for (std::size_t k = 0; k < fan.size() / 16; ++k) {
      CHECK(fan[16 * k] == static_cast<double>(fans++));
      CHECK(fan[16 * k + 3] == counted[k]);
      CHECK(fan[16 * k + 4] == oracle[k]);
      CHECK(fan[16 * k + 7] >= fan[16 * k + 8]);
      pieces += static_cast<std::uint64_t>(fan[16 * k + 5]);
    }
    contacts += column<float>(engine, SUNDER_CONTACT).size() / 8;
  }
  const sunder_report report = report_of(engine);
  CHECK(fans == report.fans_total);
  CHECK(pieces == report.pieces);
  CHECK(faces > fans);
  CHECK(contacts > 0);
  // Every crack face is one of those that fans opened, and so is the one that it lay against.
  const auto half_face = column<std::uint32_t>(engine, SUNDER_HALF_FACE);
  const auto is_crack = column<std::uint32_t>(engine, SUNDER_FACE_IS_CRACK);
  REQUIRE(half_face.size() == is_crack.size());
  std::set<std::uint32_t> cracks, opened;
  for (std::size_t f = 0; f < is_crack.size(); ++f) {
    if (is_crack[f]) cracks.insert(half_face[f]);
  }
  for (const auto& [one, other] : opposite) opened.insert({one, other});
  CHECK(cracks == opened);
}

TEST_CASE("pieces tell where they came from, crack fronts are edges inside a body", "[host]") {
  const Engine engine = monolith();
  REQUIRE(engine);
  CHECK(column<std::uint32_t>(engine, SUNDER_CRACK_FRONT).empty());
  std::size_t fronts = 0;
  for (int i = 0; i < 300; ++i) {
    sunder_step(engine.get(), nullptr);
    if (report_of(engine).fans == 0) continue;
    const auto front = column<std::uint32_t>(engine, SUNDER_CRACK_FRONT);
    const auto piece = column<std::uint32_t>(engine, SUNDER_PIECE);
    for (std::size_t e = 0; e < front.size(); e += 2)
      CHECK(piece.at(front[e]) == piece.at(front[e + 1]));
    fronts += front.size() / 2;
  }
  CHECK(fronts > 0);
  const auto parent = column<std::uint32_t>(engine, SUNDER_PARENT);
  const auto count = column<std::uint32_t>(engine, SUNDER_TETRAHEDRA);
  const auto velocity = column<float>(engine, SUNDER_VELOCITY);
  REQUIRE(parent.size() == count.size());
  CHECK(velocity.size() == 3 * count.size());
  CHECK(parent[0] == 0xffffffff);
  std::uint32_t tetrahedra = 0;
  for (std::size_t p = 0; p < count.size(); ++p) {
    tetrahedra += count[p];
    if (p > 0) CHECK(parent[p] < p);
  }
  CHECK(tetrahedra == 424);
  // Cracks of crack paper have no planes: nothing moves.
  CHECK(column<float>(engine, SUNDER_SMOOTH) == column<float>(engine, SUNDER_REST));
}

TEST_CASE("a piece that comes off is drawn where it was, and follows smoothly", "[host]") {
  const Engine engine = create(bytes_of(SUNDER_SCENES "/paper/block.json"), "../../monolith.msh",
                               bytes_of(SUNDER_MESHES "/monolith.msh"), {"gravity.ramp_time=0.3"});
  REQUIRE(engine);
  std::vector<float> old_centre;
  std::map<sunder_column, std::vector<float>> old;
  while (report_of(engine).pieces == 1) {
    REQUIRE(report_of(engine).step < 600);
    old_centre = column<float>(engine, SUNDER_REST_CENTRE);
    for (const auto kind : {SUNDER_DRAWN_POSE, SUNDER_POSE})
      old[kind] = column<float>(engine, kind);
    REQUIRE(sunder_step(engine.get(), nullptr) == 0);
  }
  const auto centre = column<float>(engine, SUNDER_REST_CENTRE);
  // m, from where the piece's rest centre was drawn as part of the body (hardly turned as yet).
  const auto jump = [&](sunder_column kind) {
    const auto now = column<float>(engine, kind);
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Map<const Eigen::Quaternionf> turn(&old[kind][4]);
      const Eigen::Map<const Eigen::Vector3f> from(&old_centre[0]), to(&centre[4]);
      const Eigen::Vector3f before =
          Eigen::Map<Eigen::Vector3f>(&old[kind][0]) + turn * (to - from);
      sum += std::pow(now[8 + i] - before[static_cast<Eigen::Index>(i)], 2);
    }
    return std::sqrt(sum);
  };
  CHECK(jump(SUNDER_POSE) > 1e-3);
  CHECK(jump(SUNDER_DRAWN_POSE) < 0.1 * jump(SUNDER_POSE));
}

TEST_CASE("points on cracks that are surfaces are brought near them", "[host]") {
  const Engine engine = monolith({"fracture.crack=object"});
  REQUIRE(engine);
  for (int i = 0; i < 300; ++i) sunder_step(engine.get(), nullptr);
  const auto rest = column<float>(engine, SUNDER_REST),
             smooth = column<float>(engine, SUNDER_SMOOTH);
  REQUIRE(rest.size() == smooth.size());
  CHECK(rest != smooth);
  float farthest = 0;
  for (std::size_t i = 0; i < rest.size(); ++i)
    farthest = std::max(farthest, std::abs(rest[i] - smooth[i]));
  CHECK(farthest < 0.3f);  // edges are about as long
}

TEST_CASE("a host is told what is wrong with a scene", "[host]") {
  CHECK_FALSE(create("{", "a.msh", ""));
  CHECK(std::string(sunder_error(nullptr)).find("syntax_error") != std::string::npos);
  const std::string scene = bytes_of(SUNDER_SCENES "/paper/monolith.json");
  CHECK_FALSE(create(scene, "other.msh", ""));
  CHECK(std::string(sunder_error(nullptr)).find("there are: other.msh") != std::string::npos);
  CHECK_FALSE(create(scene, "../../monolith.msh", "$MeshFormat\nnonsense"));
  CHECK_FALSE(std::string(sunder_error(nullptr)).empty());
}
