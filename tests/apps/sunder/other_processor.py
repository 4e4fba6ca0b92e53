#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs scenes as this processor and as one without FMA and AVX2, and compares every byte.

    other_processor.py SUNDER [SCENES]

glibc chooses its functions by the processor; GLIBC_TUNABLES forbids it the newer instructions.
Compared are events, frames and the table of fragments. Exit codes: 0 the same bytes, 1 a difference
(the file is named), 77 skipped: glibc or this processor has no choice to take away."""
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

OLDER = "glibc.cpu.hwcaps=-AVX512F,-AVX2,-AVX2_Usable,-FMA,-FMA_Usable,-FMA4,-FMA4_Usable"
# The runs: the paper's mode, crack objects under impact, bonds, rubble, order 2.
RUNS = [
    ("charts/monolith.json", ["duration=0.05", "fracture.crack=paper"]),
    ("charts/monolith.json", ["duration=0.04"]),
    ("charts/monolith.json", ["duration=0.02", "fracture.crack=cohesive",
                              "bodies.0.material.fracture_energy=100"]),
    ("charts/monolith.json", ["duration=0.2", "fracture.crack=paper", "ladder.rubble=certified"]),
    ("bar.json", ["duration=0.3", "output.crack_surface=smooth"]),
]


def has_choice():
    """Whether this machine has instructions to take away, and a glibc that can."""
    if platform.libc_ver()[0] != "glibc":
        return False
    try:
        flags = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").split()
    except OSError:
        return False
    return "fma" in flags


def files_of(folder):
    """Bytes of the compared files, by name."""
    names = [path for path in folder.rglob("*") if path.suffix in (".jsonl", ".vtu", ".csv")]
    return {str(path.relative_to(folder)): path.read_bytes() for path in names}


def run(program, scene, changes, folder, tunables):
    words = [program, "run", str(scene), "-o", str(folder), "--quiet", "--frames", "6"]
    for change in changes:
        words += ["--set", change]
    environment = dict(os.environ)
    environment.pop("GLIBC_TUNABLES", None)
    if tunables:
        environment["GLIBC_TUNABLES"] = tunables
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(words)}: exit code {done.returncode}\n{done.stderr}")
    return files_of(folder)


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    here = pathlib.Path(__file__).resolve().parents[3] / "meshes" / "scenes"
    scenes = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else here
    if not has_choice():
        print("skipped: no FMA to take away")
        return 77
    differences = 0
    with tempfile.TemporaryDirectory() as work:
        for number, (scene, changes) in enumerate(RUNS):
            new, old = (run(program, scenes / scene, changes, pathlib.Path(work, f"{number}{way}"),
                            tunables) for way, tunables in (("new", ""), ("old", OLDER)))
            if not new or new.keys() != old.keys():
                sys.exit(f"{scene} {changes}: {sorted(new)} and {sorted(old)}")
            wrong = [name for name in sorted(new) if new[name] != old[name]]
            differences += len(wrong)
            print(f"{scene} {' '.join(changes)}: {len(new)} files, {len(wrong)} differ {wrong[:3]}")
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
