#!/usr/bin/env python3
"""`voxmelt` and the programs beside it: who asks for a command meets one program.

  programs_test.py PROGRAM
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv[1]).resolve()
ELSEWHERE = {"verify": "voxmelt-hardware", "explore": "voxmelt-hardware", "bench": "voxmelt-measure",
             "accuracy": "voxmelt-measure", "sweep": "voxmelt-runs", "plot": "voxmelt-runs"}
LISTED = {"devices": "voxmelt-hardware", "memories": "voxmelt-hardware", "presets": "voxmelt-hardware", "faults": "voxmelt-hardware", "cases": "voxmelt-measure"}


def run(program, *arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True)


class Programs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()

    def test_a_command_of_another_program_looks_like_one_of_this(self):
        listed = run(PROGRAM, "--help").stdout
        for command, program in ELSEWHERE.items():
            with self.subTest(command):
                help_text = run(PROGRAM, command, "--help")
                self.assertEqual((help_text.returncode, help_text.stderr), (0, ""))
                self.assertIn(f"Usage: voxmelt {command} [OPTIONS]", help_text.stdout)
                self.assertIn(f"  {command} ", listed)
                self.assertEqual(help_text.stdout, run(PROGRAM.parent / program, command, "--help").stdout)

    def test_the_exit_code_is_that_of_the_other_program(self):
        for command in ELSEWHERE:
            wrong = run(PROGRAM, command, "--no-such-option")
            self.assertEqual(wrong.returncode, 2, command)
            self.assertIn("--help says more", wrong.stderr)

    def test_a_build_without_the_libraries_of_a_command_names_them(self):
        if "  view " in run(PROGRAM, "--help").stdout:
            self.skipTest("this build has voxmelt view")
        missing = run(PROGRAM, "view", "lesson_drain")
        said = "error: this build has no voxmelt view: apt-get install libboost-dev libjpeg-dev, then configure and build again\n"
        self.assertEqual((missing.returncode, missing.stderr), (2, said))

    def test_it_finds_them_through_a_link(self):
        (self.folder / "melt").symlink_to(PROGRAM)
        self.assertEqual(run(self.folder / "melt", "list", "faults").stdout, run(PROGRAM, "list", "faults").stdout)

    def test_what_is_not_built_says_what_builds_it(self):
        (self.folder / "app").mkdir()
        alone = self.folder / "app/voxmelt"
        shutil.copy(PROGRAM, alone)
        asked = [([command], program) for command, program in ELSEWHERE.items()]
        asked += [(["list", what], program) for what, program in LISTED.items()]
        for arguments, program in asked:
            missing = run(alone, *arguments)
            self.assertEqual((missing.returncode, missing.stdout), (2, ""), arguments)
            self.assertEqual(missing.stderr, f"error: {self.folder}/app/{program}: No such file or directory\n")
        (self.folder / "CMakeCache.txt").touch()
        for arguments, program in asked:
            missing = run(alone, *arguments)
            self.assertEqual(missing.returncode, 2, arguments)
            self.assertIn(f"{program} is not built yet", missing.stderr)
            self.assertIn(f"cmake --build {self.folder} --target {program}", missing.stderr)
        self.assertEqual(run(alone, "list", "features").returncode, 0)

    def test_devices_and_memories_have_a_line_each(self):
        for what, name, title in (("devices", "zu7ev", "230,400 LUT"), ("memories", "ddr4-2400", "19.2 GB/s")):
            listed = run(PROGRAM, "list", what)
            self.assertEqual((listed.returncode, listed.stderr), (0, ""))
            self.assertEqual([title in line for line in listed.stdout.splitlines() if line.split()[0] == name], [True])

    def test_a_closed_output_is_closed_for_all(self):
        for arguments in (["list", "features"], ["list", "devices"], ["list", "cases"]):
            closed = subprocess.run(["sh", "-c", 'exec "$0" "$@" >&-', PROGRAM, *arguments], capture_output=True, text=True)
            self.assertEqual(closed.returncode, 3, arguments)
            self.assertIn("it is closed", closed.stderr)


if __name__ == "__main__":
    unittest.main(argv=["programs_test"], verbosity=1)
