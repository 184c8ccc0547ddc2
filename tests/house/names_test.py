#!/usr/bin/env python3
"""What code says of the docs, and comments and docs of the code, is there: headings, sections, files, names.

  names_test.py ROOT
  names_test.py --self-test

- A comment that cites `docs/page.md, "Title"` or `section N` cites a heading. A bare `section N` is one of docs/automaton.md,
  unless the paper is named; with a point, as in 4.2.2, it is always the paper's.
- A path in a comment exists, and a file name exists somewhere.
- `name`, some_name, name() and Type::name in a comment are words of the code, keys of scenes or file names.
- `name` in the docs is such a word; "`name` in file.h" is a word of that file.
- A link to page.md#heading leads to one.
"""
import re
import sys
import tempfile
from pathlib import Path

TOPS = ("kernel", "render", "hwmodel", "app", "bench", "measure", "accuracy", "report", "library", "include", "python", "examples", "tests", "cmake", "docs", "scenes")
CPP = (".h", ".cpp")
HASHED = (".py", ".sh", ".cmake", ".txt", ".toml", ".yml")
# Pages whose names in backticks are not looked for in the code: they tell of times past, of trials and of tests.
ELSEWHERE = ("CHANGELOG.md", "CONTRIBUTING.md", "docs/decisions.md", "docs/decisions/", "docs/verification.md")

OTHERS = {"immintrin.h", "rol", "ror"}  # of the compiler; operations that a page defines

TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
WORD = re.compile(r"[A-Za-z_]\w*")
NUMBERS = r"(\d+(?:(?:, | and | to )\d+)*)(?!\.?\d)"
CITED_SECTIONS = re.compile(r"([\w/]+\.md),? sections? " + NUMBERS)
SECTIONS_OF = re.compile(r"[Ss]ections? " + NUMBERS + r" of ([\w/]+\.md)")
BARE_SECTIONS = re.compile(r"[Ss]ections? " + NUMBERS)
CITED_TITLE = re.compile(r'([\w/]+\.md),? "([^"]+)"')
# Others have a folder `python`, too, and sheets of memories name files of theirs.
PATH = re.compile(r"(?<![\w./-])(?:" + "|".join(top for top in TOPS if top != "python") + r")/[\w./-]*\w(?![*\w<])")
FILE = re.compile(r"(?<![\w./*<-])[\w-]+\.(?:h|cpp|py|sh|md|cmake)\b")
NAMES = [re.compile(r"`([^`\s]+)`"), re.compile(r"(?<![\w./-])([A-Za-z]\w*_\w+)(?![\w./*-])"),
         re.compile(r"\b((?:\w+::)+\w+)"), re.compile(r"(?<![\w.])([a-z]\w*)\(\)")]
IDENTIFIER = re.compile(r"[A-Za-z_]\w*(?:(?:::|\.)[A-Za-z_]\w*)*(?:\(\))?")
SUBSCRIPT = re.compile(r"[A-Za-z]'?_\w+")  # of mathematics: a_i, f_in
IN_FILE = re.compile(r"((?:`\w+`(?:, | and )?)+) in ([\w/]+\.(?:h|cpp))")


def split(text):
    """Code, and its comments as (line, text); consecutive lines of comment are one."""
    comments = []

    def taken(match):
        if not match[0].startswith(("//", "/*")):
            return match[0]
        line, words = text.count("\n", 0, match.start()) + 1, re.sub(r"^///?!?<? ?|\n\s*\* ?", " ", match[0])
        alone = not text[text.rfind("\n", 0, match.start()) + 1:match.start()].strip()
        if comments and alone and comments[-1][2] == line - 1:
            first, before, _ = comments.pop()
            comments.append((first, before + " " + words.strip(), line))
        else:
            comments.append((line, words.strip(), line + match[0].count("\n")))
        return " "
    code = TOKEN.sub(taken, text)
    return code, [(line, words) for line, words, _ in comments]


def hashed(text):
    """The same for languages whose comments begin with #."""
    lines = text.splitlines()
    comments = [(number, line.strip().lstrip("# !")) for number, line in enumerate(lines, 1) if line.strip().startswith("#")]
    return "\n".join(line for line in lines if not line.strip().startswith("#")), comments


def numbers(listed):
    for part in re.split(", | and ", listed):
        first, _, last = part.partition(" to ")
        yield from range(int(first), int(last or first) + 1)


class House:
    def __init__(self, root):
        self.root, self.found = root, []
        files = sorted(p for top in TOPS if (root / top).is_dir() for p in (root / top).rglob("*") if p.is_file())
        files += sorted(p for p in root.iterdir() if p.is_file()) + sorted((root / ".ci").glob("*"))
        self.files = [p for p in files if "__pycache__" not in p.parts]
        self.names = {p.name for p in self.files}
        self.comments, self.words, self.words_of = {}, {p.stem for p in self.files}, {}
        for path in self.files:
            if path.suffix in CPP or path.suffix in HASHED or path.name in ("run", "CMakePresets.json"):
                if path == Path(__file__).resolve():
                    continue  # its planted names would hide others
                code, comments = split(path.read_text()) if path.suffix in CPP else hashed(path.read_text())
                self.comments[path] = comments
                self.words_of[path] = set(WORD.findall(code))
                self.words |= self.words_of[path]
        self.pages = {p.relative_to(root).as_posix(): p.read_text() for p in self.files if p.suffix == ".md"}
        self.headings = {name: re.findall(r"^#+ (.*?)\s*$", re.sub(r"^```.*?^```", "", text, flags=re.S | re.M), re.M)
                         for name, text in self.pages.items()}

    def say(self, place, what):
        self.found.append(f"{place}: {what}")

    def page(self, name):
        return next((page for page in (name, f"docs/{name}") if page in self.pages), None)

    def sections(self, place, name, listed):
        page = self.page(name)
        have = {int(h[1]) for heading in self.headings.get(page, []) if (h := re.match(r"(\d+)\. ", heading))}
        for number in numbers(listed):
            if page and number not in have:
                self.say(place, f"cites section {number} of {name}, which has none")

    def citations(self, place, text):
        for name, listed in CITED_SECTIONS.findall(text):
            self.sections(place, name, listed)
        for listed, name in SECTIONS_OF.findall(text):
            self.sections(place, name, listed)
        for name, title in CITED_TITLE.findall(text):
            page = self.page(name)
            if page and title not in {re.sub(r"^\d+\. ", "", heading) for heading in self.headings[page]}:
                self.say(place, f'cites {name}, "{title}", which is no heading there')

    def paths(self, place, text):
        for path in PATH.findall(text):
            if not (self.root / path).exists():
                self.say(place, f"names {path}, which does not exist")
        for name in FILE.findall(text):
            if name not in self.names | OTHERS:
                self.say(place, f"names {name}, and there is no such file")

    def known(self, name):
        return SUBSCRIPT.fullmatch(name) or all(
            word in self.words or word.rstrip("0123456789") in self.words for word in WORD.findall(name))

    def check_comments(self):
        for path, comments in self.comments.items():
            for line, text in comments:
                place = f"{path.relative_to(self.root).as_posix()}:{line}"
                self.citations(place, text)
                self.paths(place, text)
                if path.suffix in CPP:
                    rest = SECTIONS_OF.sub("", CITED_SECTIONS.sub("", text))
                    if "paper" not in text.lower() and "docs/automaton.md" in self.pages:
                        for listed in BARE_SECTIONS.findall(rest):
                            self.sections(place, "docs/automaton.md", listed)
                    names = {name for pattern in NAMES for name in pattern.findall(text) if IDENTIFIER.fullmatch(name)}
                    for name in sorted(names):
                        if not self.known(name):
                            self.say(place, f"names {name}, which is no word of the code")

    def check_pages(self):
        for page, text in self.pages.items():
            self.citations(page, text)
            for target, anchor in re.findall(r"\]\(([^)#\s]*)#([^)\s]+)\)", text):
                other = (Path(page).parent / target).as_posix() if target else page
                other = next((name for name in self.pages if (self.root / name).resolve() == (self.root / other).resolve()), None)
                anchors = {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in self.headings.get(other, [])}
                if other and anchor not in anchors:
                    self.say(page, f"links to {target}#{anchor}, which is no heading there")
            if page.startswith(ELSEWHERE):
                continue
            for names, file in IN_FILE.findall(text):
                places = [p for p in self.words_of if p.as_posix().endswith("/" + file)]
                for name in WORD.findall(names):
                    if not any(name in self.words_of[p] for p in places):
                        self.say(page, f"names `{name}` in {file}, which has no such word")
            for name in sorted(set(re.findall(r"`([^`\s]+)`", text))):
                if IDENTIFIER.fullmatch(name) and not (self.known(name) or name in self.names | OTHERS):
                    self.say(page, f"names `{name}`, which is no word of the code")

    def offences(self):
        self.check_comments()
        self.check_pages()
        return self.found


def self_test():
    fine = {
        "docs/automaton.md": "# The automaton\n## 1. State\n## 2. Ledgers\nSee [state](#1-state), `fallen` in gravity.h, `a_i`, `heat.gamma`.\n",
        "docs/proofs.md": "# Proofs\n## Bounds\nBy [ledgers](automaton.md#2-ledgers) and automaton.md, section 2.\n",
        "scenes/a.toml": "[heat]\ngamma = 3\n",
        "kernel/gravity.h": '// docs/automaton.md, "Ledgers" (docs/proofs.md, "Bounds"); sections 1 and 2; section 4.2.2.\n'
                            "// The paper's section 7. `fallen` as in gravity.h and kernel/gravity.h, frame_00000, f_in.\n"
                            'int fallen(int amount);  // Books::fallen()\nstruct Books { const char* frame_ = "// not a comment, section 9"; };\n',
        "kernel/CMakeLists.txt": "# As docs/automaton.md, section\n# 1 says.\nadd_library(kernel gravity.h)\n",
    }
    planted = {
        "kernel/a.h": ('// docs/automaton.md, "State and formats"', "State and formats"),
        "kernel/b.h": ("// (docs/automaton.md,\n// section 3)", "section 3"),
        "kernel/c.h": ("// See sections 1 to 4.", "section 4"),
        "kernel/d.h": ("// Bounds: section 9 of docs/automaton.md.", "section 9"),
        "kernel/e.h": ("// As in kernel/gone.h.", "kernel/gone.h"),
        "kernel/f.h": ("// As in gone.cpp.", "gone.cpp"),
        "kernel/g.h": ("// Calls `risen`.", "risen"),
        "kernel/h.h": ("// Structure::cell_bits says it.", "Structure::cell_bits"),
        "kernel/i.h": ("int i;  // falls in has_fallen", "has_fallen"),
        "kernel/j.h": ("/* what sinks() does */", "sinks"),
        "kernel/k.py": ("# tests/house/gone.py", "tests/house/gone.py"),
        "kernel/l.cmake": ('# docs/proofs.md, "Widths"', "Widths"),
        "docs/m.md": ("[state](automaton.md#3-state)", "automaton.md#3-state"),
        "docs/n.md": ("`gamma` in gravity.h", "`gamma` in gravity.h"),
        "README.md": ("`risen`", "`risen`"),
        "docs/o.md": ("automaton.md, section 8", "section 8"),
    }
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in {**fine, **{name: text for name, (text, _) in planted.items()}}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text + "\n")
        found = House(root).offences()
    for name, (_, said) in planted.items():
        if not any(offence.startswith(name) and said in offence for offence in found):
            sys.exit(f"missed: {name}, {said}; found: {found}")
    if extra := [offence for offence in found if offence.split(":")[0] not in planted]:
        sys.exit(f"wrongly reported: {extra}")
    print(f"all {len(planted)} planted offences caught")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    problems = House(Path(sys.argv[1]).resolve()).offences()
    print("\n".join(problems) if problems else "what the code says of docs, and comments and docs of the code, is there")
    sys.exit(1 if problems else 0)
