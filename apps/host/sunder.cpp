// SPDX-License-Identifier: MIT
// The C functions over the library's.
#include "apps/host/sunder.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <string_view>

#include "apps/host/engine.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/scene/words.hpp"
#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "topology/io/face_list.hpp"
#include "topology/io/mesh_file.hpp"

namespace {

using namespace sunder;

constexpr std::string_view out_of_memory = "out of memory";
// In a string without memory of its own, where there is none left.
static_assert(out_of_memory.size() <= 15);

/// What was wrong with a creation, a thread each. Of fixed size, as a thread asks for memory at the
/// first use of what has a destructor, and ends the process where there is none.
class CreationError {
 public:
  void say(std::string_view words) {
    constexpr std::string_view more = "there is more\n";
    if (words.size() >= sizeof text_) {
      words = words.substr(0, sizeof text_ - 1 - more.size());
      words = words.substr(0, words.rfind('\n') + 1);
      std::memcpy(text_ + words.size(), more.data(), more.size() + 1);
    } else {
      text_[words.size()] = 0;
    }
    std::memcpy(text_, words.data(), words.size());
  }
  const char* text() const { return text_; }

 private:
  char text_[1 << 14] = {};
};

CreationError& creation_error() {
  static thread_local CreationError error;
  return error;
}

/// Creates an engine, or tells why not.
template <class Create>
sunder_engine* created(const Create& create) noexcept {
  try {
    std::string words;
    std::unique_ptr<sunder_engine> engine = create(words);
    creation_error().say(words);
    return engine.release();
  } catch (const std::bad_alloc&) {
    creation_error().say(out_of_memory);
    return nullptr;
  }
}

/// Does something with an engine that is whole. 1 where it is not, or where memory ran out.
template <class Do>
int done(sunder_engine* engine, const Do& action) noexcept {
  if (engine->torn) return 1;
  try {
    return action();
  } catch (const std::bad_alloc&) {
    engine->error = out_of_memory;
    return 1;
  }
}

/// The same with what changes its state, which is torn where memory ran out on the way.
template <class Do>
int changed(sunder_engine* engine, const Do& action) noexcept {
  return done(engine, [&] {
    engine->torn = true;
    const int result = action();
    engine->torn = false;
    return result;
  });
}

/// Copies as much of a struct as the caller has room for.
template <class T>
void give(T* target, T source) {
  if (target == nullptr) return;
  const std::uint32_t size = std::min<std::uint32_t>(target->size, sizeof(T));
  source.size = target->size;
  std::memcpy(target, &source, size);
}

/// The files of a scene by name, in memory.
struct MemoryFiles {
  std::map<std::string, std::string_view, std::less<>> bytes;

  Result<std::string_view> find(const std::string& name) const {
    if (const auto file = bytes.find(name); file != bytes.end()) return file->second;
    std::string known;
    for (const auto& [other, content] : bytes) known += (known.empty() ? "" : ", ") + other;
    return Finding{.code = "cannot_open",
                   .text = "there is no file " + name,
                   .remedy = known.empty() ? "give it with the scene" : "there are: " + known,
                   .file = name};
  }
};

template <class T, class Read>
Result<T> read_found(const MemoryFiles& files, const std::string& name, const Read& read) {
  const Result<std::string_view> bytes = files.find(name);
  if (bytes) return read(*bytes);
  Result<T> missing;
  missing.findings = bytes.findings;
  return missing;
}

Result<SceneFile> read_scene_in_memory(const sunder_scene& scene) {
  MemoryFiles files;
  for (std::uint32_t i = 0; i < scene.file_count; ++i) {
    const sunder_file& file = scene.files[i];
    files.bytes[file.name] = {static_cast<const char*>(file.bytes), file.size};
  }
  std::vector<std::string> settings(scene.settings, scene.settings + scene.setting_count);
  const SceneFiles readers{
      .mesh =
          [&](const std::string& name) {
            return read_found<TetMesh>(files, name,
                                       [&](std::string_view b) { return read_mesh(b, name); });
          },
      .surface =
          [&](const std::string& name) {
            return read_found<FileMesh>(files, name, [&](std::string_view b) {
              return read_file_mesh(b, name, {.simplices = true});
            });
          },
      .faces =
          [&](const std::string& name) {
            using Faces = std::vector<std::array<std::uint32_t, 3>>;
            return read_found<Faces>(files, name,
                                     [&](std::string_view b) { return read_face_list(b, name); });
          },
      .point_field =
          [&](const std::string& name, const std::string& field) {
            return read_found<std::vector<double>>(
                files, name, [&](std::string_view b) { return read_point_field(b, name, field); });
          }};
  return read_scene({{scene.text, scene.text_size}, scene.name}, readers, settings);
}

void note_step(sunder_report& r, const StepReport& step) {
  r.step = step.step;
  r.time = step.time;
  std::copy(step.stage_ms.begin(), step.stage_ms.end(), r.stage_ms);
  r.pieces = static_cast<std::uint32_t>(step.components);
  r.new_pieces = static_cast<std::uint32_t>(step.new_components.size());
  r.fans = static_cast<std::uint32_t>(step.fracture.fans.size());
  r.parts = step.parts;
  r.contacts = step.contact.contacts;
  r.fans_total += step.fracture.fans.size();
  if (r.fans > 0 || !step.releases.empty() || r.new_pieces > 0) ++r.shape;
  r.tested = step.fracture.tested;
  r.suspects = step.fracture.suspects;
  r.reached = step.fracture.reached;
  r.predicted = r.created = 0;
  for (const FanEvent& fan : step.fracture.fans) {
    r.predicted += fan.components.predicted;
    r.created += fan.components.created;
  }
  r.kinetic = step.energy.kinetic;
  r.strain = step.energy.strain;
  r.cracks = step.energy.cracks;
}

/// Keeps the fans of a step, behind the cuts that came before it.
void keep_fans(sunder_engine& engine, StepReport& step) {
  engine.fans = std::move(engine.cuts);
  engine.cuts.clear();
  double number = static_cast<double>(engine.report.fans_total - step.fracture.fans.size());
  for (std::size_t i = 0; i < step.fracture.fans.size(); ++i) {
    engine.fans.push_back({number++, step.fan_time[i], std::move(step.fracture.fans[i])});
  }
}

Vec3 vector_of(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

std::optional<Finding> do_action(sunder_engine& engine, const sunder_action& action) {
  const Vec3 point = vector_of(action.point), vector = vector_of(action.vector);
  switch (action.kind) {
    case SUNDER_SHOOT:
      return shoot(engine.simulation, {point, action.radius}, vector, action.mass);
    case SUNDER_PULL:
      if (action.vertex >= engine.simulation.state->mechanics.vertices.size() ||
          !point.allFinite()) {
        return Finding{.code = "bad_action",
                       .text = "there is no such vertex, or its place is none",
                       .remedy = "give a row of SUNDER_POSITION and a finite point"};
      }
      engine.spring = Spring{VertexId{action.vertex}, point};
      return std::nullopt;
    case SUNDER_RELEASE:
      engine.spring.reset();
      return std::nullopt;
    case SUNDER_CUT: {
      Result<FanEvent> made = cut(engine.simulation, point, vector);
      if (!made) return made.findings.front();
      ++engine.report.shape;
      engine.cuts.push_back({-1, engine.report.time, std::move(*made)});
      return std::nullopt;
    }
    default:
      return Finding{.code = "bad_action",
                     .text = "there is no such action",
                     .remedy = "take one of sunder_action_kind"};
  }
}

}  // namespace

std::unique_ptr<sunder_engine> sunder::make_engine(Simulation simulation) {
  auto engine = std::make_unique<sunder_engine>();
  engine->simulation = std::move(simulation);
  const Simulation& sim = engine->simulation;
  engine->loads = sim.state->loads.size();
  sunder_report& r = engine->report;
  r.step = sim.state->step;
  r.time = simulated_time(sim);
  r.time_step = sim.scene.integrator.time_step;
  r.duration = sim.scene.duration;
  r.fans_total = sim.state->fans;
  for (const Component& c : sim.state->mechanics.components) r.pieces += !c.tetrahedra.empty();
  return engine;
}

uint32_t sunder_abi(void) { return SUNDER_ABI; }

sunder_engine* sunder_create(const sunder_scene* scene) {
  return created([scene](std::string& words) -> std::unique_ptr<sunder_engine> {
    Result<SceneFile> file = read_scene_in_memory(*scene);
    words = finding_lines(file.findings);
    if (!file) return nullptr;
    Result<Simulation> simulation = build_simulation(std::move(file->scene));
    words += finding_lines(simulation.findings);
    return simulation ? make_engine(std::move(*simulation)) : nullptr;
  });
}

void sunder_destroy(sunder_engine* engine) { delete engine; }

int sunder_step(sunder_engine* engine, sunder_report* report) {
  if (!engine->failed) {
    engine->report.outcome = 1;
    engine->failed = changed(engine, [engine] {
                       load_spring(engine->simulation, engine->spring, engine->loads);
                       StepReport step = advance(engine->simulation);
                       note_step(engine->report, step);
                       keep_fans(*engine, step);
                       if (step.status.outcome != StepOutcome::fine) {
                         engine->error = finding_lines({to_finding(step.status)});
                         return 1;
                       }
                       if (!step.fracture.not_a_number) return 0;
                       engine->error = "the stress of a vertex is not a number\n";
                       return 1;
                     }) != 0;
    engine->report.outcome = engine->failed;
  }
  give(report, engine->report);
  return engine->failed;
}

void sunder_last_report(const sunder_engine* engine, sunder_report* report) {
  give(report, engine->report);
}

int sunder_read(sunder_engine* engine, uint32_t column, sunder_span* span) {
  if (column >= SUNDER_COLUMNS) return 1;
  return done(engine, [=] {
    std::vector<unsigned char>& bytes = engine->columns[column];
    if (column == SUNDER_FAN || column == SUNDER_FAN_FACE) {
      fill_fans(bytes, engine->fans, static_cast<sunder_column>(column));
    } else {
      fill_column(bytes, engine->simulation, static_cast<sunder_column>(column));
    }
    *span = {bytes.data(), bytes.size()};
    return 0;
  });
}

int sunder_inspect(sunder_engine* engine, uint32_t vertex, sunder_vertex* result) {
  return done(engine, [=] {
    if (vertex >= engine->simulation.state->mechanics.vertices.size()) return 1;
    sunder_vertex found{};
    inspect_vertex(found, engine->simulation, VertexId{vertex});
    give(result, found);
    return 0;
  });
}

int sunder_act(sunder_engine* engine, const sunder_action* action) {
  return changed(engine, [=] {
    const std::optional<Finding> finding = do_action(*engine, *action);
    engine->error = finding ? finding_lines({*finding}) : "";
    return finding ? 1 : 0;
  });
}

void sunder_save(sunder_engine* engine, sunder_span* span) {
  *span = {nullptr, 0};
  done(engine, [=] {
    load_spring(engine->simulation, std::nullopt, engine->loads);
    engine->saved = saved_state(engine->simulation);
    *span = {engine->saved.data(), engine->saved.size()};
    return 0;
  });
}

sunder_engine* sunder_restore(const void* bytes, size_t size) {
  return created([=](std::string& words) -> std::unique_ptr<sunder_engine> {
    Result<Simulation> simulation = restore({static_cast<const char*>(bytes), size});
    words = finding_lines(simulation.findings);
    return simulation ? make_engine(std::move(*simulation)) : nullptr;
  });
}

const char* sunder_error(const sunder_engine* engine) {
  return engine ? engine->error.c_str() : creation_error().text();
}
