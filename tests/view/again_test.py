#!/usr/bin/env python3
"""What a hand did is done again, exactly: again_test.py VOXMELT [--journals N --steps M]

Random journals give equal digests by `view --headless`, `digest` and `run`, with the implementations and 1 to 3 threads in
turn; with --journals each journal with every implementation. A page that goes back in time comes to the state that it had, and what came later is forgotten."""
import random
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "app"))
JOURNALS, STEPS, WHOLE = 20, 40, "--journals" in sys.argv
if WHOLE:
    JOURNALS, STEPS = int(sys.argv[sys.argv.index("--journals") + 1]), int(sys.argv[sys.argv.index("--steps") + 1])
    del sys.argv[2:]
from page import Page, Server
from program import PROGRAM, SMALL, voxmelt, write

PAPER = SMALL.replace("size = [12, 10, 12]", "size = [20, 16, 20]").replace("size = [4, 4, 4]", "size = [8, 8, 8]")
VISCOUS = PAPER.replace('law = "paper"', 'law = "viscous"\n[flow.viscous]\nkappa = 0.1\nsubsteps_max = 8')


def change(dice, law, counts):
    """A random change that is right, as its text; `counts` has how many sources, vents and drains there are."""
    place = lambda: " ".join(str(dice.uniform(-4, 24)) for _ in range(3))
    inside = lambda: f"{dice.uniform(0, 20)} {dice.uniform(0, 16)} {dice.uniform(0, 20)}"
    extreme = lambda low, high: dice.choice((low, high, dice.uniform(low, high), dice.uniform(low, high)))
    paper = law == "paper"
    kinds = [lambda: f"heat_source.add {place()} {extreme(0, 4194303) if dice.random() < 0.2 else dice.uniform(0, 90)}",
             lambda: f"vent.add {place()} {dice.uniform(0.1, 5)} {extreme(0.001, 1)} {extreme(0, 1)}",
             lambda: f"drain.add {place()} {dice.uniform(0.1, 5)} {extreme(0.001, 1)}",
             lambda: f"pour {inside()} {dice.uniform(1, 6)} {extreme(0, 1)}",
             lambda: f"carve {inside()} {dice.uniform(1, 5)}",
             lambda: f"heat.gamma {extreme(0, 0.2)}",
             lambda: f"material.melting_point {dice.uniform(0.2, 1)}",
             lambda: f"flow.paper.slump {extreme(0, 1)}" if paper else f"flow.viscous.kappa {dice.uniform(0.001, 1)}",
             lambda: f"flow.fall.minimum {extreme(0, 1)}"]
    parts = {"heat_source": (f"at {place()}", f"power {dice.uniform(0, 90)}"),
             "vent": (f"at {place()}", f"rate {extreme(0.001, 1)}", f"temperature {extreme(0, 1)}", f"radius {dice.uniform(0.1, 6)}"),
             "drain": (f"at {place()}", f"rate {extreme(0.001, 1)}", f"radius {dice.uniform(0.1, 6)}")}
    for name, count in counts.items():
        if count:
            kinds.append(lambda name=name, count=count: f"{name}.{dice.randrange(count)}.{dice.choice(parts[name])}")
            kinds.append(lambda name=name, count=count: f"{name}.{dice.randrange(count)}.remove")
    text = dice.choice(kinds)()
    name = text.split(".")[0]
    if ".add " in text:
        counts[name] += 1
    if text.endswith(".remove"):
        counts[name] -= 1
    return text


def journal(seed, law):
    dice, counts, lines = random.Random(seed), {"heat_source": 1, "vent": 0, "drain": 0}, []
    for step in sorted(dice.randrange(STEPS) for _ in range(dice.randrange(1, 14))):
        lines.append(f"{step} {change(dice, law, counts)}")
    return "\n".join(lines) + "\n"


def digests(*arguments, cwd):
    done = voxmelt(*arguments, cwd=cwd)
    assert done.returncode == 0, done.stderr
    return {int(step): digest for step, digest in re.findall(r"step (\d+) digest ([0-9a-f]{16})", done.stdout)}


class AgainTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)
        self.scenes = {"paper": write(self.path, PAPER), "viscous": write(self.path, VISCOUS, "viscous.toml")}

    def test_random_journals(self):
        listed = voxmelt("list", "implementations").stdout
        names = [line.split()[0] for line in listed.splitlines() if line and not line[0].isspace() and "not" not in line and not line.startswith("gpu:")]
        self.assertIn("reference", names)
        others = [name for name in names if name not in ("reference", "auto")]
        self.assertTrue(others, listed)
        plain = {law: digests("digest", scene, "--steps", STEPS, "--every", 10, cwd=self.path) for law, scene in self.scenes.items()}
        differ = 0
        for seed in range(JOURNALS):
            law = ("paper", "viscous")[seed % 2]
            scene = self.scenes[law]
            write(self.path, journal(seed, law), "journal.txt")
            wanted = digests("digest", scene, "--journal", "journal.txt", "--steps", STEPS, "--every", 10,
                             "--implementation", "reference", cwd=self.path)
            differ += wanted != plain[law]
            for k in range(max(2, len(others)) if WHOLE else 2):
                command = (("view", "--headless"), ("digest",))[k % 2]
                name, threads = others[(seed + k) % len(others)], 1 + (seed + k) % 3
                got = digests(command[0], scene, *command[1:], "--journal", "journal.txt", "--steps", STEPS, "--every", 10,
                              "--implementation", name, "--threads", threads, cwd=self.path)
                self.assertEqual(got, wanted, f"seed {seed}, {command}, {name}, {threads} threads")
        # Some come when all has melted and run off.
        self.assertGreater(differ, 0.8 * JOURNALS, "the journals shall change something")

    def test_run_follows_a_journal_and_goes_on_with_it(self):
        for seed, law in ((3, "viscous"), (8, "paper")):
            scene = self.scenes[law]
            write(self.path, "# by hand\n" + journal(seed, law), "journal.txt")
            wanted = digests("digest", scene, "--journal", "journal.txt", "--steps", STEPS, cwd=self.path)[STEPS]
            whole = voxmelt("run", scene, "--journal", "journal.txt", "--steps", STEPS, "--frame-every", 0, "--out", f"whole{seed}", cwd=self.path)
            self.assertEqual(whole.returncode, 0, whole.stderr)
            self.assertIn(wanted, (self.path / f"whole{seed}/report.json").read_text())
            # The second half needs neither the file of the journal nor the first half.
            half = voxmelt("run", scene, "--journal", "journal.txt", "--steps", STEPS // 2, "--frame-every", 0, "--out", f"half{seed}", cwd=self.path)
            self.assertEqual(half.returncode, 0, half.stderr)
            (self.path / "journal.txt").unlink()
            rest = voxmelt("run", "--resume", f"half{seed}", "--steps", STEPS, cwd=self.path)
            self.assertEqual(rest.returncode, 0, rest.stderr)
            self.assertIn(wanted, (self.path / f"half{seed}/report.json").read_text())

    def test_wrong_journals_are_refused(self):
        for text, place in (("0 heat.gamma 0.1\n3 vent.add 1 2 3 1 7 0.5\n", "bad.txt:2:3: set_vents: error: vent.0.rate = 7"),
                            ("0 heat.gamma nan\n", "bad.txt:1:3: error: heat.gamma nan: not a number"),
                            ("4294967296 heat.gamma 0.1\n", "bad.txt:1:1: error: a line begins"),
                            ("5 pour 90 90 90 1 1\n", "bad.txt:1:3: pour: error: no cell of the grid is in the ball"),
                            ("2 carve 5 5 5 1e300\n", "bad.txt:1:3: carve: error: radius")):
            write(self.path, text, "bad.txt")
            for command in (("view", "--headless"), ("digest",), ("run", "--out", "bad")):
                done = voxmelt(command[0], self.scenes["paper"], *command[1:], "--journal", "bad.txt", "--steps", 10, cwd=self.path)
                self.assertEqual(done.returncode, 2, (command, text))
                self.assertIn(place, done.stderr, command)
        for command in ("digest", "run", "view"):
            done = voxmelt(command, self.scenes["paper"], "--journal", "none.txt", cwd=self.path)
            self.assertEqual((done.returncode, done.stderr), (2, "error: cannot read none.txt: No such file or directory\n"), command)
            done = voxmelt(command, self.scenes["paper"], "--journal", ".", cwd=self.path)
            self.assertEqual((done.returncode, done.stderr), (2, "error: cannot read .: Is a directory\n"), command)

    def test_back_in_time(self):
        for seed, law in ((1, "paper"), (2, "viscous")):
            dice, counts, seen = random.Random(seed), {"heat_source": 1, "vent": 0, "drain": 0}, {}
            with Server(PROGRAM, self.scenes[law], "--threads", 2, "--record", "journal.txt", cwd=self.path) as server, Page(server) as page:
                seen[0] = page.rest(0)[0]["digest"]
                step = 0
                for _ in range(12):
                    page.send("change " + change(dice, law, counts))
                    count = dice.randrange(1, 12)
                    page.send(f"step {count}")
                    step += count
                    seen[step] = page.rest(step)[0]["digest"]
                steps = list(seen)
                recorded = (self.path / "journal.txt").read_text().splitlines()
                for back in (steps[-2], steps[7], steps[3]):
                    page.send(f"back {back}")
                    self.assertEqual(page.rest(back)[0]["digest"], seen[back], f"{law}, step {back}")
                    left = [line for line in recorded if line[0] == "#" or int(line.split()[0]) < back]
                    self.assertEqual((self.path / "journal.txt").read_text().splitlines(), left)
                page.send(f"change pour 10 14 10 3 0.9")
                page.send("step 9")
                last = page.rest(steps[3] + 9)[0]["digest"]
                page.send(f"back {steps[3] + 10}")
                self.assertIn("error: wants a whole number", page.text("refused")["why"])
                end = steps[-1] - 2  # states that were kept up to there are of what does not come now
                page.send(f"step {end + 3 - steps[3] - 9}")
                page.rest(end + 3)
                page.send(f"back {end}")
                later = page.rest(end)[0]["digest"]
                page.send(f"back {end + 1}")
                self.assertIn("error: wants a whole number", page.text("refused")["why"])
                for wrong in ("back", "back -1", "back 1.5", "back nan"):
                    page.send(wrong)
                    self.assertEqual(page.text("refused")["line"], wrong)
                self.assertEqual(server.end(), (0, ""))
            again = digests("view", self.scenes[law], "--headless", "--journal", "journal.txt", "--steps", end, "--every", 1, cwd=self.path)
            self.assertEqual((again[steps[3] + 9], again[end]), (last, later))

    def test_back_in_a_run_that_began_from_a_checkpoint(self):
        with Server(PROGRAM, self.scenes["paper"], cwd=self.path) as server, Page(server) as page:
            page.rest(0)
            page.send("step 20")
            page.rest(20)
            page.send("save checkpoint")
            (self.path / "there.vxc").write_bytes(page.file()[1])
        with Server(PROGRAM, "there.vxc", cwd=self.path) as server, Page(server) as page:
            first = page.rest(20)[0]["digest"]
            page.send("step 30")
            page.rest(50)
            page.send("back 19")
            self.assertEqual(page.text("refused")["why"], "error: this run began at step 20")
            page.send("back 20")
            self.assertEqual(page.rest(20)[0]["digest"], first)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
