#!/usr/bin/env python3
"""Rules of the viscous law (docs/automaton.md, sections 10 and 11): which gate fails without each of them?

    tests/accuracy/without/run.py --check       every replacement applies: this is quick, and one of ./test.sh
    tests/accuracy/without/run.py               builds and runs each; goes on where it stopped
    tests/accuracy/without/run.py --only shut   rules whose name holds this expression
    tests/accuracy/without/run.py --longest 12  quick cases alone (12 s each); a later run goes on with the others
    tests/accuracy/without/run.py --docs docs/results/rules.md    writes the table there, too

It wants a standing build: `cmake --build --preset release --target voxmelt voxmelt-measure voxmelt_oracle kernel_scalar_test kernel_rule_test`.
A rule is taken out of the reference by one exact replacement, which is built as an overlay (tests/overlay.py).
First `voxmelt accuracy --quick` runs the rule's own cases, then all of plan.toml, then tests that hold a property,
until a gate fails that the unchanged program passes. What none of them needs must at least change a value: the last
runs compare with states by hand and with the oracle. What was found is kept in results.json beside this file.
"""
import argparse
import hashlib
import json
import os
import pathlib
import re
import shutil
import sys
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

import table
from overlay import ROOT, Build, Overlay, commit, misfit, run

KEYS = {"name", "says", "file", "before", "after", "cases", "tests", "alone", "verdict"}
MEASURE = "app/voxmelt-measure"
PROGRAM, ORACLE = "app/voxmelt", "tests/oracle/oracle"
RESULTS = HERE / "results.json"
WHOLE_TESTS = "tests/kernel/kernel_scalar_test"  # none of its own sources holds a rule
RULE_TESTS = "tests/kernel/kernel_rule_test"  # has no other code than its own sources


def read_rules():
    rules = []
    for path in sorted(HERE.glob("*.toml")):
        if path.name != "plan.toml":
            section = int(re.search(r"section (\d+)", path.read_text())[1])
            rules += [rule | {"section": section} for rule in tomllib.loads(path.read_text())["rule"]]
    return rules


def read_plan():
    return tomllib.loads((HERE / "plan.toml").read_text())


def problems_of(rule):
    """Why a rule's entry is no good, in words."""
    if missing := {"name", "says", "file", "before", "after", "cases"} - set(rule):
        yield f"lacks {', '.join(sorted(missing))}"
        return
    if unknown := set(rule) - KEYS - {"section"}:
        yield f"has unknown keys: {', '.join(sorted(unknown))}"
    if not rule["file"].startswith(("kernel/automaton/rule/", "kernel/engine/scalar/")):
        yield "is not of the reference"
    if problem := misfit(rule):
        yield problem
    known = set(re.findall(r'\{"(\w+)", "', (ROOT / "accuracy/cases.cpp").read_text()))
    if strange := [case for case in rule["cases"] if case.removeprefix("full ") not in known]:
        yield f"names cases that there are not: {', '.join(strange)}"


def check(rules):
    """Prints what is wrong with the rules. Returns an exit code."""
    found = [f"{r.get('name', '?')}: {problem}" for r in rules for problem in problems_of(r)]
    names = [r.get("name") for r in rules]
    found += [f"{name}: there are two of this name" for name in {n for n in names if names.count(n) > 1}]
    print("\n".join(found) if found else f"{len(rules)} rules can be taken out")
    return 1 if found or not rules else 0


def self_test():
    """Entries that are spoilt must be refused."""
    good = read_rules()[0]
    spoilt = [good | {"before": "no such text"}, good | {"before": "\n"}, good | {"after": good["before"]},
              good | {"file": "no/such/file.h"}, good | {"file": "accuracy/cases.cpp"}, good | {"further": 1},
              good | {"cases": ["no_case"]}, {k: v for k, v in good.items() if k != "says"}]
    missed = [rule for rule in spoilt if check([rule]) == 0]
    missed += [] if check([good]) == 0 and check([good, good]) == 1 and check([]) == 1 else [good]
    print(f"self-test: {missed} not refused" if missed else "self-test: every spoilt entry is refused")
    return 1 if missed else 0


def library_of(compiles):
    """Tells of a source of the reference whether it is compiled anew when a file changes."""
    def in_library(source, file, program):
        reference = source.startswith("kernel/engine/scalar/") and program != RULE_TESTS
        return reference and source in compiles.get(file, [source])
    return in_library


def measured(program, case, seconds, folder):
    """The gated rows of a case, or in words why there are none."""
    report = folder / "report.json"
    report.unlink(missing_ok=True)
    words = [str(program), "accuracy", "--implementation", "reference", "--threads", "1", "--report", str(report)]
    words += ["--case", case.removeprefix("full ")] + ([] if case.startswith("full ") else ["--quick"])
    code, text = run(words, seconds)
    if code == 124:
        return f"does not end in {seconds} s"
    if code < 0:
        return f"dies by signal {-code}"
    if code not in (0, 1) or not report.exists():
        return f"ends with {code}: {(text.strip().splitlines() or ['no word'])[-1][:100]}"
    return [row for row in json.loads(report.read_text())["cases"] if row["gate"] is not None]


class Sound:
    """What the unchanged programs say, each case and test once."""

    def __init__(self, build, plan, out):
        self.build, self.plan, self.out = build, plan, out
        self.store = out / "sound.json"
        self.held = json.loads(self.store.read_text()) if self.store.exists() else {}

    def _once(self, program, what, find):
        key = f"{program.stat().st_mtime_ns} {what}"
        if key not in self.held:
            begin = time.monotonic()
            self.held[key] = [find(), round(time.monotonic() - begin, 1)]
            self.store.write_text(json.dumps(self.held, indent=1))
        return self.held[key]

    def rows(self, case):
        """Its gated rows, and seconds; no rows if it cannot be run in time."""
        program = self.build.folder / MEASURE
        rows, seconds = self._once(program, case, lambda: measured(program, case, self.plan["longest"], self.out))
        return ([] if isinstance(rows, str) else rows), seconds

    def test_passes(self, test):
        program = self.build.folder / target_of(test)
        return self._once(program, test, lambda: failing_test(program, test, self.plan["longest_test"]))[0] == ""


def target_of(test):
    return f"tests/kernel/{test.split()[0]}"


def failing_test(program, test, seconds):
    """The first test that fails, or nothing."""
    name, _, chosen = test.partition(" ")
    code, text = run([str(program), "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={chosen}"], seconds)
    if code == 0 and "[  PASSED  ] 0 tests" in text:
        raise RuntimeError(f"{test}: no such test")
    first = re.search(r"\[  FAILED  \] ([^\s,]*)", text)
    said = "does not end" if code == 124 else f"ends with {code}"
    return "" if code == 0 else f"{name} {first[1] if first else said}"


def differing_value(overlay, plan):
    """The first run of plan.toml's `by_value` that fails without the rule, or nothing."""
    for each in plan["by_value"]:
        if each.startswith("kernel_"):
            failed = failing_test(overlay.link(target_of(each)), each, plan["longest_test"])
        else:
            name, *words = each.split()
            script = ROOT / "tests/oracle" / f"{name}.py"
            code, text = run([sys.executable, str(script), str(overlay.link(PROGRAM)), str(overlay.build.folder / ORACLE), *words],
                             plan["longest_test"])
            failed = f"{name} {seed_or_state(text)}" if code else ""
        if failed:
            return failed
    return ""


def seed_or_state(text):
    """Which random scene differs, or which state by hand: what the first line of a test's output begins with."""
    return (text.strip().splitlines() or ["no word"])[0].split(":")[0][:100]


def missed_rows(program, case, sound, folder):
    """Rows that fail without the rule and pass with it, each beside the other."""
    good, seconds = sound.rows(case)
    if not good:
        return []
    rows = measured(program, case, max(60, 4 * seconds), folder)
    if isinstance(rows, str):
        return [{"case": case, "ends": rows}]
    told = ("setting", "quantity", "value", "error", "error_is", "gate")
    # The same settings come in the same order; a quantity may say what was measured.
    return [{"case": case, "with": beside["error"]} | {k: row[k] for k in told} for row, beside in zip(rows, good)
            if not row["passed"] and beside["passed"] and row["setting"] == beside["setting"]]


def runs_of(rule, plan, last=""):
    """The cases and the tests that may miss a rule: the case that missed it last, then its own."""
    cases, tests = rule["cases"], rule.get("tests", [])
    if not rule.get("alone"):  # alone: nothing else has it
        cases, tests = cases + plan["cases"], tests + plan["tests"]
    return list(dict.fromkeys([last] * (last in cases) + cases)), list(dict.fromkeys(tests))


def missed_last(result):
    """The case that missed a rule when it ran last, whatever has changed since."""
    return re.findall("`(.*?)`", result["cells"])[-1] if result and result["found"] == "gate" else ""


def judge(build, rule, sound, plan, before, last, options):
    """Takes a rule out, and runs what may miss it, but for what ran before, and for cases that take too long."""
    begin = time.monotonic()
    folder = options.out / "work"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    ran, missed, test, value, problem = list(before), [], "", "", ""
    cases, tests = runs_of(rule, plan, last)
    if options.longest:
        cases = [case for case in cases if case == last or sound.rows(case)[1] <= options.longest]
    try:
        overlay = Overlay(build, rule, folder, options.optimise)
        for each in [each for each in cases + tests if each not in before]:
            if each in cases:
                missed = missed_rows(overlay.link(MEASURE), each, sound, folder)
            elif sound.test_passes(each):
                test = failing_test(overlay.link(target_of(each)), each, plan["longest_test"])
            else:
                raise RuntimeError(f"{each} fails with the rule, too")
            ran.append(each)
            if missed or test:
                break
        else:
            value = differing_value(overlay, plan)
    except RuntimeError as error:
        problem = str(error)[:300]
    return {"found": "gate" if missed else "test" if test else "", "cells": table.cells(missed, test), "value": value, "error": problem,
            "ran": ran, "seconds": round(time.monotonic() - begin, 1)}


def key_of(rule):
    """What a result rests on: it holds as long as this stays the same."""
    text = json.dumps([rule[k] for k in ("file", "before", "after")]) + (ROOT / rule["file"]).read_text()
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def is_of(rule, result):
    """Tells if this was found of the rule as it is."""
    return bool(result) and not result["error"] and result["key"] == key_of(rule)


def ran_before(rule, result):
    """What has run on a rule as it is, and found nothing."""
    return result["ran"] if is_of(rule, result) else []


def holds(rule, plan, result):
    """Tells if nothing is left to run."""
    if not is_of(rule, result):
        return False
    cases, tests = runs_of(rule, plan)
    wanted = {"gate": [], "test": cases, "": cases + tests}[result["found"]]
    return set(wanted) <= set(result["ran"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only see that every replacement applies")
    parser.add_argument("--self-test", action="store_true", help="see that a spoilt entry is refused")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="the standing build")
    parser.add_argument("--only", default="", help="rules whose name holds this regular expression")
    parser.add_argument("--docs", type=pathlib.Path, help="a page to write with the table")
    parser.add_argument("--again", action="store_true", help="also run what has a result")
    parser.add_argument("--minutes", type=float, default=0, help="begin no rule after so long; 0: no limit")
    parser.add_argument("--longest", type=float, default=0, help="leave out cases of more seconds; 0: none")
    parser.add_argument("--optimise", default="-O2", help="how the overlays are compiled")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out/without", help="where it works")
    options = parser.parse_args()

    if options.self_test:
        return self_test()
    rules, plan = read_rules(), read_plan()
    if (code := check(rules)) != 0 or options.check:
        return code
    options.out = options.out.resolve()
    options.out.mkdir(parents=True, exist_ok=True)
    build = Build(options.build, library_of(plan["compiles"]), bare={MEASURE, WHOLE_TESTS})
    sound = Sound(build, plan, options.out)
    results = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    now, begin = commit(), time.monotonic()
    for rule in rules:
        late = options.minutes and time.monotonic() - begin > 60 * options.minutes
        if late or not re.search(options.only, rule["name"]):
            continue
        if holds(rule, plan, results.get(rule["name"])) and not options.again:
            continue
        known = results.get(rule["name"])
        before = [] if options.again else ran_before(rule, known)
        result = judge(build, rule, sound, plan, before, missed_last(known), options) | {"commit": now, "key": key_of(rule)}
        if before and not result["found"]:  # a test may have missed it already
            result |= {"found": known["found"], "cells": known["cells"]}
        results[rule["name"]] = result
        RESULTS.write_text(table.stored(rules, results))
        print(f"{rule['name']}: {table.verdict(result)} ({result['seconds']} s)", flush=True)
    current = {r["name"]: results[r["name"]] | {"whole": holds(r, plan, results[r["name"]])} for r in rules
               if is_of(r, results.get(r["name"]))}
    text = table.page(rules, current)
    (options.out / "rules.md").write_text(text)
    if options.docs:
        options.docs.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
