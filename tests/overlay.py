"""A program in which one file of the tree is replaced, built beside a standing build.

What includes that file is compiled by the commands of compile_commands.json, with the changed file before the
tree's own. It is linked before the libraries of the standing build.
"""
import json
import math
import os
import pathlib
import re
import resource
import shlex
import signal
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]


def misfit(change):
    """Why an exact replacement does not apply, in words, or None. `change` has file, before and after."""
    file = ROOT / change["file"]
    if not file.is_file():
        return f"no file {file}"
    times = file.read_text().count(change["before"])
    if times != 1:
        return f"its text stands {times} times in {change['file']}"
    return "changes nothing" if change["before"] == change["after"] else None


def run(words, seconds, chosen={}):
    """The exit code and the text; a run that takes too long counts as failed. Seconds are those of the processor, since
    a machine may be busy with other work, and a run that waits for ever ends after twenty times as long."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds) + 1))
    try:
        result = subprocess.run(words, cwd=ROOT, text=True, capture_output=True, timeout=20 * seconds, errors="replace",
                                env=os.environ | {"VOXMELT_ROUNDS": "all"} | chosen, preexec_fn=limit)
    except subprocess.TimeoutExpired:
        return 124, "takes too long"
    late = result.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
    return (124, "takes too long") if late else (result.returncode, result.stdout + result.stderr)


def commit():
    words = ["git", "-C", str(ROOT), "describe", "--always", "--dirty"]
    return subprocess.run(words, text=True, capture_output=True).stdout.strip() or "unknown"


class Build:
    """The standing build: how an object is compiled, and how a program is linked.

    `in_library(source, file, program)` tells which sources of libraries are compiled anew when a file changes. So
    are a program's own, but for those of the programs in `bare`.
    """

    def __init__(self, folder, in_library, bare=()):
        self.folder, self.in_library, self.bare = folder.resolve(), in_library, bare
        entries = json.loads((self.folder / "compile_commands.json").read_text())
        self.entries = {os.path.relpath(e["file"], ROOT): e for e in entries}
        self.deps = {}  # object -> files of the tree
        name = None
        for line in self.ninja("-t", "deps").splitlines():
            if line and not line[0].isspace():
                name = line.split(":")[0]
                self.deps[name] = set()
            elif name and line.strip():
                path = os.path.normpath(self.folder / line.strip())
                if path.startswith(str(ROOT) + "/"):
                    self.deps[name].add(os.path.relpath(path, ROOT))
        self.links = {}

    def ninja(self, *arguments):
        return subprocess.run(["ninja", "-C", str(self.folder), *arguments], check=True, text=True,
                              capture_output=True).stdout

    def object_of(self, source):
        words = shlex.split(self.entries[source]["command"])
        return words[words.index("-o") + 1]

    def link_of(self, program):
        """The words of its link command, and its own objects among them."""
        if program not in self.links:
            line = self.ninja("-t", "commands", program).splitlines()[-1]
            words = [w for w in shlex.split(line.split("&&")[1])]
            self.links[program] = words, [w for w in words if w.endswith(".o")]
        return self.links[program]

    def sources(self, file, program):
        """What must be compiled anew in a program when a file changes."""
        own = set(self.link_of(program)[1]) if program not in self.bare else set()
        for source in self.entries:
            name = self.object_of(source)
            if (self.in_library(source, file, program) or name in own) and file in self.deps.get(name, ()):
                yield source


def archive_of(name):
    """The archive in which this object lies: .../CMakeFiles/TARGET.dir/... is in libTARGET.a, and libvoxmelt is its own name."""
    target = re.search(r"CMakeFiles/([^/]+)\.dir/", name)
    return f"lib{target[1]}.a".replace("liblibvoxmelt", "libvoxmelt") if target else None


class Overlay:
    """A change on its way: the changed file, its objects, its programs."""

    def __init__(self, build, change, folder, optimise):
        self.build, self.change, self.folder, self.optimise = build, change, folder, optimise
        changed = folder / "overlay" / change["file"]
        changed.parent.mkdir(parents=True, exist_ok=True)
        text = (ROOT / change["file"]).read_text()
        changed.write_text(text.replace(change["before"], change["after"]))
        (folder / "bin").mkdir(exist_ok=True)
        share = folder / "share"
        if not share.exists():
            share.symlink_to(build.folder / "share")
        self.objects, self.chosen = {}, {}

    def compile(self, source):
        if source in self.objects:
            return
        entry = self.build.entries[source]
        words = shlex.split(entry["command"])
        target = self.folder / (source.replace("/", "_") + ".o")
        words[words.index("-o") + 1] = str(target)
        if source == self.change["file"]:
            words[-1] = str(self.folder / "overlay" / source)
        words = [w for w in words if w not in ("-Werror", "-O3", "-O2")]
        words[1:1] = [self.optimise, "-w", f"-I{self.folder / 'overlay'}"]
        if words[0].endswith("ccache"):
            words = words[1:]
        result = subprocess.run(words, cwd=entry["directory"], text=True, capture_output=True)
        if result.returncode != 0:
            raise RuntimeError(f"{source} does not compile:\n{result.stderr[:2000]}")
        self.objects[source] = target

    def link(self, program):
        sources = list(self.build.sources(self.change["file"], program))
        for source in sources:
            self.compile(source)
        words, own = self.build.link_of(program)
        changed = {self.build.object_of(s): str(self.objects[s]) for s in sources}
        target = self.folder / "bin" / pathlib.Path(program).name
        at = words.index("-o")
        # An object goes along only if its library does: it may want what the program does not have.
        libraries = {pathlib.Path(w).name for w in words if w.endswith(".a")}
        extra = [o for name, o in changed.items() if name not in own and archive_of(name) in libraries]
        words = [changed.get(w, w) for w in words[:at]] + extra + ["-o", str(target)] + [changed.get(w, w) for w in words[at + 2:]]
        result = subprocess.run(words, cwd=self.build.folder, text=True, capture_output=True)
        if result.returncode != 0:
            raise RuntimeError(f"{program} does not link:\n{result.stderr[:2000]}")
        return target
