# SPDX-License-Identifier: MIT
"""Struck bodies of order_charts.py: when and where the first crack is, over meshes, by order."""
import itertools
import json
import signal
import subprocess
import time

import numpy
from scipy.optimize import brentq

from order_tools import grid, run_scene, table, write_mesh
from thin_things import GLASS, struck_cases

MOST_SECONDS = 600  # of the processor, a run


def run_to_first_fan(sunder, folder, scene):
    """The first fan of a run (None: none until its end; "time": MOST_SECONDS were spent), which is then ended."""
    (folder / "scene.json").write_text(json.dumps(scene))
    log = folder / "out" / "events.jsonl"
    log.unlink(missing_ok=True)
    process = subprocess.Popen(["prlimit", f"--cpu={MOST_SECONDS}", str(sunder), "run", folder / "scene.json", "-o",
                                folder / "out", "--force", "--quiet", "--frames", "0"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    first = None
    while first is None:
        ended = process.poll() is not None
        if log.exists():
            for line in log.read_text().splitlines():
                if '"normal"' in line and line.endswith("}"):
                    first = json.loads(line)
                    break
        if ended:
            break
        time.sleep(0.05)
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
    elif first is None and process.returncode not in (0, 5):
        if process.returncode > 0:
            raise RuntimeError(f"a run ended with {process.returncode}")
        return "time"
    return first


def fan_table(seen):
    """Rows of a thing and an order: its first fans (or None, or "time") by mesh; `seen` has the lists."""
    rows = []
    for name, orders in seen.items():
        for order, fans in sorted(orders.items()):
            times, places, text = [], [], []
            for fan in fans:
                if isinstance(fan, dict):
                    times.append(1e6 * fan["time"])
                    places.append(fan["rest_position"])
                    text.append(f"{times[-1]:.0f} at ({', '.join(f'{1e3 * x:.0f}' for x in places[-1])})")
                else:
                    text.append("none" if fan is None else f"none in {MOST_SECONDS} s of computing")
            spread = f"{max(times) / min(times):.2f}" if len(times) > 1 else ""
            rows.append([name, str(order), *text, spread])
    return table(["struck", "order", *(f"mesh {k}: us at mm" for k in (1, 2, 3)), "latest / earliest"], rows)


def first_fans(sunder, folder, _):
    """Time and place of the first fan in 1 ms, three meshes."""
    seen = {}
    cases = [(level, *case) for level in range(3) for case in struck_cases(level)]
    cases.sort(key=lambda case: "vase" in case[1])  # the longest runs last
    for level, name, mesh, scene, placed in cases:
        write_mesh(folder / "body.mesh", *mesh)
        for order in (1, 2):
            body = dict(mesh="body.mesh", order=order, material=GLASS, **placed)
            whole = dict(scene, bodies=[body])
            fan = run_to_first_fan(sunder, folder, whole)
            seen.setdefault(name, {}).setdefault(order, []).append(fan)
            shown = fan if not isinstance(fan, dict) else (round(1e6 * fan["time"]), [
                round(1e3 * x) for x in fan["rest_position"]])
            print(name, level, order, len(mesh[1]), shown, flush=True)
    return fan_table(seen), None


def graded(side, least, cells):
    """Places of cells over a side: `least` m in its middle, each larger than the last by one ratio."""
    half = cells // 2
    ratio = brentq(lambda q: least * sum(q**k for k in range(half)) - side / 2, 1, 10)
    way = numpy.cumsum([least * ratio**k for k in range(half)])
    return numpy.concatenate([side / 2 - way[::-1], [side / 2], side / 2 + way])


def graded_fans(sunder, folder, _):
    """Time and place of the first fan of the pane with small cells under the ball."""
    rows = []
    meshes = ((0.012, 10, 1), (0.006, 14, 1), (0.004, 16, 1), (0.003, 16, 2))
    for (least, n, layers), order in itertools.product(meshes, (1, 2)):
        places = graded(0.3, least, n)
        points, cells = grid((n, n, layers), lambda u, v, w: (places[round(u * n)], places[round(v * n)], 0.006 * w))
        write_mesh(folder / "body.mesh", points, cells)
        row = [f"{1e3 * least:.0f}", str(layers), str(len(cells)), str(order)]
        for speed in (5, 10, 20):
            scene = {"time_step": 1e-4, "duration": 3e-4,
                     "bodies": [{"mesh": "body.mesh", "order": order, "material": GLASS}],
                     "obstacles": [{"sphere": {"center": [0.15, 0.15, -0.0201], "radius": 0.02},
                                    "velocity": [0, 0, speed], "mass": 0.26}]}
            fan = run_to_first_fan(sunder, folder, scene)
            row.append("none" if fan is None else f"none in {MOST_SECONDS} s of computing" if fan == "time" else
                       f"{1e6 * fan['time']:.1f} at ({', '.join(f'{1e3 * x:.0f}' for x in fan['rest_position'])})")
        rows.append(row)
        print(*row, flush=True)
    return table(["least cell, mm", "layers", "cells", "order", *(f"{v} m/s: us at mm" for v in (5, 10, 20))], rows), None


def broken(sunder, folder, _):
    """Pieces after 1 ms, cracks as objects, three meshes."""
    seen = {}
    for level in range(3):
        for name, mesh, scene, placed in struck_cases(level):
            write_mesh(folder / "body.mesh", *mesh)
            for order in (1, 2):
                body = dict(mesh="body.mesh", order=order, material=GLASS, **placed)
                whole = dict(scene, bodies=[body], fracture={"crack": "object"})
                report, seconds, _ = run_scene(sunder, folder, whole, ["--frames", "2"])
                pieces = numpy.loadtxt(folder / "out" / "fragments.csv", delimiter=",", skiprows=1, usecols=(2, 4),
                                       ndmin=2)
                row = [len(mesh[1]), len(pieces), f"{pieces[:, 1].max() / pieces[:, 1].sum():.2f}",
                       sum(pieces[:, 0] == 1), f"{seconds:.0f}", {w["code"] for w in report["warnings"]}]
                seen.setdefault((name, order), []).append(row)
                print(name, order, *row, flush=True)
    rows = []
    for (name, order), runs in seen.items():
        *columns, told = zip(*runs)
        rows.append([name, str(order), *(", ".join(map(str, column)) for column in columns),
                     ", ".join(sorted(set().union(*told)))])
    return table(["struck", "order", "cells, by mesh", "pieces", "largest, of the mass", "single cells", "s",
                  "warnings"], rows), None
