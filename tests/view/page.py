"""A page of `voxmelt view` without a browser: HTTP requests, and a WebSocket as RFC 6455 has it."""
import base64
import hashlib
import json
import os
import signal
import socket
import struct
import subprocess


class Server:
    """`voxmelt view`, on a port of its own."""

    def __init__(self, program, *arguments, cwd=None):
        self.process = subprocess.Popen([program, "view", *map(str, arguments)], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, cwd=cwd)
        self.url = self.process.stdout.readline().strip()
        self.port = int(self.url.rsplit(":", 1)[1].split("/")[0]) if self.url else 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()

    def end(self, how=signal.SIGINT):
        """Its exit code and what it said on standard error."""
        self.process.send_signal(how)
        _, said = self.process.communicate(timeout=30)
        return self.process.returncode, said

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=20)

    def raw(self, request):
        """The answer to some bytes, as the head's lines and the body."""
        with self.connect() as link:
            link.sendall(request)
            data = b""
            while part := link.recv(65536):
                data += part
        head, _, body = data.partition(b"\r\n\r\n")
        return head.decode().split("\r\n"), body

    def get(self, target, method="GET", **headers):
        fields = {"Host": f"127.0.0.1:{self.port}"} | {k.replace("_", "-"): v for k, v in headers.items()}
        lines = [f"{method} {target} HTTP/1.1"] + [f"{k}: {v}" for k, v in fields.items() if v is not None]
        return self.raw("\r\n".join(lines).encode() + b"\r\n\r\n")


class Closed(Exception):
    """The server has closed the connection; its code, if it said one."""


class Page:
    """A page that is open: what it says and hears."""

    def __init__(self, server, host=None, origin="same", target="/socket"):
        host = host or f"127.0.0.1:{server.port}"
        key = base64.b64encode(os.urandom(16)).decode()
        lines = [f"GET {target} HTTP/1.1", f"Host: {host}", "Upgrade: websocket", "Connection: Upgrade",
                 f"Sec-WebSocket-Key: {key}", "Sec-WebSocket-Version: 13"]
        if origin == "same":
            origin = f"http://{host}"
        if origin:
            lines.append(f"Origin: {origin}")
        self.link = server.connect()
        self.link.sendall("\r\n".join(lines).encode() + b"\r\n\r\n")
        self.data = b""
        while b"\r\n\r\n" not in self.data:
            part = self.link.recv(65536)
            if not part:
                break
            self.data += part
        head, _, self.data = self.data.partition(b"\r\n\r\n")
        self.status = int(head.split()[1])
        if self.status == 101:
            want = base64.b64encode(hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest())
            assert b"Sec-WebSocket-Accept: " + want in head, head

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.link.close()

    def send(self, payload, code=1):
        payload = payload.encode() if isinstance(payload, str) else payload
        mask = os.urandom(4)
        size = len(payload)
        head = bytes([0x80 | code])
        head += bytes([0x80 | size]) if size < 126 else bytes([0x80 | 126]) + struct.pack(">H", size)
        self.link.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(payload)))

    def _take(self, count):
        while len(self.data) < count:
            part = self.link.recv(1 << 20)
            if not part:
                raise Closed("the connection ended")
            self.data += part
        taken, self.data = self.data[:count], self.data[count:]
        return taken

    def hear(self):
        """The next message: ("text", JSON) or ("frame", header, picture)."""
        first, second = self._take(2)
        size = second & 127
        if size == 126:
            size = struct.unpack(">H", self._take(2))[0]
        elif size == 127:
            size = struct.unpack(">Q", self._take(8))[0]
        payload = self._take(size)
        assert first & 0x80, "a message is in one piece"
        code = first & 15
        if code == 8:
            raise Closed(struct.unpack(">H", payload[:2])[0] if len(payload) >= 2 else None)
        if code == 9:
            self.send(payload, 10)
            return self.hear()
        if code == 1:
            return "text", json.loads(payload)
        length = struct.unpack("<I", payload[:4])[0]
        head = json.loads(payload[4:4 + length])
        return head["type"], head, payload[4 + length:]

    def text(self, kind):
        """The next text of a type."""
        while True:
            heard = self.hear()
            if heard[0] == "text" and heard[1]["type"] == kind:
                return heard[1]

    def file(self):
        """The next file: its name and what it holds."""
        while (heard := self.hear())[0] != "file":
            pass
        return heard[1]["name"], heard[2]

    def rest(self, step=None):
        """The next frame of a state at rest: its header and the bytes of the picture."""
        while True:
            heard = self.hear()
            if heard[0] == "frame" and heard[1]["exact"] and step in (None, heard[1]["step"]):
                return heard[1], heard[2]
