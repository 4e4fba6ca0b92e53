#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs each scene for a while, exports it as GLB and asks others about the file: Khronos' validator and three.js,
# TinyGLTF where it is installed, Blender where it is.
#   apps/page/check_exports.sh BUILD [FOLDER]        BUILD: build/release; FOLDER keeps runs, files and Blender's pictures
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$(realpath "$1")
out=${2:-$(mktemp -d)}
meshes=$here/../../meshes/scenes
check() { # scene's file, s
  name=$(basename "$1" .json)
  "$build/sunder" run "$1" -o "$out/$name" --force --quiet --frames 20 --set "duration=$2" --set output.frames_at_impacts=true >/dev/null 2>&1
  "$build/sunder" export "$out/$name" "$out/$name.glb"
  (cd "$here" && node check_glb.mjs "$out/$name.glb")
  if [ -x "$build/tests/apps/sunder_tinygltf" ]; then
    "$build/tests/apps/sunder_tinygltf" "$out/$name" "$out/$name.glb"
  fi
  if command -v blender >/dev/null; then
    blender --background --python-exit-code 1 --python "$here/check_blender.py" -- "$out/$name.glb" "$out/$name.png" \
      "$out/$name/fragments.csv" >"$out/$name.txt" 2>&1 || { cat "$out/$name.txt"; exit 1; }
    grep '^check_blender' "$out/$name.txt"
  fi
}
mkdir -p "$out"
out=$(realpath "$out")
check "$meshes/monolith.json" 0.1
check "$meshes/bar.json" 0.3
check "$meshes/block.json" 0.8
check "$here/scenes/plate.json" 0.03
check "$here/scenes/ring.json" 0.03
check "$meshes/bunny.json" 0.05
