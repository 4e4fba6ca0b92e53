#!/bin/sh
# SPDX-License-Identifier: MIT
# The paper's eight figures by sunder: docs/lab/figures/make.sh build/release/sunder [FOLDER]. Ten minutes.
# Pictures and drawings are written beside this script, or in FOLDER; runs below a folder that is removed.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
sunder=$(realpath "$1")
out=${2:-$here}
meshes=$here/../../../meshes
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

run() { # scene, name of the result, then settings
  scene=$1 name=$2
  shift 2
  "$sunder" run "$meshes/scenes/$scene.json" -o "$work/$name" --force --quiet "$@" >/dev/null 2>"$work/$name.txt" || {
    cat "$work/$name.txt"
    exit 1
  }
}
draw() { # result, picture, then options
  result=$1 picture=$2
  shift 2
  "$sunder" render "$work/$result" "$out/$picture.png" --size 720,480 "$@"
}

# Figures 1, 2, 7: the block sags on its supports, then breaks under its own weight.
run paper/block block --frame-interval 0.01 --set bodies.0.material.tensile_strength=6e3 --set fracture.crack=object
draw block figure_1 --show both --magnify 50 --time "$(python3 "$here/moment.py" "$work/block" first_fan -0.004)" --eye 0.5,-3.2,1.5 --target 0,0,0.65 --fov 32
for part in a:1.1 b:1.6; do
  draw block "figure_7${part%%:*}" --time "${part##*:}" --eye 0.9,-3.2,1.6 --target 0,0,0.45 --fov 34
done
python3 "$here/moment.py" "$work/block" jump

# Figure 6: two balls strike the monolith.
run paper/monolith monolith --frame-interval 0.01 --set fracture.crack=paper
for part in a:0.05 b:0.07 c:0.17 d:0.4; do
  draw monolith "figure_6${part%%:*}" --time "${part##*:}" --eye 2.2,-3.6,2.0 --target 0,0.15,0.8 --fov 36
done

# Figure 8: the bunny in pieces.
run paper/bunny bunny --set duration=0.05 --set fracture.crack=object --frame-interval 0.005
draw bunny figure_8 --time 0.05

# Figures 3 to 5: what comes apart with one face.
python3 "$here/splits.py" "$sunder" "$meshes" "$out"
