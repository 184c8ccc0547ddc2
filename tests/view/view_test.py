#!/usr/bin/env python3
"""`voxmelt view` as a page meets it: view_test.py VOXMELT

What is drawn and changed by hand has the bits that `render` and `digest` give, and a journal gives them again.
Whoever is no page of its own is refused, and changes nothing."""
import random
import signal
import struct
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "app"))
from page import Closed, Page, Server
from program import PROGRAM, SMALL, voxmelt, write

SCENE = SMALL.replace("size = [12, 10, 12]", "size = [20, 16, 20]").replace("size = [4, 4, 4]", "size = [8, 8, 8]")


def digests(scene, *arguments, cwd):
    """Digest by step."""
    done = voxmelt(*arguments, cwd=cwd)
    assert done.returncode == 0, done.stderr
    return {int(words[1]): words[3] for words in map(str.split, done.stdout.splitlines())}


def read_png(data):
    """Width, height, and the rows of (red, green, blue), of a PNG of 8 bits without an interlace."""
    place, packed = 8, b""
    while place < len(data):
        size, kind = struct.unpack(">I4s", data[place:place + 8])
        part = data[place + 8:place + 8 + size]
        if kind == b"IHDR":
            width, height = struct.unpack(">II", part[:8])
            assert part[8:] == b"\x08\x02\0\0\0", part
        packed += part if kind == b"IDAT" else b""
        place += 12 + size
    raw, rows, before = zlib.decompress(packed), [], bytes(3 * width)
    for y in range(height):
        way, row = raw[y * (3 * width + 1)], bytearray(raw[y * (3 * width + 1) + 1:(y + 1) * (3 * width + 1)])
        for i, up in enumerate(before):
            left, corner = (row[i - 3], before[i - 3]) if i >= 3 else (0, 0)
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda one: abs(guess - one))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, paeth)[way]) % 256
        rows.append([tuple(row[i:i + 3]) for i in range(0, 3 * width, 3)])
        before = row
    return width, height, rows


class ViewTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)
        self.scene = write(self.path, SCENE)

    def tearDown(self):
        self.folder.cleanup()

    def serve(self, *arguments):
        return Server(PROGRAM, self.scene, "--threads", 1, *arguments, cwd=self.path)

    def test_files_of_the_page(self):
        with self.serve() as server:
            for target, kind in (("/", "text/html"), ("/view.js", "text/javascript"), ("/view.css", "text/css"),
                                 ("/camera.js", "text/javascript"), ("/ball.js", "text/javascript"), ("/panel.js", "text/javascript"),
                                 ("/icon.svg", "image/svg+xml")):
                head, body = server.get(target)
                self.assertIn("200", head[0], target)
                self.assertTrue(any(line.startswith(f"Content-Type: {kind}") for line in head), head)
                page = Path(__file__).resolve().parents[2] / "app/view/page"
                self.assertEqual(body, (page / (target[1:] or "index.html")).read_bytes())
                self.assertTrue(any("Content-Security-Policy: default-src 'self'" in line for line in head))

    def test_strangers_are_refused(self):
        with self.serve() as server:
            with Page(server) as page:
                before = page.rest()[0]["digest"]
                port = server.port
                for target in ("/../../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd", "/view.js/..", "/socket",
                               "/index.html?x=/etc/passwd", "http://127.0.0.1/", "/\x7f"):
                    self.assertRegex(server.get(target)[0][0], "40[034]", target)
                for host in ("evil.example", f"evil.example:{port}", "127.0.0.1", f"127.0.0.1:{port + 1}",
                             f"127.0.0.1.evil.example:{port}", f"[::1]:{port}", "", None):
                    self.assertRegex(server.get("/", Host=host)[0][0], "40[03]", host)
                self.assertIn("200", server.get("/", Host=f"localhost:{port}")[0][0])
                self.assertIn("403", server.get("/", Origin="http://evil.example")[0][0])
                for method in ("POST", "PUT", "DELETE", "OPTIONS", "TRACE"):
                    self.assertIn("405", server.get("/", method)[0][0], method)
                for request in (b"\0" * 100, b"GET / HTTP/9.9\r\n\r\n", b"GET /\r\n\r\n", b"\x16\x03\x01\x02\x00",
                                b"GET / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n"):
                    head, _ = server.raw(request)
                    self.assertRegex(head[0], "^$|40[03]", request)
                head, _ = server.get("/", X="y" * 20000)
                self.assertRegex(head[0], "^$|400")
                for origin in (None, "null", "http://evil.example", f"https://127.0.0.1:{port}",
                               f"http://127.0.0.1:{port + 1}", f"http://localhost:{port}"):
                    with Page(server, origin=origin) as other:
                        self.assertEqual(other.status, 403, origin)
                with Page(server, host=f"evil.example:{port}") as other:
                    self.assertEqual(other.status, 403)
                with Page(server, target="/other") as other:
                    self.assertEqual(other.status, 404)
                page.send("home")
                self.assertEqual(page.rest()[0]["digest"], before)

    def test_a_picture_is_that_of_render(self):
        drawn = voxmelt("render", self.scene, "--steps", 5, "--size", "160x120", "--out", "five.png", cwd=self.path)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        best = voxmelt("render", self.scene, "--steps", 5, "--size", "160x120", "--setting", "best", "--out", "best.png",
                       cwd=self.path)
        self.assertEqual(best.returncode, 0, best.stderr)
        with self.serve() as server, Page(server) as page:
            page.rest()
            page.send("size 160 120")
            page.send("step 5")
            head, picture = page.rest(5)
            while head["size"] != [160, 120]:
                head, picture = page.rest(5)
            self.assertEqual(picture, (self.path / "five.png").read_bytes())
            page.send("best")
            head, picture = page.rest(5)
            while head["quality"] != "best":
                head, picture = page.rest(5)
            self.assertEqual(picture, (self.path / "best.png").read_bytes())

    def test_steps_are_those_of_digest(self):
        wanted = digests(self.scene, "digest", self.scene, "--steps", 40, "--every", 1, cwd=self.path)
        with self.serve() as server, Page(server) as page:
            self.assertEqual(page.rest(0)[0]["digest"], wanted[0])
            for step, line in ((1, "step 1"), (4, "step 3"), (40, "step 36")):
                page.send(line)
                self.assertEqual(page.rest(step)[0]["digest"], wanted[step])
            page.send("restart")
            self.assertEqual(page.rest(0)[0]["digest"], wanted[0])
            page.send("speed 7")
            page.send("play 1")
            while (heard := page.hear())[0] != "frame" or heard[1]["step"] < 30:
                pass
            page.send("play 0")
            head, _ = page.rest()
            if head["step"] <= 40:
                self.assertEqual(head["digest"], wanted[head["step"]])
            self.assertEqual(head["step"] % 7, 0)

    def by_hand(self, page, seed):
        """Random changes between random steps. Returns steps done and the digest at the end."""
        dice = random.Random(seed)
        step = page.rest()[0]["step"]
        changes = [lambda: f"heat_source.0.at {dice.uniform(-4, 24)} {dice.uniform(2, 30)} {dice.uniform(-4, 24)}",
                   lambda: f"heat_source.0.power {dice.uniform(0, 90)}",
                   lambda: f"heat_source.add {dice.randrange(20)} {dice.randrange(30)} 7.0625 {dice.uniform(1, 40)}",
                   lambda: "heat_source.1.remove",
                   lambda: f"vent.add {dice.uniform(2, 18)} 12 {dice.uniform(2, 18)} 2 0.3 0.9",
                   lambda: f"vent.0.rate {dice.uniform(0.01, 1)}", lambda: "vent.0.remove",
                   lambda: f"drain.add {dice.uniform(2, 18)} 3 {dice.uniform(2, 18)} 3 0.5", lambda: "drain.0.remove",
                   lambda: f"pour {dice.uniform(0, 20)} {dice.uniform(0, 16)} {dice.uniform(0, 20)} {dice.uniform(1, 5)} {dice.random()}",
                   lambda: f"carve {dice.uniform(0, 20)} {dice.uniform(0, 16)} {dice.uniform(0, 20)} {dice.uniform(1, 4)}",
                   lambda: f"heat.gamma {dice.uniform(0.01, 0.3)}", lambda: f"flow.paper.slump {dice.uniform(0, 1)}"]
        for _ in range(8):
            for _ in range(dice.randrange(4)):
                page.send("change " + dice.choice(changes)())  # some are refused: there is no such source or vent
            count = dice.randrange(1, 30)
            page.send(f"step {count}")
            step += count
            head, _ = page.rest(step)
        return step, head["digest"]

    def test_a_journal_gives_the_same_bits(self):
        for seed in (1, 2):
            with self.serve("--record", "journal.txt") as server, Page(server) as page:
                step, digest = self.by_hand(page, seed)
                self.assertEqual(server.end(), (0, ""))
            self.assertGreater(len((self.path / "journal.txt").read_text().splitlines()), 3)
            for implementation, threads in (("reference", 1), ("auto", 3)):
                again = digests(self.scene, "view", self.scene, "--headless", "--journal", "journal.txt", "--steps", step,
                                "--implementation", implementation, "--threads", threads, cwd=self.path)
                self.assertEqual(again[step], digest, f"seed {seed}, {implementation}")
            # A page that follows the journal shows them, too, and writes the same journal again.
            with self.serve("--journal", "journal.txt", "--record", "again.txt") as server, Page(server) as page:
                page.rest(0)
                page.send(f"step {step}")
                self.assertEqual(page.rest(step)[0]["digest"], digest)
            first, second = ((self.path / name).read_text() for name in ("journal.txt", "again.txt"))
            late = [line for line in first.splitlines() if line.split()[0] == str(step)]
            self.assertEqual(second.splitlines(), first.splitlines()[:len(first.splitlines()) - len(late)])

    def test_what_is_saved_goes_on(self):
        with self.serve() as server, Page(server) as page:
            page.rest(0)
            page.send("change heat_source.0.power 55.5")
            page.send("step 12")
            page.rest(12)
            page.send("save checkpoint")
            name, state = page.file()
            self.assertEqual(name, "scene-000012.checkpoint")
            (self.path / name).write_bytes(state)
            page.send("save journal")
            name, journal = page.file()
            self.assertEqual(name, "scene.journal.txt")
            self.assertEqual(journal.decode(), f"# voxmelt journal of {self.scene}\n0 heat_source.0.power 55.5\n")
            page.send("step 20")
            digest = page.rest(32)[0]["digest"]
        after = voxmelt("digest", "scene-000012.checkpoint", "--steps", 32, cwd=self.path)
        self.assertIn(f"step 32 digest {digest}", after.stdout, after.stderr)

    def test_a_restart_forgets_changes(self):
        with self.serve("--record", "journal.txt") as server, Page(server) as page:
            first = page.rest(0)[0]["digest"]
            page.send("change heat_source.0.power 5")
            page.send("step 20")
            page.rest(20)
            page.send("restart")
            self.assertEqual(page.rest(0)[0]["digest"], first)
            page.send("step 20")
            digest = page.rest(20)[0]["digest"]
        self.assertEqual(digest, digests(self.scene, "digest", self.scene, "--steps", 20, cwd=self.path)[20])
        self.assertEqual((self.path / "journal.txt").read_text(), f"# voxmelt journal of {self.scene}\n")

    def test_wrong_lines_change_nothing(self):
        with self.serve() as server, Page(server) as page:
            before = page.rest()[0]["digest"]
            for line in ("change heat_source.0.power nan", "change heat_source.0.power inf", "change heat_source.0.power -1",
                         "change heat_source.0.power 1e300", "change heat_source.0.power", "change heat_source.0.power 1 2",
                         "change heat_source.9.power 1", "change heat_source.18446744073709551616.power 1",
                         "change heat_source.-1.power 1", "change heat_source.0.radius 1", "change heat_source.0.size 1",
                         "change grid.size 3", "change", "change  ", "change heat.gamma 7", "change vent.add 1 2 3",
                         "change pour 1 2 3 4", "change pour 90 90 90 2 0.5", "change pour 5 5 5 0 0.5", "change pour 5 5 5 2 1.5",
                         "change carve 1 2 3", "change carve 5 5 5 99999", "change carve 5 5 nan 2", "change carve.0 5 5 5 2",
                         "step 0", "step -1", "step 1.5", "step 99999999999", "step", "speed 0", "speed 1e9", "play 2",
                         "camera 1 2 3", "camera 0 90 100 0 0 0", "camera 0 0 nan 0 0 0", "size 1 1", "size 99999 99999",
                         "pick -1 0", "pick 99999 0", "nothing", "save", "save /etc/passwd", "save checkpoint x", "play 1 1", "restart now", "\x01", "step 1;step 1"):
                page.send(line)
                refused = page.text("refused")
                self.assertEqual(refused["line"], line)
                self.assertIn("error: ", refused["why"])
            page.send("home")
            head, _ = page.rest()
            self.assertEqual((head["step"], head["digest"]), (0, before))

    def test_who_breaks_the_grammar_is_closed(self):
        with self.serve() as server, Page(server) as page:
            before = page.rest()[0]["digest"]
            for payload, code in (("x" * 600, 1), (b"\0\1", 2), ("play 0\nplay 0", 1), ("", 1), (b"\xff\xfe", 1)):
                with Page(server) as other, self.assertRaises((Closed, ConnectionError)):
                    other.send(payload, code)
                    while True:
                        other.hear()
            with Page(server) as other, self.assertRaises((Closed, ConnectionError)):
                for _ in range(3000):
                    other.send("home")
                while True:
                    other.hear()
            for _ in range(200):
                server.connect().close()
            links = [server.connect() for _ in range(100)]  # more than it serves at a time, all silent
            for link in links:
                link.close()
            page.send("home")
            self.assertEqual(page.rest()[0]["digest"], before)
            self.assertEqual(server.end()[0], 0)

    def test_a_slow_page_holds_nobody_up(self):
        with self.serve() as server, Page(server) as page, Page(server) as slow:
            page.send("size 640 480")
            page.send("play 1")
            seen = 0
            while seen < 60:  # the slow one reads nothing meanwhile
                seen += page.hear()[0] == "frame"
            page.send("play 0")
            step = page.rest()[0]["step"]
            page.send("home")
            self.assertEqual(slow.rest(step)[0]["step"], step)

    def test_a_probe_names_the_cell(self):
        with self.serve() as server, Page(server) as page:
            size = page.rest()[0]["size"]
            page.send(f"pick {size[0] // 2} {size[1] // 2}")
            hit = page.text("pick")
            self.assertEqual(hit["shown"], "solid")
            self.assertEqual((hit["fields"]["solid"], hit["fields"]["amount"]), (1, 4096))
            self.assertEqual(hit["fields"]["heat"], 32112)  # 0.49 of 65535
            page.send("pick 0 0")
            self.assertNotIn("cell", page.text("pick"))
            for x in range(0, size[0], 16):  # the sides of the ground, too
                for y in range(0, size[1], 16):
                    page.send(f"pick {x} {y}")
                    for cell, side in zip(page.text("pick").get("cell", ()), (20, 16, 20)):
                        self.assertIn(cell, range(side))
                time.sleep(0.1)  # not too many lines a second

    def test_three_numbers_are_x_y_and_z(self):
        """A journal that swapped two of them would swap them again when it is read, so a scene file is the judge."""
        vent = "[[vent]]\nat = [4, 9, 15]\nradius = 2.5\nrate = 0.5\ntemperature = 0.8\n"
        drain = "[[drain]]\nat = [13, 5, 7]\nradius = 3.5\nrate = 0.25\n"
        sun = '[[heat_source]]\nkind = "directional"\ndirection = [1, 7, 3]\npower = 2\n'
        written = SCENE.replace("at = [14, 12, 14]", "at = [3, 12, 17]").replace("[flow]", sun + vent + drain + "[flow]")
        self.assertNotEqual(written, SCENE)
        alone = digests(None, "digest", write(self.path, written, "written.toml"), "--steps", 40, cwd=self.path)[40]
        with self.serve() as server, Page(server) as page:
            page.rest(0)
            page.send("change heat_source.0.at 3 12 17")
            self.assertEqual(page.text("world")["heat_sources"][0]["keyframes"][0]["at"], [3, 12, 17])
            for line in ("heat_source.add_sun 1 7 3 2", "vent.add 4 9 15 2.5 0.5 0.8", "drain.add 13 5 7 3.5 0.25"):
                page.send("change " + line)
                world = page.text("world")
            self.assertEqual(world["vents"][0]["at"], [4, 9, 15])
            self.assertEqual(world["drains"][0]["at"], [13, 5, 7])
            page.send("camera 10 20 30 4 5 6")
            while page.rest()[0]["camera"]["target"] != [4, 5, 6]:
                pass
            page.send("step 40")
            self.assertEqual(page.rest(40)[0]["digest"], alone)

    def test_cells_are_shown_cut_open_and_probed(self):
        with self.serve() as server, Page(server) as page:
            plain, exact = page.rest()
            self.assertNotIn("cells", plain)
            page.send("cells temperature z 6")
            head, cut = page.rest()
            self.assertEqual((head["cells"]["colours"], head["cells"]["cut"]), ("temperature", {"axis": "z", "at": 6}))
            self.assertEqual([mark["name"] for mark in head["cells"]["legend"]], ["0", "0.25", "0.5", "0.75", "1", "none"])
            self.assertEqual(head["digest"], plain["digest"])
            self.assertEqual(head["camera"], plain["camera"])
            # Before the grid's middle the camera sees the cut through the block of 0.49: 0.96 of the
            # way from (126, 3, 168) at 0.25 to (204, 71, 120) at 0.5.
            width, height, rows = read_png(cut)
            self.assertEqual([width, height], head["size"])
            self.assertEqual(rows[height // 2][width // 2], (201, 68, 122))
            self.assertEqual(rows[0][0], (232, 236, 240))
            page.send(f"pick {width // 2} {height // 2}")
            hit = page.text("pick")
            self.assertEqual((hit["cell"][2], hit["position"][2]), (5, 6))
            for line, why in (("cells", "colours"), ("cells blue", "colours"), ("cells phase w 1", "an axis"), ("cells phase x", "whole number"),
                              ("cells phase x 1.5", "whole number"), ("cells phase x 21", "0..20"), ("cells phase x -1", "0..20"),
                              ("cells sleep y 5 5", "whole number"), ("cells phase x 99999999999", "whole number"), ("cells none x 1", "colours")):
                page.send(line)
                refused = page.text("refused")
                self.assertEqual(refused["line"], line)
                self.assertIn(why, refused["why"])
            page.send("home")
            self.assertEqual(page.rest()[1], cut, "what is refused changes nothing")
            page.send("cells none")
            self.assertEqual(page.rest()[1], exact)

    def test_it_ends_by_signals(self):
        for how in (signal.SIGINT, signal.SIGTERM):
            with self.serve() as server, Page(server) as page:
                page.send("play 1")
                page.hear()
                self.assertEqual(server.end(how), (0, ""))
        # In the midst of a thousand steps, which take the reference minutes.
        with Server(PROGRAM, "cello_viscous", "--implementation", "reference", "--threads", 1, cwd=self.path) as server, Page(server) as page:
            page.rest(0)
            page.send("speed 1000")
            page.send("step 1000")
            time.sleep(0.5)
            self.assertEqual(server.end(), (0, ""))

    def test_journals_that_are_wrong(self):
        for text, wanted in (("x\n", "bad.txt:1:1: error: a line begins with a number of steps and a key"),
                             ("# fine\n\n5 heat.gamma 0.1\n4 heat.gamma 0.1\n", "bad.txt:4:1: error: step 4 comes after step 5"),
                             ("0 heat.gamma x\n", "bad.txt:1:3: error: heat.gamma x: not a number"),
                             ("7\n", "bad.txt:1:1: error: a line begins"),
                             ("1 heat.gamma 9\n", "bad.txt:1:3: "), ("2 vent.3.rate 0.1\n", "bad.txt:1:3: error: vent.3.rate"),
                             ("0 grid.size 1\n", "bad.txt:1:3: ")):
            write(self.path, text, "bad.txt")
            done = voxmelt("view", self.scene, "--headless", "--journal", "bad.txt", "--steps", 3, cwd=self.path)
            self.assertEqual(done.returncode, 2, text)
            self.assertIn(wanted, done.stderr)
        done = voxmelt("view", self.scene, "--journal", "none.txt", cwd=self.path)
        self.assertEqual((done.returncode, done.stderr), (2, "error: cannot read none.txt: No such file or directory\n"))

    def test_a_port_that_is_taken(self):
        with self.serve() as server:
            done = voxmelt("view", self.scene, "--port", server.port, cwd=self.path)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr, f"error: cannot listen on port {server.port}: Address already in use\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
