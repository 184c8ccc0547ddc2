"""Reads what `voxmelt --help` and `voxmelt COMMAND --help` say: the texts of the options stand nowhere else."""
import re
import subprocess
from dataclasses import dataclass, field

COLUMN = 30  # where descriptions begin


@dataclass
class Option:
    """An option, a flag, or a value by its place."""
    name: str  # "--steps", "scene"
    value: str = ""  # what stands behind it: TEXT, KEY=VALUE; a flag has nothing
    choices: list = field(default_factory=list)  # the values that it may have
    range: tuple = ()  # or the smallest and the largest
    default: str = ""
    required: bool = False
    several: bool = False
    text: str = ""

    def lists(self):
        """Returns the list that its text names: scenes, of "a name of `voxmelt list scenes`"."""
        named = re.search(r"`voxmelt list (\w+)`", self.text)
        return named[1] if named else ""


@dataclass
class Command:
    name: str
    text: str
    usage: str = ""
    places: list = field(default_factory=list)
    options: list = field(default_factory=list)
    footer: str = ""


def option(head, text):
    """Returns the option of a line such as `--fps INT:INT in [1 - 240]=12 Excludes: --resume`."""
    name, _, rest = head.partition(" ")
    result = Option(re.sub(r"^-\w,|\{\w+\}$", "", name), text=" ".join(text.split()))
    rest = re.sub(r"\s*(Excludes|Needs):.*", "", rest)
    result.required, result.several = " REQUIRED" in rest, " ..." in rest
    rest = rest.replace(" REQUIRED", "").replace(" ...", "")
    if found := re.search(r":\{(.*?)\}", rest):
        result.choices, rest = found[1].split(","), rest.replace(found[0], "")
    if found := re.search(r":\w+ in \[(\S+) - (\S+)\]", rest):
        result.range, rest = (found[1], found[2]), rest.replace(found[0], "")
    rest = re.sub(r":NON\w+", "", rest)
    if rest.startswith("KEY="):
        result.value = rest
    else:
        result.value, _, result.default = rest.partition("=")
    return result


def entries(lines):
    """The rows of a table of --help: what stands on the left, and its text."""
    found = []
    for line in lines:
        head = line[:COLUMN] if line[COLUMN - 2:COLUMN] == "  " else line
        if head.strip():
            found.append([head.strip(), ""])
        if head is not line:
            found[-1][1] += " " + line[COLUMN:]
    return found


def parts(text):
    """The part before "Usage:", the usage, and the paragraphs behind it by their titles; those without one are the footer."""
    before, _, rest = text.partition("Usage: ")
    usage, _, rest = rest.partition("\n")
    tables, footer = {}, []
    for paragraph in re.split(r"\n\s*\n", rest.strip("\n")):
        title, _, rows = paragraph.partition("\n")
        if re.fullmatch(r"(Positionals|Options|Subcommands):", title):
            tables[title[:-1]] = entries(rows.split("\n"))
        elif paragraph.strip():
            footer.append(" ".join(paragraph.split()))
    return before.strip("\n"), usage, tables, "\n\n".join(footer)


def help_of(program, *command):
    result = subprocess.run([program, *command, "--help"], capture_output=True, text=True)
    if result.returncode != 0:
        raise SystemExit(f"{program} {' '.join(command)} --help: {result.stderr}")
    return parts(result.stdout)


def commands_of(program):
    """The introduction of the program, and its commands in the order of --help."""
    introduction, _, tables, _ = help_of(program)
    commands = []
    for name, text in tables["Subcommands"]:
        _, usage, own, footer = help_of(program, name)
        commands.append(Command(name, text.strip(), usage, [option(*row) for row in own.get("Positionals", [])],
                                [option(*row) for row in own["Options"]], footer))
    return introduction, commands
