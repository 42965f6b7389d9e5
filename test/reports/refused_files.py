# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Mesh files with a fault, which has to be named with its place: a surface that is lost makes P too small."""
import json
import struct

from brick_files import joined, obj_lines, off_text, stl_binary, stl_text
from bricks import TRIANGLES, corners, drawn_brick
from checks import Case
from exchange import dae, gltf
from ply_dialects import XYZ, element, faces_of, plain, ply

BALL = {"sphere": 0.3, "pose": [2.5, 0, 0]}


def refused(name, mesh, content, *words):
    """The file is named, and whatever else the words say."""
    scene = {"a": BALL, "b": {"mesh": mesh}, "displacement": {"sigma": [0.1] * 3}}
    files = {mesh: content} if content is not None else {}
    return Case(name, scene, words=(mesh, *words), files=files)


def changed(lines, index, line):
    return joined(lines[:index] + [line] + lines[index + 1:])


def faulty_objs(points):
    lines = obj_lines(points)
    x, y, z = points[2]
    commas = f"v {x} {y} {z}".replace(".", ",")
    for name, content, words in (
            ("a decimal comma", changed(lines, 2, commas), ("line 3", str(x).replace(".", ","))),
            ("a vertex of two numbers", changed(lines, 5, "v 1 2"), ("line 6",)),
            ("a coordinate that is no number", changed(lines, 0, "v 1 nan 3"), ("line 1", "not finite")),
            ("a coordinate without end", changed(lines, 0, "v 1 inf 3"), ("line 1", "not finite")),
            ("a number of an old compiler", changed(lines, 0, "v 1.#QNAN 0 0"), ("line 1", "1.#QNAN")),
            ("a number in hexadecimal", changed(lines, 0, "v 1 0x10 0"), ("line 1", "0x10")),
            ("a coordinate beyond all measure", changed(lines, 0, "v 1 1e200 0"), ("line 1", "too large")),
            ("a face of a vertex that is not there", changed(lines, 9, "f 1 2 9"), ("line 10", "index 9")),
            ("a face of vertex 0", changed(lines, 9, "f 0 1 2"), ("line 10", "'0'")),
            ("a relative index too far back", changed(lines, 9, "f -9 -2 -1"), ("line 10", "-9")),
            ("a face of two corners", changed(lines, 9, "f 1 2"), ("line 10", "2 corners")),
            ("an index with a fraction", changed(lines, 9, "f 1 2.5 3"), ("line 10", "2.5")),
            ("a free-form surface", joined(lines + ["surf 0 1 0 1 1 2 3 4"]), ("line 21", "surf")),
            ("another file that is called", joined(lines + ["call more.obj"]), ("line 21", "call")),
            ("an unknown statement of three numbers", joined(["w 1 2 3"] + lines), ("line 1", "'w'")),
            ("no face", joined(lines[:8]), ("no triangles",))):
        yield f"OBJ, {name}", "part.obj", content, words


def faulty_stls(points):
    text = stl_text(points, TRIANGLES, "brick")
    broken = text.splitlines()
    sound = stl_binary(points, b"brick")
    for name, content, words in (
            ("text that ends in a facet", joined(broken[:24]), ("endsolid",)),
            ("text with a decimal comma", joined(broken[:4] + ["   vertex 0,5 0 1"] + broken[5:]), ("line 5", "0,5")),
            ("text with a vertex of two numbers", joined(broken[:4] + ["   vertex 5 0"] + broken[5:]), ("line 5",)),
            ("text with four vertices", joined(broken[:4] + ["   vertex 5 0 1"] + broken[4:]), ("line 7", "than 3")),
            ("binary, too short by a byte", sound[:-1], ("12 triangles", "684", "683")),
            ("binary, too short by triangles", sound[:-150], ("12 triangles", "534")),
            ("binary, more triangles than the count", stl_binary(points, b"brick", count=11), ("11 triangles", "684")),
            ("binary, a coordinate that is no number",
             sound[:96] + struct.pack("<f", float("nan")) + sound[100:], ("not finite",)),
            ("empty", b"", ("empty",))):
        yield f"STL, {name}", "part.stl", content, words


def faulty_plies(points):
    text = plain(points, "ascii").splitlines()
    text = [line.decode() for line in text]
    vertices = element("vertex", XYZ, points)
    sound = plain(points, "binary_little_endian")
    outside = ply("ascii", [vertices, faces_of([*TRIANGLES[:11], (0, 1, 8)])])
    other = ply("binary_big_endian", [vertices, faces_of(TRIANGLES[:6]),
                                      element("part", (("uchar", "int", "vertex_indices"),),
                                              [(t,) for t in TRIANGLES[6:]])])
    flat = ply("ascii", [element("vertex", XYZ[:2], [p[:2] for p in points]), faces_of(TRIANGLES)])
    short = joined(text[:12] + [text[12] + " 5"] + text[13:])
    for name, content, words in (
            ("faces of another element", other, ("part",)),
            ("an index that is not there", outside, ("line 29", "index 8")),
            ("no z", flat, ("x, y and z",)),
            ("a line with a number too many", short, ("line 13",)),
            ("a line with a number too few", joined(text[:12] + ["1 2"] + text[13:]), ("'vertex' 4",)),
            ("a face more than the header counts", joined(text + ["3 0 1 2"]), ("line 30", "more faces")),
            ("cut off", sound[:-5], ("the data end",)),
            ("no header's end", joined(text[:8]), ("header",)),
            ("an unknown type", joined(text).replace(b"uchar int", b"uchar long"), ("long",)),
            ("an unknown format", joined(text).replace(b"ascii", b"binary"), ("binary",))):
        yield f"PLY, {name}", "part.ply", content, words


def faulty_others(points):
    off = off_text(points)
    crossed = joined(["OFF", "4 1 0", "0 0 0", "1 1 0", "1 0 0", "0 1 0", "4 0 1 2 3"])
    for name, mesh, content, words in (
            ("OFF, binary", "part.off", off.replace(b"OFF", b"OFF BINARY", 1), ("binary",)),
            ("OFF, a face more than is counted", "part.off", off + b"3 0 1 2\n", ("line 17", "face")),
            ("OFF, an index that is not there", "part.off", off.replace(b"4 0 2 3 1", b"4 0 2 3 8"), ("line 11", "8")),
            ("OFF, cut off", "part.off", off[:-9], ("line 16", "indices")),
            ("OFF, a polygon that crosses itself", "part.off", crossed, ("line 7", "crosses")),
            ("COLLADA, cut off", "part.dae", dae(points, "")[:900], ("malformed",)),
            ("glTF, a buffer that is not there", "part.gltf", without_buffer(points), ("not_there.bin",)),
            ("a file that is not there", "part.obj", None, ("no such file",)),
            ("a suffix of nothing known", "part.sldprt", off, ("unknown kind",))):
        yield name, mesh, content, words


def without_buffer(points):
    tree = json.loads(gltf(points, [{"mesh": 0}]))
    tree["buffers"][0]["uri"] = "not_there.bin"
    return json.dumps(tree).encode()


def cases():
    low, high = drawn_brick(601)
    points = corners(low, high)
    for family in (faulty_objs, faulty_stls, faulty_plies, faulty_others):
        for name, mesh, content, words in family(points):
            yield refused(name, mesh, content, *words)
