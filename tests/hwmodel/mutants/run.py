#!/usr/bin/env python3
"""Mutants of the hardware model: each is one exact replacement in one file. Is it found, and by what?

    tests/hwmodel/mutants/run.py --check         all of them apply: this is quick, and one of ./test.sh
    tests/hwmodel/mutants/run.py                 builds and runs each; goes on where it stopped
    tests/hwmodel/mutants/run.py --only gravity  those whose name holds this expression

It wants a standing build: `cmake --build --preset release --target voxmelt-hardware` and the test programs of hwmodel.
With --together most mutants lie in one program, and an environment variable chooses (together.py). Any other
is an overlay of the one file that it changes. What includes that file is compiled by the commands of
compile_commands.json, and linked before the libraries of the standing build.

First `voxmelt verify` runs alone, on the grounds of grounds.toml, until one fails. The unit tests of a mutant
run where verify finds nothing, or with --tests always. Where no bit is wrong, they run first. A mutant that names
none has those of its folder, of grounds.toml. The table and what was found lie in --out.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import sys
import threading
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

import report
import together
from overlay import ROOT, Build, Overlay, commit, misfit, run

KEYS = {"name", "file", "before", "after", "class", "stage", "why", "boundary", "tests"}
# What a run of verify, or a unit test of the pipeline, computes with. Nobody plants a listed fault here, and
# the ray caster has mutants of its own elsewhere.
FOLDERS = ("hwmodel/check/", "hwmodel/explore/", "hwmodel/fabric/", "hwmodel/machine/", "hwmodel/memory/",
           "hwmodel/pipeline/check/", "hwmodel/pipeline/model/", "hwmodel/pipeline/report/", "hwmodel/pipeline/time/",
           "kernel/engine/parallel/")
VERIFY = "app/voxmelt-hardware"
BITS = ("wrong bits", "equivalent")
LONGEST = 150  # seconds of one run


def problems_of(mutant):
    """Why a mutant is no good, in words."""
    if missing := {"name", "file", "before", "after", "class", "why"} - set(mutant):
        yield f"lacks {', '.join(sorted(missing))}"
        return
    if unknown := set(mutant) - KEYS:
        yield f"has unknown keys: {', '.join(sorted(unknown))}"
    if mutant["class"] not in report.CLASSES:
        yield f"is of no class: {mutant['class']}"
    if mutant["class"] == "wrong bits" and "stage" not in mutant:
        yield "does not say which stage must be named"
    if problem := misfit(mutant):
        yield problem


def read_mutants():
    mutants = []
    for path in sorted(HERE.glob("*.toml")):
        if path.name != "grounds.toml":
            mutants += tomllib.loads(path.read_text()).get("mutant", [])
    return mutants


def lists():
    """What the first line of each list says of it, and the names in it."""
    for path in sorted(HERE.glob("*.toml")):
        if path.name != "grounds.toml":
            text = path.read_text()
            yield text.split("\n")[0].lstrip("# "), [m["name"] for m in tomllib.loads(text).get("mutant", [])]


def self_test():
    """Lists that are spoilt must be refused."""
    good = next(m for m in read_mutants() if m["class"] == "wrong bits")
    spoilt = [good | {"before": "no such text"}, good | {"before": "\n"}, good | {"after": good["before"]},
              good | {"class": "odd"}, good | {"file": "no/such/file.h"}, good | {"further": 1},
              {k: v for k, v in good.items() if k != "stage"}, {k: v for k, v in good.items() if k != "why"}]
    missed = [mutant for mutant in spoilt if not list(problems_of(mutant))]
    missed += [] if check([good]) == 0 else [good]
    missed += [] if check([good, good]) == 1 and check([]) == 1 else [[good, good]]
    print(f"self-test: {missed} not refused" if missed else "self-test: every spoilt list is refused")
    return 1 if missed else 0


def check(mutants):
    """Prints what is wrong with the list. Returns an exit code."""
    found = [f"{m.get('name', '?')}: {problem}" for m in mutants for problem in problems_of(m)]
    names = [m.get("name") for m in mutants]
    found += [f"{name}: there are two of this name" for name in {n for n in names if names.count(n) > 1}]
    print("\n".join(found) if found else f"{len(mutants)} mutants apply")
    return 1 if found or not mutants else 0


def library_of(compiles):
    """Tells of a source in a library whether it is compiled anew when a file changes."""
    def in_library(source, file, _program):
        ours = source.startswith(FOLDERS) or source == file
        return ours and source in compiles.get(file, [source])
    return in_library


class Found:
    """What a run of verify says."""

    def __init__(self, run, code, text):
        self.run, self.code = run, code
        kind = (re.search(r"first mismatch \(([^)]*)\): (.*)", text)
                or re.search(r"first difference \((sleep)\): step \d+, phase (\w+)", text))
        self.kind = kind.group(1) if kind else ""
        self.where = kind.group(2).strip() if kind else ""
        cell = re.search(r"^  cell \(([-\d, ]*)\)", text, re.M) or re.search(r"phase \w+: cell \(([\d, ]*)\)", text)
        self.cell = cell.group(1) if cell else ""
        self.text = text


class Chosen:
    """One mutant of a program that holds many."""

    def __init__(self, built, mutant):
        self.built = built
        self.chosen = {"VOXMELT_MUTANT": str(built.numbers[mutant["name"]])}

    def link(self, program):
        return self.built.program(program)


def verify(program, grounds, folder, chosen={}):
    """The first ground on which verify fails, or None."""
    for ground in grounds:
        code, text = run([str(program), "verify", *shlex.split(ground["run"]), "--out", str(folder / "replay")],
                         LONGEST, chosen)
        if code != 0:
            return Found(ground["name"], code, text)
    return None


def target_of(test):
    """The program that a test runs: its own, or that of the user."""
    program = test.split()[0]
    if program.endswith(".py"):
        return VERIFY
    return f"tests/{program}" if "/" in program else f"tests/hwmodel/{program}"


def script_test(mutation, script, chosen):
    """The first test of a script under tests/ that fails, or None."""
    folder, module = os.path.split(script)
    begin = (f"import sys, unittest; sys.path.insert(0, {str(ROOT / 'tests' / folder)!r}); import {module[:-3]};"
             f"unittest.main(module={module[:-3]}, argv={['test', '-f', *chosen.split()]!r})")
    code, text = run([sys.executable, "-c", begin, str(mutation.link(VERIFY))], 400, mutation.chosen)
    if code == 0:
        return None
    first = re.search(r"^(?:FAIL|ERROR): (\S+)", text, re.M)
    return f"{module} {first.group(1) if first else f'exit code {code}'}"


def unit_tests(mutation, tests):
    """The first unit test that fails, or None. `tests`: "program" or "program filter", one after another."""
    for each in tests:
        program, _, chosen = each.partition(" ")
        if program.endswith(".py"):
            if (found := script_test(mutation, program, chosen)) is not None:
                return found
            continue
        target = mutation.link(target_of(each))
        arguments = [f"--gtest_filter={chosen}"] if chosen else []
        code, text = run([str(target), "--gtest_brief=1", "--gtest_fail_fast", *arguments], 900,
                         mutation.chosen)
        if code == 124:
            raise RuntimeError(f"{each}: takes too long")
        if "[  PASSED  ] 0 tests" in text and code == 0:
            raise RuntimeError(f"{each}: no such test")
        if code != 0:
            first = re.search(r"\[  FAILED  \] ([^\s,]*)", text)
            return f"{program} {first.group(1) if first else f'exit code {code}'}"
    return None


def names_stage(mutant, found):
    stage = mutant.get("stage", "")
    return any(found.where == s or s == "channel" and found.kind == "channel" for s in stage.split(" | "))


def tests_of_folder(mutant, plan):
    """The unit tests of a mutant that names none: those of the first folder that holds its file."""
    if mutant.get("tests"):
        return []
    return next((tests for folder, tests in plan["tests"].items() if mutant["file"].startswith(folder)), [])


def judge(build, built, mutant, grounds, others, work, options):
    """Builds a mutant, where it is not in the program of many, and runs what may find it."""
    begin = time.monotonic()
    folder = work / mutant["name"]
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    result = {"name": mutant["name"], "ground": "", "verify": "", "stage_named": False, "cell": "", "tests": "", "error": ""}
    try:
        if built is not None and mutant["name"] in built.numbers:
            mutation = Chosen(built, mutant)
        else:
            mutation = Overlay(build, mutant, folder, options.optimise)
        tests, bits = mutant.get("tests"), mutant["class"] in BITS
        if tests and not bits:  # these are for the tests; verify need not find them
            result["tests"] = unit_tests(mutation, tests) or ""
        found = None if result["tests"] else verify(mutation.link(VERIFY), grounds, folder, mutation.chosen)
        if found is not None:
            result["verify"] = f"{found.run}: {found.kind or f'exit code {found.code}'}"
            result["ground"], result["where"] = found.run, found.where
            result["cell"] = found.cell
            result["stage_named"] = names_stage(mutant, found)
            if not found.kind:
                result["text"] = found.text[-600:]
        if tests and bits and (found is None or options.tests == "always"):
            result["tests"] = unit_tests(mutation, tests) or ""
        if others and (found is None or options.tests == "always"):
            result["tests"] = unit_tests(mutation, others) or ""
    except RuntimeError as error:
        result["error"] = str(error)
    result["seconds"] = round(time.monotonic() - begin, 1)
    if not options.keep:
        shutil.rmtree(folder, ignore_errors=True)
    return result


def grounds_of(mutant, grounds):
    if mutant["class"] == "wrong tool":
        return []
    return [ground for ground in grounds if mutant["class"] in BITS or ground.get("short")]


def key_of(mutant, runs):
    """What a result rests on: it holds as long as this stays the same. Of the runs: those that were needed."""
    text = json.dumps([mutant, runs], sort_keys=True) + (ROOT / mutant["file"]).read_text()
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def needed(mutant, result, plan):
    """What had to run: the grounds up to the one that found it. What none found: all, and its folder's tests."""
    runs = [ground["run"] for ground in grounds_of(mutant, plan["ground"])]
    return runs[:result["grounds"]] if result["verify"] else runs + tests_of_folder(mutant, plan)


def holds(mutant, result, plan):
    return bool(result) and not result["error"] and result["key"] == key_of(mutant, needed(mutant, result, plan))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only see that every replacement applies")
    parser.add_argument("--self-test", action="store_true", help="see that a spoilt list is refused")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="the standing build")
    parser.add_argument("--only", default="", help="mutants whose name holds this regular expression")
    parser.add_argument("--jobs", type=int, default=2, help="mutants at a time")
    parser.add_argument("--together", action="store_true", help="build most mutants into one program, once")
    parser.add_argument("--tests", choices=["survivors", "always"], default="survivors",
                        help="when the unit tests run: where verify finds nothing, or always")
    parser.add_argument("--docs", type=pathlib.Path, help="a page in which to write the sums, between its two marks")
    parser.add_argument("--again", action="store_true", help="also run what has a result")
    parser.add_argument("--minutes", type=float, default=0, help="begin no mutant after so long; 0: no limit")
    parser.add_argument("--keep", action="store_true", help="keep what was built, in OUT/work")
    parser.add_argument("--optimise", default="-O1", help="how the mutants are compiled")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out/mutants", help="folder of the results")
    options = parser.parse_args()

    if options.self_test:
        return self_test()
    mutants = read_mutants()
    if (code := check(mutants)) != 0 or options.check:
        return code
    plan = tomllib.loads((HERE / "grounds.toml").read_text())
    grounds = plan["ground"]
    chosen = [m for m in mutants if re.search(options.only, m["name"])]
    chosen.sort(key=lambda m: report.CLASSES.index(m["class"]))
    if not chosen:
        print(f"no mutant's name holds {options.only}")
        return 2
    program = options.build.resolve() / VERIFY
    if not program.exists():
        print(f"no standing build: {program} is missing")
        return 2

    options.out = options.out.resolve()
    options.out.mkdir(parents=True, exist_ok=True)
    built = None
    if options.together:
        built = together.Together(ROOT, options.out, mutants)
        programs = {target_of(test) for m in mutants for test in m.get("tests", []) + tests_of_folder(m, plan)}
        built.build([VERIFY, *sorted(programs - {VERIFY})], options.optimise, options.jobs)
        program = built.program(VERIFY)
    sound, state = options.out / "sound.txt", f"{program} {program.stat().st_mtime_ns} {grounds}"
    if not sound.exists() or sound.read_text() != state:
        if (found := verify(program, grounds, options.out)) is not None:
            print(f"without any mutant verify fails on the ground {found.run}:\n{found.text}")
            return 1
        sound.write_text(state)
    build = Build(options.build, library_of(plan["compiles"]), bare={VERIFY})
    store = options.out / "results.json"
    results = json.loads(store.read_text()) if store.exists() else {}
    lock, now, begin = threading.Lock(), commit(), time.monotonic()

    def one(mutant):
        if holds(mutant, results.get(mutant["name"]), plan) and not options.again:
            return
        if options.minutes and time.monotonic() - begin > 60 * options.minutes:
            return
        of = grounds_of(mutant, grounds)
        result = judge(build, built, mutant, of, tests_of_folder(mutant, plan), options.out / "work", options)
        ran = next((i + 1 for i, g in enumerate(of) if g["name"] == result["ground"]), len(of))
        result |= {"grounds": ran, "commit": now}
        result["key"] = key_of(mutant, needed(mutant, result, plan))
        with lock:
            results[mutant["name"]] = result
            store.write_text(json.dumps(results, indent=1))
            said = result["verify"] or result["tests"] or result["error"]
            print(f"{mutant['name']}: {report.verdict(mutant, result)} {said} {result.get('where', '')}"
                  f"{'' if result['stage_named'] or not result['verify'] else ' (another stage)'}"
                  f" {result['seconds']} s", flush=True)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(one, chosen))
    current = {m["name"]: results[m["name"]] for m in mutants
               if m["name"] in results and results[m["name"]]["error"]
               or holds(m, results.get(m["name"]), plan)}
    text = report.sums(mutants, current, list(lists()))
    (options.out / "table.md").write_text(text + report.every(mutants, current))
    print(text)
    if options.docs:
        report.into_page(options.docs, text + report.notable(mutants, current))
    bad = [m["name"] for m in chosen if m["name"] in current
           and report.verdict(m, current[m["name"]]) in ("survives", "not built")]
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
