#!/usr/bin/env python3
"""How fast are the parts of the stages in SystemVerilog on an iCE40 HX8K, and how large?

  tests/rtl/clocks/run.py --check       every part is there: this is quick, and one of ./test.sh
  tests/rtl/clocks/run.py               synthesises and places each (an hour of processor time); goes on where it stopped
  tests/rtl/clocks/run.py --only NAME   those whose name holds this expression
  tests/rtl/clocks/run.py --docs FILE   writes the page, too

Each part of parts.toml stands between shift registers, so that its own registers bound the clock. Yosys synthesises it,
with products in logic, and nextpnr places and routes it. What was found is kept in results.json beside this file.
"""
import argparse
import hashlib
import json
import re
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))
sys.path.insert(0, str(HERE))
from loops import loops_of
from yosys import run, sources_of, yosys

RESULTS = HERE / "results.json"
KEYS = {"part", "stage", "with", "tied", "note", "loops"}
SECONDS = 240  # of nextpnr, which now and then does not end
WANTED, SEEDS = 80, 3  # MHz: below that further seeds are tried, up to so many
OF_LOOPS, SEEDS_OF_LOOPS = 95, 6
CELLS = {"luts": "SB_LUT4", "registers": "SB_DFF", "memories": "SB_RAM"}
HEAD = """<!-- Written by tests/rtl/clocks/run.py -->
# Clocks of the parts in SystemVerilog

An iCE40 HX8K has 7,680 LUT4, so stages are cut at their registers into parts that fit. Each part
stands between shift registers. Yosys synthesises it with products in logic, and nextpnr places and
routes it, with up to three seeds where the first is below 80 MHz. Numbers are for columns of up to
4096 cells. A part that does not fit is placed in its own parts. LUT4 and registers count the shift
registers, too.

Run it yourself: `python3 tests/rtl/clocks/run.py`. It wants Debian's `yosys` and `nextpnr-ice40`.
"""


LOOPS = """## Loops alone

Registers that depend on themselves, and the logic between them. What lies outside of loops could
have further registers, so these set the clock that a part can reach. The loops of a part stand
together, with up to six seeds where the first is below 95 MHz. No other part of the table above
has any.
"""


def read_parts():
    return tomllib.loads((HERE / "parts.toml").read_text())["part"]


def name_of(part):
    parameters = " ".join(f"{key}={value}" for key, value in part.get("with", {}).items())
    tied = " ".join(f"{key}={value}" for key, value in part.get("tied", {}).items())
    return f"{'loops of ' if part.get('loops') else ''}{part['part']} {parameters} {tied}".replace("  ", " ").strip()


def key_of(part):
    """What a result rests on."""
    text = name_of(part) + "".join(file.read_text() for file in sources_of(part["part"]))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def ports_of(part, folder):
    """Name, direction and width of each port."""
    ports = folder / "ports.json"
    parameters = "".join(f"chparam -set {key} {value} {part['part']}; " for key, value in part.get("with", {}).items())
    files = " ".join(map(str, sources_of(part["part"])))
    yosys(f"read_verilog -sv {files}; {parameters}hierarchy -top {part['part']}; proc; write_json {ports}")
    modules = json.loads(ports.read_text())["modules"]
    top = next(m for m in modules.values() if int(m["attributes"].get("top", "0"), 2))
    return [(name, port["direction"], len(port["bits"])) for name, port in top["ports"].items()]


def wrapper(part, ports):
    """A module with three pins, whose registers feed and read the part. Inputs that are tied have one value."""
    tied = part.get("tied", {})
    into = [(name, width) for name, direction, width in ports if direction == "input" and name != "clk" and name not in tied]
    out = [(name, width) for name, direction, width in ports if direction == "output"]
    wide, read = sum(width for _, width in into), sum(width for _, width in out)
    pins, at = [".clk(clk)"] if any(name == "clk" for name, _, _ in ports) else [], 0
    pins += [f".{name}({width}'d{tied[name]})" for name, _, width in ports if name in tied]
    for name, width in into:
        pins.append(f".{name}(i[{at + width - 1}:{at}])")
        at += width
    at = 0
    for name, width in out:
        pins.append(f".{name}(o[{at + width - 1}:{at}])")
        at += width
    parameters = ", ".join(f".{key}({value})" for key, value in part.get("with", {}).items())
    return f"""module wrapper(input clk, input d, output reg q);
  reg [{wide - 1}:0] i;
  wire [{read - 1}:0] o;
  reg [{read}:0] s;
  reg load;
  always @(posedge clk) begin
    i <= {{i, d}};
    load <= d & i[{min(3, wide - 1)}];
    s <= load ? {{1'b0, o}} : {{1'b0, s[{read}:1]}};
    q <= s[0];
  end
  {part['part']} {f'#({parameters})' if parameters else ''} part ({', '.join(pins)});
endmodule
"""


def loops_alone(part, folder):
    """The command of Yosys that reads the loops of a part, and their ports."""
    parameters = "".join(f"chparam -set {key} {value} {part['part']}; " for key, value in part.get("with", {}).items())
    files = " ".join(map(str, sources_of(part["part"])))
    registers = " ".join(f"t:${kind}" for kind in ("dff", "dffe", "sdff", "sdffe", "sdffce"))
    yosys(f"read_verilog -sv {files}; {parameters}hierarchy -top {part['part']}; proc; flatten; opt -full; simplemap {registers}; "
          f"write_json {folder}/part.json")
    modules = json.loads((folder / "part.json").read_text())["modules"]
    loops = loops_of(next(m for m in modules.values() if int(m["attributes"].get("top", "0"), 2)))
    (folder / "loops.json").write_text(json.dumps({"modules": {"loops": loops}}))
    return f"read_json {folder}/loops.json", [(name, port["direction"], len(port["bits"])) for name, port in loops["ports"].items()]


def measured(part):
    """LUT4, registers, memories and MHz. No MHz: it does not fit."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if part.get("loops"):
            reads, ports = loops_alone(part, folder)
            text = wrapper({"part": "loops"}, ports)
        else:
            reads, text = f"read_verilog -sv {' '.join(map(str, sources_of(part['part'])))}", wrapper(part, ports_of(part, folder))
        (folder / "wrapper.sv").write_text(text)
        yosys(f"{reads}; read_verilog -sv {folder}/wrapper.sv; synth_ice40 -top wrapper -json {folder}/net.json")
        cells = [cell["type"] for m in json.loads((folder / "net.json").read_text())["modules"].values()
                 if int(m["attributes"].get("top", "0"), 2) for cell in m["cells"].values()]
        result = {what: sum(cell.startswith(kind) for cell in cells) for what, kind in CELLS.items()}
        return result | placed(folder / "net.json", *((OF_LOOPS, SEEDS_OF_LOOPS) if part.get("loops") else (WANTED, SEEDS)))


def placed(net, wanted, seeds):
    """The best seed and its MHz; no MHz if it does not fit."""
    found = []
    for seed in range(1, seeds + 1):
        code, text = run(["nextpnr-ice40", "--hx8k", "--package", "ct256", "--json", str(net), "--seed", str(seed), "--freq", "100",
                          "--timing-allow-fail", "--pcf-allow-unconstrained"], SECONDS)
        clocks = re.findall(r"Max frequency for clock\s+'[^']*': ([\d.]+) MHz", text)
        if code > 0 and re.search(r"(?i)unable to (place|find)|no Bels remaining|failed to (place|expand)", text):
            return {"seed": seed, "mhz": None}
        if code > 0:
            raise RuntimeError(text.strip().splitlines()[-1])
        if code == 0:
            found.append((float(clocks[-1]), seed))
        if found and max(found)[0] >= wanted:
            break
    if not found:
        raise RuntimeError(f"nextpnr does not end in {SECONDS} s with any of {seeds} seeds")
    mhz, seed = max(found)
    return {"seed": seed, "mhz": mhz}


def row(part, found):
    mhz = "not placed yet" if not found else f"{found['mhz']:.0f}" if found["mhz"] else "does not fit"
    name, _, parameters = name_of({**part, "loops": False}).partition(" ")
    return f"| `{name}`{', ' + parameters if parameters else ''} | {part['stage']} | {found.get('luts', 0):,} | " \
           f"{found.get('registers', 0):,} | {mhz} | {part.get('note', '')} |"


def table(parts, results, wanted):
    lines = ["| part | of the stage | LUT4 | registers | MHz | |", "|---|---|--:|--:|--:|---|",
             *(row(part, results.get(name_of(part), {})) for part in parts)]
    clocks = [(results[name_of(part)]["mhz"], part["part"]) for part in parts if results.get(name_of(part), {}).get("mhz")]
    if clocks:
        lines += ["", f"The slowest is `{min(clocks)[1]}`. Of {len(clocks)} that are placed, "
                  f"{sum(mhz >= wanted for mhz, _ in clocks)} reach {wanted} MHz."]
    return lines


def page(parts, results):
    whole, loops = ([part for part in parts if bool(part.get("loops")) == wanted] for wanted in (False, True))
    return "\n".join([HEAD, *table(whole, results, WANTED), "", LOOPS, *table(loops, results, OF_LOOPS)]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only see that every part is there")
    parser.add_argument("--only", default="", help="parts whose name holds this regular expression")
    parser.add_argument("--again", action="store_true", help="also what has a result")
    parser.add_argument("--docs", type=Path, help="a page to write with the table")
    options = parser.parse_args()
    parts = read_parts()
    names = [name_of(part) for part in parts]
    wrong = [f"{name}: stands there twice" for name in set(names) if names.count(name) > 1]
    wrong += [f"{name_of(part)}: has the keys {', '.join(sorted(part))}" for part in parts if not {"part", "stage"} <= set(part) <= KEYS]
    for part in parts:
        try:
            sources_of(part["part"])
        except FileNotFoundError as error:
            wrong.append(f"{name_of(part)}: {error}")
    if wrong or not parts:
        print("\n".join(wrong) or "no parts")
        return 1
    if options.check:
        print(f"{len(parts)} parts are there")
        return 0
    results = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    for part in parts:
        name, key = name_of(part), key_of(part)
        if not re.search(options.only, name) or (results.get(name, {}).get("key") == key and not options.again):
            continue
        results[name] = measured(part) | {"key": key}
        RESULTS.write_text("{\n" + ",\n".join(f"{json.dumps(n)}: {json.dumps(results[n])}" for n in names if n in results) + "\n}\n")
        print(name, {k: v for k, v in results[name].items() if k != "key"}, flush=True)
    if options.docs:
        options.docs.write_text(page(parts, {n: r for n, r in results.items() if n in names}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
