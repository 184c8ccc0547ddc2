#!/usr/bin/env python3
"""Every command of the program that README and docs show is one that works, and so is every scene.

  docs_commands_test.py PROGRAM ROOT BUILD          a command that still works after 0.3 s is let go
  docs_commands_test.py PROGRAM ROOT BUILD --whole  each runs to its end (but measurements of half an hour)
  docs_commands_test.py --self-test

Words in capitals stand for something of the reader's: WORDS says what is put in their place. What `./test.sh -R NAME`
names are tests that ctest knows. docs/tutorial.md is followed from its beginning to its end by app.tutorial.
"""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

SCENE = """[grid]
size = [16, 16, 16]
[run]
steps = 40
frame_every = 20
[[solid]]
shape = "sphere"
at = [8, 5, 8]
radius = 4
[heat]
[[heat_source]]
at = [14, 15, 14]
power = 9
[camera]
width = 64
height = 64
"""
WORDS = {"SCENE": "scene.toml", "PLAN.toml": "plan.toml", "FILE": "last.checkpoint", "out/NAME": "out/bunny", "DIR/scene.toml": "exported/scene.toml", "NAME": "out/bunny", "DIR": "dir", "N": "2", "X,Y": "20,9"}
TAKES_LONG = re.compile(r"voxmelt (bench|accuracy|view)\b")
# Of commands that differ, or stop, on purpose.
OTHER_CODES = {"--plant": (0, 1)}


def commands_of(page):
    """Commands of code blocks, of indented code, and in the running text; without comments."""
    text = re.sub(r"^<!--.*?-->", "", page, flags=re.M | re.S)
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.M | re.S):
        for line in block.replace("\\\n", " ").splitlines():
            if re.match(r"voxmelt\s", line):
                yield " ".join(re.sub(r"\s#.*", "", line).split())
    outside = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    for line in re.findall(r"^    (voxmelt .*)", outside, re.M):
        yield " ".join(re.sub(r"\s#.*", "", line).split())
    for code in re.findall(r"`(voxmelt\s[^`]*)`", outside):
        yield " ".join(code.split())


def lacks_a_library(result, error):
    """A build without a library of a command says what brings it."""
    return result == 2 and re.search(r"error: this build has no .*: apt-get install ", error) is not None


def is_mention(command):
    """Whether it names a command, and perhaps options without their values, and is not to be typed as it stands."""
    words = command.split()[2:]
    return all(word.startswith("--") for word in words) and words != ["--quick"]


def filled(command):
    for word, value in WORDS.items():
        command = re.sub(rf"(?<![\w/]){re.escape(word)}(?![\w/])", value, command)
    return command


class Reader:
    """Who tries commands in a folder of their own, where a scene, a finished run and a checkpoint are."""

    def __init__(self, program, root, folder, whole):
        self.folder, self.whole = Path(folder), whole
        (self.folder / "bin").mkdir()
        (self.folder / "bin/voxmelt").symlink_to(program)
        self.env = dict(os.environ, PATH=f"{self.folder / 'bin'}:{os.environ['PATH']}")
        (self.folder / "scene.toml").write_text(SCENE)
        self.must("voxmelt run scene.toml --out out/bunny --quiet")
        self.must("voxmelt run scene.toml --out out/long --quiet")
        (self.folder / "plan.toml").write_text('scene = "scene.toml"\n[axes]\nheat.gamma = [0.05, 0.1]\n')
        self.must("voxmelt run scene.toml --write csv --out out/lava --quiet")
        self.must("voxmelt sweep plan.toml --quiet")
        self.must("voxmelt export scene.toml --out exported --quiet")
        shutil.copytree(self.folder / "out", self.folder / "finished")
        for name in ("hwmodel", "scenes", "tests"):
            (self.folder / name).symlink_to(root / name)
        run = subprocess.Popen(["voxmelt", "run", "scene.toml", "--steps", "4000000", "--frame-every", "0", "--out", "out/stopped", "--quiet"],
                               cwd=self.folder, env=self.env, stderr=subprocess.DEVNULL)
        while not list(self.folder.glob("out/stopped.partial-*/frames")):
            assert run.poll() is None, "the run that is to be stopped has ended"
        run.send_signal(signal.SIGINT)
        run.wait()
        newest = max(self.folder.glob("out/stopped/checkpoints/*"), key=lambda path: path.stat().st_mtime)
        (self.folder / "last.checkpoint").write_bytes(newest.read_bytes())

    def must(self, command):
        subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.env, check=True)

    def offence(self, command, limit=0.3):
        if is_mention(command):
            words = command.split()
            said = subprocess.run([*words[:2], "--help"], cwd=self.folder, env=self.env, capture_output=True, text=True)
            if lacks_a_library(said.returncode, said.stderr):
                return None
            missing = [word for word in words[2:] if not re.search(rf"(?<!\S){re.escape(word)}\b", said.stdout)]
            return f"its help does not name {missing}" if said.returncode != 0 or missing else None
        run = subprocess.Popen(["bash", "-c", "exec " + filled(command)], cwd=self.folder, env=self.env, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
        try:
            error = run.communicate(timeout=1800 if self.whole and not TAKES_LONG.match(command) else limit)[1]
        except subprocess.TimeoutExpired:
            run.send_signal(signal.SIGINT)
            run.communicate()
            shutil.rmtree(self.folder / "out")  # a stopped run is not replaced
            shutil.copytree(self.folder / "finished", self.folder / "out")
            return "it did not end" if self.whole and not TAKES_LONG.match(command) else None
        if lacks_a_library(run.returncode, error):
            return None
        fine = next((codes for word, codes in OTHER_CODES.items() if word in command), (0,))
        return None if run.returncode in fine else f"exit code {run.returncode}: {error.strip()[-300:]}"


def pages(root):
    return [root / "README.md", *(page for page in sorted((root / "docs").rglob("*.md")) if page.name != "tutorial.md")]


def tests_named(page):
    return [name.replace("\\|", "|") for name in re.findall(r"-R \"?([\w.\\|]+)", page)]


def offences(root, reader, known):
    found, counts, tried = [], [0, 0, 0], set()
    not_built = [part for part in ("python", "view") if not any(test.startswith(part + ".") for test in known)]
    for page in pages(root):
        name, text = page.relative_to(root).as_posix(), page.read_text()
        for command in commands_of(text):
            if command in tried:
                continue
            tried.add(command)
            if wrong := reader.offence(command):
                found.append(f"{name}: {command}: {wrong}")
            counts[0] += 1
        for number, scene in enumerate(re.findall(r"^```toml\n(.*?)^```", text, re.M | re.S), 1):
            (reader.folder / "fragment.toml").write_text(scene)
            plan = "\n[axes]" in scene  # of a sweep
            if wrong := reader.offence("voxmelt sweep fragment.toml --emit make" if plan
                                       else "voxmelt digest fragment.toml --steps 1"):
                found.append(f"{name}: its scene {number}: {wrong}")
            counts[1] += 1
        for pattern in tests_named(text):
            if not any(re.search(pattern, test) for test in known) and pattern.split(".")[0] not in not_built:
                found.append(f"{name}: no test is called {pattern}")
            counts[2] += 1
    return found, counts


def self_test():
    page = ("```sh\nvoxmelt run a \\\n  --steps 2   # two\nls\n```\n    voxmelt info b  # c\nSee `voxmelt\nlist scenes` and `voxmelt run`.\n"
            "`./test.sh -R \"A\\|b.c\"`\n")
    assert list(commands_of(page)) == ["voxmelt run a --steps 2", "voxmelt info b", "voxmelt list scenes", "voxmelt run"], list(commands_of(page))
    assert tests_named(page) == ["A|b.c"], tests_named(page)
    assert is_mention("voxmelt verify --shrink") and not is_mention("voxmelt run a --quiet")
    assert filled("voxmelt render SCENE --steps N --trace X,Y") == "voxmelt render scene.toml --steps 2 --trace 20,9"
    assert filled("voxmelt run --resume out/NAME") == "voxmelt run --resume out/bunny"
    print("commands are found as they are written")


def main():
    program, root, build = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3]
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True, text=True)
    known = {test["name"] for test in json.loads(shown.stdout)["tests"]}
    with tempfile.TemporaryDirectory() as folder:
        reader = Reader(program, root, folder, "--whole" in sys.argv)
        found, counts = offences(root, reader, known)
        for planted in ("voxmelt run SCENE --stepz 3", "voxmelt run --shrink", "voxmelt verify nowhere --steps 2"):
            if reader.offence(planted, 60) is None:
                found.append(f"planted, and not found: {planted}")
    if counts[0] < 50 or counts[1] < 1 or counts[2] < 50:
        found.append(f"only {counts} commands, scenes and names of tests were found")
    print("\n".join(found) or "{} commands, {} scenes, {} names of tests".format(*counts))
    sys.exit(bool(found))


if __name__ == "__main__":
    self_test() if sys.argv[1:] == ["--self-test"] else main()
