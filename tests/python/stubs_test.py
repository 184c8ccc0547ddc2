#!/usr/bin/env python3
"""The stubs, the module and the headers have the same names and parameters; mypy is content where it is there.

  stubs_test.py ROOT FOLDER_OF_PACKAGE
"""
import ast
import inspect
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT, PACKAGE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.path[:0] = [str(PACKAGE), str(ROOT / "python")]
import header_docs  # noqa: E402
import voxmelt  # noqa: E402
from voxmelt import _voxmelt  # noqa: E402

STUBS = ast.parse((PACKAGE / "voxmelt/_voxmelt.pyi").read_text())
# What programs in C++ have and those in Python do not: arrays, threading.Event and keywords stand for it.
ONLY_IN_CPP = {"ByteView", "FieldView", "MaskView", "NumberView", "Options", "Position", "Progress", "Sum", "to_string",
               "kHeatSourceKinds", "NamedField::at", "voxmelt"}
OTHERWISE = {"kNever": "NEVER", "kBrickSide": "BRICK_SIDE", "from": "from_"}


def parameters_of_stub(function):
    arguments = function.args
    names = [a.arg for a in arguments.args if a.arg != "self"]
    required = len(names) - len(arguments.defaults)
    keyword = [(a.arg, default is not None, True) for a, default in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return [(name, at >= required, False) for at, name in enumerate(names)] + keyword


def split(text):
    """Splits at commas outside brackets."""
    depth, parts = 0, [""]
    for letter in text:
        depth += (letter in "([{<") - (letter in ")]}>")
        parts[-1] += letter
        if letter == "," and depth == 0:
            parts[-1] = parts[-1][:-1]
            parts.append("")
    return [part.strip() for part in parts if part.strip()]


def parameters_of_module(function):
    """Taken from the first line of the docstring, which pybind11 writes."""
    line = function.__doc__.splitlines()[0]
    inside = re.sub(r" -> .*$", "", line.replace("->", "to").replace(" to ", " -> "))
    words = split(inside[inside.index("(") + 1:inside.rindex(")")])
    found, keyword = [], False
    for word in words:
        if word == "*":
            keyword = True
        elif not word.startswith("self:"):
            found.append((re.match(r"\w+", word)[0], "=" in re.sub(r"\[.*?\]", "", word), keyword))
    return found


class Stubs(unittest.TestCase):
    def test_the_same_names(self):
        in_stubs = {node.name for node in STUBS.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        in_stubs |= {node.target.id for node in STUBS.body if isinstance(node, ast.AnnAssign)}
        in_module = {name for name in dir(_voxmelt) if not name.startswith("__")}
        self.assertEqual({name for name in in_stubs if name != "_Stop"}, in_module)

    def test_the_same_members_and_parameters(self):
        compared = 0
        for node in STUBS.body:
            if isinstance(node, ast.FunctionDef):
                self.assertEqual(parameters_of_stub(node), parameters_of_module(getattr(_voxmelt, node.name)), node.name)
            if not isinstance(node, ast.ClassDef) or node.name == "_Stop":
                continue
            cls = getattr(_voxmelt, node.name)
            members = {m.name: m for m in node.body if isinstance(m, ast.FunctionDef)}
            members |= {m.target.id: m for m in node.body if isinstance(m, ast.AnnAssign)}
            public = {name for name in vars(cls) if not name.startswith("_")}
            self.assertEqual({name for name in members if not name.startswith("_")}, public - {"name", "value"} | (
                {"name", "value"} & set(members)), node.name)
            for name, member in members.items():
                if name == "__init__" and hasattr(cls, "__signature__"):
                    signature = inspect.signature(cls)
                    self.assertEqual(parameters_of_stub(member), [(p, True, False) for p in signature.parameters], node.name)
                elif isinstance(member, ast.AnnAssign):
                    self.assertIsInstance(getattr(cls, name), cls)
                elif not member.decorator_list and name != "replace":
                    self.assertEqual(parameters_of_stub(member), parameters_of_module(getattr(cls, name)), f"{node.name}.{name}")
                compared += 1
        self.assertGreater(compared, 150)

    def test_every_name_of_the_headers(self):
        found = 0
        for name in header_docs.documented(ROOT / "include/voxmelt"):
            scope, _, member = name.partition("::")
            if {name, scope} & ONLY_IN_CPP or member in (scope, "default", "operator") or scope == "State" and member == "":
                continue
            found += 1
            self.assertTrue(hasattr(voxmelt, OTHERWISE.get(scope, scope)), name)
            if member:
                self.assertTrue(hasattr(getattr(voxmelt, scope), OTHERWISE.get(member, member)), name)
        self.assertGreater(found, 150)

    @unittest.skipUnless(shutil.which("mypy"), "no mypy here: apt-get install mypy")
    def test_mypy(self):
        for words in (["--strict", "-p", "voxmelt"], ["--ignore-missing-imports", str(ROOT / "examples/tutorial.py")]):
            result = subprocess.run(["mypy", "--cache-dir", "/dev/null", "--python-executable", sys.executable, *words],
                                    cwd=PACKAGE, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main(argv=["stubs_test"], verbosity=1)
