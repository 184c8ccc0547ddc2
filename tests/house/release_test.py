#!/usr/bin/env python3
"""A release is told the same everywhere: one version, the paper's reference, and a workflow whose commands exist.

  release_test.py ROOT
  release_test.py --self-test
"""
import json
import re
import sys
import tempfile
from pathlib import Path

WORKFLOW = ".github/workflows/ci.yml"
PAPER = "10.1109/CASA.2003.1199304"
TESTED = {"clang", "asan", "tsan"}  # presets that a public forge runs beside .ci/run


def first(pattern, text):
    match = re.search(pattern, text, re.M)
    return match[1] if match else "none"


def offences(root):
    texts = {name: (root / name).read_text() if (root / name).exists() else ""
             for name in ("CMakeLists.txt", "CHANGELOG.md", "CITATION.cff", WORKFLOW)}
    found = [f"{name}: is missing or empty" for name, text in texts.items() if not text]
    version = first(r"^project\(.*VERSION (\S+)", texts["CMakeLists.txt"])
    newest = first(r"^## (\S+)", texts["CHANGELOG.md"])
    cited = first(r"^version: (\S+)", texts["CITATION.cff"])
    if newest != version:
        found.append(f"CHANGELOG.md: begins with version {newest}, CMakeLists.txt says {version}")
    if cited != version:
        found.append(f"CITATION.cff: version {cited}, CMakeLists.txt says {version}")
    if f"doi: {PAPER}" not in texts["CITATION.cff"]:
        found.append(f"CITATION.cff: the paper's doi, {PAPER}, is not there")
    run = set(re.findall(r"--preset (\w+)", texts[WORKFLOW]))
    known = {preset["name"] for preset in json.loads((root / "CMakePresets.json").read_text())["configurePresets"]}
    found += [f"{WORKFLOW}: preset {preset} is not in CMakePresets.json" for preset in sorted(run - known)]
    found += [f"{WORKFLOW}: does not run the preset {preset}" for preset in sorted(TESTED - run)]
    if ".ci/run" not in texts[WORKFLOW] or not (root / ".ci/run").exists():
        found.append(f"{WORKFLOW}: does not run .ci/run, or there is none")
    return found


def self_test():
    fine = {"CMakeLists.txt": "project(voxmelt VERSION 1.2.0 LANGUAGES CXX)\n",
            "CHANGELOG.md": "# Changes\n## 1.2.0 (May)\n## 1.1.0\n",
            "CITATION.cff": f"cff-version: 1.2.0\nversion: 1.2.0\ndoi: {PAPER}\n",
            WORKFLOW: "run: .ci/run, test.sh --preset clang, --preset asan, --preset tsan\n",
            "CMakePresets.json": json.dumps({"configurePresets": [{"name": name} for name in TESTED]}),
            ".ci/run": "\n"}
    planted = {"CMakeLists.txt": ("1.2.0", "1.3.0"), "CHANGELOG.md": ("## 1.2.0 (May)\n", ""), "CITATION.cff": ("\nversion: 1.2.0", "\nversion: 1.1.0"),
               WORKFLOW: (".ci/run", "make"), "CMakePresets.json": ("asan", "ubsan")}
    planted = [*planted.items(), ("CITATION.cff", (PAPER, "10.0/0")), (WORKFLOW, ("--preset tsan", "")), ("CHANGELOG.md", (fine["CHANGELOG.md"], ""))]
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)

        def write(texts):
            for name, text in texts.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
        write(fine)
        assert offences(root) == [], offences(root)
        for name, (before, after) in planted:
            write({**fine, name: fine[name].replace(before, after)})
            assert offences(root), f"missed in {name}: {before} -> {after}"
    print(f"all {len(planted)} planted offences caught")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    problems = offences(Path(sys.argv[1]))
    print("\n".join(problems) if problems else "one version, and a workflow whose commands exist")
    sys.exit(1 if problems else 0)
