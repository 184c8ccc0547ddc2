#!/usr/bin/env python3
"""Writes the comments of the public headers as docstrings: the module says what the headers say.

  header_docs.py FOLDER_OF_HEADERS OUTPUT

OUTPUT is a list of C++ initialisers, {"Simulation::step", "Runs whole steps ..."}, one for each thing.
"""
import re
import sys
from pathlib import Path

SCOPE = re.compile(r"^(?:struct|class|enum class) (\w+)[^;]*$")
FUNCTION = re.compile(r"^[^=({]*?(~?\w+)\(")
NAME = re.compile(r"(\w+)\s*(?:=[^,;]*|\{[^}]*\})?[,;]?\s*\}?\s*$")


def plain(lines):
    """The words of a comment, without Doxygen's."""
    text = "\n".join(lines)
    text = re.sub(r"^@throws (\w+)", r"Raises \1", text, flags=re.M)
    text = re.sub(r"^@return ", "Returns ", text, flags=re.M)
    text = re.sub(r"^@param (\w+) ", r"\1: ", text, flags=re.M)
    return text.strip()


def things(text):
    """Pairs of a name, Scope::name, and its comment."""
    scope, comment, last = "", [], None
    for line in text.splitlines():
        words = line.strip()
        if words.startswith("///<") and last:  # a comment that goes on beside the code
            yield last, words[4:].strip()
        elif words.startswith("///"):
            comment.append(words[3:].strip())
        elif not words:
            comment = []
        else:
            code, _, beside = words.partition("///<")
            code = code.strip()
            found = SCOPE.match(code)
            if found:
                scope, last = found[1], found[1]
                name = scope
            else:
                function = FUNCTION.match(code)
                name = function[1] if function else (NAME.search(code) or [None, None])[1]
                last = f"{scope}::{name}" if scope and name else name
            if last and (comment or beside):
                yield last, plain(comment + [beside.strip()] if beside else comment)
            comment = []
            if line.startswith("}"):
                scope = ""


def documented(folder):
    found = {}
    for header in sorted(folder.glob("*.h")):
        for name, text in things(header.read_text()):
            if not text.startswith("@file"):
                found[name] = f"{found[name]} {text}" if name in found and text not in found[name] else text
    copied = re.compile(r"@copydoc (\w+)")
    for name, text in found.items():
        copy = copied.fullmatch(text)
        if copy:
            found[name] = found[f"{name.split('::')[0]}::{copy[1]}"]
    return found


def main():
    found = documented(Path(sys.argv[1]))
    lines = [f'{{"{name}", R"doc({text})doc"}},' for name, text in sorted(found.items())]
    Path(sys.argv[2]).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
