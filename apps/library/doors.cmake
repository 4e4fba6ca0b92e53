# SPDX-License-Identifier: MIT
# The public headers <sunder/NAME.hpp>, and the headers of the tree that each is made of, in the order in which they need
# each other. (version.hpp is made from version.hpp.in.) A host needs Eigen for them and nothing else, but for cgal_map.

door(finding "Findings about an input, results that carry them, and the exception for mistakes of a caller."
  topology/base/finding.hpp
  topology/base/misuse.hpp)

door(mesh "Tetrahedral meshes: cells, simple solids, files in and out, checks."
  topology/base/ids.hpp
  topology/base/tet_mesh.hpp
  topology/mesh/solids/solids.hpp
  topology/mesh/kinds/cell_kinds.hpp
  topology/mesh/file_mesh.hpp
  topology/io/read_options.hpp
  topology/io/mesh_file.hpp
  topology/kernel/counts.hpp
  topology/mesh/check.hpp)

door(map "The 3-map of a body: splitting and gluing faces, fans, components, invariants."
  topology/base/cell_change.hpp
  topology/kernel/kernel.hpp
  topology/kernel/dense_map.hpp
  topology/kernel/volume_map.hpp
  topology/mesh/build_map.hpp
  topology/kernel/split_face.hpp
  topology/kernel/plane_side.hpp
  topology/kernel/fan.hpp
  topology/kernel/components.hpp
  topology/kernel/invariants.hpp
  topology/kernel/edges.hpp
  topology/kernel/edge_nodes.hpp
  topology/kernel/map_mesh.hpp)

door(cells "Operations that change cells: division of edges, red refinement, exact plane cuts, a journal for undo."
  topology/cells/subdivide.hpp
  topology/cells/refine.hpp
  topology/cells/plane_cut.hpp
  topology/cells/columns.hpp
  topology/cells/journal.hpp)

door(mechanics "Materials, obstacles, and settings of integration, contact and impacts."
  mechanics/state/vec3.hpp
  mechanics/state/impulse.hpp
  topology/base/counters.hpp
  mechanics/state/settings/material.hpp
  mechanics/state/pose.hpp
  mechanics/contact/shapes/obstacle.hpp
  mechanics/contact/shapes/solid_surface.hpp
  mechanics/contact/settings/contact_settings.hpp
  mechanics/contact/settings/impact_settings.hpp
  mechanics/contact/contact_report.hpp
  mechanics/state/settings/settings.hpp
  mechanics/state/step_status.hpp
  mechanics/state/rung.hpp)

door(simulation "Scenes: building, stepping, saving and loading them, and the report of a step."
  fracture/strength/body_settings.hpp
  fracture/algorithms/fracture_settings.hpp
  fracture/scene/ladder_settings.hpp
  fracture/scene/scene.hpp
  fracture/scene/choose_settings.hpp
  mechanics/ties/crack_id.hpp
  mechanics/ties/tie.hpp
  fracture/cracks/crack_label.hpp
  fracture/algorithms/fan_event.hpp
  fracture/algorithms/fracture_report.hpp
  fracture/ties/tie_release.hpp
  fracture/energy/settled_crack.hpp
  fracture/simulation/step_report.hpp
  topology/base/owned.hpp
  fracture/simulation/simulation.hpp
  fracture/saving/saved_state.hpp)

door(actions "Bodies added and removed while a simulation runs; balls, pulls and cuts; poses of pieces, contacts."
  fracture/simulation/changes/bodies.hpp
  fracture/simulation/changes/actions.hpp
  fracture/simulation/queries/poses.hpp)

door(rows "For researchers: the map and the columns of a running simulation, and face splits by a law of one's own."
  fracture/simulation/rows.hpp)

door(scene "Scene files in JSON. Every key is checked."
  apps/scene/output_settings.hpp
  apps/scene/scene_json.hpp)

door(fragments "Pieces: mass, motion, inertia, surface, crack faces; tables of them."
  apps/output/fragment.hpp
  apps/output/tables.hpp)

door(frames "VTU frames of a simulation for viewers, and their list."
  topology/io/vtu/vtu.hpp
  apps/output/frame.hpp)

door(statics "Equilibrium of a scene's bodies, and their natural modes."
  fracture/simulation/statics/statics.hpp)

door(cgal_map "For researchers: CGAL's combinatorial map behind a VolumeMap. It needs CGAL, and 12 s per source to compile."
  topology/kernel/dart_map.hpp)
