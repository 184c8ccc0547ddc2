#!/usr/bin/env python3
"""The docs tell the truth where a program can see it, and they stay easy to read.

  docs_test.py ROOT
  docs_test.py --self-test

- Links and paths exist, in README, docs, scenes and examples, and the paths that include/ names.
- A line has at most 100 columns, but in tables, code and generated pages.
- The separator row of a table has a line of its own: a rewrap that runs a table together is noticed.
- README has at most 90 lines, and no sentence of more than 30 words. Its C++ programs are files of examples/. A decision has at most 40 lines and stands once in the index.
- The scripts that the README names parse.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOPS = "kernel|render|hwmodel|library|include|python|examples|app|bench|measure|accuracy|report|tests|scenes|docs|cmake"
SEPARATOR = re.compile(r"\|(?:\s*:?---*:?\s*\|)+")
COLUMNS, README_LINES, SENTENCE_WORDS, DECISION_LINES = 100, 90, 30, 40


def pages(root):
    found = sorted(root.glob("*.md"))
    for folder in ("docs", "scenes", "examples", "include"):
        found += sorted((root / folder).rglob("*.md"))
    return found


def outside_code(text):
    """All lines; an empty line where there is code."""
    fenced = False
    for line in text.splitlines():
        if line.startswith("```"):
            fenced = not fenced
        yield "" if fenced or line.startswith(("```", "    ")) else line


def prose(text):
    """Lines that are neither code nor a table; an empty line where something was left out."""
    for line in outside_code(text):
        yield "" if line.startswith(("|", "#", "!")) else line


def sentences(text):
    paragraphs = re.split(r"\n\s*\n|\n(?=\s*- )", "\n".join(prose(text)))
    for paragraph in paragraphs:
        yield from re.split(r"(?<=[.!?:])\s+(?=\S)", re.sub(r"\]\([^)]*\)", "]", " ".join(paragraph.split())))


def offences(root):
    found = []
    for page in pages(root):
        text, name = page.read_text(), page.relative_to(root).as_posix()
        for target in re.findall(r"\]\(([^)#]+)\)", text):
            if not target.startswith("http") and not (page.parent / target).exists():
                found.append(f"{name}: link to {target}, which does not exist")
        for path in re.findall(rf"`((?:{TOPS})/[\w./-]+\.\w+)`", text):
            if not (root / path).exists():
                found.append(f"{name}: names {path}, which does not exist")
        if not text.startswith("<!-- Written by"):
            found += [f"{name}:{number}: {len(line)} columns, more than {COLUMNS}"
                      for number, line in enumerate(prose(text), 1) if len(line) > COLUMNS]
        found += [f"{name}:{number}: the separator row of a table shares its line with other text"
                  for number, line in enumerate(outside_code(text), 1)
                  if SEPARATOR.search(line) and not SEPARATOR.fullmatch(line)]
    for header in sorted((root / "include").rglob("*.h")):
        for path in re.findall(rf"\b((?:docs|examples|scenes)/[\w./-]+\.\w+)", header.read_text()):
            if not (root / path).exists():
                found.append(f"{header.relative_to(root).as_posix()}: names {path}, which does not exist")

    readme = (root / "README.md").read_text()
    if readme.count("\n") > README_LINES:
        found.append(f"README.md: {readme.count(chr(10))} lines, more than {README_LINES}")
    for sentence in sentences(readme):
        if len(sentence.split()) > SENTENCE_WORDS:
            found.append(f"README.md: more than {SENTENCE_WORDS} words: {sentence}")
    examples = {path.read_text() for path in (root / "examples").glob("*.cpp")}
    for program in re.findall(r"```cpp\n(.*?)```", readme, re.S):
        if program not in examples:
            found.append(f"README.md: a program that is no file of examples/: {program.splitlines()[0]}")
    decisions = root / "docs/decisions"
    index = (decisions / "README.md").read_text()
    for page in sorted(decisions.glob("*.md")):
        if page.name == "README.md":
            continue
        if (times := index.count(f"]({page.name})")) != 1:
            found.append(f"docs/decisions/README.md: {'leaves out' if times == 0 else 'lists twice'} {page.name}")
        if page.read_text().count("\n") > DECISION_LINES:
            found.append(f"docs/decisions/{page.name}: more than {DECISION_LINES} lines")

    for script in ("run.sh", "test.sh", ".ci/run", "cmake/install-dependencies.sh"):
        if subprocess.run(["bash", "-n", str(root / script)], capture_output=True).returncode != 0:
            found.append(f"{script}: does not parse")
    return found


def self_test():
    long = "a word and " * 8
    fine = {
        "README.md": "# House\n\nSee [docs](docs/a.md), `docs/a.md`.\n\n```\n" + "x" * 120 + "\n```\n\n```cpp\nint a;\n```\n",
        "examples/a.cpp": "int a;\n",
        "docs/a.md": "| " + "x" * 120 + " | n |\n|---|--:|\n\n```\nbox |---| box\n```\n",
        "docs/results/performance.md": "<!-- Written by a script -->\n" + "x " * 60 + "\n",
        "docs/decisions/README.md": "- [one](one.md)\n- [long](long.md)\n",
        "docs/decisions/one.md": "# One\n",
        "include/house.h": "/// See docs/a.md.\n",
        "run.sh": "", "test.sh": "", ".ci/run": "", "cmake/install-dependencies.sh": "",
    }
    planted = {  # file: its text, and what is said
        "README.md": (fine["README.md"] + f"\n{long}\n{long}.\n```cpp\nint b;\n```\n" + "\n" * README_LINES,
                      ["words", "lines", "README.md: a program that is no file of examples/: int b;"]),
        "docs/deep/b.md": ("[gone](gone.md)\n", ["docs/deep/b.md: link to gone.md"]),
        "docs/c.md": ("`kernel/gone.h`\n", ["docs/c.md: names kernel/gone.h"]),
        "docs/d.md": ("y" * 101 + "\n", ["docs/d.md:1: 101 columns"]),
        "docs/e.md": ("# Table\n\n| field | meaning | |---|--:| | `a` | b |\n", ["docs/e.md:3: the separator row"]),
        "examples/README.md": ("[gone](gone.cpp)\n", ["examples/README.md: link to gone.cpp"]),
        "include/b.h": ("/// See docs/gone.md.\n", ["include/b.h: names docs/gone.md"]),
        "docs/decisions/README.md": ("- [one](one.md)\n- [one, again](one.md)\n- [long](long.md)\n", ["lists twice one.md"]),
        "docs/decisions/lost.md": ("# Lost\n", ["leaves out lost.md"]),
        "docs/decisions/long.md": ("\n" * 41, ["docs/decisions/long.md: more than 40 lines"]),
        "run.sh": ("if\n", ["run.sh: does not parse"]),
    }
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in {**fine, "docs/decisions/long.md": "# Long\n"}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        if wrong := offences(root):
            sys.exit(f"wrongly reported: {wrong}")
        for name, (text, _) in planted.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        found = offences(root)
    expected = [what for _, said in planted.values() for what in said]
    if missed := [what for what in expected if not any(what in offence for offence in found)]:
        sys.exit(f"missed: {missed}; found: {found}")
    if len(found) != len(expected):
        sys.exit(f"more than was planted: {found}")
    print(f"all {len(expected)} planted offences caught")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    problems = offences(Path(sys.argv[1]))
    print("\n".join(problems) if problems else "the docs hold")
    sys.exit(1 if problems else 0)
