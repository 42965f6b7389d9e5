# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""COLLADA and glTF: units, up axes, the transforms of nodes, and mirrored ones, which turn the winding round."""
import base64
import json
import math
import struct

from bricks import TRIANGLES, brick_questions, corners, drawn_brick, number, obj
from checks import Case
from truth import plus

# Both come through single precision; P is smooth enough for five digits.
SINGLE = {"slack": 1e-5}


def numbers(points):
    return " ".join(number(x) for p in points for x in p)


def dae(points, asset, transforms="", inner=None):
    """A document with one mesh; the node that has it may hang on another with its own transforms."""
    indices = " ".join(str(c) for t in TRIANGLES for c in t)
    node = f'<node id="n"><!-- placed -->{transforms}<instance_geometry url="#shape"/></node>'
    if inner is not None:
        child = f'<node id="c">{inner}<instance_geometry url="#shape"/></node>'
        node = f'<node id="n">{transforms}{child}</node>'
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>{asset}</asset>
<library_geometries><geometry id="shape"><mesh>
<source id="at"><float_array id="at-array" count="24">{numbers(points)}</float_array>
<technique_common><accessor source="#at-array" count="8" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="corners"><input semantic="POSITION" source="#at"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#corners" offset="0"/><p>{indices}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="all">{node}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#all"/></scene></COLLADA>
""".encode()


def unit_of(name, metres):
    return f'<unit name="{name}" meter="{metres}"/>'


def dae_of_unit(points, name, metres, up="<up_axis>Z_UP</up_axis>"):
    return dae([[x / metres for x in p] for p in points], unit_of(name, metres) + up)


def quarter_back(points):
    """Where corners are before a quarter turn about z: x' = -y, y' = x."""
    return [(y, -x, z) for x, y, z in points]


def dae_dialects(points):
    metres = unit_of("meter", 1)
    for name, size in (("millimetres", 0.001), ("centimetres", 0.01), ("feet", 0.3048), ("inches", 0.0254),
                       ("kilometres", 1000.0)):
        yield name, dae_of_unit(points, name, size)
    # The axes stay those of the file, whatever is said to be up.
    for up in ("X_UP", "Y_UP"):
        yield up, dae(points, f"{metres}<up_axis>{up}</up_axis>")
    yield "neither unit nor axis", dae(points, "")
    yield "an axis alone", dae(points, "<up_axis>Z_UP</up_axis>")
    mirrored = [(x, -y, z) for x, y, z in points]
    yield "a mirrored node", dae(mirrored, metres, "<scale>1 -1 1</scale>")
    moved = [plus(p, (2.0, -1.0, 0.5)) for p in points]
    yield "a moved node", dae(moved, metres, "<translate>-2 1 -0.5</translate>")
    yield "a turned and stretched node", dae([(0.5 * x, y, 4 * z) for x, y, z in quarter_back(points)], metres,
                                             "<rotate>0 0 1 90</rotate><scale>2 1 0.25</scale>")
    below = [plus(p, (0.0, 0.0, 3.0)) for p in quarter_back(points)]
    yield "a node on another", dae(below, metres, "<rotate>0 0 1 90</rotate>", "<translate>0 0 -3</translate>")
    yield "a matrix", dae(moved, metres, "<matrix>1 0 0 -2  0 1 0 1  0 0 1 -0.5  0 0 0 1</matrix>")


def buffer_of(points):
    data = b"".join(struct.pack("<3f", *p) for p in points)
    return data + b"".join(struct.pack("<3H", *t) for t in TRIANGLES)


def gltf_tree(points, nodes, buffer):
    columns = list(zip(*points))
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
                       "min": [min(c) for c in columns], "max": [max(c) for c in columns]},
                      {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96},
                        {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "buffers": [buffer]}


def gltf(points, nodes):
    data = buffer_of(points)
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(gltf_tree(points, nodes, {"byteLength": len(data), "uri": uri})).encode()


def glb(points, nodes):
    """The binary form: a header, a chunk of JSON and one of data, each a multiple of four bytes."""
    data = buffer_of(points)
    tree = json.dumps(gltf_tree(points, nodes, {"byteLength": len(data)})).encode()
    tree += b" " * (-len(tree) % 4)
    chunks = struct.pack("<I4s", len(tree), b"JSON") + tree + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def gltf_dialects(points):
    quarter = [0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)]
    small = [(0.5 * x, 0.25 * y, 2 * z) for x, y, z in points]
    yield "as it is", gltf(points, [{"mesh": 0}])
    yield "scaled", gltf(small, [{"mesh": 0, "scale": [2, 4, 0.5]}])
    yield "turned", gltf(quarter_back(points), [{"mesh": 0, "rotation": quarter}])
    yield "mirrored", gltf([(-x, y, z) for x, y, z in points], [{"mesh": 0, "scale": [-1, 1, 1]}])
    below = [plus((0.5 * x, 0.5 * y, 0.5 * z), (0.0, 1.0, 0.0)) for x, y, z in quarter_back(points)]
    yield "on three nodes", gltf(below, [{"children": [1], "rotation": quarter},
                                         {"children": [2], "scale": [2, 2, 2]},
                                         {"mesh": 0, "translation": [0, -1, 0]}])
    matrix = [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.25, -0.75, 1.5, 1]  # column by column
    moved = quarter_back([plus(p, (-0.25, 0.75, -1.5)) for p in points])
    yield "by a matrix", gltf(moved, [{"mesh": 0, "matrix": matrix}])


def solids():
    """A small mesh within a mirrored one: the mirrored one has to be a solid still, with its outside out."""
    low, high = drawn_brick(501)
    flipped = [(-x, y, z) for x, y, z in corners(low, high)]
    documents = {"mirrored.gltf": gltf(flipped, [{"mesh": 0, "scale": [-1, 1, 1]}]),
                 "turned.gltf": gltf(quarter_back(corners(low, high)), [
                     {"mesh": 0, "rotation": [0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)]}]),
                 "mirrored.dae": dae(flipped, "", "<scale>-1 1 1</scale>")}
    middle = [0.5 * (l + h) for l, h in zip(low, high)]
    for mesh, content in documents.items():
        files = {mesh: content, "small.obj": obj([-0.015] * 3, [0.015] * 3).encode()}
        for contact, p in (("solid", 1.0), ("fcl", 0.0)):
            scene = {"a": {"mesh": "small.obj", "pose": middle}, "b": {"mesh": mesh},
                     "displacement": {"sigma": [0.002] * 3}, "request": {"contact": contact}}
            yield Case(f"within {mesh}, {contact}", scene, (p,), files=files, **SINGLE)


def cases():
    low, high = drawn_brick(502)
    for kind, dialects, suffix in (("COLLADA", dae_dialects, "dae"), ("glTF", gltf_dialects, "gltf")):
        for index, (name, content) in enumerate(dialects(corners(low, high))):
            mesh = f"brick.{suffix}"
            yield from brick_questions(f"{kind}, {name}", low, high, mesh, {mesh: content}, corner=index % 3 == 1,
                                       **SINGLE)
    content = glb(corners(low, high), [{"mesh": 0}])
    yield from brick_questions("glTF, binary", low, high, "brick.glb", {"brick.glb": content}, **SINGLE)
    yield from solids()
