# SPDX-License-Identifier: MIT
"""The part of the module that is Python: scenes from dictionaries, runs as iterators, tables."""

import copy
import json
import os

import numpy

from . import _sunder


def _without_meshes(row, named, name):
    """A body or obstacle with the name of its mesh in place of the mesh."""
    if not isinstance(row, dict) or not isinstance(row.get("mesh"), _sunder.Mesh):
        return row
    named[name] = row["mesh"]
    return {**row, "mesh": name}


def _body_input(body, meshes, folder):
    given = _sunder.SceneInput()
    named = dict(meshes or {})
    given.text = json.dumps(_without_meshes(body, named, "mesh of the body"), default=_plain)
    given.folder = os.fspath(folder or ".")
    given.meshes = named
    return given


def _scene_input(scene, meshes, settings, folder):
    """What the compiled part reads. Meshes that stand in the scene get names of their own."""
    given = _sunder.SceneInput()
    named = dict(meshes or {})
    if isinstance(settings, dict):
        settings = [f"{key}={json.dumps(value)}" for key, value in settings.items()]
    given.settings = list(settings or ())
    if isinstance(scene, dict):
        scene = copy.copy(scene)
        for key in ("bodies", "obstacles"):
            if key in scene:
                scene[key] = [_without_meshes(row, named, f"mesh of {key}.{k}")
                              for k, row in enumerate(scene[key])]
        given.text = json.dumps(scene, default=_plain)
        given.folder = os.fspath(folder or ".")
    else:
        if named:
            raise TypeError("meshes go with a scene that is a dictionary")
        given.path = os.fspath(scene)
    given.meshes = named
    return given


def _plain(value):
    """NumPy's numbers and arrays as JSON has them."""
    if isinstance(value, (numpy.ndarray, numpy.generic)):
        return value.tolist()
    raise TypeError(f"a scene cannot hold a {type(value).__name__}")


class Simulation(_sunder.SimulationBase):
    """A scene in motion.

    `scene` is the path of a scene file, or a dictionary with its keys. In a dictionary `mesh` is the
    name of a file in `folder`, a key of `meshes`, or a Mesh. `settings` changes keys:
    {"bodies.0.material.density": 2000}. Raises Error.

    Arrays of the state are copies, because a split moves the columns in memory. `view` gives a column
    without a copy, and nothing can change while such a view is alive.
    One thread at a time may use a simulation; RuntimeError is raised in any other.
    """

    def __init__(self, scene, *, meshes=None, settings=None, folder=None):
        super().__init__(_scene_input(scene, meshes, settings, folder))

    def run(self, folder=None, *, until=None, force=False):
        """Yields the StepReport of each step, to the end of the scene or to the time `until` in s.

        With `folder` the files of `sunder run` are written there, with the same bytes: frames,
        events.jsonl, tables, report.json. The files end where the iterator is closed; an iterator
        that is left early writes a checkpoint, as an interrupted run does. `force` replaces the
        files of an earlier run. Raises Error.
        """
        if folder is not None:
            self._open_run(os.fspath(folder), force)
        failed = False
        try:
            while self.steps_taken < self.step_count and (until is None or self.time < until):
                yield self.step()
        except _sunder.Error:
            failed = True
            raise
        finally:
            if folder is not None:
                self._finish_run(failed)

    def add(self, body, *, meshes=None, folder=None):
        """Adds a body, a dictionary as in "bodies" of a scene, where it says, between two steps.

        `meshes` and `folder` are those of `Simulation`. Its rows follow those that are there. The
        history begins again. Returns a BodyChange; `findings` gets the warnings. Raises Error, and
        nothing has changed.
        """
        return self._add(_body_input(body, meshes, folder))

    @classmethod
    def load(cls, path):
        """A simulation from a file of `save`. It continues to the same bytes. Raises Error."""
        return cls._restored(os.fspath(path))

    @classmethod
    def from_bytes(cls, state):
        """A simulation from the bytes of `to_bytes`. Raises Error."""
        return cls._restored(bytes(state))

    @classmethod
    def _restored(cls, source):
        simulation = cls.__new__(cls)
        _sunder.SimulationBase.__init__(simulation, source)
        return simulation

    @property
    def history(self):
        """Energies, works and forces over time: arrays (k,) by the names of history.csv's columns."""
        header, *rows = self._history_csv().splitlines()
        values = numpy.array([[float(x) if x else numpy.nan for x in row.split(",")] for row in rows])
        return {name: values[:, column].copy() for column, name in enumerate(header.split(","))}


def split(mesh, *, normal, offset=0.0, check=False):
    """The Map of a mesh, split along the plane normal . x = offset (m), face by face. Raises Error."""
    cut = _sunder.Map(mesh)
    cut.split(cut.plane_faces(normal, offset), check=check)
    return cut


def static(scene, *, meshes=None, settings=None, folder=None):
    """The equilibrium of a scene's bodies under loads and supports, as `sunder static` finds it.

    Returns a dictionary: `bodies`, a list with `displacement` (m), `principal_stress` (Pa),
    `strength_share`, each with `value`, `point` and `position`, `supports`, `strain_energy` (J);
    `rest_positions` and `positions` (n, 3) in m; `stress` (n, 3, 3) in Pa; `findings`. Raises Error.
    """
    return _sunder.static(_scene_input(scene, meshes, settings, folder))


def modes(scene, count=6, *, meshes=None, settings=None, folder=None):
    """The rigid modes and the `count` lowest other modes of each piece of a scene, as `sunder modes`.

    Returns a list of dictionaries: `body`, `rigid` (number of rigid modes), `frequencies` (k,) in
    Hz, `vertices` (n,), `shapes` (k, n, 3) with the sum of m |shape|^2 equal to 1 kg m^2. Raises Error.
    """
    return _sunder.modes(_scene_input(scene, meshes, settings, folder), count)
