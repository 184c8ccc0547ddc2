#!/usr/bin/env python3
"""Writes the page of the manual, voxmelt.1.gz, of the texts of --help.

  manual.py PROGRAM CHANGELOG.md OUT
"""
import gzip
import re
import sys
from pathlib import Path

import help_text


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.M)


def with_commands_bold(text):
    return re.sub(r"`([^`]+)`", r"\\fB\1\\fP", escaped(text))


def facts(option):
    """What --help says in its own signs, as words."""
    said = []
    if option.choices:
        said.append(f"one of {', '.join(option.choices)}")
    if option.range:
        said.append(f"from {option.range[0]} to {option.range[1]}")
    if option.default:
        said.append(f"by default {option.default}")
    if option.several:
        said.append("may be repeated")
    return f" ({'; '.join(said)})" if said else ""


def entry(option):
    value = f" \\fI{escaped(option.value)}\\fP" if option.name.startswith("-") and option.value else ""
    sort = "B" if option.name.startswith("-") else "I"
    return [".TP", f"\\f{sort}{escaped(option.name)}\\fP{value}", with_commands_bold(option.text + facts(option))]


def command_section(command):
    lines = [f".SS {escaped(command.usage)}".replace(" [OPTIONS]", " [\\fIoptions\\fP]"), with_commands_bold(command.text) + "."]
    for option in command.places + [o for o in command.options if o.name != "--help"]:
        lines += entry(option)
    if command.footer:
        lines += [".PP", with_commands_bold(command.footer).replace("\n\n", "\n.PP\n")]
    return lines


def page(program, version, date):
    introduction, commands = help_text.commands_of(program)
    first, examples, last = introduction.split("\n\n")
    purpose = re.sub(r"^voxmelt ", "", first).rstrip(".")
    lines = [f'.TH VOXMELT 1 "{date}" "voxmelt {version}" "User Commands"', ".SH NAME", f"voxmelt \\- {escaped(purpose)}",
             ".SH SYNOPSIS", ".B voxmelt", "\\fIcommand\\fP [\\fIoptions\\fP] ...", ".SH DESCRIPTION", with_commands_bold(last),
             ".PP", "Every command knows \\fB\\-\\-help\\fP.", ".SH COMMANDS"]
    for command in commands:
        lines += command_section(command)
    lines += [".SH EXAMPLES", ".nf", escaped(re.sub(r"^  ", "", examples, flags=re.M)), ".fi", ".SH FILES", ".TP",
              "\\fI../share/voxmelt/scenes\\fP", "the scenes that came with the program, seen from its folder", ".SH SEE ALSO",
              "README.md, docs/ and examples/ of the sources."]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    version, month = re.search(r"^## (\S+) \((.+)\)$", Path(sys.argv[2]).read_text(), re.M).groups()
    data = page(sys.argv[1], version, month).encode()
    Path(sys.argv[3]).write_bytes(gzip.compress(data, 9, mtime=0))
