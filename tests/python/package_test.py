#!/usr/bin/env python3
"""The Python package does what the program does, bit for bit, and is safe where C++ leaves safety to its caller.

  package_test.py ROOT FOLDER_OF_PACKAGE VOXMELT [--all]

--all compares every committed scene.
"""
import copy
import gc
import json
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

ROOT, PACKAGE, PROGRAM = (Path(word).resolve() for word in sys.argv[1:4])
sys.path[:0] = [str(PACKAGE), str(ROOT / "tests")]
import numpy  # noqa: E402
import voxmelt  # noqa: E402
from png_pixels import pixels  # noqa: E402

APPROVED = json.loads((ROOT / "tests/app/digests.json").read_text())
SMALL = ROOT / "scenes/bunny_small.toml"
SCENES = ["arch", "bunny_small", "bunny_small_viscous", "chocolate_nuts", "lava_crust", "lesson_sky", "lesson_tubes"]
if "--all" in sys.argv:
    SCENES = sorted(APPROVED)
TINY = """[grid]
size = [16, 12, 16]
[[solid]]
shape = "box"
size = [6, 6, 6]
at = [8, 5, 8]
[[inert]]
shape = "floor"
thickness = 2
[heat]
[[heat_source]]
at = [14, 11, 14]
power = 30
"""
RESIDENT_PAGES = Path("/proc/self/statm")


def program(*arguments, cwd=None):
    result = subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True)
    if result.returncode != 0:
        raise AssertionError(result.stderr)
    return result.stdout.strip()


def line_of(simulation):
    """What `voxmelt digest` says of this state."""
    state = simulation.state()
    return (f"step {simulation.step_number()} digest {simulation.digest():016x} mass {simulation.ledgers().mass.held}"
            f" solid {state.solid.sum()} liquid {state.liquid.sum()}")


class InFolder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.tiny = self.folder / "tiny.toml"
        self.tiny.write_text(TINY)

    def tearDown(self):
        self.temporary.cleanup()


class SameAsTheProgram(InFolder):
    def test_digests_of_committed_scenes(self):
        steps = 500 if "--all" in sys.argv else 10
        for scene in SCENES:
            with self.subTest(scene):
                simulation = voxmelt.Simulation(ROOT / f"scenes/{scene}.toml")
                for step in (1, 10, 500):
                    if step <= steps:
                        simulation.step(step - simulation.steps_done())
                        self.assertEqual(line_of(simulation), APPROVED[scene][str(step)])
                self.assertEqual(line_of(simulation), program("digest", scene, "--steps", steps, "--quiet", cwd=ROOT))
                self.assertTrue(simulation.ledgers().balance())

    def test_devices_have_the_same_digest(self):
        for device in voxmelt.devices():
            simulation = voxmelt.Simulation(ROOT / "scenes/lesson_tubes.toml", implementation=device.name)
            self.assertEqual(simulation.implementation(), device.name)
            simulation.step(10)
            self.assertEqual(line_of(simulation), APPROVED["lesson_tubes"]["10"])

    def test_arrays_are_those_of_an_export(self):
        for scene in ("chocolate_nuts", "bunny_small"):  # one with a field of 8 bits
            program("export", scene, "--steps", 30, "--out", self.folder / scene, "--quiet", cwd=ROOT)
            simulation = voxmelt.Simulation(ROOT / f"scenes/{scene}.toml")
            simulation.step(30)
            state = simulation.state()
            files = {file.stem: numpy.load(file) for file in (self.folder / scene).glob("*.npy")}
            self.assertEqual({field.name for field in state.fields}, set(files))
            for field in state.fields:
                expected = files[field.name]
                if field.name in ("solid", "liquid", "amount", "heat", "material"):
                    self.assertGreater(len(numpy.unique(expected)), 1, f"{scene} has no {field.name}")
                self.assertEqual(field.cells.shape, simulation.state().amount.shape)
                numpy.testing.assert_array_equal(field.cells, expected, field.name)
                if expected.dtype == numpy.uint16 or field.unit:
                    numpy.testing.assert_array_equal(field.view(), expected, field.name)
                    numpy.testing.assert_array_equal(state.view(field.name), expected, field.name)
                if hasattr(state, field.name):
                    numpy.testing.assert_array_equal(getattr(state, field.name), expected, field.name)
            self.assertEqual(tuple(state.solid.shape), tuple(reversed([state.grid.x, state.grid.y, state.grid.z])))

    def test_changes_are_those_of_the_scene(self):
        simulation = voxmelt.Simulation(self.tiny)
        simulation.set("heat.gamma", 0.2)
        simulation.step(20)
        self.assertEqual(simulation.numbers()["heat.gamma"], 0.2)
        overridden = voxmelt.Simulation(self.tiny, overrides=["heat.gamma=0.2"], threads=1, implementation="reference")
        self.assertEqual((overridden.threads(), overridden.implementation()), (1, "reference"))
        overridden.step(20)
        said = program("digest", self.tiny, "--steps", 20, "--set", "heat.gamma=0.2")
        self.assertEqual(line_of(simulation), said)
        self.assertEqual(line_of(overridden), said)

    def test_sources_and_pouring(self):
        simulation = voxmelt.Simulation(self.tiny)
        vent = voxmelt.Vent((8, 10, 8), radius=2, rate=0.5, temperature=1, from_=3, until=9)
        simulation.set_vents([vent])
        self.assertEqual(simulation.vents(), [vent])
        simulation.set_heat_sources([voxmelt.HeatSource.fixed((2, 11, 2), 5)])
        self.assertEqual(simulation.heat_sources()[0].keyframes[0].at, (2.0, 11.0, 2.0))
        simulation.step(20)
        self.tiny.write_text(TINY.replace("at = [14, 11, 14]\npower = 30", "at = [2, 11, 2]\npower = 5") +
                             "[[vent]]\nat = [8, 10, 8]\nradius = 2\nrate = 0.5\ntemperature = 1\nfrom = 3\nuntil = 9\n")
        self.assertEqual(line_of(simulation), program("digest", self.tiny, "--steps", 20))
        before = simulation.state().amount.sum(dtype=int)
        simulation.pour((3, 7, 12), 1.5, 0.8)
        self.assertGreater(simulation.state().amount.sum(dtype=int), before)
        simulation.carve((8, 8, 8), 100)
        self.assertEqual(simulation.state().liquid.sum() + simulation.state().solid.sum(), 0)
        simulation.restart()
        self.assertEqual((simulation.steps_done(), simulation.state().solid.sum()), (0, 216))

    def test_checkpoints(self):
        simulation = voxmelt.Simulation(self.tiny)
        simulation.step(7)
        simulation.save(self.folder / "kept.vxc")
        simulation.step(5)
        again = voxmelt.Simulation(str(self.folder / "kept.vxc"))
        self.assertEqual(again.steps_done(), 7)
        again.step(5)
        self.assertEqual(again.digest(), simulation.digest())
        self.assertEqual(line_of(again), program("digest", self.folder / "kept.vxc", "--steps", 12))

    def test_pictures(self):
        simulation = voxmelt.Simulation(SMALL)
        picture = voxmelt.Picture(width=160, height=100, depth=True)
        frame = simulation.render(picture)
        program("render", SMALL, "--size", "160x100", "--out", self.folder / "p.png", "--quiet")
        simulation.draw(self.folder / "q.png", picture)
        self.assertEqual((self.folder / "p.png").read_bytes(), (self.folder / "q.png").read_bytes())
        self.assertEqual((frame.rgb.shape, frame.rgb.dtype), ((100, 160, 3), numpy.uint8))
        self.assertEqual(frame.rgb.tobytes(), pixels(self.folder / "p.png"))
        aligned = simulation.render(picture.replace(row_alignment=256))
        self.assertEqual((aligned.stride, aligned.rgb.strides), (512, (512, 3, 1)))
        numpy.testing.assert_array_equal(aligned.rgb, frame.rgb)

        # A depth counts along the direction of view, as that of a pick does.
        hits = {(x, y): simulation.pick(x, y, picture) for x in range(60, 100, 5) for y in range(30, 70, 5)}
        (x, y), hit = next((at, hit) for at, hit in hits.items() if hit and hit.shown == voxmelt.Shown.solid)
        self.assertEqual(numpy.float32(hit.depth), frame.depth[y, x])
        self.assertTrue(simulation.state().solid[hit.matter.z, hit.matter.y, hit.matter.x])
        self.assertIsNone(simulation.pick(0, 0, picture))
        self.assertEqual(frame.depth[0, 0], numpy.inf)
        self.assertIsNone(simulation.render(picture.replace(depth=False)).depth)
        cells = simulation.render_cells(voxmelt.CellView(cut=voxmelt.CellCut(voxmelt.Axis.x, 12)), picture)
        colour = {mark.name: mark.rgb for mark in voxmelt.legend(voxmelt.CellColours.phase)}["solid"]
        self.assertGreater((cells.rgb == colour).all(axis=2).sum(), 20)


class Safety(InFolder):
    def test_a_view_keeps_its_simulation_and_holds_it_still(self):
        simulation = voxmelt.Simulation(self.tiny)
        copied, digest = simulation.state().amount, simulation.digest()
        view = simulation.state().view("amount")
        part = view[2:, ::2]
        self.assertFalse(view.flags.writeable)
        with self.assertRaises(ValueError):
            view.setflags(write=True)
        with self.assertRaises(ValueError):
            view[0, 0, 0] = 1
        del view
        for change in (simulation.step, simulation.restart, lambda: simulation.pour((8, 9, 8), 1, 1),
                       lambda: simulation.set("heat.gamma", 0.3), lambda: simulation.set_vents([])):
            with self.assertRaisesRegex(BufferError, "1 views"):
                change()
        self.assertEqual(simulation.digest(), digest)
        simulation.render(voxmelt.Picture(width=32, height=32))
        del simulation
        gc.collect()
        numpy.testing.assert_array_equal(part, copied[2:, ::2])
        copied[0, 0, 0] = 1  # a copy is one's own

    def test_a_simulation_without_views_goes_on(self):
        simulation = voxmelt.Simulation(self.tiny)
        view = simulation.state().view("heat")
        del view
        self.assertEqual(simulation.step(), 1)
        with self.assertRaisesRegex(TypeError, "bits"):
            simulation.state().view("solid")
        with self.assertRaisesRegex(KeyError, "tone"):
            simulation.state().view("tone")

    def test_an_old_state_says_so(self):
        simulation = voxmelt.Simulation(self.tiny)
        state, field = simulation.state(), simulation.state().fields[3]
        simulation.step()
        for look in (lambda: state.amount, lambda: state.grid, lambda: state.fields, lambda: field.cells, lambda: state.view("heat")):
            with self.assertRaisesRegex(RuntimeError, "moved on"):
                look()

    def test_two_simulations_in_two_threads(self):
        steps = 150
        alone = voxmelt.Simulation(SMALL)
        alone.step(steps)
        found, simulations = {}, [voxmelt.Simulation(SMALL, threads=1) for _ in range(2)]

        def work(number):
            for state in simulations[number].run(steps, every=10 + number):
                found[number] = (line_of(simulations[number]), state.amount)

        threads = [threading.Thread(target=work, args=[number]) for number in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for number in range(2):
            self.assertEqual(found[number][0], line_of(alone))
            numpy.testing.assert_array_equal(found[number][1], alone.state().amount)

    def test_other_threads_run_while_one_steps_and_may_stop_it(self):
        simulation, stop, done = voxmelt.Simulation(SMALL), threading.Event(), []
        thread = threading.Thread(target=lambda: done.append(simulation.step(10**6, stop=stop)))
        thread.start()
        refused = ""
        while "another thread" not in refused:
            try:
                simulation.digest()
            except RuntimeError as error:
                refused = str(error)
        count, end = 0, time.monotonic() + 0.2
        while time.monotonic() < end:
            count += 1
        self.assertGreater(count, 10000)
        stop.set()
        thread.join(20)
        self.assertFalse(thread.is_alive())
        self.assertEqual(done, [simulation.steps_done()])
        with self.assertRaises(voxmelt.Stopped):
            simulation.render(voxmelt.Picture(width=2000, height=2000, quality=voxmelt.Quality.best), stop=stop)

    def test_progress_looks_and_does_not_step(self):
        simulation, seen = voxmelt.Simulation(self.tiny), []

        def progress(done, count):
            seen.append((done, count, simulation.steps_done(), simulation.state().amount.shape))
            with self.assertRaisesRegex(RuntimeError, "in the middle"):
                simulation.step()
            if done == 3:
                raise KeyError("enough")

        with self.assertRaisesRegex(KeyError, "enough"):
            simulation.step(9, progress=progress)
        self.assertEqual(seen, [(i, 9, i, (16, 12, 16)) for i in (1, 2, 3)])
        self.assertEqual(simulation.step(2), 2)
        self.assertEqual(simulation.steps_done(), 5)

    def test_a_thousand_loads_leak_nothing(self):
        def load():
            simulation = voxmelt.Simulation(self.tiny, threads=1)
            simulation.step()
            view, frame = simulation.state().view("amount"), simulation.render(voxmelt.Picture(width=16, height=16))
            fields = [field.cells for field in simulation.state().fields]
            return view, frame, fields, simulation.ledgers(), simulation.changes()

        for _ in range(100):
            load()
        gc.collect()
        before = int(RESIDENT_PAGES.read_text().split()[1])
        for _ in range(1000):
            load()
        gc.collect()
        grown = (int(RESIDENT_PAGES.read_text().split()[1]) - before) * os.sysconf("SC_PAGE_SIZE")
        self.assertLess(grown, 4 << 20)

    def test_ctrl_c_ends_a_call_within_a_second(self):
        setup = (f"import sys, time; sys.path.insert(0, {str(PACKAGE)!r}); import voxmelt\n"
                 f"cello = voxmelt.Simulation({str(ROOT / 'scenes/cello.toml')!r})\n")
        for call in ("cello.step(10**6)", "list(cello.run(10**6, every=10**5))",
                     "cello.render(voxmelt.Picture(width=4000, height=4000, quality=voxmelt.Quality.best))"):
            text = (setup + "print('ready', flush=True)\ntry:\n  " + call + "\nexcept KeyboardInterrupt:\n"
                    "  end = time.time()\n  done = cello.steps_done()\n  cello.step()\n"
                    "  print(end, cello.steps_done() - done, cello.ledgers().balance())\n")
            # A busy machine may be late once, but not four times.
            self.assertTrue(any(self.seconds_of_ctrl_c(text) < 1 for _ in range(4)), call)

    def seconds_of_ctrl_c(self, text):
        """How long a program goes on after Ctrl-C. It must have stepped once more, with its books balanced."""
        child = subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual(child.stdout.readline(), "ready\n")
        time.sleep(0.4)
        sent = time.time()
        child.send_signal(signal.SIGINT)
        said, errors = child.communicate(timeout=60)
        self.assertEqual(said.split()[1:], ["1", "True"], errors)
        return float(said.split()[0]) - sent


class Python(InFolder):
    def test_errors_are_exceptions_of_the_right_kind(self):
        simulation = voxmelt.Simulation(self.tiny)
        bad = self.folder / "bad.toml"
        bad.write_text("[grid]\nsize = [0, 1, 1]\n")
        for kinds, message, call in (
                ((voxmelt.InputError, ValueError, voxmelt.Error, RuntimeError), "bad.toml:2:9: error", lambda: voxmelt.Simulation(bad)),
                ((voxmelt.InputError,), "No such file", lambda: voxmelt.Simulation(self.folder / "missing.toml")),
                ((voxmelt.InputError,), "threads", lambda: voxmelt.Simulation(self.tiny, threads=-1)),
                ((voxmelt.InputError,), "count = -1", lambda: simulation.step(-1)),
                ((voxmelt.InputError,), "every = 0", lambda: simulation.run(3, every=0)),
                ((voxmelt.InputError,), "radius", lambda: simulation.set_vents([voxmelt.Vent(radius=-1)])),
                ((voxmelt.InputError,), "grid.size", lambda: simulation.set("grid.size", 1)),
                ((voxmelt.InputError,), "error", lambda: voxmelt.with_changes("[[grid", [voxmelt.SceneChange(1, "vent.0.rate 0.2")])),
                ((voxmelt.OutputError, OSError), "missing", lambda: simulation.save(self.folder / "missing/file.vxc")),
                ((voxmelt.InputError,), "format", lambda: simulation.export_state(self.folder / "e", "tiff")),
                ((TypeError,), "wrong type", lambda: voxmelt.Vent(radius="wide")),
                ((TypeError,), "no field 'radios'", lambda: voxmelt.Vent(radios=1)),
                ((TypeError,), "twice", lambda: voxmelt.Cell(1, x=2)),
                ((TypeError,), "3 fields", lambda: voxmelt.Cell(1, 2, 3, 4)),
                ((TypeError,), "incompatible", lambda: simulation.step("ten")),
                ((AttributeError,), "", lambda: setattr(voxmelt.Vent(), "radius", 3))):
            for kind in kinds:
                with self.subTest(message), self.assertRaisesRegex(kind, message):
                    call()
        self.assertEqual(simulation.digest(), voxmelt.Simulation(self.tiny).digest())

    def test_run_gives_states(self):
        simulation = voxmelt.Simulation(self.tiny)
        self.assertEqual([(simulation.steps_done(), state.amount.shape) for state in simulation.run(10, every=4)],
                         [(4, (16, 12, 16)), (8, (16, 12, 16)), (10, (16, 12, 16))])
        self.assertEqual(list(simulation.run(0)), [])
        self.assertEqual(sum(1 for _ in simulation.run(every=50)), -(-(simulation.scene_steps() - 10) // 50))
        self.assertEqual(simulation.steps_done(), simulation.scene_steps())

    def test_records_are_values(self):
        vent = voxmelt.Vent((1, 2, 3), rate=0.5)
        self.assertEqual(vent, voxmelt.Vent(at=[1, 2, 3], rate=0.5))
        self.assertNotEqual(vent, vent.replace(until=8))
        self.assertNotEqual(vent, voxmelt.Drain((1, 2, 3), rate=0.5))
        self.assertEqual((vent.radius, vent.temperature, vent.energy, vent.from_, vent.until), (1, 0, 1, 0, voxmelt.NEVER))
        self.assertEqual(eval(repr(vent), vars(voxmelt)), vent)
        source = voxmelt.HeatSource([voxmelt.Keyframe(0, (1, 2, 3), 5)], voxmelt.HeatSourceKind.sphere)
        for record in (vent, source, voxmelt.Picture(camera=voxmelt.Camera(distance=8), width=64)):
            self.assertEqual(pickle.loads(pickle.dumps(record)), record)
            self.assertEqual(copy.deepcopy(record), record)
            self.assertEqual(len({record, copy.copy(record)}), 1)
        self.assertEqual(voxmelt.Grid(3, 4, 5).cells(), 60)

    def test_what_changed(self):
        simulation = voxmelt.Simulation(self.tiny)
        first = simulation.changes()
        self.assertTrue(first.everything)
        self.assertEqual(len(first.bricks), 8)
        self.assertEqual(simulation.changes(first.version).bricks, ())
        simulation.carve((6, 4, 6), 1.5)
        self.assertIn((0, 0, 0), [(brick.x, brick.y, brick.z) for brick in simulation.changes(first.version).bricks])

    def test_docstrings_are_the_headers_words(self):
        header = " ".join((ROOT / "include/voxmelt/voxmelt.h").read_text().replace("///", "").split())
        for name in ("step", "restart", "digest", "pour", "render", "export_state", "numbers"):
            text = " ".join(getattr(voxmelt.Simulation, name).__doc__.split("\n\n", 1)[1].splitlines()[:1])
            self.assertIn(" ".join(text.split()), header, name)
        self.assertIn("centre", voxmelt.Vent.at.__doc__)


if __name__ == "__main__":
    unittest.main(argv=["package_test"], verbosity=1)
