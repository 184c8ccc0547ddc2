"""Many mutants in one program: a copy of the tree in which every function that is mutated holds all of its
bodies, and the number in VOXMELT_MUTANT chooses one. A text that does not lie in the body of one function, or lies
in a function that the compiler may evaluate, is left to a build of its own.
"""
import os
import re
import subprocess
import zlib

CHOSEN = """#pragma once
#include <cstdlib>
// Which mutant this process is: 0 is none.
namespace mutants {
inline const int chosen = [] {
  const char* number = std::getenv("VOXMELT_MUTANT");
  return number != nullptr ? std::atoi(number) : 0;
}();
}  // namespace mutants
"""
TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Za-z_])\'(?:\\.|[^\'\\\n])*\'', re.S)


def masked(text):
    """The text with comments, strings and lines of the preprocessor blank, at the same places."""
    text = TEXT.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)
    return re.sub(r"^#[^\n]*", lambda found: " " * len(found.group()), text, flags=re.M)


def bodies(text):
    """The bodies of all functions that lie in no other: (begin, end, head); the braces belong to them."""
    plain, found, stack, last = masked(text), [], [], 0
    for at, character in enumerate(plain):
        if character == "{":
            head = plain[last:at]
            inside = any(kind == "function" for kind, _, _ in stack)
            told = head.strip()
            if inside:
                kind = "inner"
            elif plain[at - 1].isspace() and ("(" in told or told in ("", "}")) and not told.endswith("="):
                kind = "function"
            else:
                kind = "other"
            stack.append((kind, at, head))
            last = at + 1
        elif character == "}":
            kind, begin, head = stack.pop()
            if kind == "function":
                found.append((begin, at + 1, head))
            last = at + 1
        elif character == ";" and not any(kind == "function" for kind, _, _ in stack):
            last = at + 1
    return found


def changed(text, mutant):
    """What a mutant changes, without the ends that stay: (begin, end, what stands there then)."""
    before, after = mutant["before"], mutant["after"]
    start = len(os.path.commonprefix([before, after]))
    tail = len(os.path.commonprefix([before[start:][::-1], after[start:][::-1]]))
    at = text.index(before)
    return at + start, at + len(before) - tail, after[start:len(after) - tail]


def combined(text, mutants):
    """A file with the mutants of (number, mutant) in it, and the numbers of those that found no place."""
    found, chosen, left = bodies(text), {}, []
    for number, mutant in mutants:
        begin, end, after = changed(text, mutant)
        body = next((b for b in found if b[0] < begin and end < b[1] and "constexpr" not in b[2]), None)
        if body is None:
            left.append(number)
        else:
            mutated = text[body[0]:begin] + after + text[end:body[1]]
            chosen.setdefault(body, []).append(f"if (mutants::chosen == {number}) {mutated}")
    for body in sorted(chosen, reverse=True):
        begin, end, _ = body
        text = text[:begin] + "{" + " else ".join(chosen[body] + [text[begin:end]]) + "}" + text[end:]
    return (f'#include "mutants_chosen.h"\n{text}' if chosen else text), left


class Together:
    """The copy of the tree in `folder`, its build, and which mutants its programs hold."""

    def __init__(self, root, folder, mutants):
        self.root, self.tree = root, folder / "tree"
        self.numbers, files = {}, {}
        names = {}
        for mutant in mutants:
            number = zlib.crc32(mutant["name"].encode()) >> 1  # the same, whatever the list: objects stay good
            names[number] = mutant["name"]
            files.setdefault(mutant["file"], []).append((number, mutant))
            self.numbers[mutant["name"]] = number
        assert len(names) == len(mutants) and 0 not in names
        self.texts = {"mutants_chosen.h": CHOSEN}
        for file, of in files.items():
            self.texts[file], left = combined((root / file).read_text(), of)
            for number in left:
                del self.numbers[names[number]]

    def copy(self):
        """What stands already is not written again: so its objects stay good."""
        words = ["git", "-C", str(self.root), "ls-files", "-co", "--exclude-standard"]
        listed = subprocess.run(words, check=True, text=True, capture_output=True).stdout.splitlines()
        contents = {file: (self.root / file).read_bytes() for file in listed if (self.root / file).is_file()}
        contents |= {file: text.encode() for file, text in self.texts.items()}
        for file, content in contents.items():
            to = self.tree / file
            if not to.exists() or to.read_bytes() != content:
                to.parent.mkdir(parents=True, exist_ok=True)
                to.write_bytes(content)

    def build(self, targets, optimise, jobs):
        """Only the objects of the model, and what is mutated, are compiled in another way than in any build."""
        self.copy()
        folder = self.tree / "build/release"
        subprocess.run(["cmake", "--preset", "release", "-DVOXMELT_TESTS=ON", "-DVOXMELT_PRECOMPILE=OFF"], check=True,
                       cwd=self.tree, stdout=subprocess.DEVNULL)
        rules, lines, ours = folder / "build.ninja", [], False
        for line in rules.read_text().splitlines():
            if line.startswith("build "):
                ours = re.match(r"build (tests/)?hwmodel/", line) or any(f"/{file} " in line for file in self.texts)
            if ours and line.startswith("  FLAGS = "):
                line = re.sub(r"-O[23]", optimise, line).replace(" -Werror", "") + " -w"
            lines.append(line)
        rules.write_text("\n".join(lines) + "\n")
        subprocess.run(["ninja", "-C", str(folder), f"-j{jobs}", *targets], check=True)

    def program(self, name):
        return self.tree / "build/release" / name
