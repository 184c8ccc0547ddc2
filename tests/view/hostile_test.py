#!/usr/bin/env python3
"""Whoever is not the page is refused, and changes nothing: hostile_test.py VOXMELT

At least 60 hostile requests come between the steps of a run. Each is answered with a refusal, or its connection ends. The run
then has the digests that it has alone. With --listen nobody gets in without the token."""
import contextlib
import socket
import struct
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "app"))
from page import Closed, Page, Server
from program import PROGRAM, SMALL, voxmelt, write


def upgrade(port, host=None, origin=None, target="/socket", version="13", key="dGhlIHNhbXBsZSBub25jZQ==", extra=""):
    host = host or f"127.0.0.1:{port}"
    origin = f"Origin: {origin}\r\n" if origin else ""
    return (f"GET {target} HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
            f"Sec-WebSocket-Version: {version}\r\n{origin}{extra}\r\n").encode()


def get(port, target="/", host=None, method="GET", extra=""):
    return f"{method} {target} HTTP/1.1\r\nHost: {host or f'127.0.0.1:{port}'}\r\n{extra}\r\n".encode()


def requests(port):
    """Whole requests that must be refused: a status of 400 or more, or nothing at all."""
    own = f"http://127.0.0.1:{port}"
    evil = [upgrade(port, origin=o) for o in (None, "null", "http://evil.example", own + "0", own + "/", own.replace("http", "https"),
                                              "http://localhost.evil.example", f"http://127.0.0.1.evil.example:{port}", "file://")]
    evil += [upgrade(port, host=h, origin=f"http://{h}") for h in (f"evil.example:{port}", f"127.0.0.1:{port + 1}", f"0.0.0.0:{port}",
                                                                  f"[::1]:{port}", f"127.1:{port}", f"2130706433:{port}", f"LOCALHOST.:{port}")]
    evil += [upgrade(port, origin=own, target=t) for t in ("/sockets", "/socket/", "/../socket", "/socket?x", "//socket", "/view.js/")]
    evil += [upgrade(port, origin=own, version="8")]
    evil += [get(port, t) for t in ("/../../etc/passwd", "/..%2f..%2fetc/passwd", "/%00", "/view.js%00.html", "/view.js/", "/page/view.js",
                                    "\\..\\etc", "/" + "a" * 5000, "*", "/?" + "a" * 7000 + "/../etc/passwd")]
    evil += [get(port, method=m) for m in ("POST", "PUT", "DELETE", "PATCH", "CONNECT", "OPTIONS", "TRACE", "EVIL")]
    evil += [get(port, host=h) for h in ("evil.example", f"evil.example:{port}", "127.0.0.1", f"127.0.0.1:{port}.evil.example")]
    evil += [get(port, extra="Content-Length: 18446744073709551616\r\n"), get(port, extra="Content-Length: -1\r\n"),
             get(port, extra="X: " + "y" * 20000 + "\r\n"), get(port, extra="Origin: http://evil.example\r\n"),
             get(port, method="POST", extra="Transfer-Encoding: chunked\r\n") + b"ffffffffffffffff\r\n",
             b"\0" * 4096, b"\x16\x03\x01\x02\x00\x01\x00", b"GET / HTTP/1.1\r\n\r\n", b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"]
    return evil


def frame(first, length, payload, mask=b"\1\2\3\4"):
    return bytes([first]) + length + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(payload))


FRAMES = {  # of a page that got in: the connection ends
    "not masked": bytes([0x81, 4]) + b"home",
    "2^63 bytes are said to come": frame(0x81, bytes([0xFF]) + struct.pack(">Q", 1 << 63), b"x"),
    "600 bytes": frame(0x81, bytes([0xFE]) + struct.pack(">H", 600), b"x" * 600),
    "reserved bits": frame(0xF1, bytes([0x84]), b"home"),
    "a reserved opcode": frame(0x83, bytes([0x84]), b"home"),
    "a continuation of nothing": frame(0x80, bytes([0x84]), b"home"),
    "binary": frame(0x82, bytes([0x84]), b"home"),
    "no UTF-8": frame(0x81, bytes([0x82]), b"\xff\xfe"),
    "two lines": frame(0x81, bytes([0x88]), b"home\nbest"),
    "a ping of 200 bytes": frame(0x89, bytes([0xFE]) + struct.pack(">H", 200), b"x" * 200),
    "a close of one byte": frame(0x88, bytes([0x81]), b"x"),
}

LINES = ["change heat.gamma nan", "change heat.gamma 1e999", "change heat_source.0.power -0.5", "change vent.add 1 2 3 1 2 0.5",
         "change heat_source.18446744073709551616.power 1", "change heat_source.add 1 2 3 4 5", "change heat_source.add_moon 1",
         "change vent.add_sun 1 2 3 4", "step 18446744073709551616", "step nan", "back -1", "speed inf", "play 0.5", "play",
         "pick 1e9 1", "camera 1 2 3 4 5 nan", "size 0 0", "size 65536 65536", "save ../../etc/passwd", "save journal.txt",
         "textures -1", "textures 1e300", "exact 2", "change pour 0 0 0 1e9 1", "change carve nan 0 0 1", "\x7f", "change \x1b[2J 1"]


class HostileTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)
        self.scene = write(self.path, SMALL)

    def wanted(self, steps):
        done = voxmelt("digest", self.scene, "--steps", steps, "--every", 1, cwd=self.path)
        return {int(line.split()[1]): line.split()[3] for line in done.stdout.splitlines()}

    def answer(self, server, request):
        """The first line of the answer to a request that ends there, or nothing."""
        with server.connect() as link:
            link.settimeout(60)  # the server's patience is less
            data = b""
            try:
                link.sendall(request)
                with contextlib.suppress(OSError):  # a server that has hung up already is right too
                    link.shutdown(socket.SHUT_WR)
                while part := link.recv(65536):
                    data += part
            except ConnectionError:
                pass
            return data.split(b"\r\n")[0].decode()

    def test_nothing_changes(self):
        with Server(PROGRAM, self.scene, "--threads", 1, cwd=self.path) as server, Page(server) as page:
            step = page.rest(0)[0]["step"]
            evil = requests(server.port)
            self.assertGreaterEqual(len(evil) + len(FRAMES) + 3, 60)
            wanted = self.wanted(len(evil) + len(FRAMES) + len(LINES))

            def go_on(what):
                nonlocal step
                step += 1
                page.send("step 1")
                self.assertEqual(page.rest(step)[0]["digest"], wanted[step], what)

            for request in evil:
                head = self.answer(server, request)
                self.assertRegex(head, r"^$|^HTTP/1.1 (4\d\d|5\d\d)|^HTTP/1.1 426", request[:300])
                go_on(request[:200])
            for name, data in FRAMES.items():
                with Page(server) as other:
                    self.assertEqual(other.status, 101)
                    other.link.sendall(data)
                    with self.assertRaises((Closed, ConnectionError), msg=name):  # a timeout is no end
                        while True:
                            other.hear()
                go_on(name)
            for line in LINES:
                page.send(line)
                self.assertEqual(page.text("refused")["line"], line)
                go_on(line)
            self.assertEqual(server.end(), (0, ""))

    def test_many_slow_and_broken_connections(self):
        with Server(PROGRAM, self.scene, "--threads", 1, cwd=self.path) as server, Page(server) as page:
            page.rest(0)
            for _ in range(2000):
                server.connect().close()
            silent = [server.connect() for _ in range(150)]  # more than are served at a time
            half = []
            for k in range(40):
                try:
                    link = server.connect()
                    link.sendall(upgrade(server.port, origin=f"http://127.0.0.1:{server.port}")[:20 + k])
                    half.append(link)
                except OSError:
                    pass
            page.send("step 10")
            self.assertEqual(page.rest(10)[0]["digest"], self.wanted(10)[10])
            for link in silent + half:
                link.close()
            for _ in range(20):  # pages that go in the middle of what they say
                with Page(server) as other:
                    other.link.sendall(frame(0x81, bytes([0x90]), b"home"))
            time.sleep(0.2)
            with Page(server) as other:  # there is room again
                self.assertEqual(other.status, 101)
            self.assertEqual(server.end(), (0, ""))

    def test_one_page_has_the_hands(self):
        with Server(PROGRAM, self.scene, "--threads", 1, cwd=self.path) as server, Page(server) as first:
            first.rest(0)
            with Page(server) as second:
                while second.text("hands")["yours"]:
                    pass
                for line in ("step 1", "play 1", "restart", "back 0", "change heat.gamma 0.1", "camera 1 2 30 1 1 1", "size 100 100", "give"):
                    second.send(line)
                    self.assertEqual(second.text("refused")["why"], "error: another page has the hands; `hands` asks for them")
                second.send("hands")
                while not first.text("hands")["asked"]:
                    pass
                first.send("give")
                while not second.text("hands")["yours"]:
                    pass
                second.send("step 3")
                self.assertEqual(second.rest(3)[0]["digest"], self.wanted(3)[3])
                first.send("step 1")
                self.assertIn("another page has the hands", first.text("refused")["why"])
                begin = time.monotonic()  # the other page does not answer
                first.send("hands")
                while not first.text("hands")["yours"]:
                    time.sleep(0.5)
                    first.send("hands")
                self.assertTrue(4.5 < time.monotonic() - begin < 15)
                first.send("step 1")
                self.assertEqual(first.rest(4)[0]["digest"], self.wanted(4)[4])
                second.send("hands")
                while not first.text("hands")["asked"]:
                    pass
                first.send("give")
            while not first.text("hands")["yours"]:  # the other has gone
                pass
            first.send("step 1")
            self.assertEqual(first.rest(5)[0]["digest"], self.wanted(5)[5])

    def test_a_slow_page_is_told_what_it_missed(self):
        with Server(PROGRAM, self.scene, "--threads", 1, cwd=self.path) as server, Page(server) as page:
            page.rest(0)
            with Page(server) as slow:
                slow.text("world")
                while slow.hear()[0] != "frame":
                    pass
                page.send("size 1280 960")
                page.send("step 400")
                page.send("speed 1")
                seen, missed = {"fast": 0, "slow": 0}, {"fast": 0, "slow": 0}

                def look(name, link):
                    kind, *rest = link.hear()
                    seen[name] += kind == "frame"
                    if kind == "text" and rest[0]["type"] == "dropped":
                        missed[name] = rest[0]["frames"]
                    return kind == "frame" and rest[0]["step"] == 400 and rest[0]["exact"]

                while not look("fast", page):
                    pass
                while not look("slow", slow):
                    pass
                self.assertGreater(missed["slow"], 0, "it shall be slow")
                # Both were offered the same frames, but for the last one that the slow page saw before.
                self.assertAlmostEqual(seen["slow"] + missed["slow"], seen["fast"] + missed["fast"], delta=2)

    def test_listen_wants_the_token(self):
        with Server(PROGRAM, self.scene, "--listen", "127.0.0.1", cwd=self.path) as server:
            self.assertRegex(server.url, r"^http://127\.0\.0\.1:\d+/\?[0-9a-f]{32}$")
            token = server.url.split("?")[1]
            for wrong in ("", "?", "?" + token[:-1], "?" + token + "0", "?" + "0" * 32, "?" + token[:-1] + ("0" if token[-1] != "0" else "1"),
                          "?" + token.upper() if token.upper() != token else "?x"):
                self.assertIn("403", server.get("/" + wrong)[0][0], wrong)
                with Page(server, target="/socket" + wrong) as other:
                    self.assertEqual(other.status, 403, wrong)
            self.assertIn("200", server.get("/?" + token)[0][0])
            self.assertIn("200", server.get("/view.js")[0][0])
            with Page(server, target="/socket?" + token, origin="http://evil.example") as other:
                self.assertEqual(other.status, 403)
            with Page(server, target="/socket?" + token) as page:
                self.assertEqual(page.rest(0)[0]["digest"], self.wanted(1)[0])
            with Server(PROGRAM, self.scene, "--listen", "127.0.0.1", cwd=self.path) as other:
                self.assertNotEqual(other.url.split("?")[1], token)
        done = voxmelt("view", self.scene, "--listen", "nowhere.example", cwd=self.path)
        self.assertEqual((done.returncode, done.stderr), (2, "error: --listen nowhere.example: is no address in numbers\n"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
