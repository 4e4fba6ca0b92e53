# SPDX-License-Identifier: MIT
"""A program whose types mypy compares with those of the module; nothing runs it."""

import numpy as np
from numpy.typing import NDArray

import sunder


def heights(path: str) -> NDArray[np.float64]:
    sim = sunder.Simulation(path, settings={"duration": 0.1})
    for report in sim.run(until=0.05):
        if len(report.new_pieces) > 0:
            print(report.time, [fan.stress for fan in report.fans])
    return sim.positions[:, 2]


def cut(mesh: sunder.Mesh) -> int:
    halves = sunder.split(mesh, normal=(0, 0, 1), check=True)
    betti = halves.betti
    return 0 if betti is None else betti[0]


def faults(path: str) -> list[str]:
    try:
        return [f.code for f in sunder.check(sunder.read(path)).findings]
    except sunder.Error as error:
        return [f.remedy for f in error.findings]


def swap(sim: sunder.Simulation, mesh: sunder.Mesh) -> float:
    come = sim.add({"mesh": mesh, "translation": [0, 0, 2]})
    gone: sunder.BodyChange = sim.remove(0)
    sim.pull(0, (0, 0, 1))
    sim.release()
    return come.kinetic - gone.kinetic + float(sim.view("masses").sum())
