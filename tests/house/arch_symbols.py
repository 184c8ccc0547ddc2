#!/usr/bin/env python3
"""No object of one instruction set may offer code that another could be linked with.

  arch_symbols.py NM ARCHIVE [SOURCE ...]
                                     every symbol that an object arch/*.cpp.o defines must name its instruction set;
                                     there must be one of each SOURCE (sse.cpp, avx2.cpp, avx512.cpp)
  arch_symbols.py --program PROGRAM  no function may hold an AVX instruction unless its name says so: the program
                                     runs on a processor without AVX
  arch_symbols.py --self-test
"""
import re
import subprocess
import sys

SETS = {"sse.cpp": ("xsimd::sse4_2", "sse42_kernels", "sse42_loops"), "avx2.cpp": ("xsimd::avx2", "avx2_kernels", "avx2_loops"),
        "avx512.cpp": ("xsimd::avx512bw", "avx512_kernels", "avx512_loops")}
DEFINED = re.compile(r"^[0-9a-f]+ ([TWVuBDRi]) (.*)$")
HARMLESS = re.compile(r"^DW\.ref\.")  # data that the linker merges; no code


def offences(listing, sources=tuple(SETS)):
    found, seen, names = [], set(), None
    for line in listing.splitlines():
        if line.endswith(".o:"):
            names = SETS.get(line[:-3].split("/")[-1])
            continue
        match = DEFINED.match(line)
        if not match or names is None:
            continue
        seen.add(names)
        if not any(name in match.group(2) for name in names) and not HARMLESS.match(match.group(2)):
            found.append(f"{names[0]}: {match.group(1)} {match.group(2)}")
    missing = {SETS[source] for source in sources} - seen
    return found + [f"no object for {names[0]}" for names in sorted(missing)]


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
                continue  # the baseline for this processor: run only where it was built for (bench/measure/native_needs.h)
            if "xsimd::avx" in function or re.search(r"avx(2|512)_(kernels|loops)", function):
                kernels += 1
            else:
                found.add(function)
    return sorted(found) + ([] if kernels else ["no AVX kernel was found at all: wrong program, or wrong check"])


def self_test():
    good = "\n".join(f"{source}.o:\n00 W void f<{names[0]}>()" for source, names in SETS.items())
    assert offences(good) == [], offences(good)
    assert len(offences(good + "\n00 W voxmelt::rule::mixed(unsigned long)")) == 1
    assert len(offences(good + "\n00 W void f<xsimd::avx2>()")) == 1
    assert offences("") != []
    kernel = "0 <void g<xsimd::avx2>()>:\n   0:\tvpaddw %ymm0,%ymm0,%ymm0\n"
    assert avx_offences(kernel + "1 <main>:\n   1:\taddps %xmm0,%xmm0\n") == []
    assert avx_offences(kernel + "1 <main>:\n   1:\tvaddps %xmm0,%xmm0,%xmm0\n") == ["main"]
    native = "<Baseline<float, (voxmelt::baseline::Variant)1>::heat()>:\n   1:\tvaddps %ymm0,%ymm0,%ymm0\n"
    assert avx_offences(kernel + "1 " + native) == []
    assert avx_offences("1 " + native) != [] and avx_offences(kernel + "1 " + native.replace("t)1", "t)0")) != []
    assert avx_offences(kernel + "1 <main>:\n   1:\tkmovd  %eax,%k1\n") == ["main"]
    assert avx_offences("") != []
    print("planted symbols and instructions are caught")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    if sys.argv[1] == "--program":
        text = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", sys.argv[2]], check=True, capture_output=True,
                              text=True).stdout
        problems = avx_offences(text)
        print("\n".join(problems) if problems else "AVX only where the name says so")
        sys.exit(1 if problems else 0)
    text = subprocess.run([sys.argv[1], "-C", "--defined-only", sys.argv[2]], check=True, capture_output=True, text=True).stdout
    problems = offences(text, sys.argv[3:] or tuple(SETS))
    print("\n".join(problems) if problems else "every symbol names its instruction set")
    sys.exit(1 if problems else 0)
