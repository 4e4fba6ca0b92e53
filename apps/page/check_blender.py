# SPDX-License-Identifier: MIT
"""Imports a GLB of `sunder export` into Blender without a display, counts, measures and draws.

    blender --background --python apps/page/check_blender.py -- FILE.glb PICTURE.png FRAGMENTS.csv

Holds the pieces against those of fragments.csv of the run: all there, animated, with their mass. Exit code 1
where something is wrong.
"""
import csv
import math
import sys

import bpy
import mathutils
import numpy

# Debian 12's Blender reads glTF with a name that its NumPy has dropped.
if not hasattr(numpy, "bool"):
    numpy.bool = bool


def fail(text):
    print("check_blender:", text)
    sys.exit(1)


def main():
    glb, picture, table = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=glb)
    pieces = [o for o in bpy.data.objects if o.type == "MESH" and o.name.startswith("piece_")]
    with open(table, newline="", encoding="utf-8") as rows:
        expected = {row["component"] for row in csv.DictReader(rows)}
    found = {o.name.split("_")[1] for o in pieces}
    if found != expected:
        fail(f"{len(found)} pieces, expected {len(expected)}")
    if not all(o.animation_data and o.animation_data.action for o in pieces):
        fail("a piece is not animated")
    if not all("mass" in o for o in pieces):
        fail("a piece has no mass")
    scene = bpy.context.scene
    end = max(a.frame_range[1] for a in bpy.data.actions)
    scene.frame_set(int(end), subframe=end % 1)
    low, high = mathutils.Vector((math.inf,) * 3), mathutils.Vector((-math.inf,) * 3)
    for o in pieces:
        for corner in o.bound_box:
            x = o.matrix_world @ mathutils.Vector(corner)
            low, high = (mathutils.Vector(map(f, w, x)) for f, w in ((min, low), (max, high)))
    middle, size = (low + high) / 2, (high - low).length
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = middle + mathutils.Vector((0.95, -1.75, 1.1)) * size
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 3
    sun.rotation_euler = (0.6, 0.2, 0.4)
    for o in (camera, sun):
        scene.collection.objects.link(o)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("world")
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 16
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = 640, 400
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)
    print(f"check_blender: {len(pieces)} pieces, {len(bpy.data.objects)} objects, {end:.2f} frames")


if __name__ == "__main__":
    main()
