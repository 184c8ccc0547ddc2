"""Builds the package for pip (PEP 517). It needs nothing but Python, CMake, Ninja and Debian's packages.

It builds for the interpreter that runs it. `pip install . --config-settings build=FOLDER` takes what an
ordinary build left in FOLDER, and compiles nothing.
"""
import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MODULE = f"_voxmelt{sysconfig.get_config_var('EXT_SUFFIX')}"
TAG = "cp{0}{1}-cp{0}{1}-{2}".format(*sys.version_info[:2], re.sub(r"[-.]", "_", sysconfig.get_platform()))
BUILD_FOLDER = f"build/pip-{TAG}"


def version():
    return re.search(r"^project\(voxmelt VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.M)[1]


def metadata():
    return (f"Metadata-Version: 2.1\nName: voxmelt\nVersion: {version()}\n"
            "Summary: Voxel models melt and flow by an exact cellular automaton\n"
            "License: Apache-2.0\nRequires-Python: >=3.8\nRequires-Dist: numpy\n")


def built():
    """The folder of the package with its module, compiled where nobody has."""
    missing = [program for program in ("cmake", "ninja") if shutil.which(program) is None]
    if missing:
        sys.exit(f"{' and '.join(missing)} not found: cmake/install-dependencies.sh installs what voxmelt needs")
    build = ROOT / BUILD_FOLDER
    subprocess.run(["cmake", "-S", ROOT / "python", "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    f"-DPython_EXECUTABLE={sys.executable}", f"-DPython_ROOT_DIR={sys.base_prefix}",
                    "-DVOXMELT_ONE_INSTRUCTION_SET=ON"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "voxmelt_python"], check=True)
    return build / "voxmelt"


def digest(data):
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("=")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    prebuilt = (config_settings or {}).get("build")
    package = ROOT / prebuilt / "python/voxmelt" if prebuilt else built()
    if not (package / MODULE).is_file():
        sys.exit(f"{package / MODULE} does not exist: no build for this interpreter")
    info = f"voxmelt-{version()}.dist-info"
    files = {f"voxmelt/{name}": (package / name).read_bytes()
             for name in ("__init__.py", "_record.py", "_voxmelt.pyi", "py.typed", MODULE)}
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: voxmelt\nRoot-Is-Purelib: false\nTag: {TAG}\n".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = "".join(f"{name},{digest(data)},{len(data)}\n" for name, data in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    wheel = f"voxmelt-{version()}-{TAG}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return wheel
