#!/usr/bin/env python3
"""foreign_scenes_test.py notices planted differences, keeps the scene, and its command finds the difference again.

  foreign_scenes_selftest.py VOXMELT ORACLE
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TEST = Path(__file__).with_name("foreign_scenes_test.py")
LAST = 19  # seeds 0..LAST; it stops at the first difference

# Each is a program that runs the true one, with something changed.
WRAPPER = """#!{python}
import json, pathlib, re, subprocess, sys
words = sys.argv[1:]
def option(name):
    return words[words.index(name) + 1] if name in words else None
def finish(code=0, change=lambda text: text):
    done = subprocess.run([{program!r}, *words], capture_output=True, text=True)
    print(change(done.stdout), end="")
    print(done.stderr, end="", file=sys.stderr)
    sys.exit(code or done.returncode)
mine = option("--implementation") == {implementation!r} and option("--steps") == "7"
{planted}
finish()
"""
PLANTED = {  # name: (which program, what is changed, what the message says)
    "another seed": ("oracle", """
file = pathlib.Path(words[0]) / "parameters.json"
file.write_text(json.dumps({**json.loads(file.read_text()), "seed": 5}))
""", "digests"),
    "a step less": ("oracle", """
words[words.index("--steps") + 1] = str(int(option("--steps")) - 1)
""", "digests"),
    "all solids of one material": ("oracle", """
file = pathlib.Path(words[0]) / "material.npy"
if file.exists():
    data = file.read_bytes()
    file.write_bytes(data[:128] + bytes(len(data) - 128))
""", "digests"),
    "a term of a ledger": ("oracle", r"""
finish(change=lambda text: re.sub(r"(ledger heat .*) (\S+) ", lambda m: f"{m[1]} {int(m[2]) + 1} ", text))
""", "ledger of heat"),
    "what a state holds": ("oracle", r"""
finish(change=lambda text: re.sub(r"(ledger energy .*) (\S+)\n", lambda m: f"{m[1]} {int(m[2]) + 1}\n", text))
""", "ledger of energy"),
    "a counter": ("oracle", r"""
finish(change=lambda text: re.sub(r"(counters .*) (\S+)\n", lambda m: f"{m[1]} {int(m[2]) + 1}\n", text))
""", "counters"),
    "a violated bound": ("oracle", "finish(code=1)", "ended with 1"),
    "one implementation, a parameter": ("voxmelt", """
if mine: words += ["--set", "material.melting_point=0.9", "--set", "material.latent_heat=0"]
""", "digests"),
    "one implementation, a digit": ("voxmelt", r"""
if mine: finish(change=lambda text: re.sub(r"(step 6 digest )(.)", lambda m: m[1] + ("1" if m[2] == "0" else "0"), text))
""", "digests"),
    "one implementation, a ledger": ("voxmelt", """
if mine:
    subprocess.run([{program!r}, *words], stdout=subprocess.DEVNULL)
    file = pathlib.Path(option("--report"))
    report = json.loads(file.read_text())
    report["mass"]["removed"] += 1
    words[words.index("--report") + 1] = str(file) + ".true"
    file.write_text(json.dumps(report))
""", "ledger of mass"),
    "one implementation, no answer": ("voxmelt", "if mine: finish(code=3)", "ended with 3"),
}


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def try_one(name, programs, implementation, folder):
    which, planted, says = PLANTED[name]
    wrapper = folder / which
    program = str(programs[which])
    planted = planted.replace("{program!r}", repr(program))
    wrapper.write_text(WRAPPER.format(python=sys.executable, program=program, implementation=implementation, planted=planted))
    wrapper.chmod(0o755)
    mixed = {**programs, which: wrapper}
    code, text = run(sys.executable, TEST, mixed["voxmelt"], mixed["oracle"], 0, LAST)
    assert code == 1 and says in text, f"{name}: not noticed, or not said:\n{code} {text}"
    kept = Path(re.search(r"The scene is in (\S+)\. ", text)[1])
    assert (kept / "scene.toml").exists(), f"{name}: {kept} does not hold the scene"
    assert len(list(kept.parent.iterdir())) == 1, f"{name}: other scenes are kept, too"
    again, text = run(*text.splitlines()[-1].split())
    assert again == 1 and says in text, f"{name}: the printed command finds nothing:\n{text}"


def main():
    programs = {name: Path(word).resolve() for name, word in zip(("voxmelt", "oracle"), sys.argv[1:3])}
    listed = run(programs["voxmelt"], "list", "implementations")[1].splitlines()
    implementation = [line for line in listed if "not on this processor" not in line and not line.startswith("gpu:")][-1].split()[0]
    with tempfile.TemporaryDirectory() as folder:
        os.environ["TMPDIR"] = folder
        for n, name in enumerate(PLANTED):
            (Path(folder) / str(n)).mkdir()
            try_one(name, programs, implementation, Path(folder) / str(n))
        code, text = run(sys.executable, TEST, *programs.values(), 0, 2, "--covering")
        assert code == 1 and "in no scene" in text, f"three scenes cover every end:\n{text}"
    print(f"all {len(PLANTED)} planted differences noticed")


main()
