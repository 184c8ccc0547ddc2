#!/usr/bin/env python3
"""Pages that come and go leave nothing behind: many_test.py VOXMELT (slow)

A thousand pages look for a moment, ten thousand connections say nothing. The server then holds no more memory, files or threads
than after the first hundred, and its run has the digests that it has alone."""
import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "app"))
from page import Page, Server
from program import PROGRAM, SMALL, voxmelt, write

MOST_KIB = 2048  # a page that stayed would keep a frame and a buffer of some 10 KiB: a thousand of them are 10,000 KiB


def held(server):
    """Resident memory in KiB, open files and threads."""
    process = Path(f"/proc/{server.process.pid}")
    words = dict(line.split(":", 1) for line in (process / "status").read_text().splitlines())
    return int(words["VmRSS"].split()[0]), len(os.listdir(process / "fd")), int(words["Threads"])


class ManyTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)
        self.scene = write(self.path, SMALL)

    def look(self, server, textures):
        with Page(server) as page:
            self.assertEqual(page.status, 101)
            if textures:
                page.send("textures 0")
            seen = set()
            while not {"world", "textures" if textures else "frame"} <= seen:
                heard = page.hear()
                seen.add(heard[1]["type"])

    def settled(self, server, page, step):
        """What is held when all that have gone are forgotten."""
        page.send("step 1")
        page.rest(step)
        return held(server)

    def check_nothing_is_left(self, come, first, rest):
        with Server(PROGRAM, self.scene, "--threads", 1, cwd=self.path) as server, Page(server) as page:
            page.rest(0)
            for i in range(first):
                come(server, i)
            before = self.settled(server, page, 1)
            for i in range(rest):
                come(server, i)
            after = self.settled(server, page, 2)
            print(f"after {first}: {before[0]} KiB, {before[1]} files; after {first + rest}: {after[0]} KiB, {after[1]} files")
            self.assertLess(after[0] - before[0], MOST_KIB)
            self.assertEqual(after[1:], before[1:])
            alone = voxmelt("digest", self.scene, "--steps", 3, cwd=self.path).stdout.split()[3]
            page.send("step 1")
            self.assertEqual(page.rest(3)[0]["digest"], alone)
            self.assertEqual(server.end(), (0, ""))

    def test_a_thousand_pages(self):
        self.check_nothing_is_left(lambda server, i: self.look(server, i % 2 == 1), 100, 900)

    def test_ten_thousand_connections(self):
        self.check_nothing_is_left(lambda server, _: server.connect().close(), 1000, 9000)


if __name__ == "__main__":
    unittest.main(argv=["many_test"], verbosity=1)
