// SPDX-License-Identifier: MIT
// The keys of a scene file besides those of the scene itself (fracture/scene/scene_fields.hpp):
// the output of a run. The reader and the schema visit these descriptions.
#pragma once

#include "apps/scene/output_settings.hpp"
#include "apps/scene/scene_json.hpp"
#include "fracture/scene/scene_fields.hpp"

namespace sunder::fields {

inline const Names<ShownShape>& names_of(ShownShape) {
  static const Names<ShownShape> names = {{ShownShape::reference, "reference"},
                                          {ShownShape::deformed, "deformed"},
                                          {ShownShape::both, "both"}};
  return names;
}

inline const Names<CrackSurface>& names_of(CrackSurface) {
  static const Names<CrackSurface> names = {{CrackSurface::mesh, "mesh"},
                                            {CrackSurface::smooth, "smooth"}};
  return names;
}

/// The key of a material that names one of `named_materials`. No member holds it.
inline Key material_name_key() {
  return {"name", "",
          "Name of a material of `sunder materials`: the other keys are then its own, unless they "
          "are given"};
}

template <class V>
void describe(V& v, CameraSettings& c) {
  v.field(Key{"eye", "m", "Position of the camera", {}, true}, c.eye);
  v.field(Key{"target", "m", "Point in the middle of the picture", {}, true}, c.target);
  v.field(Key{"field_of_view", "degrees", "Vertical opening angle", between(1, 170)},
          c.field_of_view);
}

template <class V>
void describe(V& v, PictureSettings& p) {
  v.field(Key{"count", "", "Number of pictures, spread evenly over the run with its end; 0: none",
              between(0, 10000)},
          p.count);
  v.field(Key{"times", "s", "Further moments to draw", at_least(0)}, p.times);
  v.field(Key{"width", "pixels", "Width", between(16, 8192)}, p.width);
  v.field(Key{"height", "pixels", "Height", between(16, 8192)}, p.height);
  v.field(Key{"show", "",
              "Shape to draw. reference: the rigid reference; deformed: the mesh itself; both: the "
              "deformed mesh as wires over the filled reference (figure 1)"},
          p.show);
  v.field(Key{"camera", "", "A fixed camera; left out: one that sees the start and the ground"},
          p.camera);
}

template <class V>
void describe(V& v, CheckpointSettings& c) {
  v.field(Key{"steps", "", "Steps between checkpoints; 0: not by steps", between(0, 1000000000)},
          c.steps);
  v.field(Key{"minutes", "min",
              "Minutes of computing between checkpoints; 0: not by time. With both 0 no checkpoint "
              "is written, else a last one at the end, for --until",
              at_least(0)},
          c.minutes);
  v.field(Key{"keep", "", "Number of latest checkpoints to keep; 0: all, for --from",
              between(0, 1000000)},
          c.keep);
}

template <class V>
void describe(V& v, OutputSettings& o) {
  v.field(Key{"frames", "",
              "Number of VTU frames, spread evenly over the run with start and end; 0: none",
              between(0, 1000000)},
          o.frames);
  v.field(
      Key{"frame_interval", "s", "Time between frames; above 0 it replaces frames", at_least(0)},
      o.frame_interval);
  v.field(Key{"frames_at_impacts", "",
              "Whether a frame is added after each step in which an impact window opens, no two "
              "within 1/240 s: films and exported tracks then have a key at each impact"},
          o.frames_at_impacts);
  v.field(Key{"history", "s",
              "Time between lines of history.csv; 0 or off: no such file. Left out: one line per "
              "step, or per several steps so that the run has at most 2 000 lines",
              at_least(0)},
          o.history);
  v.field(
      Key{"crack_surface", "",
          "Place of cracks in pictures. mesh: on the faces of the mesh; smooth: near the plane of "
          "each crack, as far as tetrahedra keep their shape; needs fracture.crack object or "
          "cohesive"},
      o.crack_surface);
  v.field(Key{"pictures", "", "Pictures drawn without a display"}, o.pictures);
  v.field(Key{"checkpoint", "", "Saved states, from which `sunder run --resume` continues"},
          o.checkpoint);
}

template <class V>
void describe(V& v, SceneFile& s) {
  v.field(Key{"$schema", "", "The schema, for editors; not read"}, s.schema);
  v.field(Key{"name", "", "Name of the scene in reports"}, s.scene.name);
  v.field(Key{"description", "", "Description for readers"}, s.description);
  v.field(Key{"accuracy", "",
              "Chooses keys that are left out (contact, impact, ladder, topology, bodies[].order, "
              "model "
              "and integrator.method), from mesh, material and speeds. preview: fastest; good: "
              "recommended; reference: most accurate, for comparisons (docs/howto/choose.md)"},
          s.accuracy);
  describe(v, s.scene);
  v.field(Key{"output", "", "Files of a run"}, s.output);
}

}  // namespace sunder::fields
