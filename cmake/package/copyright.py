#!/usr/bin/env python3
"""Writes the licences of all that is compiled into the programs, the library and the module, or linked with them.

  copyright.py ROOT BUILD OUT FILE...     FILE: what is shipped, as ninja calls it in BUILD

What that is, is asked of the build: the headers that ninja saw, and the libraries that each file needs. dpkg knows their
packages, and /usr/share/doc has their licences.
"""
import re
import subprocess
import sys
from pathlib import Path

OURS = """\
voxmelt is
  Copyright 2026 {authors}

  Licensed under the Apache License, Version 2.0. On Debian systems its text is
  in /usr/share/common-licenses/Apache-2.0.

Models that come with the scenes
================================

{models}
"""
THEIRS = "{rule}\n{title}\n{rule}\n\n{text}\n"


def lines_of(*command, may_fail=False):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if result.returncode != 0 and not may_fail:
        raise SystemExit(f"{command[0]}: {result.stderr}")
    return result.stdout.splitlines()


def compiled_in(root, build, files):
    """The headers of others that the objects of these files were compiled from."""
    objects = set(lines_of("ninja", "-C", build, "-t", "inputs", *files))
    headers, reading = set(), False
    for line in lines_of("ninja", "-C", build, "-t", "deps"):
        if not line.startswith(" "):
            reading = line.split(":")[0] in objects
        elif reading:
            headers.add((build / line.strip()).resolve())
    return {header for header in headers if not header.is_relative_to(root)}


def linked(build, files):
    """The libraries that these files need, as the loader finds them."""
    found = set()
    for file in files:
        needed = re.findall(r"NEEDED +(\S+)", "\n".join(lines_of("objdump", "-p", build / file)))
        for line in lines_of("ldd", build / file, may_fail=True):
            name, _, path = line.strip().partition(" => ")
            if name in needed and path.startswith("/"):
                found.add(Path(path.split(" (")[0]).resolve())
    return found


def packages_of(paths):
    """The packages that own these files, by their names."""
    # Where /lib is a link to /usr/lib, packages may know a file by either name.
    names = paths | {Path("/", path.relative_to("/usr")) for path in paths if path.is_relative_to("/usr/lib")}
    found, owned = {}, set()
    for line in lines_of("dpkg-query", "-S", *sorted(names), may_fail=True):
        owners, _, path = line.partition(": ")
        owned.add(Path(path).resolve())
        for owner in owners.split(", "):
            found.setdefault(owner.split(":")[0], set()).add(path)
    unknown = {path for path in paths if path not in owned}
    if unknown:
        raise SystemExit(f"no package owns {min(unknown)}: nobody knows its licence")
    return sorted(found)


def written(root, packages):
    authors = re.search(r"authors:\n  - name: (.+)", (root / "CITATION.cff").read_text())[1]
    models = (root / "scenes/data/README.md").read_text().partition("\n\n")[2].strip()
    texts = {}
    for package in packages:
        text = (Path("/usr/share/doc") / package / "copyright").read_text(errors="replace").strip()
        texts.setdefault(text, []).append(package)
    parts = [OURS.format(authors=authors, models=models)]
    # Boost's text names each of its files: what is long stands last.
    parts += [THEIRS.format(rule="=" * 70, title="\n".join(names), text=text) for text, names in sorted(texts.items(), key=lambda item: len(item[0]))]
    return "\n".join(parts)


if __name__ == "__main__":
    root, build, out, files = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]), sys.argv[4:]
    programs = [file for file in files if not file.endswith(".a")]
    paths = compiled_in(root, build, files) | linked(build, programs)
    out.write_text(written(root, packages_of(paths)))
