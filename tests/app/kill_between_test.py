#!/usr/bin/env python3
"""A run that dies between two system calls, at any of them (tests/app/kill_at.cpp), is resumed and gives what the
run gives that nobody killed. Nothing is left but the output, and an old output stays until the new one is there. A
signal in the moment at which the folder is made ends it as at any other.

  kill_between_test.py PROGRAM KILL_AT FULL_DISK [PLACES]    so many places of each kind by chance; else all
"""
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from kill_test import outcome
from program import PROGRAM, SMALL, write

KILL_AT, FULL_DISK = (str(Path(path).resolve()) for path in sys.argv[2:4])
PLACES = int(sys.argv[4]) if len(sys.argv) > 4 else None
SEED = random.SystemRandom().randrange(10**6)

SCENE = SMALL.replace("steps = 6", "steps = 4").replace("frame_every = 3", "frame_every = 2")
BEGIN = ["run", "scene.toml", "--out", "out/o", "--checkpoint-every", "1", "--threads", "1", "--quiet"]
RESUME = ["run", "--resume", "out/o"]


def run(folder, arguments, preload="", **variables):
    # without ffmpeg: a film is written by another process
    env = dict(os.environ, LD_PRELOAD=preload, PATH="/nowhere", **{key: str(value) for key, value in variables.items()})
    result = subprocess.run([PROGRAM, *arguments], cwd=folder, env=env, capture_output=True, text=True, timeout=60)
    return result.returncode, result.stderr.strip()


def calls_of(folder, arguments):
    """The calls of a run that ends well, in their order."""
    log = folder.parent / "log"
    code, said = run(folder, arguments, KILL_AT, KILL_LOG=log)
    assert code == 0, said
    calls = log.read_text().split("\n")[:-1]
    log.unlink()
    return calls


def copy(folder, to):
    shutil.rmtree(to, ignore_errors=True)
    shutil.copytree(folder, to)


class Sweep:
    def __init__(self, folder):
        self.folder = folder
        self.work = folder / "work"
        write(folder / "begun", SCENE)
        copy(folder / "begun", self.work)
        self.calls = calls_of(self.work, BEGIN)
        self.whole = outcome(self.work / "out/o", True)

    def starting_points(self):
        """Each kind of run that can die: its folder, and what is typed."""
        folder = self.folder
        yield "the first run", folder / "begun", BEGIN
        copy(folder / "begun", folder / "over")
        code, said = run(folder / "over", [*BEGIN, "--steps", "2"])
        assert code == 0, said
        yield "a run over an old output", folder / "over", BEGIN
        checkpoints = [n for n, call in enumerate(self.calls, 1) if call == "rename"]
        middle = checkpoints[len(checkpoints) // 3]
        copy(folder / "over", folder / "killed")
        code, said = run(folder / "killed", BEGIN, KILL_AT, KILL_AT=middle + 4)
        assert code == -signal.SIGKILL, said
        yield "a resumed run that was killed", folder / "killed", RESUME
        copy(folder / "begun", folder / "interrupted")
        code, said = run(folder / "interrupted", BEGIN, KILL_AT, KILL_AT=middle, KILL_SIGNAL=signal.SIGTERM.value)
        assert code == 4, said
        yield "a resumed run that was interrupted", folder / "interrupted", RESUME
        copy(folder / "over", folder / "full")
        code, said = run(folder / "full", BEGIN, FULL_DISK, FULL_DISK_BYTES=(256 << 10) + 16000)
        assert code == 3 and "--resume out/o` goes on" in said, said
        yield "a resumed run whose disk was full", folder / "full", RESUME

    def dies(self, start, arguments, place, torn, begun):
        copy(start, self.work)
        old = outcome(self.work / "out/o", True) if (self.work / "out/o").exists() else None
        code, said = run(self.work, arguments, KILL_AT, KILL_AT=place, **({"KILL_TORN": 1} if torn else {}))
        assert code == -signal.SIGKILL, f"exit code {code}: {said}"
        if old is not None:
            assert (self.work / "out/o/report.json").exists(), "neither the old nor the new output is there"
            now = outcome(self.work / "out/o", True)
            kept = {name: now[0].get(name) for name in old[0]} == old[0] and now[1] == old[1]
            new = {name: now[0].get(name) for name in self.whole[0]} == self.whole[0] and now[1] == self.whole[1]
            assert kept or new, "what is there is neither the old nor the new output"

        code, said = run(self.work, RESUME)
        # It died before the first checkpoint, or before there was anything of it.
        unknown = code == 0 and not begun and old is not None and outcome(self.work / "out/o", True) == old
        if unknown or (code == 2 and "there is no checkpoint" in said):
            code, said = run(self.work, BEGIN)
        assert code == 0, f"resumed: exit code {code}: {said}"
        left = sorted(p.name for p in (self.work / "out").iterdir())
        assert left == ["o"], f"left over: {left}"
        files, report = outcome(self.work / "out/o", True)
        assert sorted(files) == sorted(self.whole[0]), sorted(set(files) ^ set(self.whole[0]))
        assert (files, report) == self.whole, "another outcome"


    def ends(self, start, arguments, place):
        """A signal while the folder is made, or soon after: what is made is kept, and nothing else is left."""
        copy(start, self.work)
        code, said = run(self.work, arguments, KILL_AT, KILL_AT=place, KILL_SIGNAL=signal.SIGTERM.value)
        assert code == 4, f"exit code {code}: {said}"
        left = sorted(p.name for p in (self.work / "out").glob("*"))
        kept = ["o.incomplete"] if (start / "out/o.incomplete").exists() else []  # until the run is complete
        assert left == ["o", *kept], f"left over: {left}"
        code, said = run(self.work, RESUME)
        assert code == 0, f"resumed: exit code {code}: {said}"
        left = sorted(p.name for p in (self.work / "out").iterdir())
        assert left == ["o"], f"left over: {left}"
        assert outcome(self.work / "out/o", True) == self.whole, "another outcome"


def main():
    chance = random.Random(SEED)
    print(f"seed {SEED}")
    total, failures = 0, []
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        (folder / "begun").mkdir()
        sweep = Sweep(folder)
        for kind, start, arguments in sweep.starting_points():
            copy(start, sweep.work)
            calls = calls_of(sweep.work, arguments)
            places = [(n, False) for n in range(1, len(calls) + 1)]
            places += [(n, True) for n, call in enumerate(calls, 1) if call == "fwrite"]
            for place, torn in places if PLACES is None else chance.sample(places, PLACES):
                call = calls[place - 1]
                where = f"{kind}, killed {'within' if torn else 'before'} call {place} of {len(calls)} ({call})"
                total += 1
                try:
                    sweep.dies(start, arguments, place, torn, place > calls.index("fwrite") + 1 or torn)
                except AssertionError as error:
                    failures.append(f"{where}: {error}")
                    print(failures[-1], flush=True)
            first = calls.index("fwrite") + 1
            for place in range(1, first + 1) if PLACES is None else {1, 2, *chance.sample(range(1, first + 1), 2)}:
                total += 1
                try:
                    sweep.ends(start, arguments, place)
                except AssertionError as error:
                    failures.append(f"{kind}, a signal before call {place} ({calls[place - 1]}): {error}")
                    print(failures[-1], flush=True)
            print(f"{kind}: {len(calls)} calls, {len(places)} places, {first} of a signal", flush=True)
    print(f"{total} deaths and ends, {len(failures)} with another outcome")
    assert total > 0
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
