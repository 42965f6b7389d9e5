# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""OctoMap files: cells at the right place, what is unknown, and files that end too soon."""
import struct

from checks import Case
from truth import below, box_around_mass, plus

DEPTH, MIDDLE = 16, 1 << 15
FREE, OCCUPIED, INNER = 1, 2, 3


def tree_of(cells):
    """Nested children by index, of cells given by their keys and states."""
    root = {}
    for key, state in cells.items():
        node = root
        for level in reversed(range(DEPTH)):
            child = sum(((key[k] + MIDDLE) >> level & 1) << k for k in range(3))
            node = node.setdefault(child, state if level == 0 else {})
    return root


def written(node):
    """Two bits a child, then the children that have some themselves."""
    bits = 0
    for child, below_it in node.items():
        bits |= (INNER if isinstance(below_it, dict) else below_it) << (2 * child)
    content = struct.pack("<H", bits)
    return content + b"".join(written(node[c]) for c in sorted(node) if isinstance(node[c], dict))


def nodes_of(node):
    return 1 + sum(nodes_of(c) if isinstance(c, dict) else 1 for c in node.values())


def octomap(cells, resolution):
    tree = tree_of(cells)
    head = f"# Octomap OcTree binary file\nid OcTree\nsize {nodes_of(tree)}\nres {resolution}\ndata\n"
    return head.encode() + written(tree)


def single_cells():
    """One occupied cell on either side of the origin, beside a free one, and a box with errors in all axes."""
    resolution, size, sigma = 0.25, [0.3, 0.2, 0.5], [0.2, 0.3, 0.25]
    for key in ((0, 0, 0), (-1, 2, -3), (9, -7, 4)):
        content = octomap({key: OCCUPIED, (key[0] + 1, key[1], key[2]): FREE}, resolution)
        middle = [resolution * (k + 0.5) for k in key]
        offset = [0.17, -0.22, 0.31]
        p = box_around_mass(plus(size, [resolution] * 3), offset, sigma)
        scene = {"a": {"box": size, "pose": plus(middle, offset)}, "b": {"octomap": "map.bt", "band": [0]},
                 "displacement": {"sigma": sigma}, "request": {"relative_tolerance": 1e-3}}
        yield Case(f"one cell at {key}", scene, (p,), files={"map.bt": content}, width=1e-3, narrow=1e-6)


def floors():
    """A floor of cells, and a ball above it: the band of a map is its resolution, unless the scene has another."""
    resolution, radius, sigma, height = 0.125, 0.5, 0.05, 0.08
    cells = {(i, j, -1): OCCUPIED for i in range(-8, 8) for j in range(-8, 8)}
    files = {"floor.bt": octomap(cells, resolution)}
    # In the middle of a cell, so that the nearest point is not on an edge.
    pose = [0.5 * resolution, 0.5 * resolution, radius + height]
    inwards = 3 ** 0.5 * resolution
    for name, band, values in (
            ("without a band", [0], (below(-height / sigma),)),
            ("with the band of the map", None, (below(-(height + inwards) / sigma),
                                                below((resolution - height) / sigma)))):
        ball = {"sphere": radius, "pose": pose}
        floor = {"octomap": "floor.bt", **({"band": band} if band else {})}
        scene = {"a": ball, "b": floor, "displacement": {"sigma": [0, 0, sigma]}}
        yield Case(f"a floor of cells {name}", scene, values, files=files, width=0.01, narrow=1e-6)


def refusals():
    content = octomap({(1, 2, 3): OCCUPIED}, 0.25)
    scene = {"a": {"sphere": 0.5}, "b": {"octomap": "map.bt"}, "displacement": {"sigma": [0.1] * 3}}
    for name, faulty, words in (
            ("cut off", content[:-3], ("data end",)),
            ("of another kind", content.replace(b"OcTree\n", b"Grid\n"), ("id is not OcTree",)),
            ("without resolution", content.replace(b"res 0.25\n", b""), ("no resolution",)),
            ("empty", b"", ("not an OctoMap",))):
        yield Case(f"a map, {name}", scene, words=("map.bt", *words), files={"map.bt": faulty})


def cases():
    for family in (single_cells, floors, refusals):
        yield from family()
