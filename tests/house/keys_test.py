#!/usr/bin/env python3
"""The docs explain every key: those of scene files in docs/scenes.md, those of parameters.json in docs/automaton.md,
those of the pipeline in docs/hardware/pipeline.md, those of the ray caster in docs/hardware/ray-caster.md, and those of
memories and devices in docs/hardware/files.md.

  keys_test.py ROOT
  keys_test.py --self-test
"""
import re
import sys
import tempfile
from pathlib import Path

ASKED = re.compile(r'(?:\.|->)(?:number|integer|flag|texts?|choice|file|rows|tables?|vector<\d>)\(\s*"(\w+)"')
WRITTEN = re.compile(r'\{"(\w+)",|\["(\w+)"\]')
JSON = "kernel/run/io/parameters_json.cpp"
HW = "hwmodel/pipeline/model/configuration.h"
CASTER = "hwmodel/caster/model/configuration.h"
FILES = {"hwmodel/memory/sheet.cpp", "hwmodel/explore/device.cpp", "hwmodel/explore/family.cpp"}
IN_FILES = re.compile(r'\b(?:cycles|power_of_two|whole|pairs|logic_of|table_of|table|integer|flag|text|number|read_logic|read_of_device|read_source)\((?:\*?\w+, )?"(\w+)"')
RESOURCES = re.compile(r'kResourceNames\{([^}]*)\}')


def of_scenes(root):
    """Keys that readers ask for, each with a file; and all words that docs/scenes.md has as code."""
    asked = {}
    for path in sorted((root / "kernel/scene").rglob("*.cpp")):
        for key in ASKED.findall(path.read_text()):
            asked.setdefault(key, path.relative_to(root).as_posix())
    code = re.findall(r"`[^`]*`|^```.*?^```", (root / "docs/scenes.md").read_text(), re.M | re.S)
    return asked, set(re.findall(r"\w+", " ".join(code)))


def of_parameters(root):
    """Keys of parameters.json; and all words of the section `Parameters`."""
    written = {one or other: JSON for one, other in WRITTEN.findall((root / JSON).read_text())}
    section = re.search(r"^## \d+\. Parameters\n(.*?)(?=^## |\Z)", (root / "docs/automaton.md").read_text(), re.M | re.S)
    return written, set(re.findall(r"\w+", section[1] if section else ""))


def of_machine(root, table, page):
    """Rows of a machine's table of [hw]; and all words of its page that stand as `hw.word`."""
    rows = {key: table for key in re.findall(r'hw_key<[^>]+>\(\s*"(\w+)"', (root / table).read_text())}
    return rows, set(re.findall(r"`hw\.(\w+)`", (root / page).read_text()))


def of_files(root):
    """Keys of the files of memories, devices and families; and all words that their page has as code."""
    keys = {key: path for path in sorted(FILES) for key in IN_FILES.findall((root / path).read_text())}
    header = root / "hwmodel/explore/device.h"
    keys |= {key: header.name for names in RESOURCES.findall(header.read_text()) for key in re.findall(r'"(\w+)"', names)}
    code = re.findall(r"`[^`]*`", (root / "docs/hardware/files.md").read_text())
    return keys, set(re.findall(r"\w+", " ".join(code)))


def offences(root):
    found = []
    for page, (keys, explained) in (("docs/scenes.md", of_scenes(root)), ("docs/automaton.md", of_parameters(root)),
                                    ("docs/hardware/files.md", of_files(root)),
                                    *((page, of_machine(root, table, page)) for table, page in ((HW, "docs/hardware/pipeline.md"),
                                                                                               (CASTER, "docs/hardware/ray-caster.md")))):
        found += [f"{path}: {page} does not explain the key `{key}`" for key, path in keys.items() if key not in explained]
        found += [] if keys else [f"{page}: no key was found in the code: wrong folder, or wrong check"]
    return found


def self_test():
    reader, json = "kernel/scene/a.cpp", JSON
    fine = {"docs/scenes.md": "`gamma` in `[heat.air]`, and power.\n```toml\nmargin = 1\n```\n",
            reader: 'reader.number("gamma", x); reader->table("air"); frame.vector<3>("margin", y);\n',
            "docs/automaton.md": "## 13. Digest\nfrom\n## 14. Parameters\nheat.{radius}, `grid`\n## 15. Proofs\nuntil\n",
            json: 'json["grid"] = {{"radius", 3}};\n',
            "docs/hardware/pipeline.md": "`hw.lanes`, lanes and `tile`\n", HW: 'hw_key<&C::lanes>("lanes", 1),\n',
            "docs/hardware/ray-caster.md": "`hw.pipes`\n", CASTER: 'hw_key<&C::pipes>("pipes", 1),\n',
            "docs/hardware/files.md": "`faw`, `[stage.NAME]` and `lut`\n", "hwmodel/memory/sheet.cpp": 'p.faw = cycles("faw", 1);\n',
            "hwmodel/explore/device.cpp": 'table_of(root, "stage");\n', "hwmodel/explore/family.cpp": "", "hwmodel/explore/device.h": 'kResourceNames{"lut"};\n'}
    planted = [(reader, 'r.number("delta", x);'), (reader, 'r->integer("delta", 1);'), (reader, 'r.vector<3>("delta");'),
               (reader, 'r.tables(\n    "delta");'), (reader, 'r.flag("power", true);'), (reader, "\n"),
               (json, '{"until", 1}'), (json, '{"from", 1}'), (json, "\n"), (HW, "\n"), (CASTER, "\n"), ("hwmodel/memory/sheet.cpp", 'a = power_of_two(from, "banks", 3)'), ("hwmodel/explore/device.cpp", 'whole(*from, "clock", 1)'), ("hwmodel/explore/device.h", 'kResourceNames{"lut", "dsp"}'), (CASTER, 'hw_key<&C::levels, &S::sets>("sets", 1)'), (HW, 'hw_key<&C::tile>(\n    "tile", 1)'), ("docs/automaton.md", "## 14. Parameters\ngrid\n")]
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for changed in [None, *planted]:
            for name, text in {**fine, **dict([changed] if changed else [])}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            assert len(offences(root)) == (1 if changed else 0), (changed, offences(root))
    print(f"all {len(planted)} planted offences caught")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    problems = offences(Path(sys.argv[1]))
    print("\n".join(problems) if problems else "the docs explain every key")
    sys.exit(1 if problems else 0)
