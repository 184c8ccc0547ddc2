#!/usr/bin/env python3
"""Is a design as large as `explore` says? It writes the pipeline, synthesises it whole, and counts.

  tests/rtl/cost/whole.py cello --device zu7ev --from 1048      the answer of --rtl, of one time step
  tests/rtl/cost/whole.py cello --device zu7ev --lanes 4        this number of lanes
  tests/rtl/cost/whole.py ... --docs FILE                       puts its row into the table of a page

Ports, the code of occupancy and what stands around the pipeline are not written in SystemVerilog. So the prediction is
taken without them, and with all memories in blocks but those of channels.
"""
import argparse
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))
sys.path.insert(0, str(HERE))
from run import PROGRAM, ROOT, TOOLS, WHAT, counted, written
from yosys import RTL, yosys

OUTSIDE = [f"family.{part}.{what}=0" for part in ("base", "port") for what in ("lut", "ff")]
OUTSIDE += ["family.port.buffer_bits=1", "family.port.buffer_words=1"]
# By family: its tool, with the memories of channels in LUTs, and what the blocks of memory are worth.
BLOCKS = {"7series": {"RAMB36E1": 1, "RAMB18E1": 0.5}, "ecp5": {"DP16KD": 1}}
MEMORY_LUTS = {"7series": {r"RAM32M|RAM64M": 4, r"RAM\d+X1D": 2}, "ecp5": {}}


def explored(scene, device, settings, first):
    """The report of `voxmelt explore` by closed forms alone."""
    with tempfile.TemporaryDirectory() as folder:
        words = [PROGRAM, "explore", scene, "--device", device, "--rtl", "--memory", "none", "--points", "0", "--from", str(first),
                 "--out", f"{folder}/out", *(word for one in settings for word in ("--set", one))]
        result = subprocess.run(words, capture_output=True, text=True)
        if result.returncode != 0:
            sys.exit(result.stderr.strip())
        return json.loads((Path(folder) / "out/explore.json").read_text())


def found(scene, family, hw, first):
    """LUTs, flip-flops, DSPs and blocks of memory of the pipeline of one time step."""
    keep = [f"hw.{key}={hw[key]}" for key in ("lanes", "substeps", "fifo_depth", "overlap")] + ["hw.cascade=1"]
    with tempfile.TemporaryDirectory() as name:
        folder, net = Path(name) / "pipeline", Path(name) / "net.json"
        written(folder, scene, keep, first)
        sources = sorted(RTL.glob("*.sv"), key=lambda file: file.name != "voxmelt_pkg.sv")
        tool = TOOLS[family][0].replace(" -nolutram", "")
        yosys(f"read_verilog -sv -D VOXMELT_BLOCKS {' '.join(map(str, sources))} pipeline.sv; hierarchy -top pipeline; "
              f"setattr -set ram_style \"block\" *line_memory*/m:* *column_reverser*/m:*; {tool} -top pipeline; write_json {net}",
              folder, seconds=4 * 3600)
        modules = json.loads(net.read_text())["modules"]
    counts = counted(family, modules, "pipeline")
    kinds = [cell["type"] for cell in modules["pipeline"]["cells"].values()]
    counts["lut"] += sum(luts for kind in kinds for name, luts in MEMORY_LUTS[family].items() if re.fullmatch(name, kind))
    return counts | {"bram": math.ceil(sum(BLOCKS[family].get(kind, 0) for kind in kinds))}


def row(scene, device, hw, predicted, counts):
    cells = [f"`{scene}`", device, f"{hw['lanes']} x 1"]
    for what in (*WHAT, "bram"):
        off = f"{100 * (predicted[what] / counts[what] - 1):+.0f} %" if counts[what] else ""
        cells += [f"{predicted[what]:,}", f"{counts[what]:,}", off]
    return "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--device", required=True)
    parser.add_argument("--lanes", type=int, help="instead of those of the answer")
    parser.add_argument("--from", dest="first", type=int, default=0, help="the step whose state is asked about")
    parser.add_argument("--docs", type=Path, help="a page with a table of such rows: that of the same design is replaced")
    options = parser.parse_args()
    asked = ["hw.coded=0"] + ([f"hw.lanes={options.lanes}"] if options.lanes else [])
    hw = explored(options.scene, options.device, asked, options.first)["best"]["hw"]
    fixed = [f"hw.{key}={hw[key]}" for key in ("lanes", "substeps", "fifo_depth", "overlap", "clock_mhz")]
    report = explored(options.scene, options.device,
                      asked[:1] + fixed + ["hw.cascade=1", "device.uram=0", "device.lutram=1000000", "family.memory.deepest_lutram=32"] + OUTSIDE,
                      options.first)
    family = "ecp5" if report["family"]["name"] == "ecp5" else "7series"
    line = row(options.scene, options.device, hw, report["best"]["takes"], found(options.scene, family, hw, options.first))
    print(line)
    if options.docs:
        text = options.docs.read_text()
        same = re.escape(line[:line.index("|", line.index(f"{hw['lanes']} x 1")) + 1])
        text = re.sub(rf"^{same}.*$", line, text, flags=re.M) if re.search(rf"^{same}", text, re.M) else text.rstrip("\n") + "\n" + line + "\n"
        options.docs.write_text(text)


if __name__ == "__main__":
    main()
