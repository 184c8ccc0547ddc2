#!/usr/bin/env python3
"""Does synthesis take as many blocks of memory as the rule of `explore` says? In more than twenty pipelines.

  tests/rtl/cost/blocks.py                   asks for each memory of each pipeline
  tests/rtl/cost/blocks.py --docs FILE       writes the page

`voxmelt rtl` writes the pipelines. Yosys finds their memories, and puts each into blocks of 7 series, alone. The rule is
that of `explore` with the shapes of the family: blocks of one shape, few of them and few rows of words, where rows share
blocks byte by byte.
"""
import argparse
import collections
import json
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))
sys.path.insert(0, str(HERE))
from run import FAMILIES, written
from yosys import RTL, yosys

# Scenes of both laws, with and without heat, of 16 to 200 cells a side.
SCENES = {"cello": [], "lava": [], "goblet": [], "lesson_oven": [], "lesson_spread": [],
          "cello_viscous": ["flow.viscous.substeps=1"], "proving_ground_viscous": ["flow.viscous.substeps=1"]}
LANES = (1, 2, 4)
BLOCKS = {"RAMB36E1": 2, "RAMB18E1": 1}


def bits_of(number):
    return int(number, 2) if isinstance(number, str) else number


def memories_of(scene, settings, lanes, folder):
    """Width and words of each memory, and how often it is there. Channels of a word are registers."""
    files, net = folder / f"{scene}_{lanes}", folder / "net.json"
    written(files, scene, [*settings, f"hw.lanes={lanes}", "hw.fifo_depth=1"])
    sources = sorted(RTL.glob("*.sv"), key=lambda file: file.name != "voxmelt_pkg.sv")
    yosys(f"read_verilog -sv -D VOXMELT_BLOCKS {' '.join(map(str, sources))} pipeline.sv; hierarchy -top pipeline; proc; flatten; "
          f"opt_clean; memory -nomap; write_json {net}", files)
    found = collections.Counter()
    for cell in json.loads(net.read_text())["modules"]["pipeline"]["cells"].values():
        given = cell["parameters"]
        if cell["type"].startswith("$mem") and bits_of(given["WR_PORTS"]) and bits_of(given["SIZE"]) > 2:
            found[bits_of(given["WIDTH"]), bits_of(given["SIZE"])] += 1
    return found


def by_rule(width, words, memory):
    up, ways = lambda a, b: -(-a // b), []
    for bits, deep in memory["bram_shapes"]:
        rows, byte = up(words, deep), min(memory["byte_bits"], bits)
        parts = up(rows * up(width, byte), bits // byte)
        ways.append((parts * memory["part_mux_bits"] + (rows - 1) * width, parts))
    return min(ways)[1]


def by_synthesis(width, words, folder):
    """Blocks of a memory alone. One read and one write, each with a clock."""
    top, net = folder / "memory.sv", folder / "memory.json"
    top.write_text(f"""module top(input clk, input en, input [{width - 1}:0] d, input [{max(1, (words - 1).bit_length()) - 1}:0] at,
  output reg [{width - 1}:0] q);
  reg [{width - 1}:0] words[0:{words - 1}];
  always @(posedge clk) if (en) begin
    q <= words[at];
    words[at] <= d;
  end
endmodule
""")
    yosys(f"read_verilog -sv {top}; synth_xilinx -family xc7 -noiopad -nolutram -top top; write_json {net}")
    cells = json.loads(net.read_text())["modules"]["top"]["cells"].values()
    return sum(BLOCKS.get(cell["type"], 0) for cell in cells)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--docs", type=Path, help="the page to write")
    options = parser.parse_args()
    memory = tomllib.loads((FAMILIES / "7series.toml").read_text())["memory"]
    synthesised, rows, wrong = {}, [], collections.Counter()
    with tempfile.TemporaryDirectory() as name:
        for scene, settings in SCENES.items():
            for lanes in LANES:
                memories = memories_of(scene, settings, lanes, Path(name))
                for one in memories:
                    if one not in synthesised:
                        synthesised[one] = by_synthesis(*one, Path(name))
                    if synthesised[one] != by_rule(*one, memory):
                        wrong[one] += 1
                sums = [sum(n * blocks(one) for one, n in memories.items())
                        for blocks in (lambda one: by_rule(*one, memory), synthesised.get)]
                rows.append((scene, lanes, sum(memories.values()), *sums))
                print(*rows[-1], flush=True)
    for (width, words), times in sorted(wrong.items()):
        print(f"{words} words of {width} bits: {by_rule(width, words, memory)} by the rule, {synthesised[width, words]} by synthesis, "
              f"in {times} pipelines")
    lines = ["<!-- Written by tests/rtl/cost/blocks.py -->", "# Blocks of memory", "",
             "Memories of pipelines, in halves of a RAMB36E1: by the rule of `explore`, and by Yosys for 7 series,", "each alone.", "",
             "| scene | lanes | memories | by the rule | by synthesis |", "|---|--:|--:|--:|--:|",
             *(f"| `{scene}` | {lanes} | {count} | {rule} | {found} |" for scene, lanes, count, rule, found in rows), "",
             f"Of {len(synthesised)} different memories {len(synthesised) - len(wrong)} take what the rule says.", "",
             "Run it yourself: `python3 tests/rtl/cost/blocks.py --docs docs/results/rtl_blocks.md`. It wants", "Debian's `yosys`."]
    if options.docs:
        options.docs.write_text("\n".join(lines) + "\n")
    print(lines[-4])


if __name__ == "__main__":
    main()
