# SPDX-License-Identifier: MIT
"""Shared by the parts of order_charts.py: programs timed by the processor's own clock, meshes,
tables."""
import json
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import meshio
import numpy

from second_order import EDGES, kuhn_cells

BIG = 1e3


WATCH = ("import resource, subprocess, sys; p = subprocess.run(sys.argv[1:], stderr=subprocess.DEVNULL); "
         "u = resource.getrusage(resource.RUSAGE_CHILDREN); "
         "print(u.ru_utime + u.ru_stime, u.ru_maxrss, p.returncode, file=sys.stderr)")


def timed(command, limit=None):
    """Output, seconds of the processor (user and system) and peak memory in MB of a program.

    Seconds of the processor, not of the wall: the time of other programs is left out.
    Exit codes 0 and 5 (a run that failed) pass; others, and more seconds than `limit`, raise."""
    words = [str(w) for w in command]
    if limit:
        words = ["prlimit", f"--cpu={int(limit)}", *words]
    # Through a small process: the peak of a child begins with that of the process that makes it.
    done = subprocess.run([sys.executable, "-c", WATCH, *words], capture_output=True, check=True)
    seconds, peak, code = done.stderr.split()
    if int(code) not in (0, 5):
        raise RuntimeError(f"{' '.join(words)} ended with {int(code)}")
    return done.stdout.decode(), float(seconds), int(peak) / 1024


def write_mesh(path, points, tetrahedra):
    meshio.write(path, meshio.Mesh(points, [("tetra", tetrahedra)]), file_format="medit")


def median_of(count, run):
    """The answer of the last of `count` runs of `run` and the median of their seconds."""
    seconds = []
    for _ in range(count):
        answer, second = run()
        seconds.append(second)
    return answer, statistics.median(seconds)


def solve_static(sunder, folder, scene, fields=True):
    """Answer of `sunder static`: JSON, and rest places, displacements, node stresses of all nodes; seconds."""
    (folder / "scene.json").write_text(json.dumps(scene))
    command = [sunder, "static", folder / "scene.json", "--json"]
    if fields:
        command += ["-o", folder / "out.vtu"]
    text, seconds, _ = timed(command)
    answer = json.loads(text)
    if fields:
        out = meshio.read(folder / "out.vtu")
        u = out.point_data["displacement"]
        answer["nodes"] = (out.points - u, u, out.point_data["node_stress"])
    return answer, seconds


def run_scene(sunder, folder, scene, options=(), limit=None):
    """Report of `sunder run`, its seconds and its peak memory."""
    (folder / "scene.json").write_text(json.dumps(scene))
    text, seconds, peak = timed([sunder, "run", folder / "scene.json", "-o", folder / "out", "--force", "--quiet",
                                 "--json", *options], limit)
    return json.loads(text), seconds, peak


def steps_for(cells):
    """So many steps that their time is well over the noise of a program's start."""
    return max(30, min(2000, 1000000 // cells))


def processor_seconds(pid):
    """Processor time of a process so far, s; None where it has ended."""
    try:
        return 1e-9 * int(Path(f"/proc/{pid}/schedstat").read_text().split()[0])
    except (FileNotFoundError, ProcessLookupError):
        return None


def middle_third(sunder, folder, scene, steps):
    """Seconds of the processor a step in the middle third of a run: between its frames, of which one is in it."""
    whole = dict(scene, duration=scene["time_step"] * steps)
    (folder / "scene.json").write_text(json.dumps(whole))
    shutil.rmtree(folder / "out", ignore_errors=True)
    process = subprocess.Popen([sunder, "run", folder / "scene.json", "-o", folder / "out", "--quiet", "--frames", "4"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seen = []
    while process.poll() is None and len(seen) < 2:
        if (folder / "out" / "frames" / f"frame_{len(seen) + 1:06}.vtu").exists():
            seen.append(processor_seconds(process.pid))
        time.sleep(0.005)
    process.kill()
    process.wait()
    if len(seen) < 2 or None in seen:
        raise RuntimeError("a run ended before its last third")
    return (seen[1] - seen[0]) / (steps / 3)


def step_seconds(sunder, folder, scene, steps, limit=None):
    """Seconds per step; of all else in the run, mostly the first step, which factors; peak memory.
    A step's seconds are the median step's by the wall where that is short against the slices in
    which the machine is shared, else its processor time."""
    whole = dict(scene, duration=scene["time_step"] * steps)
    report, seconds, peak = run_scene(sunder, folder, whole, ["--frames", "0"], limit)
    step = 1e-3 * report["step_ms"]["median"]
    if step >= 1e-3:
        step = middle_third(sunder, folder, scene, 3 * max(10, min(500, round(1 / step))))
    return step, seconds - steps * step, peak


def frames(folder):
    """Times and meshes of a run's frames."""
    text = (folder / "out" / "frames.pvd").read_text()
    found = []
    for line in text.splitlines():
        if 'file="' in line:
            time = float(line.split('timestep="')[1].split('"')[0])
            found.append((time, folder / "out" / line.split('file="')[1].split('"')[0]))
    return [(time, meshio.read(path)) for time, path in found]


def grid(cells, place):
    """Points and tetrahedra of a block of (nx, ny, nz) cells with corners put by `place(u, v, w)`,
    each from 0 to 1. Diagonals alternate."""
    nx, ny, nz = cells
    points = numpy.array([place(i / nx, j / ny, k / nz) for k in range(nz + 1) for j in range(ny + 1)
                          for i in range(nx + 1)])

    return points, kuhn_cells(cells, points)


def quadratic(points, tetrahedra):
    """Points and ten-node tetrahedra (corners, then the middles of EDGES) of straight cells."""
    middle, places, cells = {}, list(map(tuple, points)), []
    for t in tetrahedra:
        nodes = list(t)
        for i, j in EDGES:
            key = (min(t[i], t[j]), max(t[i], t[j]))
            if key not in middle:
                middle[key] = len(places)
                places.append(tuple(0.5 * (points[t[i]] + points[t[j]])))
            nodes.append(middle[key])
        cells.append(nodes)
    return numpy.array(places), numpy.array(cells)


def held_box(minimum, maximum, axes=None, velocity=None):
    """A held box; None stands for no bound."""
    box = {"minimum": [-BIG if m is None else m for m in minimum],
           "maximum": [BIG if m is None else m for m in maximum]}
    if axes:
        box["axes"] = list(axes)
    if velocity is not None:
        box["velocity"] = list(velocity)
    return box


def table(head, rows):
    """Lines of a Markdown table."""
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head),
            *("| " + " | ".join(row) + " |" for row in rows), ""]


def percent(value, exact):
    return f"{100 * (value / exact - 1):+.1f}"


def in_folder(action):
    """Calls `action(folder)` in a folder that is gone afterwards."""
    with tempfile.TemporaryDirectory() as folder:
        return action(Path(folder))
