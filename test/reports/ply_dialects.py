# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""PLY files of a brick: byte orders, types of counts, line ends before binary data, other properties, strips."""
import struct

from bricks import QUADS, TRIANGLES, number

LETTERS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d",
           "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "float32": "f",
           "float64": "d"}
FORMATS = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}
XYZ = (("float", "x"), ("float", "y"), ("float", "z"))


def element(name, properties, rows):
    """An element: its properties as (type, name) or (count type, type, name), and a row of values each; the value of a
    list is a tuple."""
    return name, properties, rows


def header_line(prop):
    return f"property list {' '.join(prop)}" if len(prop) == 3 else f"property {' '.join(prop)}"


def header(form, elements, extra=()):
    lines = ["ply", f"format {form} 1.0", *extra]
    for name, properties, rows in elements:
        lines += [f"element {name} {len(rows)}"] + [header_line(p) for p in properties]
    return lines + ["end_header"]


def written(form, kind, value):
    """One number in text or in binary."""
    order = FORMATS[form]
    if order:
        return struct.pack(order + LETTERS[kind], value)
    return (number(value) if LETTERS[kind] in "fd" else str(value)).encode() + b" "


def row_of(form, properties, row):
    content = b""
    for prop, value in zip(properties, row):
        if len(prop) == 3:
            content += written(form, prop[0], len(value))
        for v in value if len(prop) == 3 else (value,):
            content += written(form, prop[-2], v)
    return content if FORMATS[form] else content.rstrip() + b"\n"


def ply(form, elements, end="\n", extra=()):
    content = "".join(line + end for line in header(form, elements, extra)).encode()
    return content + b"".join(row_of(form, properties, row) for _, properties, rows in elements for row in rows)


def faces_of(polygons, count="uchar", index="int", name="vertex_indices"):
    return element("face", ((count, index, name),), [(tuple(p),) for p in polygons])


def plain(points, form, kind="float", **lists):
    vertices = element("vertex", tuple((kind, axis) for axis in "xyz"), points)
    return ply(form, [vertices, faces_of(TRIANGLES, **lists)])


def with_extras(points, form):
    """Colours, texture of faces, and elements in front, between and behind that say nothing of the shape."""
    camera = element("camera", (("float", "view_px"), ("uchar", "float", "view")), [(1.5, (0.5, 2.0)), (7.0, ())])
    vertices = element("vertex", (("uchar", "red"), *XYZ, ("float", "quality")),
                       [(10 + i, *p, 0.5) for i, p in enumerate(points)])
    material = element("material", (("int", "vertex"), ("short", "ushort", "list")), [(3, (1, 2, 3, 4))])
    properties = (("uchar", "float", "texcoord"), ("ushort", "flags"), ("uchar", "int", "vertex_index"))
    faces = element("face", properties, [((0.25,) * (i % 3), i, t) for i, t in enumerate(TRIANGLES)])
    edges = element("edge", (("int", "vertex1"), ("int", "vertex2")), [(0, 1), (5, 3)])
    notes = ("comment element face 9", "obj_info end_header")
    return ply(form, [camera, vertices, material, faces, edges], extra=notes)


def other_order(points, form):
    """z, y and x in that order and of other types, among others."""
    properties = (("double", "z"), ("float", "nx"), ("float", "y"), ("uchar", "alpha"), ("double", "x"))
    vertices = element("vertex", properties, [(z, 0.5, y, 9, x) for x, y, z in points])
    return ply(form, [vertices, faces_of(QUADS, "int", "short")])


def strips(points, form, lists=1):
    """Strips of triangles, each second one the other way round, ended by −1: a band around the brick and its two
    ends, in one list or in several."""
    around = (0, 4, 1, 5, 3, 7, 2, 6, 0, 4)
    ends = ((0, 1, 2, 3), (4, 6, 5, 7))
    pieces = [around, *ends]
    if lists == 1:
        pieces = [sum((tuple(p) + (-1,) for p in pieces), ())[:-1]]
    rows = [(tuple(p),) for p in pieces]
    return ply(form, [element("vertex", XYZ, points),
                      element("tristrips", (("int", "int", "vertex_indices"),), rows)])


def faces_in_front(points, form):
    """Faces before the vertices that they are made of."""
    return ply(form, [faces_of(TRIANGLES), element("vertex", XYZ, points)])


def ply_dialects(points):
    little, big = "binary_little_endian", "binary_big_endian"
    vertices = element("vertex", XYZ, points)
    for end, name in (("\r\n", "carriage returns and line feeds"), ("\r", "carriage returns")):
        yield f"little endian behind a header of {name}", ply(little, [vertices, faces_of(TRIANGLES)], end)
    yield "big endian behind a header of both", ply(big, [vertices, faces_of(QUADS, "uint8", "uint16")], "\r\n")
    yield "counts of two bytes", plain(points, little, count="ushort", index="uint")
    yield "counts of four bytes, doubles, big endian", plain(points, big, "double", count="uint", index="int")
    yield "signed counts, indices of a byte", plain(points, little, count="char", index="uchar")
    yield "names of types with sizes", plain(points, big, "float64", count="uint8", index="int32")
    yield "text of floats", plain(points, "ascii")
    for form in FORMATS:
        yield f"other properties and elements, {form}", with_extras(points, form)
    yield "z, y, x", other_order(points, "ascii")
    yield "z, y, x, big endian", other_order(points, big)
    yield "strips", strips(points, little)
    yield "strips, big endian", strips(points, big)
    yield "strips of text, a list each", strips(points, "ascii", lists=3)
    yield "faces in front of vertices", faces_in_front(points, little)
    yield "words behind the last face", plain(points, "ascii") + b"made by hand\n", ("behind",)
