#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs scenes and tools on both kernels of the map, rows alone (dense) and CGAL's darts (lcc), and
compares their output, byte by byte.

    tests/experiments/both_kernels.py [build/release/sunder] [--quick] [--csv FILE] [--plot FILE.png]

With --csv and --plot but no program it draws the table (Debian's python3-matplotlib).

Scenes: bar, block, monolith, bunny (--quick: the first steps of each): every file of a run but
report.json, which holds wall times. Tools: split, refine, cut on the bunny and on the bunny refined
twice (--quick: on the bunny alone), static and modes of a scene: files, tables and exit codes.
A line per case: processor seconds and peak memory on each kernel. The exit code is 1 when a byte
differs."""
import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from same_bytes import SHORT, digests

KERNELS = ["dense", "lcc"]
TREE = pathlib.Path(__file__).resolve().parents[2]


def measured(words, out):
    """Runs a command in `out`, keeps its standard output there; processor seconds and peak MB."""
    out.mkdir(parents=True)
    with open(out / "printed", "wb") as printed, open(out / "errors", "wb") as errors:
        child = subprocess.Popen(list(map(str, words)), stdout=printed, stderr=errors, cwd=out)
        _, status, usage = os.wait4(child.pid, 0)
    (out / "exit_code").write_text(str(os.waitstatus_to_exitcode(status)))
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def cases(program, work, quick):
    """Name, and the words of the command on a kernel."""
    for name, short in SHORT.items():
        scene = TREE / "meshes/scenes" / f"{name}.json"
        words = ["--set", f"duration={short}"] if quick else []
        yield f"run {name}", lambda kernel, scene=scene, words=words: [
            program, "run", scene, "-o", "out", "--quiet", "--frames", 2,
            "--set", f"topology.kernel={kernel}", *words]
    bar = TREE / "meshes/scenes/bar.json"
    for tool in ("static", "modes"):
        yield f"{tool} bar", lambda kernel, tool=tool: [
            program, tool, bar, "--set", f"topology.kernel={kernel}", "--json"]
    meshes = {"bunny": TREE / "meshes/bunny.msh"}
    if not quick:
        meshes["bunny x 64"] = work / "fine.msh"
        subprocess.run([program, "refine", meshes["bunny"], work / "fine.msh", "--levels", "2"],
                       check=True, capture_output=True)
    for body, mesh in meshes.items():
        plane = ["--plane", "0.3,1,0.2,0.02"]
        tools = {"split": ["split", mesh, *plane, "-o", "halves.vtu", "--json"],
                 "refine": ["refine", mesh, "finer.msh", *plane, "--within", "0.01", "--json"],
                 "cut": ["cut", mesh, "cut.msh", *plane, "--exact", "--json"]}
        for tool, words in tools.items():
            yield f"{tool} {body}", lambda kernel, words=words: [program, *words, "--kernel", kernel]


def plot(table, path):
    """The cost of CGAL's darts over that of rows alone: a bar per case of half a second or more."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    with open(table) as file:
        rows = [r for r in csv.DictReader(file) if float(r["dense_s"]) >= 0.5][::-1]
    pyplot.rcParams.update({"font.size": 12})
    picture, panels = pyplot.subplots(1, 2, figsize=(10, 4), sharey=True)
    for axes, unit, title, color in zip(panels, ("s", "MB"), ("processor time", "peak memory"), ("#0072b2", "#d55e00")):
        ratios = [float(r[f"lcc_{unit}"]) / float(r[f"dense_{unit}"]) for r in rows]
        axes.barh([r["case"] for r in rows], ratios, color=color)
        for k, (row, ratio) in enumerate(zip(rows, ratios)):
            axes.text(ratio + 0.08, k, f"{ratio:.1f}  ({float(row[f'dense_{unit}']):.3g} {unit} in dense)", va="center",
                      fontsize=10)
        axes.axvline(1, color="#333333", lw=1)
        axes.set_xlim(0, 7)
        axes.set_xlabel(f"{title}, kernel lcc over kernel dense")
        axes.spines[["top", "right"]].set_visible(False)
    picture.suptitle("Runs cost the same on both kernels; mesh tools are two to four times cheaper on dense", fontsize=13)
    picture.tight_layout()
    picture.savefig(path, dpi=100, metadata={"Software": None})


def main():
    words = argparse.ArgumentParser(description=__doc__,
                                    formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("program", type=pathlib.Path, nargs="?")
    words.add_argument("--quick", action="store_true")
    words.add_argument("--csv", type=pathlib.Path)
    words.add_argument("--plot", type=pathlib.Path)
    said = words.parse_args()
    if not said.program:  # draws the figures of an earlier run
        plot(said.csv, said.plot)
        return 0
    differing, rows = 0, []
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        for name, words_on in cases(said.program.resolve(), work, said.quick):
            figures, files = [], []
            for kernel in KERNELS:
                out = work / name.replace(" ", "-") / kernel
                figures.append(measured(words_on(kernel), out))
                if name.startswith("run"):
                    (out / "printed").unlink()  # has wall times
                files.append(digests(out))
            code = (out / "exit_code").read_text()
            changed = sorted(k for k in files[0] | files[1] if files[0].get(k) != files[1].get(k))
            differing += bool(changed)
            rows.append((name, *figures))
            (a, memory_a), (b, memory_b) = figures
            print(f"{name:18} exit {code}  dense {a:8.2f} s {memory_a:7.0f} MB   lcc {b:8.2f} s "
                  f"{memory_b:7.0f} MB   {b / max(a, 1e-3):5.2f} x   "
                  + (f"DIFFER: {' '.join(changed)}" if changed else f"{len(files[0])} files the same"),
                  flush=True)
    if said.csv:
        said.csv.write_text("case,dense_s,dense_MB,lcc_s,lcc_MB\n" + "".join(
            f"{n},{a[0]:.3f},{a[1]:.1f},{b[0]:.3f},{b[1]:.1f}\n" for n, a, b in rows))
        if said.plot:
            plot(said.csv, said.plot)
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
