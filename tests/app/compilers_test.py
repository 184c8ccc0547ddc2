#!/usr/bin/env python3
"""g++ and clang++, unoptimised and optimised, give the approved digests of the small and the paper's scenes.

  compilers_test.py ROOT     builds the program four times in build/compilers/
"""
import json
import subprocess
import sys
from pathlib import Path

root = Path(sys.argv[1])
approved = json.loads((root / "tests/app/digests.json").read_text())
problems, compared = [], 0
for compiler in ("g++", "clang++"):
    for kind in ("Debug", "Release"):  # -O0 and -O3
        build = root / "build" / "compilers" / f"{compiler}-{kind}"
        subprocess.run(["cmake", "-S", root, "-B", build, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={compiler}",
                        f"-DCMAKE_BUILD_TYPE={kind}", "-DVOXMELT_TESTS=OFF"],
                       check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["cmake", "--build", build], check=True, stdout=subprocess.DEVNULL)
        program = build / "app/voxmelt"
        known = subprocess.run([program, "list", "implementations"], check=True, capture_output=True, text=True).stdout
        for implementation in [line.split()[0] for line in known.splitlines() if "not on this" not in line and not line.startswith("gpu:")]:
            for scene, lines in approved.items():
                result = subprocess.run([program, "digest", scene, "--steps", "10", "--quiet", "--implementation",
                                         implementation], cwd=root, check=True, capture_output=True, text=True).stdout.strip()
                compared += 1
                if result != lines["10"]:
                    problems.append(f"{compiler} {kind} {scene} {implementation}: {result}, approved {lines['10']}")
print("\n".join(problems) if problems else f"{compared} digests agree over four builds")
sys.exit(1 if problems or compared == 0 else 0)
