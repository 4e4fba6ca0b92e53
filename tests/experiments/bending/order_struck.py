# SPDX-License-Identifier: MIT
"""Struck bodies of order_charts.py: when and where the first crack is, over meshes, by order."""
import json
import signal
import subprocess
import time

from order_tools import table, write_mesh
from second_order_runs import GLASS, struck_cases

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
    """Time and place of the first fan in 1 ms, sub-steps of L/c / 16, three meshes."""
    seen = {}
    cases = [(level, *case) for level in range(3) for case in struck_cases(level)]
    cases.sort(key=lambda case: "vase" in case[1])  # the longest runs last
    for level, name, mesh, scene, placed in cases:
        write_mesh(folder / "body.mesh", *mesh)
        for order in (1, 2):
            body = dict(mesh="body.mesh", order=order, material=GLASS, **placed)
            whole = dict(scene, bodies=[body], impact={"fraction": 0.0625}, duration=0.001)
            fan = run_to_first_fan(sunder, folder, whole)
            seen.setdefault(name, {}).setdefault(order, []).append(fan)
            shown = fan if not isinstance(fan, dict) else (round(1e6 * fan["time"]), [
                round(1e3 * x) for x in fan["rest_position"]])
            print(name, level, order, len(mesh[1]), shown, flush=True)
    return fan_table(seen), None
