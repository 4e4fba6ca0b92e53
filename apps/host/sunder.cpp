// SPDX-License-Identifier: MIT
// The C functions over the library's.
#include "apps/host/sunder.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <iterator>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "apps/host/creation_error.hpp"
#include "apps/host/engine.hpp"
#include "apps/host/memory_scene.hpp"
#include "apps/scene/words.hpp"
#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/changes/actions.hpp"
#include "fracture/simulation/changes/bodies.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "topology/base/fnv1a.hpp"

namespace {

using namespace sunder;

constexpr std::string_view out_of_memory = "out of memory";
constexpr std::string_view internal_fault = "internal fault";
// In a string without memory of its own, where there is none left.
static_assert(out_of_memory.size() <= 15 && internal_fault.size() <= 15);

CreationError& creation_error() {
  static thread_local CreationError error;
  return error;
}

/// Creates an engine, or says why not.
template <class Create>
sunder_engine* created(const Create& create) noexcept {
  try {
    std::vector<Finding> findings;
    std::unique_ptr<sunder_engine> engine = create(findings);
    creation_error().say(finding_lines(findings), findings);
    return engine.release();
  } catch (const std::bad_alloc&) {
    creation_error().say(out_of_memory, {});
  } catch (const std::exception& fault) {
    creation_error().say(fault.what(), {});
  }
  return nullptr;
}

/// Notes why a call failed.
int refuse(sunder_engine* engine, std::vector<Finding> findings, sunder_result result) {
  engine->error = finding_lines(findings);
  engine->findings = std::move(findings);
  return result;
}

/// Why an engine is torn.
int why_torn(const sunder_engine* engine) {
  return engine->error == out_of_memory ? SUNDER_NO_MEMORY : SUNDER_FAILED;
}

/// Does something with an engine that is whole. A failure where it is not, or where memory ran out.
template <class Do>
int done(sunder_engine* engine, const Do& action) noexcept {
  if (engine->torn) return why_torn(engine);
  try {
    return action();
  } catch (const std::bad_alloc&) {
    engine->findings.clear();
    engine->error = out_of_memory;
    return SUNDER_NO_MEMORY;
  } catch (const std::exception&) {  // no thread could be started, or a fault of ours
    engine->findings.clear();
    engine->error = internal_fault;
    return SUNDER_FAILED;
  }
}

/// The same with changes of its state, which is torn where one did not come to its end.
template <class Do>
int changed(sunder_engine* engine, const Do& action) noexcept {
  return done(engine, [&] {
    engine->torn = true;
    const int result = action();
    engine->torn = false;
    return result;
  });
}

Finding bad_size(const char* type) {
  return {.code = "bad_size",
          .text = std::string("the size of a ") + type + " is too small",
          .remedy = std::string("set its field size to sizeof(") + type + ")"};
}

Finding not_a_number() {
  return {.code = "not_a_number",
          .text = "the stress of a vertex is not a number",
          .remedy = "take shorter steps, or look for a body that is torn apart"};
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
      return pull(engine.simulation, VertexId{action.vertex}, point);
    case SUNDER_RELEASE:
      release(engine.simulation);
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

sunder_body_change change_of(const BodyChange& change) {
  sunder_body_change result{};
  result.body = static_cast<std::uint32_t>(change.body);
  result.pieces = static_cast<std::uint32_t>(change.pieces.size());
  result.first_piece = change.pieces.front().value;
  result.mass = change.mass;
  result.kinetic = change.kinetic;
  result.strain = change.strain;
  std::copy_n(change.momentum.data(), 3, result.momentum);
  std::copy_n(change.momentum.data() + 3, 3, result.angular_momentum);
  return result;
}

/// Notes that a body came (`sign` 1) or went (-1), or why not.
int note_change(sunder_engine& engine, Result<BodyChange>&& made, int sign,
                sunder_body_change* change) {
  if (!made) return refuse(&engine, std::move(made.findings), SUNDER_REFUSED);
  sunder_report& report = engine.report;
  ++report.shape;
  report.pieces += static_cast<std::uint32_t>(sign * static_cast<int>(made->pieces.size()));
  give(change, change_of(*made));
  return refuse(&engine, std::move(made.findings), SUNDER_OK);
}

}  // namespace

std::unique_ptr<sunder_engine> sunder::make_engine(Simulation simulation) {
  auto engine = std::make_unique<sunder_engine>();
  engine->simulation = std::move(simulation);
  const Simulation& sim = engine->simulation;
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

sunder_engine* sunder::engine_of(const SceneReader& read) noexcept {
  return created([&read](std::vector<Finding>& findings) -> std::unique_ptr<sunder_engine> {
    Result<SceneFile> file = read();
    findings = std::move(file.findings);
    if (!file) return nullptr;
    Result<Simulation> simulation = build_simulation(std::move(file->scene));
    std::ranges::move(simulation.findings, std::back_inserter(findings));
    return simulation ? make_engine(std::move(*simulation)) : nullptr;
  });
}

sunder_engine* sunder_create(const sunder_scene* scene) {
  return engine_of([scene] { return read_scene_in_memory(*scene); });
}

void sunder_destroy(sunder_engine* engine) { delete engine; }

int sunder_step(sunder_engine* engine, sunder_report* report) {
  if (!engine->failed) {
    engine->report.outcome = 1;
    engine->failed = changed(engine, [engine] {
                       StepReport step = advance(engine->simulation);
                       note_step(engine->report, step);
                       keep_fans(*engine, step);
                       if (step.status.outcome != StepOutcome::fine) {
                         return refuse(engine, {to_finding(step.status)}, SUNDER_FAILED);
                       }
                       if (!step.fracture.not_a_number) return int{SUNDER_OK};
                       return refuse(engine, {not_a_number()}, SUNDER_FAILED);
                     }) != 0;
    engine->report.outcome = engine->failed;
  }
  give(report, engine->report);
  if (!engine->failed) return SUNDER_OK;
  return engine->torn ? why_torn(engine) : int{SUNDER_FAILED};
}

void sunder_last_report(const sunder_engine* engine, sunder_report* report) {
  give(report, engine->report);
}

int sunder_read(sunder_engine* engine, uint32_t column, sunder_span* span) {
  return done(engine, [=] {
    if (column >= SUNDER_COLUMNS) {
      return refuse(engine,
                    {{.code = "no_such_column",
                      .text = "there is no column " + std::to_string(column),
                      .remedy = "take one of sunder_column"}},
                    SUNDER_REFUSED);
    }
    std::vector<unsigned char>& bytes = engine->columns[column];
    if (column == SUNDER_FAN || column == SUNDER_FAN_FACE) {
      fill_fans(bytes, engine->fans, static_cast<sunder_column>(column));
    } else {
      fill_column(bytes, engine->simulation, static_cast<sunder_column>(column));
    }
    *span = {bytes.data(), bytes.size()};
    return int{SUNDER_OK};
  });
}

int sunder_inspect(sunder_engine* engine, uint32_t vertex, sunder_vertex* result) {
  return done(engine, [=] {
    if (vertex >= engine->simulation.state->mechanics.vertices.size()) {
      return refuse(engine,
                    {{.code = "no_such_vertex",
                      .text = "there is no vertex " + std::to_string(vertex),
                      .remedy = "give a row of SUNDER_POSITION"}},
                    SUNDER_REFUSED);
    }
    sunder_vertex found{};
    inspect_vertex(found, engine->simulation, VertexId{vertex});
    give(result, found);
    return int{SUNDER_OK};
  });
}

int sunder_act(sunder_engine* engine, const sunder_action* action) {
  return changed(engine, [=] {
    if (action->size < sizeof(sunder_action)) {
      return refuse(engine, {bad_size("sunder_action")}, SUNDER_REFUSED);
    }
    const std::optional<Finding> finding = do_action(*engine, *action);
    if (finding) return refuse(engine, {*finding}, SUNDER_REFUSED);
    return refuse(engine, {}, SUNDER_OK);
  });
}

int sunder_add_body(sunder_engine* engine, const sunder_scene* body, sunder_body_change* change) {
  return changed(engine, [=] {
    Result<BodySettings> settings = read_body_in_memory(*body);
    if (!settings) return refuse(engine, std::move(settings.findings), SUNDER_REFUSED);
    return note_change(*engine, add_body(engine->simulation, std::move(*settings)), 1, change);
  });
}

int sunder_remove_body(sunder_engine* engine, uint32_t body, sunder_body_change* change) {
  return changed(engine, [=] {
    Result<BodyChange> made = remove_body(engine->simulation, body);
    if (made) {
      engine->fans.clear();  // of rows as they were
      engine->cuts.clear();
    }
    return note_change(*engine, std::move(made), -1, change);
  });
}

void sunder_save(sunder_engine* engine, sunder_span* span) {
  *span = {nullptr, 0};
  done(engine, [=] {
    engine->saved = saved_state(engine->simulation);
    *span = {engine->saved.data(), engine->saved.size()};
    return 0;
  });
}

int sunder_hash(sunder_engine* engine, uint64_t* hash) {
  sunder_span state;
  sunder_save(engine, &state);
  if (state.bytes == nullptr) return why_torn(engine);
  Fnv1a sum;
  sum.add({static_cast<const char*>(state.bytes), state.size});
  *hash = sum.value;
  return SUNDER_OK;
}

sunder_engine* sunder_restore(const void* bytes, size_t size) {
  return created([=](std::vector<Finding>& findings) -> std::unique_ptr<sunder_engine> {
    Result<Simulation> simulation = restore({static_cast<const char*>(bytes), size});
    findings = std::move(simulation.findings);
    return simulation ? make_engine(std::move(*simulation)) : nullptr;
  });
}

const char* sunder_error(const sunder_engine* engine) {
  return engine ? engine->error.c_str() : creation_error().lines();
}

uint32_t sunder_finding_count(const sunder_engine* engine) {
  return static_cast<uint32_t>(engine ? engine->findings.size()
                                      : creation_error().findings().size());
}

int sunder_get_finding(const sunder_engine* engine, uint32_t row, sunder_finding* finding) {
  if (row >= sunder_finding_count(engine)) return SUNDER_REFUSED;
  give(finding, engine ? finding_of(engine->findings[row]) : creation_error().findings()[row]);
  return SUNDER_OK;
}
