/* SPDX-License-Identifier: MIT */
/* A host in C99: bodies from arrays, without files, from files; findings; save, load, hash; structs of older versions.
     c_host SCENE.json   prints a line per check and ends with 0, or names the first that fails. */
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sunder.h>

static int failures = 0;

static void check(int holds, const char* words) {
  printf("%s: %s\n", holds ? "ok" : "FAILED", words);
  if (!holds) ++failures;
}

static const char scene_text[] =
    "{\"bodies\": [{\"mesh\": \"bar\"}], \"obstacles\": [{\"plane\": {}}], \"duration\": 0.02}";

static const char shape_text[] =
    "{\"bodies\": [{\"shape\": {\"box\": {\"size\": [1, 0.1, 0.1]}, \"cell\": 0.05},"
    " \"translation\": [0, 0, 0.07], \"velocity\": [0, 0, -8],"
    " \"material\": {\"tensile_strength\": 1e6}}],"
    " \"obstacles\": [{\"plane\": {}}], \"time_step\": 1e-3, \"duration\": 0.02,"
    " \"fracture\": {\"crack\": \"paper\"}}";

static sunder_scene scene_of(const char* text) {
  sunder_scene scene;
  memset(&scene, 0, sizeof scene);
  scene.size = sizeof scene;
  scene.text = text;
  scene.text_size = strlen(text);
  scene.name = "c_host.json";
  return scene;
}

static uint64_t hash_of(sunder_engine* engine) {
  uint64_t hash = 0;
  check(sunder_hash(engine, &hash) == SUNDER_OK && hash != 0, "the state has a hash");
  return hash;
}

static sunder_engine* engine_of_shape(void) {
  sunder_scene scene = scene_of(shape_text);
  return sunder_create(&scene);
}

static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};

static sunder_engine* engine_of_arrays(const uint32_t* tetrahedra, size_t count) {
  sunder_mesh mesh;
  const sunder_mesh* meshes[1];
  sunder_scene scene = scene_of(scene_text);
  memset(&mesh, 0, sizeof mesh);
  mesh.size = sizeof mesh;
  mesh.name = "bar";
  mesh.points = corners;
  mesh.point_count = 5;
  mesh.tetrahedra = tetrahedra;
  mesh.tetrahedron_count = count;
  meshes[0] = &mesh;
  scene.meshes = meshes;
  scene.mesh_count = 1;
  return sunder_create(&scene);
}

static void steps_and_states(void) {
  sunder_engine* engine = engine_of_shape();
  sunder_engine* second;
  sunder_report report;
  sunder_span state;
  int i;
  check(engine != NULL, "a scene of a box without files");
  if (engine == NULL) return;
  memset(&report, 0, sizeof report);
  report.size = sizeof report;
  for (i = 0; i < 10; ++i) check(sunder_step(engine, &report) == SUNDER_OK, "a step");
  check(report.step == 10 && report.fans_total > 0 && report.pieces > 1, "the box breaks");
  sunder_save(engine, &state);
  second = sunder_restore(state.bytes, state.size);
  check(second != NULL && hash_of(second) == hash_of(engine), "what is loaded has the same hash");
  if (second != NULL) sunder_step(second, NULL);
  sunder_step(engine, NULL);
  check(second != NULL && hash_of(second) == hash_of(engine), "and goes on to the same state");
  sunder_destroy(second);
  check(sunder_restore("no state", 8) == NULL, "other bytes are no state");
  sunder_destroy(engine);
}

static void findings(void) {
  const uint32_t good[] = {0, 1, 2, 3, 1, 2, 3, 4}, bad[] = {0, 1, 2, 77, 1, 2, 3, 3};
  sunder_engine* engine = engine_of_arrays(good, 2);
  sunder_finding finding;
  sunder_span span;
  uint32_t i;
  int row = 0, repeated = 0;
  check(engine != NULL, "a body of arrays");
  check(engine != NULL && sunder_read(engine, SUNDER_POSITION, &span) == SUNDER_OK && span.size == 5 * 12,
        "it has its five points");
  check(engine != NULL && sunder_read(engine, 999, &span) == SUNDER_REFUSED && sunder_finding_count(engine) == 1,
        "an unknown column is refused with a finding");
  sunder_destroy(engine);
  check(engine_of_arrays(bad, 2) == NULL, "rows that do not exist are refused");
  memset(&finding, 0, sizeof finding);
  finding.size = sizeof finding;
  for (i = 0; i < sunder_finding_count(NULL); ++i) {
    check(sunder_get_finding(NULL, i, &finding) == SUNDER_OK, "a finding");
    if (strcmp(finding.code, "index_out_of_range") == 0) {
      row = finding.severity == 2 && finding.count == 1 && finding.id_count == 1 && finding.ids[0] == 0 &&
            strlen(finding.remedy) > 0;
    }
    if (strcmp(finding.code, "repeated_vertex") == 0) repeated = finding.ids[0] == 1;
  }
  check(row && repeated, "both faults are named with their tetrahedra");
  check(sunder_get_finding(NULL, i, &finding) == SUNDER_REFUSED, "and there is no further one");
}

/* What a host that was compiled with the first header hands over. */
static void older_versions(const char* path) {
  struct {
    sunder_scene scene;
    unsigned char after[64];
  } old;
  sunder_report report;
  sunder_engine* engine;
  memset(&old, 0xff, sizeof old);
  old.scene = scene_of("{\"bodies\": []}");
  memset((char*)&old.scene + offsetof(sunder_scene, reserved), 0xff, sizeof(sunder_scene) - offsetof(sunder_scene, reserved));
  old.scene.size = offsetof(sunder_scene, reserved);
  check(sunder_create(&old.scene) == NULL && strstr(sunder_error(NULL), "bad_size") == NULL,
        "a scene of the first version is read, and what follows it is not");
  old.scene.size = 8;
  check(sunder_create(&old.scene) == NULL && strstr(sunder_error(NULL), "bad_size") != NULL, "a smaller one is refused");
  engine = sunder_open(path, NULL, 0);
  check(engine != NULL, "a scene file with its meshes");
  if (engine == NULL) return;
  memset(&report, 0xab, sizeof report);
  report.size = offsetof(sunder_report, pieces);
  sunder_last_report(engine, &report);
  check(report.size == offsetof(sunder_report, pieces) && report.step == 0 && report.pieces == 0xabababab,
        "a report of an older version is filled as far as it goes");
  sunder_destroy(engine);
  check(sunder_open("nowhere.json", NULL, 0) == NULL && strstr(sunder_error(NULL), "cannot_open") != NULL,
        "a file that is not there is named");
}

int main(int count, char** arguments) {
  if (count != 2) return 2;
  check(sunder_abi() == SUNDER_ABI, "library and header are of one version");
  steps_and_states();
  findings();
  older_versions(arguments[1]);
  return failures > 0;
}
