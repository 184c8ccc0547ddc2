"""Reads the PNG files of `voxmelt`: 8-bit RGB, filters 0, 1 and 2."""
import struct
import zlib


def pixels(png):
    """The bytes red, green, blue of all pixels of a file, rows from the top."""
    data, at, packed = png.read_bytes(), 8, b""
    while at < len(data):
        size, = struct.unpack(">I", data[at:at + 4])
        name, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        if name == b"IHDR":
            width, height = struct.unpack(">II", body[:8])
        packed += body if name == b"IDAT" else b""
        at += 12 + size
    raw, above, rows = zlib.decompress(packed), bytes(3 * width), b""
    for y in range(height):
        kind, *row = raw[y * (3 * width + 1):(y + 1) * (3 * width + 1)]
        for i in range(len(row)):
            row[i] = (row[i] + (0, row[i - 3] if i >= 3 else 0, above[i])[kind]) % 256
        above = bytes(row)
        rows += above
    return rows
