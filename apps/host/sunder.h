/* SPDX-License-Identifier: MIT */
/* A simulation for hosts in any language: plain C99, one opaque handle, structs that carry their
   size (docs/howto/c.md). The page is one such host, through WebAssembly and through a server. */
#ifndef SUNDER_H
#define SUNDER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Version of this interface. It rises when a function or the meaning of a field changes. Fields
   added at the end of a struct do not raise it, because `size` shows which fields the caller knows.
 */
#define SUNDER_ABI 1

/** Marks the functions of the shared library. */
#if defined(__GNUC__)
#define SUNDER_API __attribute__((visibility("default")))
#else
#define SUNDER_API
#endif

/** Outcome of a call. Each value but SUNDER_OK is a failure, and sunder_get_finding has the
 * reasons.
 */
typedef enum sunder_result {
  SUNDER_OK = 0,
  SUNDER_REFUSED = 1,  /**< the request is impossible, and nothing has changed */
  SUNDER_FAILED = 2,   /**< the simulation has failed in this or an earlier step */
  SUNDER_NO_MEMORY = 3 /**< memory ran out; there are no findings */
} sunder_result;

/** A scene with its state and the actions on it. One thread at a time may use it. */
typedef struct sunder_engine sunder_engine;

/** A file in memory, under the name that the scene uses for it ("../bar.msh"). */
typedef struct sunder_file {
  const char* name;
  const void* bytes;
  size_t size;
} sunder_file;

/** A mesh of arrays, under the name that the scene uses for it. The arrays are copied. */
typedef struct sunder_mesh {
  uint32_t size;     /**< sizeof(sunder_mesh) */
  uint32_t reserved; /**< 0 */
  const char* name;
  const double* points; /**< 3 per point, m */
  size_t point_count;
  const uint32_t* tetrahedra; /**< 4 rows of points per tetrahedron, counted from 0 */
  size_t tetrahedron_count;
  const int32_t* regions; /**< one per tetrahedron, or null */
} sunder_mesh;

/** A scene in memory. Bodies and obstacles name files and meshes alike: {"mesh": "a"}. */
typedef struct sunder_scene {
  uint32_t size; /**< sizeof(sunder_scene) */
  uint32_t file_count;
  const char* text; /**< JSON (docs/reference/scene.md) */
  size_t text_size;
  const char* name; /**< of the scene's file, for messages */
  const sunder_file* files;
  const char* const* settings; /**< each "dotted.path=value", applied before reading */
  uint32_t setting_count;
  uint32_t reserved; /**< not read: the end of the first version may have padding here */
  const sunder_mesh* const* meshes;
  uint32_t mesh_count;
  uint32_t reserved2; /**< 0 */
} sunder_scene;

/** A fault or remark about an input. Texts are UTF-8 and never null. They are valid until the next
    call with the same engine, or the next creation of the thread. */
typedef struct sunder_finding {
  uint32_t size;      /**< sizeof(sunder_finding), set by the caller */
  uint32_t severity;  /**< 0: note, 1: warning, 2: error */
  const char* code;   /**< stable name, such as "flat_tetrahedron" */
  const char* text;   /**< the fault, its place and the expected value */
  const char* remedy; /**< the remedy */
  const char* file;   /**< empty without a file */
  uint64_t line;      /**< counted from 1; 0 without a line */
  uint64_t count;     /**< number of cells or places with this fault */
  const int64_t* ids; /**< the first of these, at most 16: rows from 0 */
  uint64_t id_count;
} sunder_finding;

/** Report of one step, and the state of the simulation after it. */
typedef struct sunder_report {
  uint32_t size;    /**< sizeof(sunder_report), set by the caller */
  uint32_t outcome; /**< 0: fine; 1: the simulation failed (sunder_error has the reason) */
  uint64_t step;    /**< number of steps since the start */
  double time;      /**< s, since the start */
  double time_step; /**< s */
  double duration;  /**< s, of the scene */
  /** Wall time of the stages mechanics, fracture, rebuild, display, ms. */
  double stage_ms[4];
  uint32_t pieces;
  uint32_t new_pieces;
  uint32_t fans;       /**< of this step */
  uint32_t parts;      /**< parts of the step; above 1 after an impact */
  uint32_t shape;      /**< rises with every change of faces, vertices or pieces */
  uint32_t contacts;   /**< with an impulse */
  uint64_t fans_total; /**< since the start */
  uint64_t tested;     /**< vertices tested (table 3 of the paper) */
  uint64_t suspects;   /**< vertices over Gershgorin's bound */
  uint64_t reached;    /**< vertices that reach their threshold */
  uint64_t predicted;  /**< faces with a piece predicted by the oracle (table 4) */
  uint64_t created;    /**< pieces that fans made */
  double kinetic;      /**< J, change over the step */
  double strain;       /**< J, change over the step */
  double cracks;       /**< J, work on ties over the step */
} sunder_report;

/** Columns of the state. A split appends rows and renumbers none. Former pieces have no faces. Rows
    of vertices and tetrahedra change in sunder_remove_body alone. */
typedef enum sunder_column {
  SUNDER_POSITION = 0, /**< float 3 per vertex: present position, m */
  SUNDER_REST = 1,     /**< float 3 per vertex: position in the body's mesh, m */
  SUNDER_PIECE = 2,    /**< uint32 per vertex: row of its piece */
  SUNDER_FACE = 3,     /**< uint32 3 per boundary face: vertices, counterclockwise from outside */
  SUNDER_FACE_IS_CRACK = 4, /**< uint32 per boundary face: 1 for a face of a crack or cut */
  /** float 8 per piece: drawn pose (section 3.3 of the paper) as centre, m, 0, and rotation as a
      quaternion x, y, z, w. A vertex is drawn at centre + R (rest - rest centre). */
  SUNDER_DRAWN_POSE = 5,
  SUNDER_POSE = 6,        /**< float 8 per piece: the same for its rigid reference */
  SUNDER_REST_CENTRE = 7, /**< float 4 per piece: rest centre, m, and mass, kg */
  SUNDER_STRESS = 8,      /**< float per vertex: largest principal stress, Pa */
  SUNDER_LOAD_RATIO = 9,  /**< float per vertex: that stress over its threshold */
  SUNDER_SPEED = 10,      /**< float per vertex: speed, m/s */
  SUNDER_BIRTH = 11,      /**< uint32 per piece: step in which it came off; 0: the start */
  SUNDER_BODY = 12,       /**< uint32 per piece: row of its body */
  /** double 16 per obstacle: kind (0 plane, 1 ball, 2 box, 3 mesh), normal and offset or centre and
      radius (4), half extents (3), rotation x, y, z, w (4), velocity, m/s (3), mass, kg, or 0.
      The corners of a mesh are at centre + rotation * corner (SUNDER_SOLID). */
  SUNDER_OBSTACLE = 13,
  SUNDER_HALF_FACE = 14,  /**< uint32 per boundary face: 4 times its tetrahedron, plus its place */
  SUNDER_PARENT = 15,     /**< uint32 per piece: the piece that it came off; 0xffffffff: none */
  SUNDER_TETRAHEDRA = 16, /**< uint32 per piece: number of tetrahedra */
  SUNDER_VELOCITY = 17,   /**< float 3 per piece: velocity of its mass centre, m/s */
  /** float 3 per vertex: as SUNDER_REST, with points on cracks moved near the crack's plane (the
      scene's output.crack_surface: smooth). Without planes it equals SUNDER_REST. m. */
  SUNDER_SMOOTH = 18,
  SUNDER_SOLID = 19, /**< float 10 per triangle of a mesh: row of its obstacle, its corners, m */
  /** float 8 per contact with an impulse, without resting rubble: place, m; duration of the part of
      the step with the impulse, s; impulse on the vertex, ball or corner there, N s; 0. */
  SUNDER_CONTACT = 20,
  /** uint32 2 per edge of a crack front, where a crack ends inside a body: its vertices. */
  SUNDER_CRACK_FRONT = 21,
  /** double 16 per fan of the last step, in order, after the cuts by hand since the previous step:
      number from 0 since the start (-1: a cut); time, s; vertex that broke; number of faces; number
      of faces with a piece predicted by the oracle; pieces made; the first of these or -1; stress
      and threshold, Pa; normal of the plane, and rest position, m, both in the rest frame (6);
      tetrahedra visited. Empty after sunder_restore until the next step. */
  SUNDER_FAN = 22,
  /** uint32 12 per face of those fans, in order: the half-face of the call and the opposite one;
      rows of its vertices before the split, in the order of darts (3); new rows of vertices that
      split, or 0xffffffff (3); bits of split edges, bit i for the edge from vertex i to the next;
      1 if the oracle predicts a piece; row of SUNDER_FAN; 0. For a face that another fan had split,
      all but the first are 0xffffffff or 0. */
  SUNDER_FAN_FACE = 23,
  /** double 6 per body: Young's modulus, Pa; Poisson's ratio; density, kg/m^3; strength, Pa;
      toughness, Pa sqrt(m); fracture energy, J/m^2. 0 for one of the last two that is not given. */
  SUNDER_MATERIAL = 24,
  SUNDER_COLUMNS = 25
} sunder_column;

/** Bytes of the engine, valid until its next call. */
typedef struct sunder_span {
  const void* bytes;
  size_t size;
} sunder_span;

typedef enum sunder_action_kind {
  SUNDER_SHOOT = 0,   /**< a free ball from `point` with `vector` m/s, `radius`, `mass` */
  SUNDER_PULL = 1,    /**< a spring from `vertex` to `point`, until SUNDER_RELEASE */
  SUNDER_RELEASE = 2, /**< the spring ends */
  SUNDER_CUT = 3 /**< parts all pieces by the plane through `point` with the normal `vector`, along
                      faces of the mesh */
} sunder_action_kind;

/** An action on the scene between two steps. World coordinates, SI units. */
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

/** A body that came or went, with all of its pieces, and its share of the sums of all bodies. */
typedef struct sunder_body_change {
  uint32_t size;              /**< sizeof(sunder_body_change), set by the caller */
  uint32_t body;              /**< its row, as in SUNDER_BODY */
  uint32_t pieces;            /**< number of its pieces */
  uint32_t first_piece;       /**< the lowest row of these */
  double mass;                /**< kg */
  double kinetic;             /**< J */
  double strain;              /**< J */
  double momentum[3];         /**< kg m/s */
  double angular_momentum[3]; /**< kg m^2/s, about the origin */
} sunder_body_change;

/** A vertex as the fracture search sees it. */
typedef struct sunder_vertex {
  uint32_t size; /**< sizeof(sunder_vertex), set by the caller */
  uint32_t piece;
  uint32_t tetrahedra; /**< of its star */
  uint32_t fan;        /**< faces that would split on the plane of its largest stress */
  double stress[6];    /**< Pa, frame of its piece: xx, yy, zz, xy, yz, xz */
  double principal[3]; /**< Pa, largest first */
  double direction[9]; /**< direction of each, unit length, world */
  double threshold;    /**< Pa; infinite where it cannot break */
  double gershgorin;   /**< Pa, the bound of eq. 7 */
  double position[3];  /**< m */
  double speed;        /**< m/s */
} sunder_vertex;

/* No function throws. Input structs of an older version are accepted by their size, and their
   missing fields count as 0. After SUNDER_NO_MEMORY in a step or an action every call fails in this
   way: destroy the engine. */

/** SUNDER_ABI of the library. */
SUNDER_API uint32_t sunder_abi(void);

/** Creates an engine with a scene at its start. Returns null for a scene with errors, and
    sunder_get_finding(null, ...) returns them. */
SUNDER_API sunder_engine* sunder_create(const sunder_scene* scene);

/** Creates the same from a scene file with the files that it names. `settings` is as in
    sunder_scene. Not in WebAssembly. */
SUNDER_API sunder_engine* sunder_open(const char* path, const char* const* settings,
                                      uint32_t setting_count);

/** Ends an engine and frees its memory. Null is allowed. */
SUNDER_API void sunder_destroy(sunder_engine* engine);

/** Takes one step of the scene's length. Returns a sunder_result. After SUNDER_FAILED the state can
    be read, and not advanced. `report` may be null. */
SUNDER_API int sunder_step(sunder_engine* engine, sunder_report* report);

/** Gives the report of the last step, or of the start. */
SUNDER_API void sunder_last_report(const sunder_engine* engine, sunder_report* report);

/** Gives the present bytes of one column, row after row. Returns a sunder_result. */
SUNDER_API int sunder_read(sunder_engine* engine, uint32_t column, sunder_span* span);

/** Gives the state of one vertex. Returns a sunder_result. */
SUNDER_API int sunder_inspect(sunder_engine* engine, uint32_t vertex, sunder_vertex* result);

/** Carries out an action. Returns a sunder_result. */
SUNDER_API int sunder_act(sunder_engine* engine, const sunder_action* action);

/** Adds a body between two steps. `body` is as in sunder_create, but its text is that of one body:
    {"mesh": "bar", "material": ...}. Places in findings and settings begin with "bodies.0". Rows of
    the body follow those that are there. `change` may be null. Returns a sunder_result. After
    SUNDER_OK the findings are warnings. */
SUNDER_API int sunder_add_body(sunder_engine* engine, const sunder_scene* body,
                               sunder_body_change* change);

/** Removes the body of that row with all of its pieces. Rows of pieces and bodies stay, and rows of
    vertices and tetrahedra close up. SUNDER_FAN is empty until the next step. `change` may be null.
    Returns a sunder_result. */
SUNDER_API int sunder_remove_body(sunder_engine* engine, uint32_t body, sunder_body_change* change);

/** Gives the whole simulation as bytes (docs/lab/saved_state.md), without the spring of a pull. The
    bytes are null if memory ran out. */
SUNDER_API void sunder_save(sunder_engine* engine, sunder_span* span);

/** Creates an engine from such bytes. Returns null for other bytes, and sunder_get_finding(null,
    ...) has the reason. */
SUNDER_API sunder_engine* sunder_restore(const void* bytes, size_t size);

/** Gives a number (FNV-1a, 64 bits) of the bytes of sunder_save. Equal simulations have equal
    numbers. Returns a sunder_result. O(state). */
SUNDER_API int sunder_hash(sunder_engine* engine, uint64_t* hash);

/** Returns the last errors as text with one per line, UTF-8, or an empty text. With null it returns
    those of the last creation of this thread. After a successful one it returns its warnings. */
SUNDER_API const char* sunder_error(const sunder_engine* engine);

/** Number of findings behind that text. */
SUNDER_API uint32_t sunder_finding_count(const sunder_engine* engine);

/** Gives one of these findings. Returns SUNDER_REFUSED for a row that does not exist. */
SUNDER_API int sunder_get_finding(const sunder_engine* engine, uint32_t row,
                                  sunder_finding* finding);

#ifdef __cplusplus
}
#endif

#endif
