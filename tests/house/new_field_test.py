#!/usr/bin/env python3
"""A field more in the state costs a member and a row: it then travels through everything that carries a state.

  new_field_test.py ROOT COMPILER

Compiles what carries a state with a field `mark` of 5 bits per cell, which no file of the tree knows: headers with its
member and its row stand in place of those of the tree. Its marks must come back from start.fields, npy, VTI and a
checkpoint. The files are written and read here by hand.
"""
import os
import re
import struct
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from vti import arrays_of

ROOM = "kernel/automaton/state"
CARRIERS = [ROOM, "kernel/scene", "kernel/scene/text", "kernel/scene/shape", "kernel/scene/mesh_file", "kernel/scene/voxel_file",
            "kernel/run/io", "kernel/run/checkpoint"]
MEMBER = "  Field<std::uint8_t> mark;\n"
ROW = '    FieldRow<&Volume::mark>{{.name = "mark", .bits = 5, .digest_bit = 59, .optional = true}},\n'
SIDES = x, y, z = 5, 6, 7


def replaced(text, before, after):
    if text.count(before) != 1:
        sys.exit(f"not there once: {before}")
    return text.replace(before, after)


def with_a_mark(root, folder):
    """The two headers that a new field changes."""
    (folder / ROOM).mkdir(parents=True)
    volume, fields = (root / ROOM / "volume.h").read_text(), (root / ROOM / "fields.h").read_text()
    last = "  Field<std::uint16_t> amount, energy, heat;\n"
    (folder / ROOM / "volume.h").write_text(replaced(volume, last, last + MEMBER))
    end = re.search(r"inline constexpr std::tuple kFields\{.*?^\};", fields, re.M | re.S)[0]
    (folder / ROOM / "fields.h").write_text(replaced(fields, end, end[:-2] + ROW + "};"))


def program(root, compiler, folder):
    sources = [p for room in CARRIERS for p in sorted((root / room).glob("*.cpp"))]
    sources += [root / "kernel/engine/cpu" / name for name in ("turns.cpp", "workers.cpp")]
    sources.append(root / "tests/house/new_field_main.cpp")

    def compiled(source):
        out = folder / (source.relative_to(root).as_posix().replace("/", "_") + ".o")
        subprocess.run([compiler, "-std=c++20", "-DVOXMELT_PLAIN_THREADS", "-DFMT_HEADER_ONLY", "-I", folder, "-I", root,
                        "-c", source, "-o", out], check=True)
        return out
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        objects = list(pool.map(compiled, sources))
    subprocess.run([compiler, "-pthread", *objects, "-lzstd", "-lxxhash", "-ldeflate", "-lpng", "-o", folder / "carries"], check=True)
    return folder / "carries"


def npy(kind, data):
    text = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': ({z}, {y}, {x}), }}"
    text += " " * (117 - len(text)) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode() + data


def main():
    root, compiler = Path(sys.argv[1]), sys.argv[2]
    wrong = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        with_a_mark(root, folder)
        carries = program(root, compiler, folder)

        fields, out = folder / "fields", folder / "out"
        fields.mkdir(), out.mkdir()
        cells = x * y * z
        marks = bytes((7 * i + 3) % 32 for i in range(cells))
        for mask in ("solid", "liquid", "inert"):
            (fields / f"{mask}.npy").write_bytes(npy("|u1", bytes([mask == "liquid"] * cells)))
        for number in ("amount", "energy", "heat"):
            (fields / f"{number}.npy").write_bytes(npy("<u2", struct.pack("<H", 77 if number == "amount" else 0) * cells))
        (fields / "mark.npy").write_bytes(npy("|u1", marks))
        (folder / "scene.toml").write_text(f'[grid]\nsize = [{x}, {y}, {z}]\n[start]\nfields = "fields"\n')

        run = subprocess.run([carries, folder / "scene.toml", out], capture_output=True, text=True)
        if run.returncode != 0:
            wrong.append(f"{run.stdout}{run.stderr}")
        if not (out / "mark.npy").read_bytes().endswith(b"\n" + marks):
            wrong.append("mark.npy has other marks")
        vti = (out / "volume.vti").read_bytes()
        if b'type="UInt8" Name="mark"' not in vti or arrays_of(vti).get("mark") != marks:
            wrong.append("volume.vti has other marks")
        if (out / "plain/mark.npy").exists() or b"mark" in (out / "plain/volume.vti").read_bytes():
            wrong.append("a volume without marks is exported with some")
    print("\n".join(wrong) if wrong else "a field of 5 bits travels through start.fields, npy, VTI and checkpoints")
    sys.exit(1 if wrong else 0)


main()
