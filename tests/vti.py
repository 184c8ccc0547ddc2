"""Reads a VTK image (.vti) as VTK's page of file formats says: raw appended arrays, each in zlib blocks."""
import re
import struct
import zlib


def arrays_of(data):
    """The bytes of each array of cells, by name."""
    head, marker, rest = data.partition(b'<AppendedData encoding="raw">\n_')
    assert marker and b'compressor="vtkZLibDataCompressor"' in head and b'header_type="UInt64"' in head
    arrays = {}
    for name, offset in re.findall(rb'Name="(\w+)" format="appended" offset="(\d+)"', head):
        at = int(offset)
        count, size, last = struct.unpack_from("<3Q", rest, at)
        packed = struct.unpack_from(f"<{count}Q", rest, at + 24)
        at += 24 + 8 * count
        blocks = []
        for i, bytes_ in enumerate(packed):
            blocks.append(zlib.decompress(rest[at:at + bytes_]))
            assert len(blocks[-1]) == (last if last and i == count - 1 else size), (name, i, len(blocks[-1]))
            at += bytes_
        arrays[name.decode()] = b"".join(blocks)
    return arrays


def time_of(data):
    """The time step that the image says it is of."""
    return float(re.search(rb'Name="TimeValue"[^>]*>([^<]*)<', data)[1])
