#!/bin/sh
# SPDX-License-Identifier: MIT
# Makes the reference charts of docs/lab/charts.md again: docs/lab/charts/make.sh [PROGRAM] [NAME...]
# in the root of the repository; a quarter of an hour of an idle machine, six minutes of it the bunny's.
set -e
program=${1:-build/release/sunder}
[ $# -gt 0 ] && shift
wanted=${*:-bar rod flight monolith bunny}
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

# NAME SCENE QUANTITY OPTIONS...: the chart as docs/lab/charts/NAME.png and NAME.csv.
chart() {
  name=$1 scene=$2 quantity=$3
  shift 3
  case " $wanted " in *" $name "*) ;; *) return 0 ;; esac
  echo "== $name"
  "$program" chart "$scene" --quantity "$quantity" --quiet --out "$out" "$@" || [ $? -eq 1 ]
  mv "$out/$quantity.png" "docs/lab/charts/$name.png"
  mv "$out/$quantity.csv" "docs/lab/charts/$name.csv"
}

scenes=meshes/scenes
chart bar $scenes/charts/bar.json peak_stress --exact 4.5e6 --within 0.1 --levels 0 \
  --steps 4.525483e-3,1.131371e-3,2.828427e-4,7.071068e-5,3.535534e-5,1.767767e-5,5.656854e-6
chart rod $scenes/charts/rod.json end_stress --exact 7.5e5 --steps 0.016,4e-3,1e-3,2.5e-4,6.25e-5 --limit 10
chart flight $scenes/charts/flight.json position --levels 0
chart monolith $scenes/paper/monolith.json first_fan_time --within 0.002 --levels 0 \
  --set duration=0.06 --set time_step=1e-3 --steps 4e-3,1e-3,2.5e-4,6.25e-5
chart bunny $scenes/paper/bunny.json fans --within 0.15 --levels 0 --limit 30 \
  --set duration=0.028 --set impact.negligible=0.1 --steps 8e-4,2e-4,5e-5
