# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""One brick in the dialects of STL, OBJ, PLY and OFF that readers have taken for another shape, or for none."""
import struct

from bricks import QUADS, TRIANGLES, brick_questions, corners, drawn_brick, number, text_of
from ply_dialects import ply_dialects


def obj_lines(points, faces=TRIANGLES, point="v {}", face="{}"):
    """Vertices and faces, each index written as the pattern says."""
    lines = [point.format(text_of(p)) for p in points]
    return lines + ["f " + " ".join(face.format(i + 1) for i in f) for f in faces]


def joined(lines, end="\n", encoding="utf-8"):
    return "".join(line + end for line in lines).encode(encoding)


def obj_relative(points):
    """Every triangle brings its own vertices, counted back from where it stands."""
    lines = []
    for t in TRIANGLES:
        lines += [f"v {text_of(points[c])}" for c in t] + ["f -3 -2 -1"]
    return joined(lines)


def obj_relative_after_later_vertices(points):
    """Indices count back from their own line: vertices that follow do not move them. Those that no face uses touch
    nothing."""
    first = [f"f {' '.join(str(c - 8) for c in t)}" for t in TRIANGLES[:5]]
    rest = [f"f {' '.join(str(c - 10) for c in t)}" for t in TRIANGLES[5:]]
    return joined([f"v {text_of(p)}" for p in points] + first + ["v 90 80 70", "v -55 4 3"] + rest)


def obj_continued(points, end):
    """Statements that go on in the next line, in the middle of vertices and of faces."""
    vertices = [f"v {number(x)} \\{end}\t{number(y)}  \\{end}{number(z)}" for x, y, z in points]
    faces = [f"f {a + 1}\\{end} {b + 1} \\{end} \\{end} {c + 1}" for a, b, c in TRIANGLES]
    return joined(vertices + faces, end)


def obj_weighted(points):
    """Homogeneous coordinates: the position is divided by the weight."""
    weights = [0.5, 1.0, 2.0, 4.0, 0.25, 1.0, 8.0, 2.0]
    lines = [f"v {text_of([w * x for x in p])} {number(w)}" for p, w in zip(points, weights)]
    return joined(lines + obj_lines([], TRIANGLES))


def obj_names(points):
    """Comments and names that end in a backslash do not swallow the vertex behind them."""
    lines = obj_lines(points)
    head = ["# drawn in C:\\frames\\", "mtllib C:\\colours\\all.mtl", "o D:\\bricks\\", "# the last one \\"]
    return joined(head + lines[:8] + ["usemtl paint\\blue\\", "g side\\"] + lines[8:])


def obj_dialects(points):
    """Name and content; what a note has to say comes last where there is one."""
    vertices = obj_lines(points, [])
    triangles = obj_lines([])
    yield "relative indices", obj_relative(points)
    yield "relative indices and later vertices", obj_relative_after_later_vertices(points)
    yield "continued lines", obj_continued(points, "\n")
    yield "continued lines with carriage returns", obj_continued(points, "\r\n")
    yield "carriage returns alone", joined(obj_lines(points), "\r")
    yield "coloured vertices", joined(obj_lines(points, point="v {} 0.25 0.75 1"))
    yield "weights", obj_weighted(points)
    yield "names that end in backslashes", obj_names(points)
    yield "texture indices of nothing", joined(vertices + ["vn 0 1 0"] + obj_lines([], face="{}/1"))
    yield "normals alone", joined(vertices + ["vn 0 0 1"] + obj_lines([], face="{}//1"))
    yield "all three indices", joined(vertices + ["vt 0 0", "vn 0 0 1"] + obj_lines([], face="{}/1/1"))
    head = ["# Maße der Schraubzwinge", "mtllib fehlt.mtl", "o Bügel"]
    yield "names in Latin-1", joined(head + obj_lines(points), encoding="latin-1")
    yield "points, lines, groups", joined(vertices + ["p 1 2", "l 3 4 5", "g upper lower", "s 1", "s off"] + triangles)
    yield "polygons", joined(obj_lines(points, QUADS))
    yield "faces of old", joined(vertices + [line.replace("f ", "fo ") for line in triangles])
    yield "a byte order mark", b"\xef\xbb\xbf" + joined(obj_lines(points))
    yield "signs, points and exponents", joined([f"v {with_exponents(p)}" for p in points] + triangles)
    yield "no line end at the end", joined(obj_lines(points))[:-1]
    yield "words that are no statement", joined(obj_lines(points) + ["made by hand"]), ("made",)


def with_exponents(point):
    return " ".join(f"{x:+.12E}" for x in point)


def stl_text(points, triangles, name, upper=False, point_text=text_of):
    lines = [f"solid {name}"]
    for t in triangles:
        lines += [" facet normal 0 0 0", "  outer loop"] + [f"   vertex {point_text(points[c])}" for c in t]
        lines += ["  endloop", " endfacet"]
    text = "\n".join(lines + [f"endsolid {name}"]) + "\n"
    return text.upper() if upper else text


def stl_binary(points, header, attribute=0, count=None, tail=b""):
    content = header.ljust(80, b" ")[:80] + struct.pack("<I", len(TRIANGLES) if count is None else count)
    for t in TRIANGLES:
        content += struct.pack("<12fH", 0, 0, 0, *(x for c in t for x in points[c]), attribute)
    return content + tail


def stl_dialects(points):
    """Name, content, the file's suffix, and what a note has to say."""
    text = stl_text(points, TRIANGLES, "brick")
    yield "a binary file that begins with solid", stl_binary(points, b"solid saved by a drawing program"), "stl", ()
    head = b"solid x\nfacet normal 0 0 1\nouter loop"
    yield "a binary file that begins like a text", stl_binary(points, head), "stl", ()
    yield "attributes that are colours", stl_binary(points, b"\0" * 80, attribute=0x8421), "STL", ()
    behind = stl_binary(points, b"brick", tail=b"\0\xff\x07")
    yield "bytes behind the last triangle", behind, "stl", ("behind the last triangle",)
    solids = ((TRIANGLES[:5], "one"), (TRIANGLES[5:9], "two words"), (TRIANGLES[9:], ""))
    yield "several solids", "".join(stl_text(points, *solid) for solid in solids).encode(), "stl", ()
    yield "capitals", stl_text(points, TRIANGLES, "brick", upper=True).encode(), "stl", ()
    long_name = stl_text(points, TRIANGLES, "n" * 900)
    yield "a name of 900 letters", long_name.encode(), "stl", ()
    yield "exponents", stl_text(points, TRIANGLES, "brick", point_text=with_exponents).encode(), "stl", ()
    yield "carriage returns", text.replace("\n", "\r\n").encode(), "Stl", ()
    yield "no spaces in front", "\n".join(line.strip() for line in text.splitlines()).encode(), "stl", ()
    yield "tabs and many spaces", text.replace("  ", "\t \t").replace("vertex ", "vertex\t   ").encode(), "stl", ()
    coloured = text.replace(" endfacet\n", " endfacet\n colour 1 2 3\n", 1)
    yield "words between facets", coloured.encode(), "stl", ("colour",)
    yield "normals that are not numbers", text.replace("normal 0 0 0", "normal nan nan nan").encode(), "stl", ()


def off_text(points, first="OFF", extra="", colour="", edges=0):
    lines = [first, f"{len(points)} {len(QUADS)} {edges}"] + [text_of(p) + extra for p in points]
    return joined(lines + [f"{len(q)} {' '.join(map(str, q))}{colour}" for q in QUADS])


def off_dialects(points):
    yield "quads", off_text(points)
    yield "colours of vertices", off_text(points, "COFF", " 10 20 30 255")
    yield "normals and colours of faces", off_text(points, "NOFF", " 0 0 1", " 0.1 0.2 0.3")
    yield "texture, colours and normals", off_text(points, "STCNOFF", " 0 0 1 1 0 0 1 0.5 0.5")
    yield "weights", off_text([[2 * x for x in p] for p in points], "4OFF", " 2")
    yield "comments and counts of edges", off_text(points, "OFF # of a brick\n# sizes:", edges=18)
    yield "words behind the last face", off_text(points) + b"made by hand\n", ("behind",)


def questions(kind, seed, dialects):
    """Name, content, suffix and notes of each dialect of one brick."""
    low, high = drawn_brick(seed)
    for index, (name, content, suffix, notes) in enumerate(dialects(corners(low, high))):
        mesh = f"brick.{suffix}"
        yield from brick_questions(f"{kind}, {name}", low, high, mesh, {mesh: content}, corner=index % 3 == 1,
                                   notes=notes)


def with_suffix(dialects, suffix):
    def four(points):
        for name, content, *notes in dialects(points):
            yield name, content, suffix, notes[0] if notes else ()
    return four


def cases():
    yield from questions("OBJ", 401, with_suffix(obj_dialects, "obj"))
    yield from questions("STL", 402, stl_dialects)
    yield from questions("PLY", 403, with_suffix(ply_dialects, "ply"))
    yield from questions("OFF", 404, with_suffix(off_dialects, "off"))
