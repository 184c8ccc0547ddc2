#!/usr/bin/env python3
"""Meshes in every format, as a user meets them.

  meshes_test.py VOXMELT

The same cup, written by a program that is not ours (tests/data/write_cup.py), gives the same cells in each format. What
is no mesh gets exit code 2 and one line that names its place, soon and with little memory.
"""
import json
import struct
import tempfile
import unittest
from pathlib import Path

import bad_files
from program import voxmelt, write

DATA = Path(__file__).resolve().parent.parent / "data"
CUPS = ["cup.obj", "cup.stl", "cup_text.stl", "cup.ply", "cup_text.ply", "cup.glb", "cup.gltf"]

CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def binary_stl(faces=FACES, corners=CORNERS, header=b"made by hand", count=None):
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(v for i in face for v in corners[i]), 0) for face in faces)
    return header.ljust(80, b" ") + struct.pack("<I", len(faces) if count is None else count) + body


STL = "solid a\n" + "".join(
    "facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % CORNERS[i] for i in face) + "endloop\nendfacet\n"
    for face in FACES) + "endsolid a\n"
PLY = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
       "property list uchar int vertex_indices\nend_header\n" + "".join("%g %g %g\n" % c for c in CORNERS)
       + "".join("3 %d %d %d\n" % f for f in FACES))


def binary_ply(order="<"):
    head = PLY[:PLY.index("end_header\n")].replace("ascii", "binary_little_endian" if order == "<" else "binary_big_endian")
    return ((head + "end_header\n").encode() + b"".join(struct.pack(order + "3f", *c) for c in CORNERS)
            + b"".join(struct.pack(order + "B3i", 3, *f) for f in FACES))


def gltf(change=None, corners=CORNERS, faces=FACES):
    """The JSON of a tetrahedron, after `change`, and its bytes."""
    bytes_ = b"".join(struct.pack("<3f", *c) for c in corners)
    bytes_ += b"".join(struct.pack("<3H", *f) for f in faces)
    text = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
            "buffers": [{"byteLength": len(bytes_)}]}
    if change:
        change(text)
    return json.dumps(text).encode(), bytes_


def glb(change=None, **tetrahedron):
    text, bytes_ = gltf(change, **tetrahedron)
    text += b" " * (-len(text) % 4)
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(bytes_)) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(bytes_), b"BIN\0") + bytes_)


def put(path, value):
    """A change of the JSON: the value at a path, which None takes away."""
    def change(text):
        *way, last = path.split(".")
        for step in way:
            text = text[int(step) if step.isdigit() else step]
        if value is None:
            del text[last]
        else:
            text[int(last) if last.isdigit() else last] = value
    return change


NAN, FAR = float("nan"), 3.4e38
LOST = [(NAN, 0, 0), *CORNERS[1:]]
# name of the file: (what it holds, what the message must hold)
BAD = {
    "empty.stl": (b"", "the mesh has no faces"),
    "short.stl": (b"\0\1\2", "no STL file: is it truncated?"),
    "header.stl": (b"ab\0" * 27, "no STL file: is it truncated?"),
    "cut.stl": (binary_stl()[:-7], "4 triangles are 284 bytes, and the file has 277: is it truncated?"),
    "solid_cut.stl": (binary_stl(header=b"solid a\0")[:-7], "is it truncated?"),
    "more.stl": (binary_stl() + b"x", "4 triangles are 284 bytes, and the file has 285"),
    "promise.stl": (binary_stl(count=0xFFFFFFFF), "4294967295 triangles are"),
    "none.stl": (binary_stl([]), "the mesh has no faces"),
    "nan.stl": (binary_stl(corners=LOST), "triangle 1 of 4: nan is not a coordinate"),
    "infinite.stl": (binary_stl(corners=[(float("inf"), 0, 0), *CORNERS[1:]]), "triangle 1 of 4: inf is"),
    "far.stl": (binary_stl(corners=[(FAR, 0, 0), *CORNERS[1:]]), "is not a coordinate"),
    "wide.stl": (STL.encode("utf-16"), "this is UTF-16"),
    "packed.stl": (b"PK\3\4" + bytes(100), "this is a packed file"),
    "pointer.stl": (b"version https://git-lfs.github.com/spec/v1\n", "git lfs pull"),
    "words.stl": (b"a model\n", ":1: 'a' begins no line of an STL file"),
    "text_cut.stl": (STL[:STL.rindex("endloop")], "the file ends within a facet"),
    "no_end.stl": (STL.replace("endsolid a\n", ""), "the file ends within a solid"),
    "two_corners.stl": (STL.replace("vertex 0 0 0\n", "", 1), ":7: a facet needs 3 vertices, not 2"),
    "two_numbers.stl": (STL.replace("vertex 0 0 0\n", "vertex 0 0\n", 1), ":4: a vertex needs 3 coordinates"),
    "letters.stl": (STL.replace("vertex 0 0 0\n", "vertex 0 0 O\n", 1), ":4: 'O' is not a coordinate"),
    "text_nan.stl": (STL.replace("vertex 0 0 0\n", "vertex 0 nan 0\n", 1), ":4: 'nan' is not a coordinate"),
    "loose.stl": ("solid\nvertex 0 0 0\n", ":2: a vertex outside of a facet"),
    "facets.stl": ("solid\nfacet\nfacet\n", ":3: a facet within a facet"),
    "ends.stl": ("endsolid\n", ":1: an endsolid where no solid can end"),
    "no_solid.stl": ("facet\n", ":1: a facet outside of a solid"),
    "nothing_in.stl": ("solid\nendsolid\n", "the mesh has no faces"),
    "empty.ply": (b"", ":0: a PLY file begins with the line `ply`"),
    "other.ply": (b"plywood\n", ":1: a PLY file begins"),
    "no_format.ply": (PLY.replace("format ascii 1.0\n", ""), "the header has no line `format`"),
    "format.ply": (PLY.replace("ascii", "binary"), ":2: the format must be"),
    "version.ply": (PLY.replace("1.0", "2.0"), ":2: the format must be"),
    "no_end.ply": (PLY[:PLY.index("element face")], "the header has no line `end_header`"),
    "word.ply": (PLY.replace("element face", "elemental face"), ":7: 'elemental' begins no line of a PLY header"),
    "type.ply": (PLY.replace("float y", "real y"), ":5: 'real' is no type of a property"),
    "list.ply": (PLY.replace("list uchar", "list float"), ":8: the length of a list must have a whole type"),
    "reals.ply": (PLY.replace("uchar int", "uchar float"), "no list vertex_indices of whole numbers"),
    "lonely.ply": ("ply\nproperty int x\n", ":2: a property before the first element"),
    "negative.ply": (PLY.replace("vertex 4", "vertex -4"), ":3: an element needs a name, and a number"),
    "promise.ply": (PLY.replace("vertex 4", "vertex 4000000000"), "4000000000 times `vertex` do not fit"),
    "faces.ply": (PLY.replace("face 4", "face 4000000000000000000"), "do not fit into the rest"),
    "no_z.ply": (PLY.replace("property float z\n", ""), "a vertex has no number z"),
    "no_list.ply": (PLY.replace("vertex_indices", "corners"), "a face has no list vertex_indices"),
    "far.ply": (PLY.replace("3 1 2 3", "3 1 2 4"), ":17: face 3 names vertex 4, and there are 4"),
    "below.ply": (PLY.replace("3 1 2 3", "3 1 2 -1"), "face 3 names vertex -1"),
    "long.ply": (PLY.replace("3 1 2 3", "3 1 2 3 4"), ":17: face 3 has more than its numbers: '4'"),
    "short.ply": (PLY.replace("3 1 2 3", "3 1 2"), ":17: face 3 has too few numbers"),
    "count.ply": (PLY.replace("3 1 2 3", "-3 1 2 3"), "face 3 has a list of -3 numbers"),
    "letters.ply": (PLY.replace("\n1 0 0\n", "\n1 0 O\n"), ":11: vertex 1 'O' is no number"),
    "nan.ply": (PLY.replace("\n1 0 0\n", "\n1 nan 0\n"), ":11: vertex 1 has nan, which is not a coordinate"),
    "no_faces.ply": (PLY[:PLY.index("3 0")].replace("face 4", "face 0"), "the mesh has no faces"),
    "missing.ply": (PLY[:PLY.index("3 1 2")], "face 3"),
    "cut.ply": (binary_ply()[:-1], "face 3 is not whole"),
    "cut_big.ply": (binary_ply(">")[:-1], "face 3 is not whole"),
    "order.ply": (binary_ply().replace(b"little", b"big", 1), "face 0 names vertex"),
    "more.ply": (binary_ply() + b"xx", "2 bytes behind its last element"),
    "empty.glb": (b"", "byte 1 of its JSON is wrong"),
    "header.glb": (b"glTF\2\0\0\0", "truncated in its header"),
    "version.glb": (b"glTF\1" + glb()[5:], "version 1 of glTF is not read"),
    "cut.glb": (glb()[:-8], "is it truncated?"),
    "chunk.glb": (glb()[:12] + b"\xff\xff\xff\x7f" + glb()[16:], "chunk 0 says 2147483647 bytes"),
    "no_json.glb": (glb().replace(b"JSON", b"JSOX"), "its first chunk is no JSON"),
    "broken.glb": (glb().replace(b'"asset":', b'"asset";'), "of its JSON is wrong"),
    "asset.glb": (glb(put("asset", {})), "asset.version: is missing"),
    "old.glb": (glb(put("asset.version", "1.0")), "asset.version: '1.0' is not read"),
    "draco.glb": (glb(put("extensionsRequired", ["KHR_draco_mesh_compression"])), "'KHR_draco_mesh_compression' is not read"),
    "sparse.glb": (glb(put("accessors.0.sparse", {})), "accessors.0.sparse: is not read"),
    "no_scene.glb": (glb(put("scene", 3)), "there is no scenes.3"),
    "no_node.glb": (glb(put("scenes.0.nodes", [7])), "there is no nodes.7"),
    "loop.glb": (glb(put("nodes.0.children", [0])), "nodes.0: stands within itself"),
    "no_mesh.glb": (glb(put("nodes.0.mesh", 5)), "there is no meshes.5"),
    "text.glb": (glb(put("nodes.0.mesh", "x")), "nodes.0.mesh: is no whole number"),
    "scale.glb": (glb(put("nodes.0.scale", [1, 2])), "nodes.0.scale: must be 3 numbers"),
    "matrix.glb": (glb(put("nodes.0.matrix", [1e300] * 16)), "nodes.0.matrix: has something else than numbers"),
    "no_position.glb": (glb(put("meshes.0.primitives.0.attributes", {})), "attributes.POSITION: is missing"),
    "mode.glb": (glb(put("meshes.0.primitives.0.mode", 7)), "mode: 7 is none of 0 to 6"),
    "lines.glb": (glb(put("meshes.0.primitives.0.mode", 1)), "the mesh has no vertices"),
    "accessor.glb": (glb(put("meshes.0.primitives.0.indices", 9)), "there is no accessors.9"),
    "vec2.glb": (glb(put("accessors.0.type", "VEC2")), "accessors.0.type: must be VEC3"),
    "component.glb": (glb(put("accessors.0.componentType", 5130)), "accessors.0.componentType: 5130 is none"),
    "reals.glb": (glb(put("accessors.1.componentType", 5126)), "accessors.1: 12 times 4 bytes are not within"),
    "count.glb": (glb(put("accessors.0.count", 5)), "accessors.0: 5 times 12 bytes are not within its view of 48"),
    "eleven.glb": (glb(put("accessors.1.count", 11)), "11 corners are no triangles"),
    "view.glb": (glb(put("accessors.0.bufferView", 9)), "there is no bufferViews.9"),
    "no_view.glb": (glb(put("accessors.0.bufferView", None)), "accessors.0.bufferView: is missing"),
    "stride.glb": (glb(put("bufferViews.0.byteStride", 4)), "byteStride: 4 is not within 12..4096"),
    "offset.glb": (glb(put("bufferViews.0.byteOffset", (1 << 64) - 8)), "are not within its buffer"),
    "buffer.glb": (glb(put("bufferViews.0.buffer", 2)), "there is no buffers.2"),
    "bytes.glb": (glb(put("buffers.0.byteLength", 99999)), "buffers.0: says 99999 bytes, and has 72"),
    "far.glb": (glb(faces=[(0, 2, 1), (0, 1, 9), *FACES[2:]]), "corner 5 is vertex 9, and there are 4"),
    "nan.glb": (glb(corners=LOST), "vertex 0 is at nan"),
    "bomb.glb": (glb(lambda text: (text["nodes"].extend({"mesh": 0} for _ in range(300)),
                                   put("scenes.0.nodes", list(range(301)))(text),
                                   put("meshes.0.primitives", text["meshes"][0]["primitives"] * 30000)(text))), "more than 100000000 corners"),
    "deep.glb": (b"glTF\2\0\0\0" + struct.pack("<II4s", 2000020, 2000000, b"JSON") + b"[" * 2000000, "of its JSON is wrong"),
    "gone.gltf": (gltf(put("buffers.0.uri", "gone.bin"))[0], "gone.bin"),
    "web.gltf": (gltf(put("buffers.0.uri", "https://example.org/a.bin"))[0], "is no file beside this one"),
    "base64.gltf": (gltf(put("buffers.0.uri", "data:;base64,&&"))[0], "no Base64"),
    "no_chunk.gltf": (gltf()[0], "buffers.0: has no uri"),
    "model.fbx": (b"Kaydara FBX Binary", "meshes are read from .obj, .stl, .ply, .glb, .gltf, not from .fbx"),
}


def scene_of(file, more="height = 24\nat = [16, 4, 16]\n"):
    return f'[grid]\nsize = [32, 32, 32]\n[[solid]]\nshape = "mesh"\nfile = "{file}"\n{more}'


class Meshes(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def test_the_same_cup_in_each_format(self):
        lines = {}
        for cup in CUPS:
            result = voxmelt("digest", write(self.folder, scene_of(DATA / cup)), "--steps", 0,
                             *(["--set", "solid.0.up=z"] if cup.endswith(".stl") else []))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(result.stderr.replace(cup, "cup"), "warning: cup: 2 shells\n"
                             "warning: cup: shells overlap, or one crosses itself: united\n")
            lines[cup] = result.stdout
        self.assertEqual(len(set(lines.values())), 1, lines)
        self.assertNotIn("solid 0 ", lines["cup.obj"])

    def digest_of(self, name, data):
        (self.folder / name).write_bytes(data)
        result = voxmelt("digest", write(self.folder, scene_of(name, "height = 23.7\nat = [16, 4, 16]\n")), "--steps", 0)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout + result.stderr.replace(name, "model")

    # A turned node moves what is within it; a mirrored one keeps its outside. The corners of the OBJ are worked by hand.
    def test_nodes_turn_move_and_mirror(self):
        half = 2 ** -0.5
        nodes = [{"mesh": 0}, {"rotation": [0, 0, half, half], "children": [2]}, {"mesh": 0, "translation": [2, 0, 0]},
                 {"mesh": 0, "scale": [-1, 1, 1], "translation": [-2, 0, 0]}]
        made = glb(lambda text: (put("nodes", nodes)(text), put("scenes.0.nodes", [0, 1, 3])(text)))
        bodies = [(CORNERS, FACES), ([(-y, x + 2, z) for x, y, z in CORNERS], FACES),
                  ([(-x - 2, y, z) for x, y, z in CORNERS], [face[::-1] for face in FACES])]
        obj = "".join("v %g %g %g\n" % corner for corners, _ in bodies for corner in corners)
        obj += "".join("f %d %d %d\n" % tuple(i + 1 + 4 * k for i in face) for k, (_, faces) in enumerate(bodies) for face in faces)
        said = self.digest_of("nodes.glb", made)
        self.assertTrue(said.endswith("\nwarning: model: 3 shells\n"), said)
        self.assertEqual(said, self.digest_of("nodes.obj", obj.encode()))

    def test_minus_zero_is_zero(self):
        negative = [tuple(v or -0.0 for v in corner) for corner in CORNERS]
        mixed = binary_stl(FACES[:2], count=4) + binary_stl(FACES[2:], negative)[84:]
        self.assertEqual(self.digest_of("zero.stl", mixed), self.digest_of("plain.stl", binary_stl()))

    def test_what_the_bad_ones_are_made_of_is_good(self):
        lines = set()
        for name, bytes_ in (("a.stl", binary_stl()), ("b.stl", binary_stl(header=b"solid")), ("c.stl", STL.encode()),
                             ("d.ply", PLY.encode()), ("e.ply", binary_ply()), ("f.ply", binary_ply(">")), ("g.glb", glb())):
            (self.folder / name).write_bytes(bytes_)
            result = voxmelt("digest", write(self.folder, scene_of(name)), "--steps", 0)
            self.assertEqual((result.returncode, result.stderr), (0, ""), name)
            lines.add(result.stdout)
        self.assertEqual(len(lines), 1)

    def test_a_model_without_a_scene(self):
        (self.folder / "cup of tea.stl").write_bytes((DATA / "cup.stl").read_bytes())
        first = voxmelt("run", "cup of tea.stl", "--steps", 2, "--size", "32x32", cwd=self.folder)
        self.assertEqual(first.returncode, 0, first.stderr)
        assumed = [line for line in first.stderr.splitlines() if line.startswith("assumed: ")]
        # The cup is 9.75 wide, 8 high and 7.5 deep, with its handle. 96 cells of width are 9.846 to a unit.
        self.assertEqual(assumed[0], "assumed: z points up in cup of tea.stl; it is fitted to a grid of 128 x 85 x 106 cells, 9.846 to its unit")
        self.assertEqual(len(assumed), 3)
        self.assertIn("scene          out/cup of tea.stl/scene.toml; change it", first.stdout)
        scene = self.folder / "out/cup of tea.stl/scene.toml"
        digests = [voxmelt("digest", name, "--steps", 3, cwd=self.folder).stdout for name in ("cup of tea.stl", scene)]
        self.assertEqual(*digests)
        again = voxmelt("run", "cup of tea.stl", "--steps", 1, "--size", "32x32", "--quiet", cwd=self.folder)
        self.assertEqual((again.returncode, again.stderr, again.stdout), (0, "", ""))
        on = voxmelt("run", "--resume", "out/cup of tea.stl", "--steps", "+1", cwd=self.folder)
        self.assertEqual(on.returncode, 0, on.stderr)
        self.assertEqual(voxmelt("run", scene, "--steps", 0, "--out", "other", cwd=self.folder).returncode, 0)

        text = scene.read_text()
        scene.write_text(text.replace("melting_point = 0.5", "melting_point = 0.4"))
        changed = voxmelt("run", "cup of tea.stl", "--steps", 1, cwd=self.folder)
        self.assertEqual(changed.returncode, 2)
        self.assertIn("out/cup of tea.stl/scene.toml: error: it is another one than is assumed of cup of tea.stl; run it, or take it away\n",
                      changed.stderr)
        self.assertIn("melting_point = 0.4", scene.read_text(), "what somebody changed is never lost")

    def test_models_of_each_format_stand_alike(self):
        lines = {voxmelt("digest", DATA / cup, "--steps", 1, "--quiet").stdout for cup in CUPS}
        self.assertEqual(len(lines), 1, lines)

    def test_models_that_are_none(self):
        for name, content, expected in (
                ("cut.stl", binary_stl()[:-7], "cut.stl: error: cut.stl: 4 triangles are 284 bytes, and the file has 277"),
                ("point.ply", PLY.replace("\n1 0 0", "\n0 0 0").replace("\n0 1 0", "\n0 0 0").replace("\n0 0 1", "\n0 0 0"),
                 "point.ply: error: the model has no size"),
                ("gone.glb", None, "gone.glb: error: cannot read gone.glb: No such file")):
            with self.subTest(name):
                if content is not None:
                    (self.folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
                result = voxmelt("run", name, cwd=self.folder)
                self.assertEqual(result.returncode, 2)
                self.assertTrue(result.stderr.startswith(expected), result.stderr)
                self.assertEqual(result.stderr.count("\n"), 1)
                self.assertFalse((self.folder / "out").exists())

    def test_bad_files(self):
        self.assertGreaterEqual(len(BAD), 60)
        bad_files.check(self, BAD, scene_of)


unittest.main(argv=["meshes_test"])
