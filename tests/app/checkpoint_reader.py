"""Reads and writes checkpoints from docs/checkpoint.md alone: the format's second program."""
import ctypes
import ctypes.util
import json
import struct

ZSTD = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
XXHASH = ctypes.CDLL(ctypes.util.find_library("xxhash") or "libxxhash.so.0")
ZSTD.ZSTD_decompress.restype = ctypes.c_size_t
ZSTD.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
XXHASH.XXH3_64bits.restype = ctypes.c_uint64
XXHASH.XXH3_64bits.argtypes = [ctypes.c_char_p, ctypes.c_size_t]
ZSTD.ZSTD_compress.restype = ctypes.c_size_t
ZSTD.ZSTD_compress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t, ctypes.c_int]
MAGIC = b"\x89VXC\r\n\x1a\n"


def xxh3(data):
    return XXHASH.XXH3_64bits(data, len(data))


def unpack(stored, size):
    if not stored:
        return bytes(size)
    raw = ctypes.create_string_buffer(size)
    assert ZSTD.ZSTD_decompress(raw, size, stored, len(stored)) == size
    return raw.raw


def blocks(data):
    """(kind, first, count, raw size, stored bytes, where its header begins) of each block."""
    assert data[:16] == MAGIC + struct.pack("<II", 1, 0), "magic, version, no flags"
    at, sums = 16, b""
    while True:
        kind, first, count, raw, size = struct.unpack_from("<8sIIQQ", data, at)
        (total,) = struct.unpack_from("<Q", data, at + 32)
        stored = data[at + 40:at + 40 + size]
        assert len(stored) == size
        assert xxh3(data[at:at + 32] + stored) == total
        kind = kind.rstrip(b"\0").decode()
        yield kind, first, count, raw, stored, at
        at += 40 + size
        if kind == "end":
            assert stored == sums and at == len(data)
            return
        sums += struct.pack("<Q", total)


def read(path):
    """The head, and each column's cells as bytes in the order z, y, x: u8 of masks, little-endian u16 of fields."""
    head, columns = None, {}
    for kind, first, count, raw, stored, _ in blocks(path.read_bytes()):
        if kind == "end":
            continue
        content = unpack(stored, raw)
        if kind == "head":
            head = json.loads(content)
            x, y, z = head["grid"]
            continue
        if kind in ("solid", "liquid", "inert"):
            row = (x + 63) // 64 * 8
            assert len(content) == row * y * count
            rows = (content[i:i + row] for i in range(0, len(content), row))
            content = b"".join(bytes(r[i // 8] >> i % 8 & 1 for i in range(x)) for r in rows)
        elif kind != "terrain":
            assert len(content) == 2 * x * y * count
        columns[kind] = columns.get(kind, b"") + content
    return head, columns


def packed(content):
    stored = ctypes.create_string_buffer(len(content) + 1024)
    size = ZSTD.ZSTD_compress(stored, len(stored), content, len(content), 1)
    return stored.raw[:size]


def sealed(contents):
    """A file of these (kind, first, count, content): every checksum fits."""
    data, sums = MAGIC + struct.pack("<II", 1, 0), b""

    def block(kind, first, count, raw, stored):
        header = struct.pack("<8sIIQQ", kind.encode(), first, count, raw, len(stored))
        total = struct.pack("<Q", xxh3(header + stored))
        return header + total + stored, total

    for kind, first, count, content in contents:
        one, total = block(kind, first, count, len(content), packed(content))
        data, sums = data + one, sums + total
    return data + block("end", len(sums) // 8, 0, 0, sums)[0]


def state_digest(columns):
    """docs/automaton.md, section 13."""
    mask = 2**64 - 1

    def fields(name):
        return struct.unpack(f"<{len(columns[name]) // 2}H", columns[name])

    total = 0
    cells = zip(fields("amount"), fields("energy"), fields("heat"), columns["solid"], columns["liquid"], columns["inert"])
    for i, (amount, energy, heat, solid, liquid, inert) in enumerate(cells):
        v = amount | energy << 16 | heat << 32 | solid << 48 | liquid << 49 | inert << 50
        if v == 0:
            continue
        v = (v + 0x9E3779B97F4A7C15 * (i + 1)) & mask
        v = (v ^ v >> 30) * 0xBF58476D1CE4E5B9 & mask
        v = (v ^ v >> 27) * 0x94D049BB133111EB & mask
        total += v ^ v >> 31
    return f"{total & mask:016x}"
