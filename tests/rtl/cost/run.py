#!/usr/bin/env python3
"""How large are the stages in SystemVerilog? The answer goes into the files of the families, which `explore` reads.

  tests/rtl/cost/run.py --check          the families and the page say what the results say: one of ./test.sh
  tests/rtl/cost/run.py                  synthesises what has no result yet, or another one's sources
  tests/rtl/cost/run.py --only NAME      those whose name holds this expression
  tests/rtl/cost/run.py --write          writes the families and docs/results/rtl_cost.md

It wants the program: cmake --build --preset release --target voxmelt voxmelt-hardware

`voxmelt rtl` writes the pipelines of two scenes in which every stage has work. Yosys synthesises each stage of them, with
its constants, for 1, 4 and 16 lanes and each family. What it finds is kept in results.json. A number counts what a stage
has beside its dividers and its random blocks, which families have apart.
"""
import argparse
import collections
import hashlib
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))
from yosys import sources_of, yosys

ROOT = HERE.parents[2]
PROGRAM = ROOT / "build/release/app/voxmelt"
RESULTS, PAGE, FAMILIES = HERE / "results.json", ROOT / "docs/results/rtl_cost.md", ROOT / "hwmodel/explore/families"
LANES = (1, 4, 16)
# Columns of up to 1024 cells and planes of up to 4096 tokens, whose memories are blocks; runs of up to 256 cells.
MEMORIES = {"DEPTH_EAST": 1023, "DEPTH_NORTH": 4095, "DEPTH_SOUTH_EAST": 1023, "DEPTH_FINISHED": 1023, "HEIGHT": 1024, "BLOCKS": 64,
            "SUM": 24, "LAST": 8}
# Scenes, what is set in them, and the stages that have their constants. The first two have none but the grid's size.
SCENES = [("", [], ["fall", "walls"]),
          ("proving_ground", ["heat.neighbours=6"],
           ["source", "conduction", "convection", "exchange", "melt", "gravity", "pattern", "apply"]),
          ("proving_ground", ["heat.neighbours=26"], ["edges", "corners"]),
          ("proving_ground_viscous", ["heat.neighbours=6", "flow.viscous.substeps=1"], ["settle", "spread"])]
STAGES = [stage for _, _, stages in SCENES for stage in stages]
PARTS = {"mixer": "divider", "speck_unit": "random_block"}
# By family: what synthesises, and what cells take of LUTs. Yosys takes registers into the DSPs of 7 series alone. Those of
# UltraScale+ have the same ones, and its LUTs and shift registers are alike.
TOOLS = {"7series": ("synth_xilinx -family xc7 -noiopad -nolutram -flatten",
                     {r"LUT[1-6]": 1, r"SRL16E|SRLC32E": 1},
                     r"FD[RSCP]E", r"DSP48E1"),
         "ecp5": ("synth_ecp5", {r"LUT4": 1, r"CCU2C": 2, r"TRELLIS_DPR16X4": 6}, r"TRELLIS_FF", r"MULT18X18D")}
WHAT = ("lut", "ff", "dsp")
# Products and dividers of a lane of these, as Stage::units counts, but for those of thermal viscosity: the circuits have a
# table for that.
PRODUCTS = {"source": 6, "conduction": 3, "edges": 6, "corners": 4, "convection": 1, "exchange": 4, "melt": 1, "gravity": 5, "pattern": 2, "apply": 11,
            "settle": 16, "spread": 21}
DIVIDERS = {"source": 1, "gravity": 1, "apply": 1, "settle": 5, "spread": 1}


def written(folder, scene, settings, first=0):
    """The pipeline that `voxmelt rtl` writes."""
    words = [word for one in settings for word in ("--set", one)]
    result = subprocess.run([PROGRAM, "rtl", scene, "--from", str(first), *words, "--out", folder], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{PROGRAM} rtl {scene}: {result.stderr.strip()}")
    return (folder / "pipeline.sv").read_text()


def with_constants(pipeline, stage):
    """A module that has the first such stage of a pipeline. Its constants stay, and all that flows is a port."""
    parameters, pins = re.search(rf"^  {stage}_stage #\((.*?)\) t0_\w+ \(\n(.*?)\);$", pipeline, re.M | re.S).groups()
    lanes = re.search(r"\.P\((\d+)\)", parameters)[1]
    parameters = re.sub(r"\.(\w+)\(\d+\)", lambda m: f".{m[1]}({MEMORIES[m[1]]})" if m[1] in MEMORIES else m[0], parameters)
    head = re.search(r"^module \w+ #\(.*?\)\s*\(\n(.*?)^\);", sources_of(f"{stage}_stage")[-1].read_text(), re.M | re.S)[1]
    word = r"\bP\b"
    kinds = {name: f"{way} {kind} {re.sub(word, lanes, width or '')}" for way, kind, width, name in
             re.findall(r"^\s*(input|output)\s+(logic|voxmelt_pkg::\w+)\s*(\[[^\]]*\])?\s*(\w+)", head, re.M)}
    found = re.findall(r"\.(\w+)\(((?:[^()]|\([^()]*\))*)\)", pins)
    constants = {name for name, value in found if re.fullmatch(r"\d+'[hdb][0-9a-f]+", value)}
    ports = ", ".join(f"{kinds[name]} {name}" for name, _ in found if name not in constants)
    pins = ", ".join(f".{name}({value if name in constants else name})" for name, value in found)
    return f"module top({ports});\n  {stage}_stage #({parameters}) stage({pins});\nendmodule\n"


def alone(part, parameters, constants=None):
    """The same of a part, with these of its inputs constant."""
    constants = constants or {}
    file = sources_of(part)[-1]
    head = re.search(rf"^module {part}\b(?: #\((?:.*?)^\))? \(\n(.*?)^\);", file.read_text(), re.M | re.S)[1]
    given = {key: value for key, value in (MEMORIES | parameters).items() if re.search(rf"parameter {key}\b", file.read_text())}
    widths = re.sub(r"\bP\b", str(parameters.get("P", 1)), re.sub(r"//.*", "", head))
    ports = {line.split()[-1]: line.strip() for line in widths.replace("\n", " ").split(",")}
    outside = ", ".join(line for name, line in ports.items() if name not in constants)
    return f"module top({outside});\n  {part} {'#(' + ', '.join(f'.{k}({v})' for k, v in given.items()) + ')' if given else ''} " \
           f"part({', '.join(f'.{name}({constants.get(name, name)})' for name in ports)});\nendmodule\n"


def jobs(folder):
    """Name, part, the module that has it, and the folder of its files, of each synthesis."""
    one_lane = written(folder / "keys", "proving_ground", ["heat.neighbours=6", "hw.lanes=1"])
    for part in PARTS:
        yield part, part, alone(part, {}, dict(re.findall(r"\.(keys)\((\w+'h\w+)\)", one_lane)) if part == "speck_unit" else None), folder
    for lanes in LANES:
        for number, (scene, settings, stages) in enumerate(SCENES):
            files = folder / f"{number}_{lanes}"
            pipeline = written(files, scene, [*settings, f"hw.lanes={lanes}"]) if scene else ""
            for stage in stages:
                text = with_constants(pipeline, stage) if scene else alone(f"{stage}_stage", {"P": lanes})
                yield f"{stage} x {lanes}", f"{stage}_stage", text, files if scene else folder


def key_of(family, part, text):
    text = f"{TOOLS[family][0]} {text}" + "".join(file.read_text() for file in sources_of(part))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def counted(family, modules, top):
    """LUTs, flip-flops and DSPs of a netlist."""
    _, luts, registers, products = TOOLS[family]
    cells = collections.Counter(cell["type"] for cell in modules[top]["cells"].values())
    count = lambda kind: sum(n for name, n in cells.items() if re.fullmatch(kind, name))
    return dict(zip(WHAT, (sum(n * count(kind) for kind, n in luts.items()), count(registers), count(products))))


def synthesised(family, part, text, files, folder):
    net, top = folder / "net.json", folder / "top.sv"
    top.write_text(text)
    sources = " ".join(map(str, [*sources_of(part), top]))
    yosys(f"read_verilog -sv -D VOXMELT_BLOCKS {sources}; {TOOLS[family][0]} -top top; write_json {net}", files)
    return counted(family, json.loads(net.read_text())["modules"], "top")


def slope(results, family, stage, what):
    """What a stage takes once, and what for each lane, beside its random blocks, of which one serves eight lanes."""
    block = results[f"{family}: speck_unit"][what] if stage == "pattern" else 0
    found = [(n, results[key][what] - -(-n // 8) * block) for n in LANES if (key := f"{family}: {stage} x {n}") in results]
    (few, least), (many, most) = found[-2:]
    lane = (most - least) / (many - few)
    return least - few * lane, lane


def divider(results, family, what):
    """A divider is the mixer, or less where a stage of several has less. Its other logic counts as one more there."""
    shares = [slope(results, family, stage, what)[1] / (count + 1) for stage, count in DIVIDERS.items() if count > 1]
    return round(min(results[f"{family}: mixer"][what], *shares))


def beside(results, family, stage, what):
    """The same beside its dividers, too."""
    once, lane = slope(results, family, stage, what)
    return once, lane - (DIVIDERS.get(stage, 0) * divider(results, family, what) if what != "dsp" else 0)


def numbers_of(results, family):
    """Of each table of a family: LUTs, flip-flops, products and DSPs, and where they are from."""
    found = {"divider": [divider(results, family, what) for what in ("lut", "ff")],
             "random_block": [results[f"{family}: speck_unit"][what] for what in ("lut", "ff")]}
    once = [[beside(results, family, stage, what)[0] for stage in STAGES] for what in ("lut", "ff")]
    found["control"] = [max(0, round(sum(column) / len(column))) for column in once]
    for stage in STAGES:
        found[f"stage.{stage}"] = [max(0, round(beside(results, family, stage, what)[1])) for what in ("lut", "ff")]
    said = dict.fromkeys(found, "synthesised: by tests/rtl/cost/run.py")
    said["stage.source"] += ", with a vent and a drain"
    dsp = {f"stage.{stage}": [count, round(beside(results, family, stage, "dsp")[1])] for stage, count in PRODUCTS.items()}
    return {name: (*found[name], dsp.get(name), said[name]) for name in found}


def with_numbers(text, numbers):
    """The text of a family's file with these numbers in its tables."""
    for table, (lut, ff, dsp, source) in numbers.items():
        head = rf"^\[{re.escape(table)}\]\n"
        body = re.search(head + r"((?:(?!\[).*\n)*)", text, re.M)
        if not body:
            sys.exit(f"a family has no table [{table}]")
        kept = [line for line in body[1].splitlines() if not re.match(r"(lut|ff|dsp|source|ff_source|lut_range|ff_range) =", line)]
        stays = [line for line in kept if line and not line.startswith("#")]
        new = [f"lut = {lut}", f"ff = {ff}", *([f"dsp = {dsp}"] if dsp else []), *stays, f'source = "{source}"']
        tail = [line for line in kept if not line or line.startswith("#")]
        text = text[:body.start(1)] + "\n".join(new + tail) + "\n" + text[body.end(1):]
    return text


def families(results):
    """The texts of the families' files."""
    for family, of in (("7series", "7series"), ("ultrascale+", "7series"), ("ecp5", "ecp5")):
        numbers = numbers_of(results, of)
        if family != of:
            numbers = {name: (lut, ff, dsp, source.replace("by tests", "as 7 series, by tests")) for name, (lut, ff, dsp, source) in numbers.items()}
        yield FAMILIES / f"{family}.toml", with_numbers((FAMILIES / f"{family}.toml").read_text(), numbers)


HEAD = """<!-- Written by tests/rtl/cost/run.py -->
# Sizes of the stages in SystemVerilog

`voxmelt rtl` writes the pipelines of the proving grounds, in which every stage has work. Yosys
synthesises their stages with heat and with the scene's constants, products in DSPs and memories in
blocks. A shift register of 7 series is a LUT. Columns have up to 1024 cells, and runs up to 256. The
scene has a vent and a drain. `explore` takes its numbers from here, as a lane and once for each stage.

Yosys takes registers into the DSPs of 7 series alone. Those of UltraScale+ have the same ones, and
its LUTs and shift registers are alike. So `explore` takes these numbers for both.

Run it yourself: `python3 tests/rtl/cost/run.py --write`. It wants Debian's `yosys`, and `voxmelt`.
"""


def page(results):
    lines = [HEAD]
    for family in TOOLS:
        lines += [f"## {family}", "", "| stage | " + " | ".join(f"LUT, {n} | FF, {n} | DSP, {n}" for n in LANES) + " |",
                  "|---|" + "--:|" * 3 * len(LANES)]
        for stage in STAGES:
            cells = [f"{results[key][what]:,}" if (key := f"{family}: {stage} x {lanes}") in results else ""
                     for lanes in LANES for what in WHAT]
            lines.append(f"| {stage} | " + " | ".join(cells) + " |")
        for module, name in PARTS.items():
            one = results[f"{family}: {module}"]
            lines.append(f"| `{module}` | " + " | ".join(f"{one[what]:,}" for what in WHAT) + " |" + " |" * 3 * (len(LANES) - 1))
        lines.append("")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only see that families and page say what the results say")
    parser.add_argument("--only", default="", help="those whose name holds this regular expression")
    parser.add_argument("--write", action="store_true", help="write families and page")
    options = parser.parse_args()
    results = json.loads(RESULTS.read_text()) if RESULTS.is_file() else {}
    if options.check:
        wrong = [str(file.relative_to(ROOT)) for file, text in [*families(results), (PAGE, page(results))] if file.read_text() != text]
        print("\n".join(f"{file} is not what tests/rtl/cost/run.py --write writes" for file in wrong) or f"{len(results)} results")
        sys.exit(1 if wrong else 0)
    with tempfile.TemporaryDirectory() as folder:
        for name, part, text, files in jobs(Path(folder)):
            for family in TOOLS:
                title = f"{family}: {name}"
                key = key_of(family, part, text)
                if not re.search(options.only, title) or results.get(title, {}).get("key") == key:
                    continue
                results[title] = {"key": key} | synthesised(family, part, text, files, Path(folder))
                print(title, {what: results[title][what] for what in WHAT}, flush=True)
                RESULTS.write_text("{\n" + ",\n".join(f'"{one}": {json.dumps(results[one])}' for one in sorted(results)) + "\n}\n")
    if options.write:
        for file, text in [*families(results), (PAGE, page(results))]:
            file.write_text(text)


if __name__ == "__main__":
    main()
