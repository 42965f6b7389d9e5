"""Certificates made from scratch, of scenes whose probability of contact is known in closed form."""
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
import json
import math

IDENTITY = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
BOX_FACES = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
             [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]


def box_part(obj, lo, hi, convex=True, solid=False, translation=(0, 0, 0)):
    """A box; vertex i has its upper side along the axes whose bits i has."""
    vertices = [[(hi if i >> k & 1 else lo)[k] for k in range(3)] for i in range(8)]
    return {"part": obj, "rotation": IDENTITY, "translation": list(translation), "vertices": vertices,
            "triangles": [list(t) for t in BOX_FACES], "convex": convex, "solid": solid}


def mesh_part(obj, vertices, triangles, solid=False, convex=False):
    return {"part": obj, "rotation": IDENTITY, "translation": [0, 0, 0], "vertices": vertices,
            "triangles": triangles, "convex": convex, "solid": solid}


def header(rank=3, mean=(0, 0, 0), deviations=(1, 1, 1), contact="surface", axes=None, whitening=None):
    return {"fcl_prob_certificate": 1, "contact": contact, "mean": list(mean),
            "axes": [list(a) for a in (axes or IDENTITY)][:rank], "deviations": list(deviations)[:rank],
            "whitening": whitening}


def interval_mass(lo, hi):
    if lo > 0:
        return interval_mass(-hi, -lo)
    if hi <= 0:
        return 0.5 * (math.erfc(-hi / math.sqrt(2)) - math.erfc(-lo / math.sqrt(2)))
    return 0.5 * (math.erf(hi / math.sqrt(2)) - math.erf(lo / math.sqrt(2)))


def box_mass(lo, hi):
    return math.prod(interval_mass(a, b) for a, b in zip(lo, hi))


def split_cells(lo, hi, depth, judge):
    """Cells of a k-d tree over the box; judge(lo, hi, last) is what to claim, or None to split on."""
    claim = judge(lo, hi, depth == 0)
    if claim is not None:
        return [{"cell": list(lo) + list(hi), **claim}]
    axis = max(range(len(lo)), key=lambda i: hi[i] - lo[i])
    middle = 0.5 * (lo[axis] + hi[axis])
    low, high = list(lo), list(hi)
    low[axis] = high[axis] = middle
    return split_cells(lo, high, depth - 1, judge) + split_cells(low, hi, depth - 1, judge)


def judge_box(inner_lo, inner_hi, witness=None, with_planes=False):
    """Contact in a box of displacements, and nowhere else."""
    witness = witness or {"pair": [0, 0]}

    def judge(lo, hi, last):
        rank = len(lo)
        if all(a >= c and b <= d for a, b, c, d in zip(lo, hi, inner_lo, inner_hi)):
            return {"contact": [{"planes": [], "by": witness}]}
        if any(b <= c or a >= d for a, b, c, d in zip(lo, hi, inner_lo, inner_hi)):
            return {"free": True}
        if not last:
            return None
        if not with_planes:
            return {}
        planes = []
        for i in range(rank):
            unit = [1.0 if k == i else 0.0 for k in range(rank)]
            if lo[i] < inner_lo[i]:
                planes.append(unit + [inner_lo[i]])
            if hi[i] > inner_hi[i]:
                planes.append([-u for u in unit] + [-inner_hi[i]])
        return {"free": planes, "contact": [{"planes": planes, "by": witness}]}

    return judge


def write(path, head, parts, cells, lower, upper, caps=()):
    lines = [head, *parts, *caps, *cells, {"lower": lower, "upper": upper, "cells": len(cells)}]
    with open(path, "w") as file:
        for line in lines:
            file.write(json.dumps(line) + "\n")


def sphere(radius, center, level):
    """Vertices on a sphere and triangles, an octahedron divided `level` times; normals outwards."""
    vertices = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(level):
        middles, finer = {}, []

        def middle(i, j):
            key = (min(i, j), max(i, j))
            if key not in middles:
                point = [a + b for a, b in zip(vertices[i], vertices[j])]
                length = math.sqrt(sum(x * x for x in point))
                middles[key] = len(vertices)
                vertices.append(tuple(x / length for x in point))
            return middles[key]

        for i, j, k in faces:
            a, b, c = middle(i, j), middle(j, k), middle(k, i)
            finer += [(i, a, c), (a, j, b), (c, b, k), (a, b, c)]
        faces = finer
    return ([[c + radius * x for c, x in zip(center, v)] for v in vertices], [list(f) for f in faces])


def judge_spheres(a, b, radius_a, radius_b, inner_b, center_a, center_b, deviations, solid):
    """Contact of two meshes of spheres, `a` and `b` their vertices: claims what is plain to see."""
    def judge(lo, hi, last):
        rank = len(lo)
        shifts = [[center_a[i] - center_b[i] + deviations[i] * y[i] if i < rank else
                   center_a[i] - center_b[i] for i in range(3)]
                  for y in ([(hi if c >> k & 1 else lo)[k] for k in range(rank)] for c in range(1 << rank))]
        # The nearest point of the cell to where the centers coincide.
        near = [min(max(0, min(s[i] for s in shifts)), max(s[i] for s in shifts)) for i in range(3)]
        if math.sqrt(sum(x * x for x in near)) > (radius_a + radius_b) * (1 + 1e-9):
            return {"free": True}

        def distance(v, shift):
            return math.sqrt(sum((v[i] - center_a[i] + shift[i]) ** 2 for i in range(3)))
        middle = [sum(s[i] for s in shifts) / len(shifts) for i in range(3)]
        inside = min(range(len(a)), key=lambda v: distance(a[v], middle))
        if max(distance(a[inside], s) for s in shifts) < inner_b * (1 - 1e-9):
            if solid:
                return {"contact": [{"planes": [], "by": {"inside": "A", "vertex": inside}}]}
            outside = max(range(len(a)), key=lambda v: distance(a[v], middle))
            # On the far side of a plane that touches the sphere of B, everywhere in the cell.
            length = distance(a[outside], middle)
            normal = [(a[outside][i] - center_a[i] + middle[i]) / length for i in range(3)]
            if all(sum(n * (a[outside][i] - center_a[i] + s[i]) for i, n in enumerate(normal)) >
                   radius_b * (1 + 1e-9) for s in shifts):
                return {"contact": [{"planes": [], "by": {"inside": "A", "vertex": inside,
                                                          "outside": outside}}]}
        return {} if last else None
    return judge


def swept_part(obj, vertices, radius, triangles=(), translation=(0, 0, 0)):
    """The hull of the vertices swept by a ball."""
    return {"part": obj, "rotation": IDENTITY, "translation": list(translation),
            "vertices": [list(v) for v in vertices], "triangles": [list(t) for t in triangles], "convex": True,
            "solid": False, "radius": radius}


def distance_to_hull(points):
    """Of 0 from the hull of points, by Frank and Wolfe's steps towards the lowest of them and away from the highest:
    bounds from below and above."""
    weights = [1.0 / len(points)] * len(points)

    def dot(a, b):
        return sum(x * y for x, y in zip(a, b))
    for _ in range(300):
        at = [sum(w * p[i] for w, p in zip(weights, points)) for i in range(3)]
        heights = [dot(at, p) for p in points]
        low = min(range(len(points)), key=lambda i: heights[i])
        used = [i for i in range(len(points)) if weights[i] > 0]
        high = max(used, key=lambda i: heights[i])
        length = math.sqrt(dot(at, at))
        if length == 0 or dot(at, at) - heights[low] < 1e-4 * length * length:
            break
        along = [a - b for a, b in zip(points[low], points[high])]
        step = min(weights[high], max(0.0, -dot(at, along) / max(dot(along, along), 1e-300)))
        weights[low] += step
        weights[high] -= step
    return (max(0.0, heights[low] / length) if length > 0 else 0.0), length


def judge_swept(core_a, core_b, radius, deviations):
    """Contact of two cores of which one is swept by a ball of this radius: whole cells only."""
    def judge(lo, hi, last):
        corners = [[deviations[k] * (hi if c >> k & 1 else lo)[k] if k < len(lo) else 0.0 for k in range(3)]
                   for c in range(1 << len(lo))]
        difference = [[x - y for x, y in zip(b, a)] for a in core_a for b in core_b]
        if all(distance_to_hull([[x - y for x, y in zip(d, c)] for d in difference])[1] < radius * (1 - 1e-6)
               for c in corners):
            return {"contact": [{"planes": [], "by": {"pair": [0, 0]}}]}
        if distance_to_hull([[x - y for x, y in zip(d, c)] for d in difference for c in corners])[0] > (
                radius * (1 + 1e-6)):
            return {"free": True}
        return {} if last else None
    return judge
