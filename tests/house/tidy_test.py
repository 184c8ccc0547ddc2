#!/usr/bin/env python3
"""clang-tidy finds nothing, by the checks of .clang-tidy.

  tidy_test.py ROOT BUILD              every source that BUILD compiles
  tidy_test.py ROOT BUILD --changed    those changed since origin/main, or since the commit before, for a minute at most
  tidy_test.py --self-test

A changed header is seen through a source that includes it. Each source is read with its own includes alone, without the
headers that a build precompiles. What was clean is remembered in BUILD/tidy, by its content and that of all it includes.
Without clang-tidy, or without a history to compare with: skipped (77).
"""
import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TIDY = shutil.which("clang-tidy")
BUDGET = 40  # seconds for --changed
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+\.h)[">]', re.M)
PRECOMPILED = re.compile(r"-Winvalid-pch +-include +\S+/cmake_pch\.hxx")
SKIPPED = 77
NOT_FOR_CLANG = {"app/view/server.cpp"}  # Boost 1.74 has no coroutines for clang 14


def git(root, *arguments):
    """What git says, or nothing where there is no git, no repository or no such commit."""
    try:
        done = subprocess.run(["git", "-C", root, *arguments], capture_output=True, text=True)
    except FileNotFoundError:
        return None
    return done.stdout.strip() if done.returncode == 0 else None


def changed(root):
    """Files that differ from where this branch left origin/main; on origin/main itself, from the commit before."""
    here = git(root, "rev-parse", "HEAD")
    base = git(root, "merge-base", "HEAD", "origin/main")
    if base in (None, here):
        base = git(root, "rev-parse", "--verify", "--quiet", "HEAD~1")
    if base is None:
        return None
    listed = (git(root, "diff", "--name-only", "--diff-filter=d", base), git(root, "ls-files", "-o", "--exclude-standard"))
    return {name for names in listed for name in (names or "").splitlines()}


class Sources:
    """What a build compiles, and what each source includes."""

    def __init__(self, root, build):
        self.root, self.build, self.known, self.all = root, build, {}, {}
        commands = json.loads((build / "compile_commands.json").read_text())
        for c in commands:
            c["command"] = PRECOMPILED.sub("", c["command"])
        (build / "tidy").mkdir(exist_ok=True)
        (build / "tidy" / "compile_commands.json").write_text(json.dumps(commands))
        self.commands = {os.path.relpath(c["file"], root): c["command"] for c in commands}
        self.commands = {name: command for name, command in self.commands.items()
                         if not name.startswith("..") and name not in NOT_FOR_CLANG and not (root / name).is_relative_to(build)}

    def named(self, name):
        """The files of ours that `name` itself includes."""
        if name not in self.known:
            places = (Path(name).parent, Path(), Path("include"))
            found = [(place / other).as_posix() for other in INCLUDE.findall((self.root / name).read_text()) for place in places]
            self.known[name] = [other for other in found if (self.root / other).is_file()]
        return self.known[name]

    def included(self, name):
        """The files of ours that `name` includes, with itself."""
        if name not in self.all:
            seen, waiting = {name}, [name]
            while waiting:
                new = set(self.named(waiting.pop())) - seen
                seen |= new
                waiting += new
            self.all[name] = seen
        return self.all[name]

    def seeing(self, names):
        """The changed sources, and for each changed header the source that includes least beside it."""
        found = [name for name in sorted(names) if name in self.commands]
        for header in sorted(name for name in names if name.endswith(".h")):
            through = [source for source in self.commands if header in self.included(source)]
            if through and not set(through) & set(found):
                found.append(min(through, key=lambda source: (len(self.included(source)), source)))
        return found

    def key(self, name):
        text = self.commands[name].replace(str(self.root), "") + (self.root / ".clang-tidy").read_text()
        for other in sorted(self.included(name)):
            text += other + (self.root / other).read_text()
        return hashlib.sha256(text.encode()).hexdigest()

    def findings(self, name, seconds):
        """What clang-tidy finds in one source and the headers it includes; None without an answer in time."""
        remembered = self.build / "tidy" / self.key(name)
        if remembered.exists():
            return ""
        try:
            # GCC's own warnings, which a source may switch off, are no findings.
            command = [TIDY, "--quiet", "--extra-arg=-Wno-unknown-warning-option", "-p", self.build / "tidy", self.root / name]
            done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
        except subprocess.TimeoutExpired:
            return None
        if done.returncode == 0:
            remembered.touch()
            return ""
        return done.stdout + ("" if done.stdout else done.stderr)


def check(sources, names, budget):
    """Findings, and the files for which `budget` seconds, or none for as long as it takes, were too few."""
    ending = None if budget is None else time.monotonic() + budget

    def one(name):
        return sources.findings(name, None if ending is None else max(0, ending - time.monotonic()))

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(one, names))
    return [text for text in results if text], [name for name, text in zip(names, results) if text is None]


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder).resolve()
        build = root / "build"
        build.mkdir()
        (root / "kernel").mkdir()
        texts = {"clean.cpp": "int clean() { return 1; }\n",
                 "null.cpp": "int* null() { return 0; }\n",
                 "null.h": "inline const char* null_of_header() { return 0; }\n",
                 "through.cpp": '#include "kernel/null.h"\n#include "kernel/fine.h"\nconst char* through() { return null_of_header(); }\n',
                 "other.cpp": '#include "fine.h"\nint other() { return fine(); }\n',
                 "fine.h": "inline int fine() { return 2; }\n"}
        for name, text in texts.items():
            (root / "kernel" / name).write_text(text)
        (root / ".clang-tidy").write_text("Checks: '-*,modernize-use-nullptr'\nWarningsAsErrors: '*'\nHeaderFilterRegex: 'kernel/'\n")
        (build / "compile_commands.json").write_text(json.dumps(
            [{"directory": folder, "file": str(root / "kernel" / name), "command": shlex.join(
                ["c++", "-I", folder, "-Winvalid-pch", "-include", folder + "/cmake_pch.hxx", "-c", str(root / "kernel" / name)])}
             for name in texts if name.endswith(".cpp")]))
        sources = Sources(root, build)
        assert sorted(sources.commands) == ["kernel/clean.cpp", "kernel/null.cpp", "kernel/other.cpp", "kernel/through.cpp"]
        assert sources.included("kernel/through.cpp") == {"kernel/through.cpp", "kernel/null.h", "kernel/fine.h"}
        assert Sources(root, build).included("kernel/other.cpp") == {"kernel/other.cpp", "kernel/fine.h"}
        assert sources.seeing({"kernel/null.h"}) == ["kernel/through.cpp"]
        assert sources.seeing({"kernel/fine.h"}) == ["kernel/other.cpp"]
        assert sources.seeing({"kernel/fine.h", "kernel/through.cpp", "README.md"}) == ["kernel/through.cpp"]

        def reported():
            return " ".join(check(sources, sorted(sources.commands), None)[0])
        assert "null.cpp:1" in reported() and "null.h:1" in reported() and "other.cpp" not in reported()
        assert len(list((build / "tidy").iterdir())) == 1 + 2, "the clean ones are remembered, the others are not"
        (root / "kernel/clean.cpp").write_text("int* clean() { return 0; }\n")
        assert "clean.cpp:1" in reported(), "what is remembered holds for one content only"
        assert check(sources, ["kernel/null.cpp"], 0) == ([], ["kernel/null.cpp"])

        if shutil.which("git") is None:
            print("planted findings are noticed; no git to look for changes")
            return
        who = ("-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false")
        assert changed(root) is None
        git(root, "init", "-q", "-b", "main")
        git(root, "add", "kernel")
        git(root, *who, "commit", "-qm", "one")
        assert changed(root) is None, "a single commit has nothing to compare with"
        (root / "kernel/other.cpp").write_text("int other();\n")
        git(root, *who, "commit", "-qam", "two")
        (root / "kernel/fine.h").write_text("inline int fine() { return 3; }\n")
        (root / "kernel/new.cpp").write_text("\n")
        assert {"kernel/other.cpp", "kernel/fine.h", "kernel/new.cpp"} <= changed(root) and "kernel/null.h" not in changed(root)
        git(root, "update-ref", "refs/remotes/origin/main", "HEAD~1")
        (root / "kernel/other.cpp").write_text("int other() { return 4; }\n")
        git(root, *who, "commit", "-qam", "three")
        git(root, *who, "commit", "-q", "--allow-empty", "-m", "four")
        assert "kernel/other.cpp" in changed(root), "all since origin/main"
    print("planted findings and changes are noticed")


def main(arguments):
    if TIDY is None:
        print("no clang-tidy")
        return SKIPPED
    if arguments == ["--self-test"]:
        self_test()
        return 0
    root, build = Path(arguments[0]).resolve(), Path(arguments[1]).resolve()
    sources = Sources(root, build)
    names, budget = sorted(sources.commands), None
    if "--changed" in arguments:
        differing = changed(root)
        if differing is None:
            print("no history to compare with: the slow test looks at everything")
            return SKIPPED
        names, budget = sorted(sources.seeing(differing), key=lambda name: -(root / name).stat().st_mtime), BUDGET  # the latest first
    found, left = check(sources, names, budget)
    print("".join(found) + f"{len(names) - len(left)} sources looked at, {len(found)} with findings")
    if left:
        print(f"no time for {len(left)} more; the slow test looks at them: {', '.join(left)}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
