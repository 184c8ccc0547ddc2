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
from yosys import run, sources_of, yosys

RESULTS = HERE / "results.json"
KEYS = {"part", "stage", "with", "tied", "note"}
SEEDS, SECONDS = (1, 2, 3), 240  # of nextpnr, which now and then does not end
WANTED = 80  # MHz: below that further seeds are tried
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


def read_parts():
    return tomllib.loads((HERE / "parts.toml").read_text())["part"]


def name_of(part):
    parameters = " ".join(f"{key}={value}" for key, value in part.get("with", {}).items())
    tied = " ".join(f"{key}={value}" for key, value in part.get("tied", {}).items())
    return f"{part['part']} {parameters} {tied}".replace("  ", " ").strip()


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


def measured(part):
    """LUT4, registers, memories and MHz. No MHz: it does not fit."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "wrapper.sv").write_text(wrapper(part, ports_of(part, folder)))
        files = " ".join(map(str, sources_of(part["part"])))
        yosys(f"read_verilog -sv {files} {folder}/wrapper.sv; synth_ice40 -top wrapper -json {folder}/net.json")
        cells = [cell["type"] for m in json.loads((folder / "net.json").read_text())["modules"].values()
                 if int(m["attributes"].get("top", "0"), 2) for cell in m["cells"].values()]
        result = {what: sum(cell.startswith(kind) for cell in cells) for what, kind in CELLS.items()}
        return result | placed(folder / "net.json")


def placed(net):
    """The best seed and its MHz; no MHz if it does not fit."""
    found = []
    for seed in SEEDS:
        code, text = run(["nextpnr-ice40", "--hx8k", "--package", "ct256", "--json", str(net), "--seed", str(seed), "--freq", "100",
                          "--timing-allow-fail", "--pcf-allow-unconstrained"], SECONDS)
        clocks = re.findall(r"Max frequency for clock\s+'[^']*': ([\d.]+) MHz", text)
        if code > 0 and re.search(r"(?i)unable to (place|find)|no Bels remaining|failed to (place|expand)", text):
            return {"seed": seed, "mhz": None}
        if code > 0:
            raise RuntimeError(text.strip().splitlines()[-1])
        if code == 0:
            found.append((float(clocks[-1]), seed))
        if found and max(found)[0] >= WANTED:
            break
    if not found:
        raise RuntimeError(f"nextpnr does not end in {SECONDS} s with any of {len(SEEDS)} seeds")
    mhz, seed = max(found)
    return {"seed": seed, "mhz": mhz}


def page(parts, results):
    lines = [HEAD, "| part | of the stage | LUT4 | registers | MHz | |", "|---|---|--:|--:|--:|---|"]
    slowest = []
    for part in parts:
        found = results.get(name_of(part), {})
        mhz = "not placed yet" if not found else f"{found['mhz']:.0f}" if found["mhz"] else "does not fit"
        name, _, parameters = name_of(part).partition(" ")
        lines.append(f"| `{name}`{', ' + parameters if parameters else ''} | {part['stage']} | {found.get('luts', 0):,} | "
                     f"{found.get('registers', 0):,} | {mhz} | {part.get('note', '')} |")
        slowest += [(found["mhz"], name)] if found.get("mhz") else []
    if slowest:
        lines += ["", f"The slowest is `{min(slowest)[1]}`. Of {len(slowest)} that are placed, "
                  f"{sum(mhz >= WANTED for mhz, _ in slowest)} reach {WANTED} MHz."]
    return "\n".join(lines) + "\n"


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
