"""What the program says of a bad file: one line with its place, exit code 2, in little time and memory."""
import os
import subprocess

from program import PROGRAM, write

SECONDS, BYTES = 2, 200 << 20  # of processor time, and of memory


def check(test, bad, scene_of):
    """Of each file of `bad` (its content, and a part of the message): `scene_of(name)` is refused where it names the file.
    The test has a `folder`."""
    for name, (content, expected) in bad.items():
        with test.subTest(name):
            (test.folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
            scene = write(test.folder, scene_of(name))
            before = set(test.folder.iterdir())
            child = subprocess.Popen([PROGRAM, "run", scene.name, "--steps", "1"], cwd=test.folder, stdout=subprocess.PIPE,
                                     stderr=subprocess.PIPE, text=True)
            out, error = child.stdout.read(), child.stderr.read()
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            child.stdout.close()
            child.stderr.close()
            test.assertEqual((child.returncode, out), (2, ""), error)
            test.assertRegex(error, rf"\Ascene\.toml:5:8: error: [^\n]*\b{name}\b[^\n]*\n\Z")
            test.assertIn(expected, error)
            test.assertLess(used.ru_maxrss << 10, BYTES)
            test.assertLess(used.ru_utime + used.ru_stime, SECONDS)
            test.assertEqual(set(test.folder.iterdir()), before)
