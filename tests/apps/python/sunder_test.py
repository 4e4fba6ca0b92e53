# SPDX-License-Identifier: MIT
"""The Python module: python3 sunder_test.py MODULE_FOLDER SUNDER_PROGRAM PROJECT

Meshes, maps, simulations, errors, and the same bytes as the program. MODULE_FOLDER holds the package `sunder`.
"""

import gc
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy

sys.path.insert(0, sys.argv[1])
import sunder  # noqa: E402

PROGRAM, PROJECT = sys.argv[2], pathlib.Path(sys.argv[3])
MESHES, SCENES = PROJECT / "meshes", PROJECT / "meshes/scenes"
MONOLITH = SCENES / "charts/monolith.json"
BREAKING = {"bodies": [{"mesh": "bar", "translation": [0, 0, 0.07], "velocity": [0, 0, -8],
                        "material": {"tensile_strength": 1e6}}],
            "obstacles": [{"plane": {}}], "time_step": 1e-3, "duration": 0.02, "fracture": {"crack": "paper"}}


def program(*arguments):
    result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300)
    if result.returncode != 0:
        raise AssertionError(f"sunder {arguments}: {result.stderr}")
    return result.stdout


def breaking(**more):
    return sunder.Simulation(BREAKING, meshes={"bar": sunder.box((1, 0.1, 0.1), (10, 2, 2))}, **more)


class Meshes(unittest.TestCase):
    def test_arrays_come_out_as_they_went_in(self):
        points = numpy.random.default_rng(7).random((1000, 3))
        mesh = sunder.Mesh(points, [[0, 1, 2, 3], [4, 5, 6, 7]], regions=[5, 6])
        numpy.testing.assert_array_equal(mesh.points, points)
        self.assertEqual(mesh.tetrahedra.tolist(), [[0, 1, 2, 3], [4, 5, 6, 7]])
        self.assertEqual(mesh.regions.tolist(), [5, 6])

    def test_a_million_points_come_out_without_a_copy(self):
        mesh = sunder.Mesh(numpy.zeros((1_000_000, 3)))
        one, other = mesh.points, mesh.points
        self.assertTrue(numpy.shares_memory(one, other))
        self.assertFalse(one.flags.writeable or one.flags.owndata)
        with self.assertRaises(ValueError):
            one[0, 0] = 1

    def test_a_view_keeps_its_mesh_alive(self):
        points = sunder.box((1, 1, 1), (20, 20, 20)).points
        gc.collect()
        self.assertEqual(points.shape, (21 ** 3, 3))
        self.assertEqual((points.min(), points.max()), (-0.5, 0.5))

    def test_rows_that_do_not_exist_are_refused_with_findings(self):
        with self.assertRaises(sunder.Error) as caught:
            sunder.Mesh(numpy.zeros((4, 3)), [[0, 1, 2, 3], [0, 1, 2, 9], [0, 0, 1, 2]])
        found = {f.code: f for f in caught.exception.findings}
        self.assertEqual(found["index_out_of_range"].ids, [1])
        self.assertEqual(found["repeated_vertex"].ids, [2])
        self.assertTrue(all(f.severity == "error" and f.remedy for f in found.values()))
        self.assertIn("index_out_of_range", str(caught.exception))
        with self.assertRaises(ValueError):
            sunder.Mesh(numpy.zeros((4, 3)), [[-1, 1, 2, 3]])
        for tetrahedra, regions in (([[0, 1, 2, 2.5]], None), ([[0.0, 1.0, 2.0, 3.0]], None), ([[0, 1, 2]], None),
                                    ([[0, 1, 2, 3]], [2 ** 40]), ([[0, 1, 2, 3]], [1, 2])):
            with self.assertRaises(ValueError):
                sunder.Mesh(numpy.eye(4, 3), tetrahedra, regions=regions)
        with self.assertRaises(ValueError):
            sunder.Mesh(numpy.zeros((4, 2)))
        with self.assertRaises(sunder.Error):
            sunder.Mesh([[0, 0, numpy.nan]])

    def test_a_file_that_is_not_there_is_named(self):
        with self.assertRaises(sunder.Error) as caught:
            sunder.read("nowhere.msh")
        self.assertEqual(caught.exception.findings[0].code, "cannot_open")

    def test_conversions_have_the_bytes_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for name, options, arguments in (("a.vtu", {}, []), ("a.mesh", {}, []), ("a.inp", {}, []),
                                             ("a.msh", {"version": "2.2", "encoding": "binary"},
                                              ["--format-version", "2.2", "--binary"])):
                ours, theirs, written = folder / f"1{name}", folder / f"2{name}", folder / f"3{name}"
                findings = sunder.convert(MESHES / "ring.msh", ours, **options)
                program("convert", MESHES / "ring.msh", theirs, "--quiet", *arguments)
                self.assertEqual(ours.read_bytes(), theirs.read_bytes(), name)
                sunder.write(written, sunder.read(MESHES / "ring.msh"), **options)
                self.assertEqual(written.read_bytes(), theirs.read_bytes(), name)
                self.assertFalse([f for f in findings if f.severity == "error"])

    def test_strict_writes_nothing_where_something_is_lost(self):
        with tempfile.TemporaryDirectory() as folder:
            target = pathlib.Path(folder) / "a.stl"
            with self.assertRaises(sunder.Error):
                sunder.convert(MESHES / "ring.msh", target, strict=True)
            self.assertFalse(target.exists())

    def test_a_check_agrees_with_the_program(self):
        for name in ("ring.msh", "cube.msh"):
            check = sunder.check(sunder.read(MESHES / name))
            told = json.loads(program("check", MESHES / name, "--json"))
            self.assertTrue(check.ok)
            self.assertEqual(list(check.counts["betti"]), told["betti"] if "betti" in told else told["invariants"]["betti"])
        flat = sunder.check(sunder.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 1, 2, 3]]))
        self.assertFalse(flat.ok)
        self.assertIn("flat_tetrahedron", [f.code for f in flat.findings])

    def test_solids_are_what_their_arguments_name(self):
        for cells in ((1, 1, 1), (3, 4, 5)):
            check = sunder.check(sunder.box((1, 2, 3), cells))
            self.assertEqual([f.code for f in check.findings], [])
            self.assertEqual(check.counts["betti"], (1, 0, 0))
            self.assertAlmostEqual(check.counts["volume"], 6, 12)
            self.assertEqual(check.counts["tetrahedra"], 6 * cells[0] * cells[1] * cells[2])
        for mesh, count in ((sunder.ball(0.5, 4), 20 * 64), (sunder.cylinder(0.5, 1, 3, 2), 18 * 9 * 2)):
            check = sunder.check(mesh)
            self.assertEqual((check.ok, check.counts["betti"], check.counts["tetrahedra"]), (True, (1, 0, 0), count))
        for call in (lambda: sunder.box((1, 1, 0), (1, 1, 1)), lambda: sunder.box((1, 1, 1), (1, 0, 1)),
                     lambda: sunder.ball(float("nan"), 2), lambda: sunder.ball(1, 10 ** 4), lambda: sunder.cylinder(1, 1, 0, 1)):
            with self.assertRaises(ValueError):
                call()


class Maps(unittest.TestCase):
    def test_a_ring_has_a_handle_until_it_is_cut(self):
        for kernel in ("rows", "darts"):
            cut = sunder.Map(sunder.read(MESHES / "ring.msh"), kernel)
            self.assertEqual(cut.betti, (1, 1, 0))
            faces = cut.plane_faces((1, 0, 0), 1.01)
            splits = cut.split(faces, check=True)
            self.assertEqual([s.face for s in splits], faces.tolist())
            self.assertTrue(all(s.did for s in splits))
            self.assertEqual(cut.check(), [])
            self.assertEqual(len(set(cut.components)), cut.betti[0])
            self.assertEqual(sum(s.created for s in splits), cut.betti[0] - 1)

    def test_a_split_is_glued_again(self):
        cut = sunder.Map(sunder.box((1, 1, 1), (2, 2, 2)))
        before, corners = cut.counts, cut.corners
        splits = cut.split(cut.plane_faces((1, 0, 0), 0))
        self.assertEqual(cut.betti, (2, 0, 0))
        self.assertEqual(splits[-1].oracle, True)
        self.assertTrue((corners != cut.corners).any())
        for s in reversed(splits):
            cut.glue(s.face, s.opposite)
        self.assertEqual(cut.counts, before)
        numpy.testing.assert_array_equal(cut.corners, corners)
        with self.assertRaises(sunder.Error):
            cut.glue(0, 0)

    def test_fans_and_stars(self):
        cut = sunder.Map(sunder.box((1, 1, 1), (2, 2, 2)))
        middle = int(numpy.flatnonzero((cut.points == 0).all(axis=1))[0])
        star = cut.star(middle)
        self.assertEqual(star.tolist(), numpy.flatnonzero((cut.corners == middle).any(axis=1)).tolist())
        fan = cut.fan(middle, (0, 0, 1))
        self.assertTrue(len(fan) > 0 and set(fan // 4) <= set(star))
        faces = cut.corners[fan // 4].copy()
        others = [[p for k, p in enumerate(row) if k != f % 4] for row, f in zip(faces, fan)]
        found, across = cut.find(others), cut.neighbours.reshape(-1)[fan]
        numpy.testing.assert_array_equal(found, numpy.minimum(fan, across))
        self.assertEqual(cut.find([[0, 1, 26], [0, 1, -7]]).tolist(), [-1, -1])
        for call in (lambda: cut.star(10 ** 6), lambda: cut.star(-1), lambda: cut.split([10 ** 9])):
            with self.assertRaises(IndexError):
                call()
        with self.assertRaises(sunder.Error):
            cut.fan(middle, (0, 0, 0))

    def test_what_is_split_is_a_mesh(self):
        halves = sunder.split(sunder.box((1, 1, 1), (2, 2, 2)), normal=(1, 0, 0), check=True)
        mesh = halves.mesh()
        self.assertEqual(len(mesh.points), 27 + 9)
        self.assertEqual(sunder.Map(mesh).betti, (2, 0, 0))


class Simulations(unittest.TestCase):
    def test_a_run_has_the_bytes_of_the_program(self):
        settings = ["duration=0.08", "output.frames=5"]
        with tempfile.TemporaryDirectory() as folder:
            ours, theirs = pathlib.Path(folder) / "1", pathlib.Path(folder) / "2"
            sim = sunder.Simulation(MONOLITH, settings=settings)
            reports = list(sim.run(ours))
            program("run", MONOLITH, "-o", theirs, "--quiet", *(w for s in settings for w in ("--set", s)))
            self.assertEqual(len(reports), sim.step_count)
            self.assertGreater(sum(len(r.fans) for r in reports), 0)
            names = [p.relative_to(theirs) for p in sorted(theirs.rglob("*")) if p.is_file()]
            self.assertEqual(names, [p.relative_to(ours) for p in sorted(ours.rglob("*")) if p.is_file()])
            same = [n for n in names if n.name != "report.json" and n.suffix != ".checkpoint"]
            self.assertTrue({"events.jsonl", "frames.pvd", "history.csv", "fragments.csv"} <= {n.name for n in same})
            self.assertGreater(len([n for n in same if n.suffix == ".vtu"]), 4)
            for name in same:
                self.assertEqual((ours / name).read_bytes(), (theirs / name).read_bytes(), name)
            header = (theirs / "history.csv").read_text().splitlines()
            self.assertEqual(list(sim.history), header[0].split(","))
            self.assertEqual([float(x) for x in header[-1].split(",")], [c[-1] for c in sim.history.values()])
            with self.assertRaises(sunder.Error) as caught:
                next(sunder.Simulation(MONOLITH, settings=settings).run(ours))
            self.assertEqual(caught.exception.findings[0].code, "folder_holds_a_run")

    def test_a_run_that_is_left_early_can_be_continued_by_the_program(self):
        settings = ["duration=0.06", "output.frames=5"]
        with tempfile.TemporaryDirectory() as folder:
            ours, theirs = pathlib.Path(folder) / "1", pathlib.Path(folder) / "2"
            for report in sunder.Simulation(MONOLITH, settings=settings).run(ours):
                if report.step == 100:
                    break
            del report
            gc.collect()
            program("run", "--resume", ours, "--quiet")
            program("run", MONOLITH, "-o", theirs, "--quiet", *(w for s in settings for w in ("--set", s)))
            for name in ("events.jsonl", "history.csv", "fragments.csv"):
                self.assertEqual((ours / name).read_bytes(), (theirs / name).read_bytes(), name)

    def test_a_run_that_fails_says_so_and_ends_its_files(self):
        with tempfile.TemporaryDirectory() as folder:
            sim = breaking(settings={"integrator.method": "verlet", "fracture.mode": "off"})
            with self.assertRaises(sunder.Error) as caught:
                list(sim.run(folder))
            self.assertTrue(caught.exception.findings[0].remedy)
            report = json.loads((pathlib.Path(folder) / "report.json").read_text())
            self.assertEqual(report["end"], "failed")
            with self.assertRaises(sunder.Error) as caught:
                sim.step()
            self.assertEqual(caught.exception.findings[0].code, "simulation_failed")

    def test_an_array_from_before_a_split_stays_as_it_was(self):
        sim = breaking()
        before, rows = sim.positions, sim.tetrahedra
        kept = before.copy()
        while len(sim.fragments()) == 1:
            sim.step()
        self.assertTrue(before.flags.owndata and rows.flags.owndata)
        numpy.testing.assert_array_equal(before, kept)
        self.assertGreater(len(sim.positions), len(before))
        del sim
        gc.collect()
        numpy.testing.assert_array_equal(before, kept)

    def test_a_view_holds_the_simulation_still(self):
        sim = sunder.Simulation(MONOLITH, settings={"duration": 0.1})
        for name in ("positions", "rest_positions", "velocities", "masses", "strengths", "tetrahedra"):
            one, other = sim.view(name), sim.view(name)
            self.assertTrue(numpy.shares_memory(one, other), name)
            numpy.testing.assert_array_equal(one, getattr(sim, name))
            with self.assertRaises(ValueError):
                one[0] = 1
        del one, other
        part = sim.view("positions")[3:, 2]
        before = part.copy()
        for act in (sim.step, lambda: sim.cut((0, 0, 0), (0, 0, 1)), lambda: sim.remove(0), lambda: sim.add({}),
                    lambda: next(sim.run())):
            with self.assertRaises(BufferError):
                act()
        numpy.testing.assert_array_equal(part, before)
        state = sim.hash  # reading is allowed
        del part
        sim.step()
        self.assertNotEqual(sim.hash, state)
        with self.assertRaises(IndexError):
            sim.view("nothing")
        sim.step()
        masses, expected = sim.view("masses"), sim.masses.sum()
        del sim
        self.assertEqual(masses.sum(), expected)

    def test_a_million_points_come_and_go_with_one_copy_each(self):
        def resident():
            words = pathlib.Path("/proc/self/statm").read_text().split()
            return int(words[1]) * os.sysconf("SC_PAGE_SIZE")

        points = numpy.random.default_rng(1).random((1_000_000, 3))
        before = resident()
        mesh = sunder.Mesh(points)
        taken = resident() - before
        self.assertLess(taken, 1.5 * points.nbytes)  # its own copy, and no other
        arrays = [mesh.points for _ in range(20)]
        self.assertLess(resident() - before - taken, 0.5 * points.nbytes)
        numpy.testing.assert_array_equal(arrays[-1], points)

    def test_arrays_fit_together(self):
        sim = breaking()
        for _ in sim.run(until=0.01):
            pass
        n, t = len(sim.positions), len(sim.tetrahedra)
        self.assertEqual(sim.steps_taken, 10)
        for name in ("rest_positions", "velocities", "masses", "strengths", "vertex_pieces", "vertex_stresses"):
            self.assertEqual(len(getattr(sim, name)), n, name)
        self.assertEqual((len(sim.pieces), sim.stresses.shape, t), (t, (t, 3, 3), 240))
        fragments = sim.fragments()
        self.assertEqual({f.id for f in fragments}, set(sim.pieces))
        self.assertAlmostEqual(sum(f.mass for f in fragments), 2400 * 0.01, 9)
        self.assertAlmostEqual(sim.masses.sum(), 2400 * 0.01, 9)
        self.assertEqual(sim.check_map(), [])
        faces = 0
        for f in fragments:
            surface = sim.surface(f.id)
            faces += len(surface["triangles"])
            numpy.testing.assert_array_equal(surface["positions"], sim.positions[surface["vertices"]])
        self.assertEqual(faces, len(sim.faces))
        self.assertEqual(len(sim.face_is_crack), faces)
        with self.assertRaises(IndexError):
            sim.surface(10 ** 6)

    def test_a_saved_state_goes_on_to_the_same_bytes(self):
        sim = breaking()
        for _ in range(6):
            sim.step()
        with tempfile.TemporaryDirectory() as folder:
            sim.save(pathlib.Path(folder) / "state")
            others = [sunder.Simulation.load(pathlib.Path(folder) / "state"), sunder.Simulation.from_bytes(sim.to_bytes())]
        for other in others:
            self.assertIsInstance(other, sunder.Simulation)
            self.assertEqual(other.hash, sim.hash)
            other.step()
        sim.step()
        self.assertEqual([o.hash for o in others], [sim.hash] * 2)
        self.assertEqual(len(sim.hash), 16)
        with self.assertRaises(sunder.Error) as caught:
            sunder.Simulation.from_bytes(b"no state")
        self.assertEqual(caught.exception.findings[0].code, "not_a_saved_state")

    def test_scenes_as_dictionaries(self):
        mesh = sunder.box((1, 0.1, 0.1), (10, 2, 2))
        scene = json.loads(json.dumps(BREAKING))
        scene["bodies"][0]["mesh"] = mesh
        scene["bodies"][0]["translation"] = numpy.array([0, 0, 0.07])
        self.assertEqual(sunder.Simulation(scene).hash, breaking().hash)
        text = json.loads(MONOLITH.read_text())
        self.assertEqual(sunder.Simulation(text, folder=MONOLITH.parent).hash, sunder.Simulation(MONOLITH).hash)
        with self.assertRaises(sunder.Error) as caught:
            sunder.Simulation({"bodies": [{"mesh": mesh}], "durration": 1})
        self.assertIn("duration", caught.exception.findings[0].text + caught.exception.findings[0].remedy)
        with self.assertRaises(sunder.Error):
            sunder.Simulation({"bodies": [{"mesh": sunder.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 1, 2, 3]])}]})
        self.assertEqual(breaking(settings={"duration": 0.5}).step_count, 500)

    def test_one_thread_at_a_time_and_the_others_run(self):
        sim = sunder.Simulation(MONOLITH)
        turns, refused, ended = [], [], threading.Event()

        def look():
            while not ended.is_set():
                turns.append(1)
                try:
                    sim.positions
                except RuntimeError as error:
                    refused.append(str(error))

        other = threading.Thread(target=look)
        other.start()
        steps = 0
        while steps < 400 and not (refused and steps > 20):
            try:
                sim.step()
                steps += 1
            except RuntimeError:  # the other thread was there first
                pass
        ended.set()
        other.join()
        self.assertGreater(len(turns), 0)
        self.assertTrue(refused and "another thread" in refused[0])

    def test_balls_and_cuts(self):
        sim = breaking()
        fan = sim.cut((0, 0, 0), (1, 0, 0))
        self.assertEqual((fan.created, len(sim.fragments())), (1, 2))
        sim.shoot((0, 0, 2), (0, 0, -10), radius=0.1, mass=5)
        sim.step()
        with self.assertRaises(sunder.Error):
            sim.shoot((0, 0, 0), (0, 0, 0), radius=-1, mass=1)
        with self.assertRaises(sunder.Error):
            sim.cut((50, 0, 0), (1, 0, 0))

    def test_bodies_come_and_go(self):
        box = sunder.box(size=(0.2, 0.1, 0.1), cells=(4, 2, 2))
        body = {"mesh": box, "translation": [0, 0, 0.06], "velocity": [0, 0, -5], "material": {"tensile_strength": 2e5}}
        scene = {"bodies": [body], "obstacles": [{"plane": {}}], "time_step": 1e-3, "duration": 0.1}

        def sequence():
            sim = sunder.Simulation(scene)
            for _ in range(10):
                sim.step()
            ids = [piece.id for piece in sim.fragments()]
            self.assertGreater(len(ids), 1)
            come = sim.add({**body, "translation": [0, 1, 0.06]})
            self.assertEqual(come.body, 1)
            self.assertEqual(come.pieces.tolist(), [max(ids) + 1])
            self.assertAlmostEqual(come.kinetic, 12.5 * come.mass)
            numpy.testing.assert_allclose(come.momentum, (0, 0, -5 * come.mass))
            before = sim.to_bytes()
            for fault in ({}, {"mesh": box, "colour": 1}, {"mesh": box, "material": {"density": -1}}):
                with self.assertRaises(sunder.Error):
                    sim.add(fault)
            with self.assertRaises(sunder.Error) as caught:
                sim.remove(5)
            self.assertEqual(caught.exception.findings[0].code, "no_such_body")
            self.assertEqual(sim.to_bytes(), before)
            sim.step()
            gone = sim.remove(0)
            self.assertGreaterEqual(set(gone.pieces.tolist()), set(ids))
            self.assertEqual({piece.body for piece in sim.fragments()}, {1})
            self.assertEqual(len(sim.pieces), len(box.tetrahedra))
            self.assertEqual(sim.check_map(), [])
            again = sunder.Simulation.from_bytes(sim.to_bytes())
            for _ in range(10):
                sim.step()
                again.step()
            self.assertEqual(again.hash, sim.hash)
            self.assertGreater(len(sim.history["time"]), 0)
            return sim.hash

        self.assertEqual(sequence(), sequence())

    def test_a_run_with_files_has_the_bodies_of_its_scene(self):
        body = {"mesh": sunder.box(size=(1, 1, 1), cells=(2, 2, 2))}
        with tempfile.TemporaryDirectory() as folder:
            sim = sunder.Simulation({"bodies": [body], "time_step": 1e-3, "duration": 0.01})
            run = sim.run(folder)
            next(run)
            for act in (lambda: sim.add({**body, "translation": [0, 0, 5]}), lambda: sim.remove(0),
                        lambda: sim.pull(0, (0, 0, 1))):
                with self.assertRaises(sunder.Error) as caught:
                    act()
                self.assertEqual(caught.exception.findings[0].code, "run_is_recorded")
            run.close()
            sim = sunder.Simulation({"bodies": [body], "time_step": 1e-3, "duration": 0.01})
            sim.add({**body, "translation": [0, 0, 5]})
            with self.assertRaises(sunder.Error) as caught:
                next(sim.run(folder, force=True))
            self.assertEqual(caught.exception.findings[0].code, "run_has_begun")

    def test_a_pull_leads_a_vertex(self):
        sim = sunder.Simulation({"bodies": [{"mesh": sunder.box(size=(1, 1, 1), cells=(2, 2, 2))}],
                                 "gravity": {"acceleration": [0, 0, 0]}, "time_step": 1e-3, "duration": 1})
        with self.assertRaises(sunder.Error):
            sim.pull(10 ** 6, (0, 0, 0))
        end = sim.positions[0] + (0.5, 0, 0)
        sim.pull(0, end)
        for _ in range(600):
            sim.step()
        self.assertLess(numpy.abs(sim.positions[0] - end).max(), 0.05)
        sim.release()

    def test_equilibrium_and_modes(self):
        cantilever = SCENES / "charts/cantilever.json"
        told = json.loads(program("static", cantilever, "--json"))
        found = sunder.static(cantilever)["bodies"][0]
        self.assertAlmostEqual(found["displacement"]["value"] / told["bodies"][0]["max_displacement"]["value"], 1, 12)
        pieces = sunder.modes(cantilever, 3)
        self.assertEqual((len(pieces), len(pieces[0]["frequencies"])), (1, pieces[0]["rigid"] + 3))
        self.assertEqual(pieces[0]["shapes"].shape, (len(pieces[0]["frequencies"]), len(pieces[0]["vertices"]), 3))
        self.assertTrue((numpy.diff(pieces[0]["frequencies"]) >= 0).all())


class Types(unittest.TestCase):
    def test_every_public_name_has_a_type_and_words(self):
        stub = (pathlib.Path(sunder.__file__).parent / "__init__.pyi").read_text()
        for name in sunder.__all__:
            thing = getattr(sunder, name)
            self.assertRegex(stub, rf"(class|def) {name}\b", name)
            self.assertTrue(thing.__doc__, name)
            if isinstance(thing, type) and not issubclass(thing, Exception):
                body = stub.split(f"class {name}", 1)[1].split("\nclass ", 1)[0]
                for member in dir(thing):
                    if not member.startswith("_") and not hasattr(object, member):
                        self.assertIn(f"def {member}(", body, f"{name}.{member}")
                        self.assertTrue(getattr(thing, member).__doc__, f"{name}.{member}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
