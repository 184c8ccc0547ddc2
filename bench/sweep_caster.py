#!/usr/bin/env python3
"""Tables of docs/hardware/ray-caster.md: what the ray caster's numbers are worth, in simulated cycles.

sweep_caster.py PROGRAM sampler|defaults|frames|simulation [SIZE [SCENE...]]

sampler     how busy the sampler is on cello, with caches that hold everything; fails if it is less than 90 % with
            the default number of tiles
defaults    cycles against bits of memory, one number of the configuration changed at a time
frames      frames per second at 200 MHz, W = 4, on a DRAM (ddr4-2400), and what bounds them
simulation  samples per second of the simulation, with everything compared

Every run checks the picture's bytes. The simulated cycles do not depend on the machine at hand.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

SCENES = {"cello": 1048, "goblet": 600, "lava": 400, "lava_viscous": 400, "bunny": 300, "proving_ground": 40, "ice": 200}
SHOWCASE = ["cello", "goblet", "lava", "lava_viscous", "bunny", "ice"]
SWEPT = ["cello", "goblet", "lava", "lava_viscous", "bunny", "proving_ground"]
VIEWS = ["", "160,40", "290,8"]
CACHES = ["levels", "matter", "light", "ground"]
# Bits of a ray under way: 3 x 32 of its place, 3 x 20 of its step, three inverses, the ground that it met, two
# counts of 27 bits, a level and its slope. Of the search: parts of 36 bits in place of the levels.
WALK_BITS, SEARCH_BITS = 96 + 60 + 54 + 170 + 54 + 24, 96 + 60 + 54 + 108
TILE_BITS = 64 * 3 * 18 + 64 * 6 + 192 * 8  # sums, counts and bytes of a tile
LINE_BITS = {"levels": 128 * 8, "matter": 256 * 8, "light": 128 * 8, "ground": 128 * 8}
TAG_BITS, ENTRY_BITS = 32, 160


def run(program, scene, *, view="", size="128x128", setting="normal", frames=1, hw=(), compare=False):
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        command = [program, "verify", scene, "--picture", "--from", str(SCENES[scene]), "--size", size,
                   "--setting", setting, "--frames", str(frames), "--report", str(report),
                   "--set", "pieces.fall=false"]  # as docs/hardware/ray-caster.md has it
        if view:
            command += ["--view", view]
        if not compare:
            command.append("--no-compare")
        for one in hw:
            command += ["--set", "hw." + one]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
        result = json.loads(report.read_text())
        result["text"] = done.stdout
        return result


def bits(configuration):
    """Of the memories of a pipe that its configuration sizes."""
    total = configuration["rays"] * WALK_BITS + 32 * SEARCH_BITS + configuration["tiles"] * TILE_BITS
    for name in CACHES:
        cache = configuration[name]
        lines = cache["sets"] * cache["ways"]
        times = 2 if name == "ground" else 1  # heights and texels have one each
        total += times * ((lines + cache["spare"]) * LINE_BITS[name] + lines * TAG_BITS + cache["queue"] * ENTRY_BITS)
    return total


def stages(report):
    return {stage["name"]: stage for stage in report["stages"]}


def window(stage):
    return sum(stage[c] for c in ("busy", "starved", "blocked", "memory"))


def sampler(program, only):
    all_in = [f"{c}_{k}={v}" for c in CACHES for k, v in (("sets", 1024), ("ways", 8))]
    print("| size | configuration | cycles of a frame | levels read: busy, whole frame | from fill to drain |")
    print("|---|---|--:|--:|--:|")
    for size in [only] if only else ["256x256", "512x512"]:
        for hw in ([], ["tiles=8"], ["tiles=10"], ["tiles=16"], ["bands=1"], ["rays=128"]):
            cold, both = (run(program, "cello", size=size, setting="fast", frames=n, hw=all_in + hw) for n in (1, 2))
            a, b = stages(cold)["levels data"], stages(both)["levels data"]
            warm = {c: b[c] - a[c] for c in ("busy", "starved", "blocked", "memory")}
            cycles = both["cycles"] - cold["cycles"]
            print(f"| {size} | {', '.join(hw) or 'default'} | {cycles} | {100 * warm['busy'] / cycles:.1f} % | "
                  f"{100 * warm['busy'] / sum(warm.values()):.1f} % |", flush=True)
            if hw in ([], ["tiles=16"]) and warm["busy"] < 0.9 * cycles:
                sys.exit("the sampler is busy in less than 90 % of the cycles")


def defaults(program, size):
    quarter = ["levels_sets=16", "light_sets=8", "matter_sets=4", "ground_sets=16"]
    choices = [[], quarter, ["levels_ways=2"], ["tiles=4"], ["tiles=8"], ["tiles=16"], ["bands=1"], ["rays=32"], ["rays=128"],
               ["walkers=2"], ["searchers=2"], [f"{c}_spare=8" for c in CACHES], [f"{c}_queue=16" for c in CACHES]]
    base = {}
    print("| changed | kilobits | cycles, mean of ratios | worst | best |\n|---|--:|--:|--:|--:|")
    for hw in choices:
        ratios, kilobits = [], 0
        for scene in SWEPT:
            for view in VIEWS:
                report = run(program, scene, view=view, size=size, hw=hw)
                kilobits = bits(report["configuration"]) / 1000
                if not hw:
                    base[scene, view] = report["cycles"]
                ratios.append(report["cycles"] / base[scene, view])
        mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
        name = hw[0] if len(hw) == 1 else "all caches: " + hw[-1].split("_")[1] if hw else "nothing"
        name = "all caches: a quarter of the sets" if hw is quarter else name
        print(f"| {name} | {kilobits:.0f} | {mean:.3f} | {max(ratios):.3f} | {min(ratios):.3f} |", flush=True)


def frames(program, size):
    print("| scene, step | frames a second | cycles of the first pass, of the second | busiest stages | bus |\n|---|--:|--:|---|--:|")
    for scene in sys.argv[4:] or SHOWCASE:
        report = run(program, scene, size=size, hw=["pipes=4", "memory=ddr4-2400"])
        busy = sorted(((100 * s["busy"] / (4 * report["cycles"]), s["name"]) for s in report["stages"]), reverse=True)
        names = ", ".join(f"{name} {share:.0f} %" for share, name in busy[:3])
        passes = ", ".join(str(p["cycles"]) for p in report["passes"])
        bus = 100 * report["memory"]["bus_cycles"] / report["cycles"]
        print(f"| {scene}, {SCENES[scene]} | {2e8 / report['cycles_of_last_frame']:.0f} | {passes} | {names} | {bus:.0f} % |", flush=True)


def simulation(program, size):
    print("| scene | million samples a second | million cycles a second |\n|---|--:|--:|")
    for scene in sys.argv[4:] or SHOWCASE:
        best = [0.0, 0.0]
        for _ in range(3):  # the machine is shared: the fastest of three
            text = run(program, scene, size=size, compare=True)["text"]
            words = next(line for line in text.splitlines() if line.startswith("simulated in")).split()
            best = [max(old, float(new)) for old, new in zip(best, (words[words.index("cycles") + 3], words[4]))]
        print(f"| {scene} | {best[0]:.2f} | {best[1]:.2f} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    tables = {"sampler": sampler, "defaults": defaults, "frames": frames, "simulation": simulation}
    default_sizes = {"sampler": "", "defaults": "64x64", "frames": "512x512", "simulation": "256x256"}
    tables[sys.argv[2]](sys.argv[1], sys.argv[3] if len(sys.argv) > 3 else default_sizes[sys.argv[2]])
