#!/usr/bin/env python3
"""How large are the stages in SystemVerilog? The answer goes into the files of the families, which `explore` reads.

  tests/rtl/cost/run.py --check          the families and the page say what the results say: one of ./test.sh
  tests/rtl/cost/run.py                  synthesises what has no result yet, or another one's sources
  tests/rtl/cost/run.py --only NAME      those whose name holds this expression
  tests/rtl/cost/run.py --write          writes the families and docs/results/rtl_cost.md

Yosys synthesises each stage with every feature but those of no committed scene, for 1, 4 and 16 lanes and each family.
What it finds is kept in results.json. A number counts what a stage has beside its dividers and its random blocks, which
families have apart.
"""
import argparse
import collections
import hashlib
import json
import re
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))
from yosys import sources_of, yosys

ROOT = HERE.parents[2]
RESULTS, PAGE, FAMILIES = HERE / "results.json", ROOT / "docs/results/rtl_cost.md", ROOT / "hwmodel/explore/families"
LANES = (1, 4, 16)
# Columns of up to 1024 cells and planes of up to 4096 tokens, whose memories are blocks.
MEMORIES = {"DEPTH_EAST": 1023, "DEPTH_NORTH": 4095, "DEPTH_SOUTH_EAST": 1023, "DEPTH_FINISHED": 1023, "HEIGHT": 1024, "BLOCKS": 64}
STAGES = {"fall": {}, "source": {}, "walls": {}, "conduction": {}, "convection": {}, "exchange": {}, "melt": {}, "gravity": {},
          "pattern": {}, "apply": {"TABLE": 0, "PRINTED": 0}, "settle": {}, "spread": {}}
PARTS = {"mixer": "divider", "speck_unit": "random_block"}
# By family: what synthesises, and what cells take of LUTs.
TOOLS = {"ultrascale+": ("synth_xilinx -family xcup -noiopad -nolutram -flatten",
                         {r"LUT[1-6]": 1, r"SRL16E|SRLC32E": 1},
                         r"FD[RSCP]E", r"DSP48E2"),
         "ecp5": ("synth_ecp5", {r"LUT4": 1, r"CCU2C": 2, r"TRELLIS_DPR16X4": 6}, r"TRELLIS_FF", r"MULT18X18D")}
WHAT = ("lut", "ff", "dsp")
# Products and dividers of a lane with every feature (the paper's law without thermal viscosity), as Stage::units counts.
PRODUCTS = {"source": 12, "conduction": 3, "convection": 1, "exchange": 4, "melt": 1, "gravity": 5, "pattern": 2, "apply": 11,
            "settle": 16, "spread": 21}
DIVIDERS = {"source": 2, "gravity": 1, "apply": 1, "settle": 5, "spread": 1}


def jobs():
    """Name, module and parameters of each synthesis."""
    for part in PARTS:
        yield part, part, {}
    for lanes in LANES:
        for stage, given in STAGES.items():
            yield f"{stage} x {lanes}", f"{stage}_stage", {"P": lanes} | given


def parameters_of(module, given):
    text = sources_of(module)[-1].read_text()
    head = re.search(rf"^module {module} #\((.*?)^\)", text, re.M | re.S)
    known = re.findall(r"parameter (\w+)", head[1]) if head else []
    return {key: value for key, value in (MEMORIES | given).items() if key in known}


def key_of(family, module, given):
    text = f"{TOOLS[family][0]} {module} {given}" + "".join(file.read_text() for file in sources_of(module))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def synthesised(family, module, given):
    tool, luts, registers, products = TOOLS[family]
    with tempfile.TemporaryDirectory() as folder:
        net = Path(folder) / "net.json"
        files = " ".join(map(str, sources_of(module)))
        parameters = "".join(f"chparam -set {key} {value} {module}; " for key, value in parameters_of(module, given).items())
        yosys(f"read_verilog -sv -D VOXMELT_BLOCKS {files}; {parameters}{tool} -top {module}; write_json {net}")
        modules = json.loads(net.read_text())["modules"].values()
    top = next(m for m in modules if int(m["attributes"].get("top", "0"), 2))
    cells = collections.Counter(cell["type"] for cell in top["cells"].values())
    count = lambda kind: sum(n for name, n in cells.items() if re.fullmatch(kind, name))
    return dict(zip(WHAT, (sum(n * count(kind) for kind, n in luts.items()), count(registers), count(products))))


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
    said["stage.source"] += ", with two vents and two drains"
    for name, parts, words in ("stage.edges", 2, "two conductions"), ("stage.corners", 4 / 3, "four thirds of a conduction"):
        found[name] = [round(parts * number) for number in found["stage.conduction"]]
        said[name] = f"assumed: {words}"
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
    for family in TOOLS:
        yield FAMILIES / f"{family}.toml", with_numbers((FAMILIES / f"{family}.toml").read_text(), numbers_of(results, family))
    counted = {name: (lut, ff, None, re.sub("^synthesised:", "counted: on UltraScale+ it was synthesised", source))
               for name, (lut, ff, _, source) in numbers_of(results, "ultrascale+").items()}
    yield FAMILIES / "7series.toml", with_numbers((FAMILIES / "7series.toml").read_text(), counted)


HEAD = """<!-- Written by tests/rtl/cost/run.py -->
# Sizes of the stages in SystemVerilog

Yosys synthesises each stage with heat, with its products in DSPs and its memories in blocks. A shift
register of UltraScale+ is a LUT. Columns have up to 1024 cells. The stage `source` has two vents and
two drains. `explore` takes its numbers from here, as a lane and once for each stage.

Run it yourself: `python3 tests/rtl/cost/run.py --write`. It wants Debian's `yosys`.
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
    for name, module, given in jobs():
        for family in TOOLS:
            title = f"{family}: {name}"
            if not re.search(options.only, title):
                continue
            key = key_of(family, module, given)
            if results.get(title, {}).get("key") == key:
                continue
            results[title] = {"key": key} | synthesised(family, module, given)
            print(title, {what: results[title][what] for what in WHAT}, flush=True)
            RESULTS.write_text("{\n" + ",\n".join(f'"{one}": {json.dumps(results[one])}' for one in sorted(results)) + "\n}\n")
    if options.write:
        for file, text in [*families(results), (PAGE, page(results))]:
            file.write_text(text)


if __name__ == "__main__":
    main()
