#!/usr/bin/env python3
"""docs/scenes.md explains every key that a reader of kernel/scene asks for.

  scene_keys_test.py ROOT
  scene_keys_test.py --self-test
"""
import re
import sys
import tempfile
from pathlib import Path

ASKED = re.compile(r'(?:\.|->)(?:number|integer|flag|text|choice|file|rows|tables?|vector<\d>)\(\s*"(\w+)"')


def offences(root):
    page = (root / "docs/scenes.md").read_text()
    explained = set(re.findall(r"\w+", " ".join(re.findall(r"`[^`]*`|^```.*?^```", page, re.M | re.S))))
    asked = {}
    for path in sorted((root / "kernel/scene").rglob("*.cpp")):
        for key in ASKED.findall(path.read_text()):
            asked.setdefault(key, path.relative_to(root).as_posix())
    found = [f"{path}: asks for `{key}`, which docs/scenes.md does not explain" for key, path in asked.items() if key not in explained]
    return found if asked else ["no reader asks for any key: wrong folder, or wrong check"]


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "docs").mkdir()
        (root / "kernel/scene").mkdir(parents=True)
        reader = root / "kernel/scene/a.cpp"
        (root / "docs/scenes.md").write_text("`gamma` in `[heat.air]`, and power.\n```toml\nmargin = 1\n```\n")
        reader.write_text('reader.number("gamma", x); reader->table("air"); frame.vector<3>("margin", y);\n')
        assert offences(root) == [], offences(root)
        for planted in ('r.number("delta", x);', 'r->integer("delta", 1);', 'r.vector<3>("delta");', 'r.tables(\n    "delta");', 'r.flag("power", true);'):
            reader.write_text(planted)
            assert len(offences(root)) == 1, planted
        reader.write_text("\n")
        assert offences(root)
    print("planted keys are noticed")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    problems = offences(Path(sys.argv[1]))
    print("\n".join(problems) if problems else "docs/scenes.md explains every key")
    sys.exit(1 if problems else 0)
