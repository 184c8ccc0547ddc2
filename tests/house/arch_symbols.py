#!/usr/bin/env python3
"""No object of one instruction set may offer code that another could be linked with.

  arch_symbols.py NM OBJECT ...      the objects of one source (cmake/InstructionSets.cmake): each instantiates its
                                     templates for an architecture of xsimd that no other has, and every symbol that
                                     it defines names that architecture
  arch_symbols.py --program PROGRAM  no function may hold an AVX instruction unless its name says so: the program
                                     runs on a processor without AVX
  arch_symbols.py --self-test
"""
import re
import subprocess
import sys

DEFINED = re.compile(r"^[0-9a-f]+ ([TWVuBDRi]) (.*)$", re.M)
INSTANCE = re.compile(r"\b\w+_for<(xsimd::\w+)>\(")  # what the source instantiates: kernels_for<xsimd::avx2>(...)
HARMLESS = re.compile(r"^DW\.ref\.")  # data that the linker merges; no code


def offences(listings):
    """`listings`: object -> what nm says of it."""
    found, seen = [], {}
    for name, listing in listings.items():
        symbols = DEFINED.findall(listing)
        own = sorted({match[1] for _, symbol in symbols if (match := INSTANCE.search(symbol))})
        if len(own) != 1:
            found.append(f"{name}: instantiates for {own or 'nothing'}, not for one architecture")
            continue
        if own[0] in seen:
            found.append(f"{name}: {own[0]}, as {seen[own[0]]} has")
        seen[own[0]] = name
        named = re.compile(re.escape(own[0]) + r"\b")
        found += [f"{name}: {kind} {symbol}" for kind, symbol in symbols
                  if not named.search(symbol) and not HARMLESS.match(symbol)]
    return found or ([] if listings else ["no objects"])


FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
AVX = re.compile(r"^\s+[0-9a-f]+:\t(?:v[a-z0-9]+|k(?:mov|and|or|xor|not|unpck|add|shift|test)[a-z]*)(?:\s|$)")


def avx_offences(disassembly):
    found, kernels, function = set(), 0, ""
    for line in disassembly.splitlines():
        match = FUNCTION.match(line)
        if match:
            function = match.group(1)
        elif AVX.match(line):
            if "baseline::Variant)1" in function:
                continue  # the baseline for this processor: run only where it was built for (measure/native_needs.h)
            if "xsimd::avx" in function:
                kernels += 1
            else:
                found.add(function)
    return sorted(found) + ([] if kernels else ["no AVX kernel was found at all: wrong program, or wrong check"])


def self_test():
    good = {name: f"00 W Kernels kernels_for<xsimd::{name}>(int)\n01 V DW.ref.x\n02 t memcpy\n" for name in ("sse4_2", "avx2")}

    def planted(line):
        return offences({**good, "avx2": good["avx2"] + line})
    assert offences(good) == [], offences(good)
    assert len(planted("00 W voxmelt::rule::mixed(unsigned long)\n")) == 1
    assert len(planted("00 T voxmelt::f()\n")) == 1
    assert len(planted("00 W void f<xsimd::sse4_2>()\n")) == 1
    assert len(planted("00 W void f<xsimd::avx25>()\n")) == 1
    assert len(planted("00 W Kernels kernels_for<xsimd::sse4_2>(int)\n")) == 1
    assert len(offences({**good, "other": good["avx2"]})) == 1
    assert len(offences({**good, "none": ""})) == 1
    assert offences({}) != []
    kernel = "0 <void g<xsimd::avx2>()>:\n   0:\tvpaddw %ymm0,%ymm0,%ymm0\n"
    assert avx_offences(kernel + "1 <main>:\n   1:\taddps %xmm0,%xmm0\n") == []
    assert avx_offences(kernel + "1 <main>:\n   1:\tvaddps %xmm0,%xmm0,%xmm0\n") == ["main"]
    native = "<Baseline<float, (voxmelt::baseline::Variant)1>::heat()>:\n   1:\tvaddps %ymm0,%ymm0,%ymm0\n"
    assert avx_offences(kernel + "1 " + native) == []
    assert avx_offences("1 " + native) != [] and avx_offences(kernel + "1 " + native.replace("t)1", "t)0")) != []
    assert avx_offences(kernel + "1 <main>:\n   1:\tkmovd  %eax,%k1\n") == ["main"]
    assert avx_offences("") != []
    print("planted symbols and instructions are caught")


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    if sys.argv[1] == "--program":
        problems = avx_offences(output("objdump", "-d", "-C", "--no-show-raw-insn", sys.argv[2]))
        print("\n".join(problems) if problems else "AVX only where the name says so")
        sys.exit(1 if problems else 0)
    problems = offences({path: output(sys.argv[1], "-C", "--defined-only", path) for path in sys.argv[2:]})
    print("\n".join(problems) if problems else "every symbol names its instruction set")
    sys.exit(1 if problems else 0)
