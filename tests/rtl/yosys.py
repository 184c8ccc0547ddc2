"""The parts in SystemVerilog, and Yosys as a command."""
import re
import resource
import subprocess
from pathlib import Path

RTL = Path(__file__).resolve().parents[2] / "hwmodel/rtl"


def sources_of(top):
    """The file of a module, and those of the modules in it, which come first."""
    files = {name: file for file in sorted(RTL.glob("*.sv"))
             for name in re.findall(r"^module (\w+)", file.read_text(), re.M)}
    if top not in files:
        raise FileNotFoundError(f"no part {top}")
    found, wanted = [], [files[top]]
    while wanted:
        file = wanted.pop()
        if file in found:
            continue
        found.append(file)
        text = re.sub(r"//.*", "", file.read_text())
        wanted += [files[word] for word in re.findall(r"^\s*(\w+)\s*(?:#\(|\w+\s*\()", text, re.M) if word in files]
    return [RTL / "voxmelt_pkg.sv"] + [file for file in reversed(found)]


def run(words, seconds=1800, folder=None):
    """The exit code, below 0 where it took more seconds of the processor, and the text."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    result = subprocess.run(words, capture_output=True, text=True, preexec_fn=limit, cwd=folder)
    return result.returncode, result.stdout + result.stderr


def yosys(script, folder=None, seconds=1800):
    code, text = run(["yosys", "-q", "-p", script], seconds, folder)
    if code != 0:
        raise RuntimeError(text.strip().splitlines()[-1])
    return text
