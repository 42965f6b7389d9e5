# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""A brick as a mesh, and the questions that show whether a file was read as that brick."""
import random

from checks import Case
from truth import below, shell_mass, unit

# Corner i is at the high end of x, y or z where bit 0, 1 or 2 of i is set; loops run counter-clockwise from outside.
QUADS = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (3, 2, 6, 7), (0, 4, 6, 2), (1, 3, 7, 5))
TRIANGLES = tuple(t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d)))


def corners(low, high):
    return [tuple(high[k] if i >> k & 1 else low[k] for k in range(3)) for i in range(8)]


def drawn_brick(seed):
    """Low and high corner in 64ths of a metre, which are exact in every format."""
    draw = random.Random(seed)
    low = [-draw.randrange(20, 90) / 64 for _ in range(3)]
    return low, [draw.randrange(25, 120) / 64 for _ in range(3)]


def number(x):
    """A decimal that is the same double again."""
    return repr(float(x))


def text_of(point, separator=" "):
    return separator.join(number(x) for x in point)


def obj(low, high, first=1):
    lines = [f"v {text_of(p)}" for p in corners(low, high)]
    lines += ["f " + " ".join(str(first + i) for i in t) for t in TRIANGLES]
    return "\n".join(lines) + "\n"


def shell_question(name, bricks, mesh, files, place, half, sigmas, **options):
    """A block that moves in three dimensions beside the surfaces of bricks, far enough from each other that it
    touches one at most: P has a part of every triangle, so a lost or moved one shows."""
    p = sum(shell_mass(low, high, half, place, sigmas) for low, high in bricks)
    scene = {"a": {"box": [2 * h for h in half], "pose": list(place)}, "b": {"mesh": mesh},
             "displacement": {"sigma": list(sigmas)}, "request": {"relative_tolerance": 1e-3}}
    return Case(name, scene, (p,), files=files, **{"width": 1e-3, "narrow": 1e-6, **options})


def corner_question(name, low, high, mesh, files, normal, **options):
    """A half-space beyond the corner that is farthest along the normal: its place counts to the last digit."""
    normal = unit(normal)
    reach = sum(n * (h if n > 0 else l) for n, l, h in zip(normal, low, high))
    sigma = 0.05
    scene = {"a": {"mesh": mesh}, "displacement": {"sigma": [sigma] * 3},
             "b": {"halfspace": {"normal": [-n for n in normal], "offset": -reach - 1.25 * sigma}},
             "request": {"absolute_tolerance": 1e-12}}
    return Case(name, scene, (below(-1.25),), files=files, **options)


def brick_questions(name, low, high, mesh, files, corner=True, **options):
    """One or two cases for one file that should be the brick: each triangle counts in the first."""
    draw = random.Random(name)
    size = [h - l for l, h in zip(low, high)]
    half = [draw.uniform(0.05, 0.15) * s for s in size]
    place = [l + draw.uniform(0.2, 0.8) * s for l, s in zip(low, size)]
    sigmas = [draw.uniform(0.4, 0.6) * s for s in size]
    yield shell_question(f"{name}: its surface", [(low, high)], mesh, files, place, half, sigmas, **options)
    normal = [draw.choice((-1, 1)) * draw.uniform(0.3, 1) for _ in range(3)]
    if corner:
        yield corner_question(f"{name}: a corner", low, high, mesh, files, normal, **options)
