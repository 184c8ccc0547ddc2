#!/usr/bin/env python3
"""Oracle, reference and every instruction set agree on random foreign scenes: digests of every step, all ledgers,
and the counters of section 10.

  foreign_scenes_test.py VOXMELT ORACLE FIRST LAST             the scenes of these seeds
  foreign_scenes_test.py VOXMELT ORACLE FIRST LAST --covering  also: every range was used at both ends, and more
  foreign_scenes_test.py VOXMELT ORACLE FIRST LAST --only NAME,NAME  by these implementations alone

Ends with 1 at the first scene that differs, keeps its folder and says how to run it again.
"""
import collections
import concurrent.futures
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # a folder of bytecode here would fail oracle.independence
from foreign_keys import ENDS, LAST_STEP, uses
from foreign_scenes import write_scene
from foreign_sources import KEYS_OF

LEDGERS = ("mass", "energy", "heat")
COUNTERS = ("cells", "mass", "limited_cells", "limited_mass")  # in the order of the oracle's line
FREEZE = ("a cell freezes", "a cell is set", "a set cell does not give", "a set cell does not fall",
          "nothing flows back from a set cell", "a frozen cell melts")  # likewise
MATERIALS = ("a pair of two materials conducts", "a wall and another material conduct", "top bounds a temperature",
             "what melts takes heat", "what melts keeps its heat", "what melts gives heat", "its heat is cut at 65535",
             "a bed of another material", "a partly molten bed of another material", "another material falls as a piece",
             "air or glow warms or cools another material")  # likewise
MOST_WORK = 1000000  # cells x sub-steps x steps of a run of more than one step
MANY_SUBSTEPS = 20
CASTERS = ("auto", "walk", "two-level")  # of voxmelt --visibility
MOST_DEAD = 0.2  # share of the scenes in which nothing flows and nothing melts
LEAST_PAST_2_31 = 5  # scenes that cross step 2^31


class Differs(Exception):
    pass


def output(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise Differs(f"{' '.join(map(str, command))}\n  ended with {done.returncode}: {done.stdout[-500:]}{done.stderr[-500:]}")
    return done.stdout.strip().splitlines()


def implementations(voxmelt):
    """Names of those that this processor can run, or of those asked for. A device builds a program for each scene, so
    it runs only if asked for."""
    if "--only" in sys.argv:
        return sys.argv[sys.argv.index("--only") + 1].split(",")
    return [line.split()[0] for line in output(voxmelt, "list", "implementations")
            if "not on this processor" not in line and not line.startswith("gpu:")]


def of_oracle(oracle, start, steps, fields):
    """Its digest lines; for each ledger (start, terms..., what the state holds); the counters; and what happens to pairs, to pieces,
    where it is cold and to materials."""
    lines = output(oracle, start, "--steps", steps, "--every", 1, "--ledger", "--fields", fields)
    digests = [line for line in lines if line.startswith("step")]
    ledgers = {line.split()[1]: [int(n) for n in line.split()[2:]] for line in lines if line.startswith("ledger")}
    counters, *moves = (next([int(n) for n in line.split()[1:]] for line in lines if line.startswith(word))
                        for word in ("counters", "pairs", "pieces", "freeze", "materials"))
    return digests, ledgers, counters, moves


def of_voxmelt(voxmelt, folder, steps, implementation, threads, caster):
    """The same of the program, and its report."""
    file = folder / f"{implementation}.json"
    digests = output(voxmelt, "digest", folder / "scene.toml", "--steps", steps, "--every", 1, "--quiet",
                     "--implementation", implementation, "--threads", threads, "--visibility", caster, "--report", file)
    report = json.loads(file.read_text())
    ledgers = {}
    for name in LEDGERS:
        terms = {key: int(value) for key, value in report[name].items()}  # large numbers are strings
        held = sum(terms.pop(key) for key in ("solid", "liquid", "held") if key in terms)
        start, drift = terms.pop("start"), terms.pop("drift")
        if drift != 0:
            raise Differs(f"{implementation}: the ledger of {name} drifts by {drift}")
        ledgers[name] = [start, *terms.values(), held]
    return digests, ledgers, report


def compare(what, mine, judge):
    if mine == judge:
        return
    pairs = list(zip(mine, judge)) if len(mine) == len(judge) else []
    at, (a, b) = next(((n, pair) for n, pair in enumerate(pairs) if pair[0] != pair[1]), (0, (mine, judge)))
    raise Differs(f"{what}, entry {at}:\n  voxmelt {a}\n  oracle  {b}")


def field(folder, name):
    data = (folder / f"{name}.npy").read_bytes()
    begin = 10 + struct.unpack("<H", data[8:10])[0]
    return struct.unpack(f"<{(len(data) - begin) // 2}H", data[begin:])


def events(scene, steps, digests, moves, report, start, end):
    """What may happen in a scene, by name, and whether it did in this one."""
    pairs, pieces, freeze, materials = moves
    first, side = scene.get("start", {}).get("step", 0), scene["grid"]["size"][0]
    moved = sum(abs(a - b) for a, b in zip(field(start, "amount"), field(end, "amount")))
    solids = [int(line.split()[7]) for line in (digests[0], digests[-1])]
    terms = {f"{name}: {term}": int(value) != 0 for name in LEDGERS for term, value in report[name].items()
             if term not in ("start", "solid", "liquid", "held", "drift")}
    # Vents and drains alone change amounts by what they add and remove; melting changes none.
    flows, melts = moved > int(report["mass"]["added"]) + int(report["mass"]["removed"]), solids[1] < solids[0]
    sources = scene.get("heat_source", [])
    changing = [s for s in sources if len(s.get("keyframes", [])) > 1]
    substeps = scene["flow"].get("viscous", {}).get("substeps")
    return terms | {
        "liquid flows": flows, "solids melt": melts, "dead": not flows and not melts and freeze[0] == 0,
        "law: paper": report["law"] == "paper", "law: viscous": report["law"] == "viscous",
        "crosses step 2^31": first < 2**31 < first + steps, "crosses a multiple of 2^16": first % 2**16 + steps > 2**16,
        "63 cells and more along x": side > 62,
        "a limit withholds flow": int(report["limit"]["limited_cells"]) > 0,
        "counts its sub-steps": substeps == "auto",
        "heads relax, sub-steps counted": pairs[0] > 0 and substeps in ("auto", None),
        "heads relax, sub-steps given": pairs[0] > 0 and substeps not in ("auto", None),
        "a relaxed pair flows back": pairs[1] > 0,
        "a shut pair would give": pairs[2] > 0,
        "a piece falls": pieces[0] > 0, "a piece wades": pieces[1] > 0, "a piece floats": pieces[2] > 0,
        **{name: count > 0 for name, count in (*zip(FREEZE, freeze), *zip(MATERIALS, materials))},
        "2 materials": len(scene.get("materials", [])) == 1, "16 materials": len(scene.get("materials", [])) == 15,
        "many sub-steps": most_substeps(scene) > MANY_SUBSTEPS,
        "several kinds of sources": len({s.get("kind", "point") for s in sources}) > 1,
        **{f"keyframes of a {s.get('kind', 'point')}": True for s in changing},
        "radiation without a cut": int(report["heat"]["radiated"]) != 0 and report["irradiance_capped"] == 0,
        **{f"{name} 65535 at the start": max(field(start, name)) == 65535 for name in ("amount", "energy", "heat")},
        **{f"feature: {name}": True for name in report["features"]}}


def most_substeps(scene):
    viscous = scene["flow"].get("viscous", {})
    substeps = viscous.get("substeps", 1)
    return viscous.get("substeps_max", 1024) if substeps == "auto" else substeps


def run_scene(voxmelt, oracle, names, seed, folder):
    """(rows of KEYS with the values used, what happened). Raises Differs."""
    scene = write_scene(seed, folder)
    work = math.prod(scene["grid"]["size"]) * most_substeps(scene)
    lengths = [1, *(steps for steps in (7, 20) if steps * work <= MOST_WORK)]
    last = LAST_STEP - scene.get("start", {}).get("step", 0)
    lengths = [steps for steps in lengths if steps <= last] or [0]  # step numbers have an end
    start, end = folder / "start", folder / "end"
    output(voxmelt, "export", folder / "scene.toml", "--steps", 0, "--out", start, "--quiet")
    for steps in lengths:
        judge, judged, counters, moves = of_oracle(oracle, start, steps, end)
        for name in names:
            mine, ledgers, report = of_voxmelt(voxmelt, folder, steps, name, 1 + seed % 3, CASTERS[seed // 3 % 3])
            compare(f"{name}, {steps} steps, digests", mine, judge)
            for ledger in LEDGERS:
                compare(f"{name}, {steps} steps, ledger of {ledger} {list(report[ledger])}", ledgers[ledger], judged[ledger])
            compare(f"{name}, {steps} steps, counters {COUNTERS}", [int(report["limit"][key]) for key in COUNTERS], counters)
    return list(uses(scene)), events(scene, steps, judge, moves, report, start, end)


def offences(used, happened, scenes):
    """Ends of ranges that no scene used, and what happened in too few scenes."""
    wrong = [f"{name} = {end}: in no scene" for name, end in ENDS if used[name, end] == 0]
    wrong += [f"{name}: in no scene" for name, count in happened.items() if count == 0 and name != "dead"]
    if happened["crosses step 2^31"] < LEAST_PAST_2_31:
        wrong.append(f"only {happened['crosses step 2^31']} scenes cross step 2^31")
    if happened["dead"] > MOST_DEAD * scenes:
        wrong.append(f"{happened['dead']} of {scenes} scenes are dead")
    return wrong


def run_scenes(voxmelt, oracle, seeds, folder):
    """(how often each value was used, how often each event happened). Raises Differs; the scene's folder then stays."""
    names = implementations(voxmelt)
    used = collections.Counter()
    happened = collections.Counter({f"feature: {name}": 0 for name in output(voxmelt, "list", "features")})
    happened.update({f"keyframes of a {kind}": 0 for kind in KEYS_OF})

    def run(seed):
        try:
            return run_scene(voxmelt, oracle, names, seed, folder / str(seed))
        except Differs as difference:
            raise Differs(f"seed {seed}: {difference}\n"
                          f"The scene is in {folder / str(seed)}. This runs it again:\n"
                          f"  python3 {Path(__file__).resolve()} {voxmelt} {oracle} {seed} {seed}") from None

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = {seed: pool.submit(run, seed) for seed in seeds}
        try:
            for seed, one in runs.items():
                uses_of_one, events_of_one = one.result()
                used.update(uses_of_one)
                happened.update({name: int(happens) for name, happens in events_of_one.items()})
                shutil.rmtree(folder / str(seed))
        except Differs:
            pool.shutdown(cancel_futures=True)
            for other in seeds:
                if other != seed:
                    shutil.rmtree(folder / str(other), ignore_errors=True)
            raise
    print(f"{len(seeds)} scenes agree, by {', '.join(names)} and the oracle")
    return used, happened


def main():
    voxmelt, oracle = (Path(word).resolve() for word in sys.argv[1:3])
    seeds = range(int(sys.argv[3]), int(sys.argv[4]) + 1)
    folder = Path(tempfile.mkdtemp(prefix="foreign_scenes_"))
    try:
        used, happened = run_scenes(voxmelt, oracle, seeds, folder)
    except Differs as difference:
        sys.exit(str(difference))
    folder.rmdir()
    for name, count in happened.items():
        print(f"  {count:4d} {name}")
    rarest = sorted(ENDS, key=lambda end: used[end])[:5]
    print("ends used least:", ", ".join(f"{name} = {end} ({used[name, end]} times)" for name, end in rarest))
    wrong = offences(used, happened, len(seeds)) if "--covering" in sys.argv else []
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)


main()
