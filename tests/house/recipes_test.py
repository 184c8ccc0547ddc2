#!/usr/bin/env python3
"""The recipes of CONTRIBUTING.md name files and tests that exist.

  recipes_test.py ROOT BUILD
  recipes_test.py --self-test

A path with <name> is one to be made: its folder exists, and other files there have names of that form. Tests are those
that ctest knows in BUILD.
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

WANTED = {"scene", "field", "key", "rule", "kernel", "instruction set", "stage", "format", "subcommand", "look", "kind of heat source", "ledger term", "device", "accuracy case"}


def known_tests(build):
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True, text=True)
    return {test["name"] for test in json.loads(shown.stdout)["tests"]}


def exists(root, path):
    if "<name>" not in path:
        return (root / path).is_file()
    return any(path != found.relative_to(root).as_posix() for found in root.glob(path.replace("<name>", "*")))


def is_known(name, tests):
    return any(test == name or test.startswith((f"{name}.", f"{name}_NOT_BUILT")) for test in tests)


def offences(root, tests):
    page = (root / "CONTRIBUTING.md").read_text()
    found = []
    head, *recipes = re.split(r"^### ", page.partition("\n## Recipes\n")[2], flags=re.M)
    names = {re.sub(r"^An? ", "", recipe.split("\n")[0]) for recipe in recipes}
    found += [f"there is no recipe for a new {name}" for name in sorted(WANTED - names)]
    for recipe in recipes:
        title = recipe.split("\n")[0]
        steps = re.findall(r"^\d+\. (.*(?:\n {3}.*)*)", recipe, re.M)
        paths = [path for step in steps for path in re.findall(r"`([\w.-]+/[\w./<>-]+)`", step)]
        found += [f"{title}: {path} does not exist" for path in paths if not exists(root, path)]
        said = re.search(r"^Test: (.*(?:\n.+)*)", recipe, re.M)
        tested = re.findall(r"`([\w.]+)`", said[1]) if said else []
        found += [f"{title}: there is no test {name}" for name in tested
                  if not is_known(name, tests)]
        if not paths or not tested:
            found.append(f"{title}: names no file, or no test")
    table = page.partition("\n## Recipes\n")[0]
    found += [f"the table: there is no test {name}" for name in re.findall(r"`(house\.\w+)`", table) if name not in tests]
    rows = table.partition("| a change of | begins in | test |")[2]
    named = [name for cell in re.findall(r"\| ([^|\n]*) \|$", rows, re.M) for name in re.findall(r"`([\w.]+)`", cell)]
    found += [f"the table: there is no test {name}" for name in named if not is_known(name, tests)]
    return [f"CONTRIBUTING.md: {offence}" for offence in found]


def self_test():
    recipe = "### A {}\n\n1. `app/<name>.cpp` (or\n   `app/main.cpp`): its `value`.\n\nTest: `app.commands` (begin\nhere), `unit_test`.\n\n"
    fine = "| `house.docs` |\n\n| a change of | begins in | test |\n|---|---|---|\n| one | `app/main.cpp` | `lone_test` |\n\n## Recipes\n\nEach.\n\n" + "".join(recipe.format(name) for name in sorted(WANTED))
    tests = {"app.commands", "house.docs", "lone_test.Case", "unit_test.Suite.Case"}
    planted = [("app/main.cpp", "app/gone.cpp"), ("app/<name>.cpp", "app/gone/<name>.cpp"), ("app/<name>.cpp", "app/<name>.toml"), ("app.commands", "app.gone"),
               ("unit_test", "unit_gone"), ("house.docs", "house.gone"), ("lone_test", "lone_gone"), ("### A look", "### A view"), ("Test:", "Tested:")]
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "app").mkdir()
        (root / "app/main.cpp").write_text("\n")
        page = root / "CONTRIBUTING.md"
        page.write_text(fine)
        assert offences(root, tests) == [], offences(root, tests)
        assert offences(root, {"app.commands", "house.docs", "lone_test.Case", "unit_test_NOT_BUILT-1"}) == []
        for before, after in planted:
            page.write_text(fine.replace(before, after))
            assert offences(root, tests), f"missed: {before} -> {after}"
    print(f"all {len(planted)} planted offences caught")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    problems = offences(Path(sys.argv[1]), known_tests(sys.argv[2]))
    print("\n".join(problems) if problems else "every recipe names files and tests that exist")
    sys.exit(1 if problems else 0)
