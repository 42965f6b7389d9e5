#!/usr/bin/env python3
"""A second, small checker of certificates (FORMAT.md), in exact fractions and nothing but Python.

Usage: verify.py FILE [PAIRS]. Checks the cheapest kinds of claims: cells that do not overlap, pairs that touch, and
free sets by all pairs of pieces, where there are at most PAIRS (400). What it does not check it says, and takes for
not claimed in the bounds that it prints. Masses are those of boxes only, by math.erf and erfc with a slack of 1e-13
of each. Exit codes: 0 nothing is wrong, 1 a claim fails, 2 malformed.
"""
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
import collections
import itertools
import json
import math
import operator
import sys
from fractions import Fraction

SLACK, IDENTITY = 1e-13, [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


class Refused(Exception):
    """A claim that fails."""


def exact(v):
    return list(map(Fraction, v))


def dot(a, b):
    return sum(map(operator.mul, a, b))


def minus(a, b):
    return list(map(operator.sub, a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def root(x):
    """The square root, or None where it is no fraction."""
    result = Fraction(math.isqrt(x.numerator), math.isqrt(x.denominator))
    return result if result * result == x else None


def solve(rows, right):
    """The solution of a linear system, by Cramer's rule; None if there is not just one."""
    def det(m):
        return sum((-1) ** i * m[0][i] * det([r[:i] + r[i + 1:] for r in m[1:]]) for i in range(len(m))) if m else 1
    whole = det(rows)
    if whole == 0:
        return None
    return [det([r[:i] + [b] + r[i + 1:] for r, b in zip(rows, right)]) / whole for i in range(len(rows))]


class Scene:
    """Pieces in the world, as (vertices, faces), and the displacement `mean + Σ columns_i y_i`."""

    def __init__(self, head):
        self.solid = head["contact"] == "solid"
        self.mean, self.rank = exact(head["mean"]), len(head["axes"])
        self.pieces, self.solids = {"A": [], "B": []}, 0
        scaled = [[Fraction(d) * x for x in exact(a)] for a, d in zip(head["axes"], head["deviations"])]
        self.columns, rows = scaled, []
        for whitening in head["whitening"] or []:
            row = [dot(exact(whitening), s) for s in scaled]
            for before in rows:
                row = minus(row, [dot(row, before) * x for x in before])
            length = root(dot(row, row))
            if not length:  # a frame that is not rational: nothing of it is checked
                self.columns = None
                return
            rows.append([x / length for x in row])
        if rows:
            self.columns = [[sum(r[j] * scaled[j][k] for j in range(self.rank)) for k in range(3)] for r in rows]

    def add(self, part):
        rotation, translation = [exact(r) for r in part["rotation"]], exact(part["translation"])
        points = [[dot(r, v) + t for r, t in zip(rotation, translation)] for v in map(exact, part["vertices"])]
        faces = [[points[i] for i in t if i >= 0] for t in part["triangles"]]
        if part.get("radius"):
            raise ValueError("what is swept by a ball is not for this checker")
        if part["convex"]:
            edges = collections.Counter((t[i - 1], t[i]) for t in part["triangles"] for i in range(3))
            heights = [dot(cross(minus(f[1], f[0]), minus(f[2], f[0])), minus(p, f[0])) for f in faces for p in points]
            if any(edges[a, b] != edges[b, a] for a, b in list(edges)) or max(heights) > 0 or min(heights) == 0:
                raise ValueError("a convex part is not the hull that it is said to be")
            self.pieces[part["part"]].append((points, faces))
        else:
            self.solids += part["solid"]
            self.pieces[part["part"]] += [(face, [face]) for face in faces]

    def displacement(self, y):
        return [m + sum(c[k] * t for c, t in zip(self.columns, y)) for k, m in enumerate(self.mean)]


def region_corners(lo, hi, planes):
    """Corners of the box cut by half-spaces `m·y >= s`; none if it has no inside."""
    rank = len(lo)
    if rank == 0:
        return [[]]
    unit = [[Fraction(int(i == k)) for k in range(rank)] for i in range(rank)]
    sides = [(u, l) for u, l in zip(unit, lo)] + [([-x for x in u], -h) for u, h in zip(unit, hi)]
    sides += [(exact(p[:-1]), Fraction(p[-1])) for p in planes]
    met = (solve(*map(list, zip(*chosen))) for chosen in itertools.combinations(sides, rank))
    corners = [y for y in met if y is not None and all(dot(n, y) >= s for n, s in sides)]
    return [] if any(all(dot(n, y) == s for y in corners) for n, s in sides) else corners


def edges_of(faces):
    return [minus(f[i], f[i - 1]) for f in faces for i in range(3)]


def normals_of_difference(k, l):
    """Normals of the faces of L - K, among others."""
    for face in k[1] + l[1]:
        yield cross(minus(face[1], face[0]), minus(face[2], face[0]))
    for e in edges_of(k[1]):
        for f in edges_of(l[1]):
            yield cross(e, f)


def ranges(n, k, l, moved):
    """What n says of `L - K` and of the displacements: least and most of each."""
    of_k, of_l, of_q = ([dot(n, v) for v in points] for points in (k[0], l[0], moved))
    return min(of_l) - max(of_k), max(of_l) - min(of_k), min(of_q), max(of_q)


def separated(scene, k, l, moved):
    def by(n):
        least, most, low, high = ranges(n, k, l, moved)
        varies = any(dot(n, c) != 0 for c in scene.columns)
        return least > high or most < low or (varies and (least >= high or most <= low))
    of_region = [minus(a, b) for a, b in itertools.combinations(moved, 2)]
    edges = itertools.chain(itertools.product(edges_of(k[1] + l[1]), of_region), itertools.combinations(of_region, 2))
    return any(map(by, itertools.chain(IDENTITY, normals_of_difference(k, l), itertools.starmap(cross, edges))))


def touches_throughout(k, l, moved):
    edges = edges_of(k[1] + l[1])
    if all(dot(a, cross(b, c)) == 0 for a, b, c in itertools.combinations(edges, 3)):
        return False
    said = (ranges(n, k, l, moved) for n in normals_of_difference(k, l))
    return all(least <= low and high <= most for least, most, low, high in said)


def box_mass(lo, hi):
    result = 1.0
    for a, b in zip(lo, hi):
        a, b = (-b, -a) if a > 0 else (a, b)
        a, b = float(a) / math.sqrt(2), float(b) / math.sqrt(2)
        result *= (math.erfc(-b) - math.erfc(-a) if b <= 0 else math.erf(b) - math.erf(a)) / 2
    return result


class Checker:
    def __init__(self, scene, most_pairs):
        self.scene, self.most_pairs = scene, most_pairs
        self.checked, self.unchecked = collections.Counter(), collections.Counter()
        self.lower, self.upper, self.boxes = 0.0, 1.0, []

    def free(self, lo, hi, planes):
        """Whether it was checked that nothing touches in the set; raises Refused if something may."""
        scene = self.scene
        pairs = math.prod(map(len, scene.pieces.values()))
        if scene.columns is None or pairs > self.most_pairs or (scene.solid and scene.solids):
            self.unchecked["free"] += 1
            return False
        moved = [scene.displacement(y) for y in region_corners(lo, hi, planes)]
        if moved and not all(separated(scene, k, l, moved) for k in scene.pieces["A"] for l in scene.pieces["B"]):
            raise Refused("pieces may touch in a free set")
        self.checked["free"] += 1
        return True

    def contact(self, lo, hi, region):
        by = region["by"]
        if "pair" not in by or self.scene.columns is None:
            self.unchecked["contact by " + next(iter(by))] += 1
            return 0.0
        if min(by["pair"]) < 0:
            raise ValueError("pair")
        k, l = (self.scene.pieces[x][i] for x, i in zip("AB", by["pair"]))
        moved = [self.scene.displacement(y) for y in region_corners(lo, hi, region["planes"])]
        if moved and not touches_throughout(k, l, moved):
            raise Refused("the pair does not touch everywhere in the region")
        self.checked["contact by pair"] += 1
        self.unchecked["mass of a region"] += bool(region["planes"])
        return 0.0 if region["planes"] else box_mass(lo, hi)

    def cell(self, line):
        rank = self.scene.rank
        lo, hi = exact(line["cell"][:rank]), exact(line["cell"][rank:])
        if len(hi) != rank or any(a >= b for a, b in zip(lo, hi)):
            raise ValueError("cell")
        self.boxes.append((lo, hi))
        regions, free = line.get("contact", []), line.get("free", [])
        planes = [plane for region in regions for plane in region["planes"]] + (free if isinstance(free, list) else [])
        if not all(any(plane[:-1]) for plane in planes):
            raise ValueError("a plane without a normal")
        for one, other in itertools.combinations(regions, 2):
            if not any([-x for x in p] in other["planes"] for p in one["planes"]):
                raise Refused("regions of contact may overlap")
        self.lower += sum(self.contact(lo, hi, region) for region in regions) * (1 - SLACK)
        if free is True and self.free(lo, hi, []):
            self.upper -= box_mass(lo, hi) * (1 - SLACK)
        for plane in free if isinstance(free, list) else []:
            self.free(lo, hi, [[-x for x in plane]])
            self.unchecked["mass of a region"] += 1

    def end(self, line):
        if line["cells"] != len(self.boxes):
            raise ValueError("cells")
        self.boxes.sort()
        for i, (lo, hi) in enumerate(self.boxes):
            later = itertools.islice(self.boxes, i + 1, None)
            for low, high in itertools.takewhile(lambda box: box[0][0] < hi[0], later):
                if all(max(a, b) < min(c, d) for a, b, c, d in zip(lo, low, hi, high)):
                    raise Refused("cells overlap")
        upper = self.upper + 1e-15 * (len(self.boxes) + 1)
        for what, counts in (("checked:", self.checked), ("not checked:", self.unchecked)):
            print(what, ", ".join(f"{n} {key}" for key, n in sorted(counts.items()) if n) or "nothing")
        print(f"shown [{self.lower:.17g}, {upper:.17g}], claimed [{line['lower']:.17g}, {line['upper']:.17g}]")
        if not +self.unchecked and (line["lower"] > self.lower * (1 + 1e-12) or line["upper"] < upper - 1e-12):
            raise Refused("bounds are not what the claims show")


def main():
    checker, number = None, 0
    try:
        with open(sys.argv[1]) as file:
            for number, text in enumerate(file, 1):
                line = json.loads(text)
                if "fcl_prob_certificate" in line:
                    checker = Checker(Scene(line), int(sys.argv[2]) if len(sys.argv) > 2 else 400)
                elif "part" in line and "caps" not in line:
                    checker.scene.add(line)
                elif "cell" in line:
                    checker.cell(line)
                elif "lower" in line:
                    checker.end(line)
                    checker = None
        if checker is not None or number == 0:
            raise ValueError("the last line is missing")
    except Refused as refused:
        print(f"refused: line {number}: {refused}")
        return 1
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, OSError) as error:
        print(f"malformed: line {number}: {error!r}")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
