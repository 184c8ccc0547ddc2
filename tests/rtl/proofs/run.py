#!/usr/bin/env python3
"""What is proved of the stages in SystemVerilog, by Yosys and z3.

  tests/rtl/proofs/run.py --check         every part, register and planted bug is there: one of ./test.sh
  tests/rtl/proofs/run.py                 proves every property
  tests/rtl/proofs/run.py --mutants       plants each property's bug, and wants the proof to fail
  tests/rtl/proofs/run.py --only NAME     those whose name holds this expression
  tests/rtl/proofs/run.py --docs FILE     does both, and writes the page

A proof of proofs.toml is a module beside this file. It looks at registers within a part, and says in assertions what
holds. A part without feedback forgets what it held: where all registers begin with any value, so many moves prove all.
"""
import argparse
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
RTL = HERE.parents[2] / "hwmodel/rtl"
KEYS = {"name", "part", "file", "with", "looks_at", "moves", "induction", "logic", "says", "property", "memory", "lemmas"}
PROPERTY_KEYS = {"name", "says", "file", "bug", "becomes"}
SECONDS = 240  # for one property


def read_proofs():
    return tomllib.loads((HERE / "proofs.toml").read_text())["proof"]


def sources_of(text):
    """The files of the parts that a text names, and those of the parts in them."""
    parts = {file.stem: file for file in RTL.glob("*.sv")}
    found, wanted = [], set(re.findall(r"\w+", text)) & set(parts)
    while wanted:
        name = wanted.pop()
        found.append(name)
        wanted |= set(re.findall(r"^\s*(\w+)\s+(?:#\(|\w+ \()", parts[name].read_text(), re.M)) & set(parts)
        wanted -= set(found)
    order = ["voxmelt_pkg"] + sorted(set(found) - {"voxmelt_pkg"})
    return [parts[name] for name in order]


def assertions_of(proof):
    if proof.get("lemmas"):
        return sorted(file.stem for file in HERE.glob("*.smt2"))
    return re.findall(r"^\s*(\w+): assert \(", (HERE / f"{proof['name']}.sv").read_text(), re.M)


def looks_after(proof):
    """The numbers of moves after which a proof looks at something."""
    if proof.get("lemmas"):
        return []
    text = (HERE / f"{proof['name']}.sv").read_text()
    return [int(age) for age in re.findall(r"age == 8'd(\d+)\) begin\n\s+\w+: assert", text)]


def script(proof, files, wanted, out, together):
    """What Yosys does: registers that the proof looks at become ports of the part. Assertions stay `together` in an
    induction, where each is proved with the help of the others."""
    reads = "-D VOXMELT_BLOCKS " if not proof.get("logic") else ""
    lines = [f"read_verilog -sv {reads}{' '.join(map(str, files))}"]
    lines += [f"chparam -set {key} {value} {proof['part']}" for key, value in proof.get("with", {}).items()]
    lines += [f"hierarchy -top {proof['part']}", "proc", "flatten"]
    if proof.get("memory"):
        lines += ["memory -nomap", "memory_map", "opt_clean"]
    for wire in proof.get("looks_at", []):
        lines += [f"select -assert-count 1 w:{wire}", f"expose w:{wire}"]
    lines += [f"read_verilog -formal -sv {HERE / 'past.sv'} {HERE / (proof['name'] + '.sv')}",
              "prep -flatten -top proof", f"select -assert-count 1 t:$assert n:{wanted} %i",
              *([] if together else [f"delete t:$assert n:{wanted} %d"]), "memory_map", "async2sync", "dffunmap", f"write_smt2 -wires {out}"]
    return "\n".join(lines) + "\n"


def run(command, seconds):
    """Output of a command, and its seconds of processor; None if it did not end."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                             start_new_session=True)
    try:
        text, _ = child.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(child.pid, 9)
        child.communicate()
        return None, child.returncode, float(seconds)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return text, child.returncode, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def solve(proof, wanted, folder, files, plant):
    """"holds", "fails" or "no answer", and seconds of processor. A bug has to show from the reset on."""
    if proof.get("lemmas"):
        text, _, spent = run(["z3", str(files[0])], SECONDS)
        return {None: "no answer", "unsat": "holds", "sat": "fails"}.get(text and text.strip(), f"error: {text}"), spent
    steps, smt = folder / "proof.ys", folder / "proof.smt2"
    steps.write_text(script(proof, files, wanted, smt, "induction" in proof and not plant))
    text, code, spent = run(["yosys", "-q", "-s", str(steps)], SECONDS)
    if code != 0:
        sys.exit(f"{proof['name']}: yosys: {text}")
    depths = [["-t", str(proof["moves"] + 1)]]
    if "induction" in proof and not plant:
        depths.append(["-i", "-t", str(proof["induction"])])
    for depth in depths:
        answer, _, seconds = run(["yosys-smtbmc", "-s", "z3", "--unroll", "--noincr", *depth, str(smt)], SECONDS)
        spent += seconds
        if answer is None:
            return "no answer", spent
        if "Status: PASSED" not in answer:
            return ("fails" if "Status: FAILED" in answer else f"error: {answer[-400:]}"), spent
    return "holds", spent


def planted(files, one, folder):
    """The files, one of them with the bug."""
    changed = []
    for file in files:
        if file.name == one["file"]:
            text = file.read_text()
            copy = folder / file.name
            copy.write_text(text.replace(one["bug"], one["becomes"]))
            file = copy
        changed.append(file)
    return changed


def check(proofs):
    """All that can be seen without a proof."""
    wrong = []
    for proof in proofs:
        folder = HERE if proof.get("lemmas") else RTL
        if set(proof) - KEYS:
            wrong.append(f"{proof['name']}: unknown keys {set(proof) - KEYS}")
        here = assertions_of(proof)
        listed = [one["name"] for one in proof["property"]]
        if sorted(here) != sorted(listed):
            wrong.append(f"{proof['name']}: assertions {here}, listed {listed}")
        ages = looks_after(proof)
        if ages and max(ages) != proof["moves"]:
            wrong.append(f"{proof['name']}: {proof['moves']} moves, but looks after {ages}")
        for one in proof["property"]:
            if set(one) != PROPERTY_KEYS:
                wrong.append(f"{proof['name']}.{one['name']}: keys {sorted(one)}")
            elif (folder / one["file"]).read_text().count(one["bug"]) != 1:
                wrong.append(f"{proof['name']}.{one['name']}: {one['file']} does not have once: {one['bug']}")
    for line in wrong:
        print(line)
    print(f"{sum(len(proof['property']) for proof in proofs)} properties of {len(proofs)} proofs")
    return not wrong


def files_of(proof, one):
    """The parts that a proof reads, or a lemma alone."""
    if proof.get("lemmas"):
        return [HERE / one["file"]]
    return sources_of(f"{proof.get('file', proof['part'])} {(HERE / (proof['name'] + '.sv')).read_text()}")


def prove(proofs, only, plant):
    """Rows of what was found; the answer that is wanted in each is "holds", or "fails" with a bug planted."""
    rows = []
    for proof in proofs:
        for one in proof["property"]:
            files = files_of(proof, one)
            name = f"{proof['name']}.{one['name']}"
            if not re.search(only, name):
                continue
            with tempfile.TemporaryDirectory() as folder:
                used = planted(files, one, Path(folder)) if plant else files
                answer, seconds = solve(proof, one["name"], Path(folder), used, plant)
            rows.append((name, answer, seconds))
            print(f"{name:44} {'with a bug: ' if plant else ''}{answer} ({seconds:.1f} s)", flush=True)
    return rows


HEAD = """<!-- Written by tests/rtl/proofs/run.py -->
# What is proved of the stages in SystemVerilog

Each property is an assertion in `tests/rtl/proofs`. Yosys and z3 prove it: where a part has no
feedback, from any state of its registers; for a channel by induction; for what counts, in so many
cycles from the reset on. Products are operators there, but in the proofs of the products. A bug
that breaks the property was planted, and its proof failed. Seconds are of one core.

Run it yourself: `python3 tests/rtl/proofs/run.py`, and with `--mutants` for the bugs. It wants
Debian's `yosys` and `z3`.
"""


def page(proofs, holding, failing):
    """The page: a table for each proof."""
    text = HEAD
    found = {name: answer for name, answer, _ in failing}
    for proof in proofs:
        text += f"\n## {proof['says'][0].upper() + proof['says'][1:]}\n\n"
        if not proof.get("lemmas"):
            text += f"`{proof['name']}.sv` looks at `{proof.get('file', proof['part'])}.sv`.\n\n"
        text += "| property | answer | with its bug | s |\n|---|---|---|---|\n"
        rows = {name: (answer, seconds) for name, answer, seconds in holding}
        for one in proof["property"]:
            name = f"{proof['name']}.{one['name']}"
            text += f"| {one['says']} | {rows[name][0]} | {found[name]} | {rows[name][1]:.1f} |\n"
    good = sum(answer == "holds" for _, answer, _ in holding)
    caught = sum(answer == "fails" for answer in found.values())
    return text + (f"\n{good} of {len(holding)} properties hold, in {sum(row[2] for row in holding):.0f} s. "
                   f"{caught} of {len(failing)} bugs were found.\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--mutants", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--docs", type=Path)
    options = parser.parse_args()
    proofs = read_proofs()
    if not check(proofs) and options.check:
        return 1
    if options.check:
        return 0
    if options.docs:
        holding, failing = prove(proofs, "", False), prove(proofs, "", True)
        options.docs.write_text(page(proofs, holding, failing))
        return 0
    begin = time.time()
    rows = prove(proofs, options.only, options.mutants)
    wanted = "fails" if options.mutants else "holds"
    good = sum(answer == wanted for _, answer, _ in rows)
    print(f"{good} of {len(rows)} {'bugs are found' if options.mutants else 'properties hold'}, "
          f"{sum(row[2] for row in rows):.0f} s of processor, {time.time() - begin:.0f} s")
    return 0 if rows and good == len(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
