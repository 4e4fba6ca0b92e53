/* SPDX-License-Identifier: MIT */
/* A scene in motion for hosts in any language: plain C, one opaque handle, structs that say their
   size. The page (docs/howto/embed.md) is one such host, through WebAssembly and through a server. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Raised when a function or the meaning of a field changes; fields that are added at the end of a
    struct do not raise it: `size` tells which fields the caller knows. */
#define SUNDER_ABI 1

/** A scene, its state, and what was done to it from outside. Not for two threads at once. */
typedef struct sunder_engine sunder_engine;

/** A file in memory, under the name by which the scene calls it ("../bar.msh"). */
typedef struct sunder_file {
  const char* name;
  const void* bytes;
  size_t size;
} sunder_file;

/** A scene in memory. */
typedef struct sunder_scene {
  uint32_t size; /**< sizeof(sunder_scene) */
  uint32_t file_count;
  const char* text; /**< JSON, as docs/reference/scene.md has it */
  size_t text_size;
  const char* name; /**< of the scene's file, for messages */
  const sunder_file* files;
  const char* const* settings; /**< each "dotted.path=value", applied on the text first */
  uint32_t setting_count;
} sunder_scene;

/** What one step did, and where the simulation is after it. */
typedef struct sunder_report {
  uint32_t size;    /**< sizeof(sunder_report), set by the caller */
  uint32_t outcome; /**< 0: go on; 1: the simulation failed (sunder_error says how) */
  uint64_t step;    /**< taken since the start */
  double time;      /**< s, since the start */
  double time_step; /**< s */
  double duration;  /**< s, of the scene */
  /** Wall time of the stages mechanics, fracture, rebuild, display, ms. */
  double stage_ms[4];
  uint32_t pieces;
  uint32_t new_pieces;
  uint32_t fans;       /**< of this step */
  uint32_t parts;      /**< of the step; above 1 where something was struck */
  uint32_t shape;      /**< raised whenever faces, vertices or pieces are others than before */
  uint32_t contacts;   /**< with an impulse */
  uint64_t fans_total; /**< since the start */
  uint64_t tested;     /**< vertices: table 3 of the paper, */
  uint64_t suspects;   /**< those that Gershgorin's bound let through, */
  uint64_t reached;    /**< and those that reach their threshold */
  uint64_t predicted;  /**< faces after which the oracle predicts new pieces: table 4, */
  uint64_t created;    /**< and pieces that fans made */
  double kinetic;      /**< J, change over the step */
  double strain;       /**< J, change over the step */
  double cracks;       /**< J, taken by ties */
} sunder_report;

/** Columns of the state. Rows of vertices, tetrahedra and pieces are never renumbered; a split
    appends rows. Pieces that are no more have no faces. */
typedef enum sunder_column {
  SUNDER_POSITION = 0,     /**< float 3, a vertex: where it is, m */
  SUNDER_REST = 1,         /**< float 3, a vertex: in its body's mesh, m */
  SUNDER_PIECE = 2,        /**< uint32, a vertex */
  SUNDER_FACE = 3,         /**< uint32 3, a boundary face: vertices, counterclockwise from outside */
  SUNDER_FACE_IS_CRACK = 4, /**< uint32, a boundary face: 1 where a crack or a cut made it */
  /** float 8, a piece: the pose at which it is drawn (section 3.3), its centre, m, 0, its rotation
      as a quaternion x, y, z, w. A vertex is drawn at centre + R (rest - rest centre). */
  SUNDER_DRAWN_POSE = 5,
  SUNDER_POSE = 6,        /**< float 8, a piece: the same of its rigid reference */
  SUNDER_REST_CENTRE = 7, /**< float 4, a piece: m, and its mass, kg */
  SUNDER_STRESS = 8,      /**< float, a vertex: largest principal stress, Pa */
  SUNDER_LOAD_RATIO = 9,  /**< float, a vertex: that over its threshold */
  SUNDER_SPEED = 10,      /**< float, a vertex: m/s */
  SUNDER_BIRTH = 11,      /**< uint32, a piece: the step in which it came off; 0: the start */
  SUNDER_BODY = 12,       /**< uint32, a piece: row of its body */
  /** double 16, an obstacle: kind (0 plane, 1 ball, 2 box, 3 mesh), normal and offset or centre and
      radius (4), half extents (3), rotation x, y, z, w (4), velocity (3), mass or 0. Of a mesh its
      corners are at centre + rotation * corner (SUNDER_SOLID). */
  SUNDER_OBSTACLE = 13,
  SUNDER_HALF_FACE = 14, /**< uint32, a boundary face: 4 times its tetrahedron, plus its place */
  SUNDER_PARENT = 15, /**< uint32, a piece: the one it came off; 0xffffffff: there at the start */
  SUNDER_TETRAHEDRA = 16, /**< uint32, a piece: how many it has */
  SUNDER_VELOCITY = 17,   /**< float 3, a piece: of its mass centre, m/s */
  /** float 3, a vertex: as SUNDER_REST, with the points on cracks near the planes of those (the
      scene's output.crack_surface: smooth); as SUNDER_REST where cracks have no planes. */
  SUNDER_SMOOTH = 18,
  SUNDER_SOLID = 19, /**< float 10, a triangle of a mesh: row of its obstacle, its corners, m */
  /** float 8, a contact with an impulse, among resting rubble none: its place, m, the length of the
      part of the step that it had the impulse in, s, the impulse on the vertex, ball or corner
      there, N s, 0. */
  SUNDER_CONTACT = 20,
  /** uint32 2, an edge of a crack front, where a crack ends inside a body: its vertices. */
  SUNDER_CRACK_FRONT = 21,
  /** double 16, a fan of the last step, in order, and before them the cuts by hand since the step
      before: number from 0 since the start (-1: a cut), time, s, the vertex that broke, how many
      faces, after how many of them the oracle predicted a piece, pieces made, the first of them or
      -1, stress and threshold, Pa, normal of the plane and rest position, m, both rest frame (6),
      tetrahedra visited. Empty after sunder_restore until the next step. */
  SUNDER_FAN = 22,
  /** uint32 12, a face of those fans in order: the half-face passed and the one opposite, rows of
      its vertices before, in the order of darts (3), the new rows of those that came apart or
      0xffffffff (3), bit i: the edge from vertex i to the next came apart; 1 where the oracle says
      that a piece may have come off, row of SUNDER_FAN, 0. All but the first 0xffffffff or 0 where
      another fan had split the face already. */
  SUNDER_FAN_FACE = 23,
  SUNDER_COLUMNS = 24
} sunder_column;

/** Bytes that belong to the engine: valid until its next call. */
typedef struct sunder_span {
  const void* bytes;
  size_t size;
} sunder_span;

typedef enum sunder_action_kind {
  SUNDER_SHOOT = 0,  /**< a free ball from `point` with `vector` m/s, `radius`, `mass` */
  SUNDER_PULL = 1,   /**< a spring from `vertex` to `point`, until it is released */
  SUNDER_RELEASE = 2, /**< the spring ends */
  SUNDER_CUT = 3 /**< parts all pieces by the plane through `point` with the normal `vector`, along
                      faces of the mesh */
} sunder_action_kind;

/** Something done to the scene from outside, between two steps. World coordinates, SI units. */
typedef struct sunder_action {
  uint32_t size; /**< sizeof(sunder_action) */
  uint32_t kind;
  uint32_t vertex;
  uint32_t reserved; /**< 0 */
  double point[3];
  double vector[3];
  double radius;
  double mass;
} sunder_action;

/** A vertex as the fracture search sees it. */
typedef struct sunder_vertex {
  uint32_t size; /**< sizeof(sunder_vertex), set by the caller */
  uint32_t piece;
  uint32_t tetrahedra; /**< of its star */
  uint32_t fan;        /**< faces that would part on the plane of its largest stress */
  double stress[6];    /**< Pa, frame of its piece: xx, yy, zz, xy, yz, xz */
  double principal[3]; /**< Pa, falling */
  double direction[9]; /**< of each of them, unit length, world */
  double threshold;    /**< Pa; infinite where it cannot break */
  double gershgorin;   /**< Pa, the bound of eq. 7 */
  double position[3];  /**< m */
  double speed;        /**< m/s */
} sunder_vertex;

/* No function throws. Where memory runs out it says 1 or null and sunder_error "out of memory"; out of a
   step or an action that ran out nothing comes any more but that: destroy the engine. */

/** SUNDER_ABI of the library. */
uint32_t sunder_abi(void);

/** A scene at its start; null where it has errors, which sunder_error(null) then tells. */
sunder_engine* sunder_create(const sunder_scene* scene);

void sunder_destroy(sunder_engine* engine);

/** One step of the scene's length. 0, or 1 where the simulation has failed, now or before: its
    state may be looked at and not be advanced. `report` may be null. */
int sunder_step(sunder_engine* engine, sunder_report* report);

/** The report of the last step, or of the start. */
void sunder_last_report(const sunder_engine* engine, sunder_report* report);

/** One column as it is now; its bytes are those of rows one after the other. 0, or 1 for a column
    that is not known. */
int sunder_read(sunder_engine* engine, uint32_t column, sunder_span* span);

/** One vertex. 0, or 1 where there is no such vertex. */
int sunder_inspect(sunder_engine* engine, uint32_t vertex, sunder_vertex* result);

/** Does what `action` says. 0, or 1 where it cannot be done, which sunder_error then tells. */
int sunder_act(sunder_engine* engine, const sunder_action* action);

/** The whole simulation as bytes (docs/lab/saved_state.md); a spring that pulls is not among them. None
    (null) where memory ran out. */
void sunder_save(sunder_engine* engine, sunder_span* span);

/** A simulation from such bytes; null where they are none, which sunder_error(null) then tells. */
sunder_engine* sunder_restore(const void* bytes, size_t size);

/** What was wrong last, a line each, UTF-8; empty when nothing was. Of create and restore: null.
    Warnings about a scene are told after a successful create. */
const char* sunder_error(const sunder_engine* engine);

#ifdef __cplusplus
}
#endif
