#!/usr/bin/env python3
"""Checkpoints as a user meets them: interrupted runs go on, other commands begin there, damaged files are refused."""
import json
import random
import re
import resource
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import checkpoint_reader
from program import PROGRAM, SMALL, voxmelt, write

LONG = SMALL.replace("steps = 6", "steps = 2000").replace("frame_every = 3", "frame_every = 250")
LONG = LONG.replace("temperature = 0.49", "temperature = 0.0").replace("melting_point = 0.5", "melting_point = 0.5\nlatent_heat = 0.45")


def report_of(folder):
    report = json.loads((folder / "report.json").read_text())
    for cost in ("seconds", "memory", "implementation_reason"):  # two first runs at once both make a trial
        del report[cost]
    del report["visibility"]["rays_cast"]
    return report


def outcome(folder):
    files = {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*")
             if p.is_file() and p.name != "last.vxc"}  # it says who ran, and for how long
    del files["report.json"]
    return files, report_of(folder)


class Checkpoints(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.scene = write(cls.folder, LONG)
        assert voxmelt("run", cls.scene, "--out", "whole", "--quiet", cwd=cls.folder).returncode == 0
        cls.kept = cls.begin_and_end("kept", signal.SIGTERM)
        cls.checkpoint = sorted((cls.kept / "checkpoints").iterdir())[-1]
        cls.step = int(cls.checkpoint.stem[5:])

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def begin_and_end(cls, out, how):
        """A run that gets a signal between its first steps and its last: at least two checkpoints are there."""
        process = subprocess.Popen([PROGRAM, "run", str(cls.scene), "--out", out, "--checkpoint-every", "7"],
                                   cwd=cls.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while not any(int(p.stem[5:]) >= 21 for p in cls.folder.glob(f"{out}.partial-*/checkpoints/*.vxc")):
            assert process.poll() is None and time.monotonic() < deadline, process.communicate()
        process.send_signal(how)
        cls.said = process.communicate(timeout=60)[1]
        assert process.returncode == (4 if how == signal.SIGTERM else -how), (process.returncode, cls.said)
        return cls.folder / out if how == signal.SIGTERM else next(cls.folder.glob(f"{out}.partial-*"))

    def refused(self, *arguments, names, code=2, seconds=2):
        before = sorted(p for p in self.folder.rglob("*"))
        begin = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime  # other programs do not count
        result = voxmelt(*arguments, cwd=self.folder)
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - begin, seconds)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn(names, result.stderr)
        self.assertEqual(sorted(p for p in self.folder.rglob("*")), before, "nothing is written")
        return result.stderr

    def test_a_checkpoint_is_not_what_resume_wants(self):
        file = max((self.folder / "kept/checkpoints").iterdir())
        for given, hint in ((file, ", kept"), (self.scene, "")):
            result = voxmelt("run", "--resume", given, cwd=self.folder)
            self.assertEqual((result.returncode, result.stderr), (
                2, f"--resume {given}: error: is a file; give the folder of the run's output{hint}\n"))

    def test_an_interrupted_run_goes_on(self):
        kept = self.begin_and_end("ended", signal.SIGTERM)
        self.assertIn("voxmelt run --resume ended", self.said)
        self.assertIs(json.loads((kept / "report.json").read_text())["complete"], False)
        result = voxmelt("run", "--resume", "ended", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(outcome(kept), outcome(self.folder / "whole"))
        again = voxmelt("run", "--resume", "ended", cwd=self.folder)
        self.assertEqual((again.returncode, again.stdout), (0, "the run in ended is complete; --steps +N goes on\n"))

    def test_a_killed_run_is_found_by_its_name_and_kept_from_others(self):
        partial = self.begin_and_end("died", signal.SIGKILL)
        steps = [int(p.stem[5:]) for p in (partial / "checkpoints").glob("*.vxc")]
        self.assertEqual({step % 7 for step in steps}, {0}, "every seventh step, as it was asked for")
        said = self.refused("run", self.scene, "--out", "died", names="died.partial-")
        self.assertIn("voxmelt run --resume died", said)
        for old in sorted((partial / "checkpoints").glob("*.vxc"))[-1:]:  # the newest one is damaged
            data = bytearray(old.read_bytes())
            data[len(data) // 2] ^= 1
            old.write_bytes(data)
        result = voxmelt("run", "--resume", partial.name, "--implementation", "reference", "--threads", "1",
                         cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("an older checkpoint will do", result.stderr)
        self.assertEqual(list(self.folder.glob("died.*")), [])
        files, report = outcome(self.folder / "died")
        expected_files, expected = outcome(self.folder / "whole")
        self.assertEqual(files, expected_files)
        self.assertEqual(report["implementation"], "reference")
        for key in set(expected) - {"implementation", "implementation_reason", "threads", "visibility"}:
            self.assertEqual(report[key], expected[key], key)

    # The frame of the former last step is one of the longer run, or it is not.
    def test_a_complete_run_goes_on_with_more_steps(self):
        def run(out, *arguments):
            result = voxmelt("run", *arguments, "--quiet", cwd=self.folder)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            return outcome(self.folder / out)
        short = ("--frame-every", "3", "--size", "64x48")
        for first, more, last in (("7", "+5", "12"), ("6", "12", "12"), ("6", "+0", "6"), ("0", "+4", "4")):
            with self.subTest(first=first, more=more):
                wanted = run("straight", self.scene, "--out", "straight", "--steps", last, *short)
                run("longer", self.scene, "--out", "longer", "--steps", first, *short)
                self.assertEqual(run("longer", "--resume", "longer", "--steps", more), wanted)
        self.refused("run", "--resume", "longer", "--steps", "3", names="--steps 3: error: step 4 of this run is done already")
        self.refused("run", "--resume", "longer", "--steps", "+4294967295", names="step numbers end at 4294967295")
        self.refused("run", self.scene, "--steps", "+3", names="--steps +3: error: +N means steps further than the run of --resume has made")
        self.assertEqual(voxmelt("info", "longer/last.vxc", cwd=self.folder).returncode, 0)
        (self.folder / "longer/last.vxc").unlink()
        self.refused("run", "--resume", "longer", "--steps", "+3", names="the run is complete, and its last state is not there")

    def test_a_stopped_run_is_not_replaced(self):
        before = outcome(self.folder / "kept")
        for arguments in (["run", self.scene, "--steps", "3"], ["export", self.scene], ["render", self.scene, "--turntable", "2"]):
            self.refused(*arguments, "--out", "kept", names=f"holds a run that was stopped, with a checkpoint of step {self.step}; `voxmelt run --resume kept`")
        self.assertEqual(outcome(self.folder / "kept"), before)
        self.assertEqual(voxmelt("info", "whole", cwd=self.folder).returncode, 0, "its last state")

    def test_nothing_to_resume(self):
        self.refused("run", "--resume", "nowhere", names="there is no checkpoint in it")
        self.refused("run", "--resume", "kept", self.scene, names="--resume")
        self.refused("run", "--resume", "kept", "--steps", "9", names=f"--steps 9: error: step {self.step} of this run is done already")
        self.refused("run", "--resume", "kept", "--set", "heat.gamma=0.1", names="--resume")
        self.refused("run", names="a scene, or --resume FOLDER")
        for every in ("0", "s", "0s", "-3", "1.5", "10m", ""):
            with self.subTest(every):
                self.refused("run", self.scene, f"--checkpoint-every={every}", names="--checkpoint-every")

    def test_a_scene_that_changed_is_said_and_changes_nothing(self):
        text = self.scene.read_text()
        self.begin_and_end("moved", signal.SIGTERM)
        try:
            self.scene.write_text(text.replace("power = 30", "power = 10"))
            result = voxmelt("run", "--resume", "moved", "--quiet", cwd=self.folder)
        finally:
            self.scene.write_text(text)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"warning: {self.scene} is no longer what this run has read", result.stderr)
        self.assertEqual(outcome(self.folder / "moved"), outcome(self.folder / "whole"))

    def test_the_format(self):
        head, columns = checkpoint_reader.read(self.checkpoint)
        export = voxmelt("export", self.scene, "--steps", self.step, "--out", "exported", "--quiet", cwd=self.folder)
        self.assertEqual(export.returncode, 0, export.stderr)
        for name in ("solid", "liquid", "inert", "amount", "energy", "heat"):
            data = (self.folder / f"exported/{name}.npy").read_bytes()
            self.assertEqual(columns[name], data[10 + int.from_bytes(data[8:10], "little"):], name)
        self.assertTrue(any(columns["light"]), "the source lights something")
        self.assertEqual(head["run"]["steps_done"], self.step)
        self.assertEqual(json.loads(head["scene"]["parameters"])["seed"], 1)
        files = head["scene"]["files"]
        self.assertEqual([f["file"] for f in files], [str(self.scene)])
        self.assertEqual(int(files[0]["xxh3"], 16), checkpoint_reader.xxh3(self.scene.read_bytes()))
        for frame in json.loads(head["command"])["frames"]:
            content = (self.kept / "frames" / frame["file"]).read_bytes()
            self.assertEqual((len(content), checkpoint_reader.xxh3(content)), (frame["bytes"], frame["xxh3"]))

    def test_info(self):
        for given in (self.checkpoint, self.kept):
            result = voxmelt("info", given, cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"step           {self.step} of 2000", result.stdout)
            line = voxmelt("digest", self.scene, "--steps", self.step, cwd=self.folder).stdout
            self.assertIn(f"digest         {line.split()[3]}\n", result.stdout)
            self.assertIn(f"{self.scene}  {self.scene.stat().st_size} bytes, as it was", result.stdout)

    def test_other_commands_begin_there(self):
        later = self.step + 5
        for arguments in (["digest", "--steps", later], ["digest", "--steps", later, "--implementation", "reference"]):
            name, *rest = arguments
            self.assertEqual(voxmelt(name, self.checkpoint, *rest).stdout, voxmelt(name, self.scene, *rest).stdout)
        for step in (self.step, later):
            for begin, out in ((self.checkpoint, "a"), (self.scene, "b")):
                for arguments in (["export", begin, "--out", out], ["render", begin, "--out", f"{out}.png"]):
                    result = voxmelt(*arguments, "--steps", step, "--quiet", cwd=self.folder)
                    self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())
            for field in (self.folder / "a").iterdir():
                self.assertEqual(field.read_bytes(), (self.folder / "b" / field.name).read_bytes(), field.name)
        result = voxmelt("verify", self.checkpoint, "--steps", 2, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("no difference", result.stdout)
        from_it = voxmelt("verify", self.scene, "--from", self.checkpoint, "--steps", 2, cwd=self.folder)
        self.assertEqual(from_it.returncode, 0, from_it.stderr)
        untimed = [re.sub("[0-9.]+ million cell-steps a second", "", r.stdout) for r in (from_it, result)]
        self.assertEqual(*untimed)
        other = write(self.folder, LONG.replace("power = 30", "power = 31"), "other.toml")
        self.refused("verify", other, "--from", self.checkpoint, names="is of another scene")
        self.refused("bench", "--from", self.scene, names="neither a step nor a checkpoint")
        self.refused("digest", self.checkpoint, "--set", "heat.gamma=0.1", names="come too late")
        self.refused("render", self.checkpoint, "--steps", 3, names=f"is at step {self.step} already")
        self.refused("export", self.checkpoint, "--steps", 3, "--out", "c", names=f"is at step {self.step} already")

    def test_hostile_files(self):
        whole = self.checkpoint.read_bytes()
        hostile = self.folder / "hostile.vxc"
        chance = random.Random(19)
        begins = [at for *_, at in checkpoint_reader.blocks(whole)]
        broken = {f"cut at {at}": whole[:at] for b in begins for at in (b, b + 20, b + 40)}
        for _ in range(100):
            bit = chance.randrange(8 * len(whole))
            data = bytearray(whole)
            data[bit // 8] ^= 1 << bit % 8
            broken[f"bit {bit}"] = bytes(data)
        broken |= {"empty": b"", "longer": whole + b"\0", "text": b"title = 1\n", "noise": chance.randbytes(5000)}
        for name, data in broken.items():
            with self.subTest(name):
                hostile.write_bytes(data)
                self.refused(chance.choice(["info", "digest", "render"]), hostile, names=f"{hostile}: error: ")
        hostile.write_bytes(whole[:8] + b"\2" + whole[9:])
        self.refused("info", hostile, names="has version 2 of the format; this program reads version 1")
        hostile.write_bytes(b"title = 1\n")
        self.refused("info", hostile, names="is no checkpoint of voxmelt")
        hostile.unlink()
        self.refused("info", hostile, names="there is no such file")
        (self.folder / "empty").mkdir()
        self.refused("info", self.folder / "empty", names="there is no checkpoint in it")


    # Whoever writes one by hand gets the checksums right, and the digest too.
    def crafted(self, change=None, head_change=None):
        head, columns = checkpoint_reader.read(self.checkpoint)
        columns = {name: bytearray(cells) for name, cells in columns.items()}
        if change is not None:
            change(columns)
        head["digest"] = checkpoint_reader.state_digest(columns)
        if head_change is not None:
            head_change(head)
        contents = []
        x = head["grid"][0]
        for kind, first, count, raw, stored, _ in checkpoint_reader.blocks(self.checkpoint.read_bytes()):
            if kind == "end":
                break
            content = checkpoint_reader.unpack(stored, raw)
            if kind == "head":
                content = json.dumps(head).encode()
            elif kind in ("solid", "liquid", "inert"):
                rows = [columns[kind][i:i + x] for i in range(0, len(columns[kind]), x)]
                content = b"".join(sum(bit << i for i, bit in enumerate(row)).to_bytes(-(-x // 64) * 8, "little") for row in rows)
            elif kind in columns:
                content = bytes(columns[kind])
            contents.append((kind, first, count, content))
        file = self.folder / "crafted.vxc"
        file.write_bytes(checkpoint_reader.sealed(contents))
        return file

    def test_crafted_files(self):
        good = self.crafted()
        self.assertEqual(voxmelt("digest", good).stdout, voxmelt("digest", self.checkpoint).stdout)
        air = next(i for i, kinds in enumerate(zip(*self.masks())) if kinds == (0, 0, 0))
        # on a busy machine all has melted before the signal comes
        matter, kinds = next((i, kinds) for i, kinds in enumerate(zip(*self.masks()))
                             if kinds in ((1, 0, 0), (0, 1, 0)))
        other = "liquid" if kinds[0] else "solid"

        def put(column, cell, value):
            def change(columns):
                if column in ("amount", "energy", "heat"):
                    columns[column][2 * cell:2 * cell + 2] = value.to_bytes(2, "little")
                else:
                    columns[column][cell] = value
            return change

        for change in (put(other, matter, 1), put("inert", matter, 1), put("amount", air, 7), put("energy", air, 7),
                       put("solid", air, 1), put("amount", matter, 0)):
            self.refused("digest", self.crafted(change), names="crafted.vxc: error: ")

        def set_head(*path, value):
            def change(head):
                for key in path[:-1]:
                    head = head[key]
                head[path[-1]] = value
            return change

        head, _ = checkpoint_reader.read(self.checkpoint)
        for change, names in (
                (set_head("digest", value="0" * 16), "its cells do not have the digest"),
                (set_head("grid", value=[1, 1, 1]), "bytes, not"),
                (set_head("grid", value=[4096, 4096, 4096]), "bytes, not"),
                (set_head("grid", value=head["grid"][:2]), "grid is no size of a grid"),
                (set_head("scene", "parameters", value="{}"), "resolves its scene to other parameters"),
                (set_head("scene", "settings", value="[grid]\nsize = [2, 2, 2]\n"), "another grid than its cells"),
                (set_head("scene", "settings", value="[gird]\nsize = [2, 2, 2]\n"), "(its scene):1:"),
                (set_head("run", "mass", "start", value="1e5"), "run.mass.start is no sum in decimal digits"),
                (set_head("run", "steps_done", value=-1), "run.steps_done is out of its range"),
                (set_head("radiates", value=False), "its last block does not fit the others"),
                (set_head("scene", "warnings", value=[1]), "scene.warnings are no texts")):
            with self.subTest(names):
                self.refused("digest", self.crafted(head_change=change), names=names)

    def test_a_run_is_not_resumed_by_numbers_that_do_not_fit(self):
        head, _ = checkpoint_reader.read(self.checkpoint)
        crafted = self.folder / "crafted"
        (crafted / "checkpoints").mkdir(parents=True)
        for key, value in (("steps", 1e19), ("steps", 2.5), ("steps", 2**32 + 5), ("steps", -1), ("frame_every", True),
                           ("threads", 2**31), ("seed", 1e19), ("watch", [0, 0, 0, 0, -1]), ("watch", [2**31, 0, 0, 0, 0])):
            with self.subTest(f"{key} {value}"):
                command = json.loads(head["command"])
                command[key] = value
                file = self.crafted(head_change=lambda head: head.update(command=json.dumps(command)))
                file.rename(crafted / "checkpoints" / self.checkpoint.name)
                self.refused("run", "--resume", "crafted", names=f"command.{key} is out of its range")
        command = {**json.loads(head["command"]), "setting": "better"}
        file = self.crafted(head_change=lambda head: head.update(command=json.dumps(command)))
        file.rename(crafted / "checkpoints" / self.checkpoint.name)
        self.refused("run", "--resume", "crafted", names="command.setting is none of this program's")

    def masks(self):
        _, columns = checkpoint_reader.read(self.checkpoint)
        return columns["solid"], columns["liquid"], columns["inert"]


if __name__ == "__main__":
    unittest.main(argv=["checkpoint_test"], verbosity=1)
