#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The contact patch test in motion: two blocks of 0.2 m are pressed on a floor, nu = 0, so that the stress is the pressure
everywhere, whatever the friction.

    tests/experiments/bending/pressed_blocks.py SUNDER

A row for the orders of lower and upper block and a friction: the largest error of the stress at
corners over the pressure, 0.2 s after the load began to rise (for 0.05 s), for blocks with matching
faces, and for blocks with other diagonals in their squares. Needs python3-meshio."""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import meshio
import numpy

from order_tools import grid, write_mesh

CONCRETE = {"young_modulus": 3e10, "poisson_ratio": 0, "density": 2400}
PRESSURE = 1e5


def worst(sunder, folder, orders, friction, layers):
    """Blocks of orders (lower, upper) and `layers` cells up: diagonals alternate from layer to layer, so that faces match where it is odd."""
    points, cells = grid((2, 2, layers), lambda u, v, w: (0.2 * u, 0.2 * v, 0.2 * w))
    write_mesh(folder / "block.mesh", points, cells)
    lower, upper = ({"mesh": "block.mesh", "order": order, "material": CONCRETE} for order in orders)
    load = {"minimum": [-1, -1, 0.2 - 1e-6], "maximum": [9, 9, 9], "pressure": PRESSURE, "ramp_time": 0.05}
    scene = {"time_step": 1e-3, "duration": 0.2, "gravity": {"acceleration": [0, 0, 0]}, "fracture": {"mode": "off"},
             "bodies": [lower, dict(upper, translation=[0, 0, 0.2], loads=[load])],
             "obstacles": [{"plane": {"normal": [0, 0, 1]}, "friction": friction}],
             "contact": {"friction": friction, "tolerance": 1e-9, "max_iterations": 2000}}
    (folder / "scene.json").write_text(json.dumps(scene))
    subprocess.run([sunder, "run", folder / "scene.json", "-o", folder / "out", "--force", "--quiet", "--frames", "2"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    frame = meshio.read(sorted((folder / "out/frames").glob("*.vtu"))[-1])
    along = frame.point_data["node_stress"].reshape(len(frame.points), -1)[:, 2]
    return numpy.abs(along[along != 0] / PRESSURE + 1).max()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sunder", type=Path)
    sunder = parser.parse_args().sunder.resolve()
    print("| orders | friction | faces match | other diagonals |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        for orders in ((1, 1), (2, 2), (1, 2), (2, 1)):
            for friction in (0, 0.5):
                errors = [worst(sunder, Path(name), orders, friction, layers) for layers in (1, 2)]
                print(f"| {orders[0]}, {orders[1]} | {friction} | {errors[0]:.2g} | {errors[1]:.2g} |", flush=True)


if __name__ == "__main__":
    main()
