#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints the tables of docs/lab/defaults.md as CSV: docs/lab/charts/defaults.sh [PROGRAM], in the root.
set -e
program=${1:-build/release/sunder}
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

# QUANTITY SCENE OPTIONS...: key and value, step, cracks, value, error, ms/ms, end.
vary() {
  quantity=$1 scene=$2
  shift 2
  "$program" chart "meshes/scenes/$scene" --quantity "$quantity" --quiet --levels 0 --out "$out" \
    --method floating_frame "$@" >/dev/null || [ $? -eq 1 ]
  sed -n 2p "$out/$quantity.csv"
  grep -v '^#' "$out/$quantity.csv" | cut -d, -f2,4,10-12,15,18
}

for quantity in position peak_stress; do
  vary $quantity charts/cantilever.json --set gravity.ramp_time=0 --set duration=0.04 \
    --probe 1,0,0 --steps 1e-2,2e-3,5e-4,2.5e-4,1e-4,5e-5 \
    --vary integrator.rho_infinity=0,0.25,0.5
done
for values in impact.negligible=0.01,0.03,0.1,0.3,1 contact.tolerance=1e-2,1e-3,1e-4,1e-5,1e-6 \
  contact.max_iterations=5,10,20,40,200 contact.max_passes=1,2,3,5; do
  vary fans paper/monolith.json --set duration=0.06 --set time_step=1e-3 --steps 1e-3 --windows on \
    --set contact.max_iterations=1000 --set contact.max_passes=3 --vary $values
done
for values in impact.negligible=0.03,0.1,0.3,1 contact.max_iterations=10,40,200 \
  contact.max_passes=1,3 contact.tolerance=1e-3,1e-5; do
  vary fans paper/bunny.json --set duration=0.028 --set impact.negligible=0.1 --steps 8e-4 \
    --windows on --exact 2270 --limit 60 --vary $values
done
