// SPDX-License-Identifier: MIT
// The keys of a scene file beside those of the scene itself (fracture/scene/scene_fields.hpp):
// what a run writes. The reader and the schema visit these descriptions.
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

template <class V>
void describe(V& v, CameraSettings& c) {
  v.field(Key{"eye", "m", "Where the camera stands", {}, true}, c.eye);
  v.field(Key{"target", "m", "What it looks at", {}, true}, c.target);
  v.field(Key{"field_of_view", "degrees", "Vertical opening angle", between(1, 170)},
          c.field_of_view);
}

template <class V>
void describe(V& v, PictureSettings& p) {
  v.field(Key{"count", "", "Pictures spread evenly over the run with its end; 0 draws none",
              between(0, 10000)},
          p.count);
  v.field(Key{"times", "s", "Further moments to draw", at_least(0)}, p.times);
  v.field(Key{"width", "pixels", "Width", between(16, 8192)}, p.width);
  v.field(Key{"height", "pixels", "Height", between(16, 8192)}, p.height);
  v.field(Key{"show", "",
              "reference: the rigid reference; deformed: the mesh itself; both: the deformed mesh "
              "as wires over the filled reference (figure 1)"},
          p.show);
  v.field(Key{"camera", "", "A fixed camera; absent: one that sees the start and the ground"},
          p.camera);
}

template <class V>
void describe(V& v, CheckpointSettings& c) {
  v.field(Key{"steps", "", "A checkpoint after every so many steps; 0: not by steps",
              between(0, 1000000000)},
          c.steps);
  v.field(Key{"minutes", "min",
              "A checkpoint after every so many minutes of computing; 0: not by time. With both 0 "
              "nothing is saved, else a last one at the end, for --until",
              at_least(0)},
          c.minutes);
  v.field(Key{"keep", "", "The latest so many stay; 0: all, for --from", between(0, 1000000)},
          c.keep);
}

template <class V>
void describe(V& v, OutputSettings& o) {
  v.field(Key{"frames", "", "VTU frames spread evenly over the run with start and end; 0: none",
              between(0, 1000000)},
          o.frames);
  v.field(Key{"frame_interval", "s", "Time between frames; above 0 it is used instead of frames",
              at_least(0)},
          o.frame_interval);
  v.field(Key{"frames_at_impacts", "",
              "A frame more after each step in which a blow opens a window, no two within 1/240 s: "
              "films and exported tracks then turn where bodies are struck"},
          o.frames_at_impacts);
  v.field(
      Key{"crack_surface", "",
          "Where pictures show cracks. mesh: on the faces of the mesh; smooth: near the plane of "
          "each crack, as far as tetrahedra keep their shape; needs fracture.crack object or "
          "cohesive"},
      o.crack_surface);
  v.field(Key{"pictures", "", "Pictures drawn without a display"}, o.pictures);
  v.field(Key{"checkpoint", "", "What `sunder run --resume` goes on from"}, o.checkpoint);
}

template <class V>
void describe(V& v, SceneFile& s) {
  v.field(Key{"$schema", "", "The schema, for editors; not read"}, s.schema);
  v.field(Key{"name", "", "What reports call the scene"}, s.scene.name);
  v.field(Key{"description", "", "What happens and why the numbers are what they are"},
          s.description);
  v.field(
      Key{"accuracy", "",
          "Chooses keys that are left out (contact, impact, ladder, bodies[].order, model and "
          "integrator.method), from mesh, material and speeds: preview: fastest; good: what the "
          "charts recommend; reference: most accurate, for comparisons (docs/defaults.md)"},
      s.accuracy);
  describe(v, s.scene);
  v.field(Key{"output", "", "What a run writes"}, s.output);
}

}  // namespace sunder::fields
