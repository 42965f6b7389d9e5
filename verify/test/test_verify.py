"""Tests of fcl_prob_verify: certificates that are true, and thousands of changes that make them false.

Usage: test_verify.py VERIFIER [unittest arguments]"""
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
import collections
import copy
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
import unittest

from judge_boxes import is_true
from make import (IDENTITY, box_mass, box_part, header, judge_box, judge_spheres, judge_swept, mesh_part,
                  sphere, split_cells, swept_part)

VERIFIER = sys.argv[1] if len(sys.argv) > 1 else "fcl_prob_verify"
PYTHON_VERIFIER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "verify.py")


def certificate(head, parts, cells, lower=0.0, upper=1.0, caps=()):
    return [head, *parts, *caps, *cells, {"lower": lower, "upper": upper, "cells": len(cells)}]


class Answer:
    def __init__(self, lines, *options):
        with tempfile.NamedTemporaryFile("w", suffix=".jsonl") as file:
            file.write(lines if isinstance(lines, str) else "".join(json.dumps(x) + "\n" for x in lines))
            file.flush()
            run = subprocess.run([VERIFIER, file.name, *options], capture_output=True, text=True)
        self.code, self.text = run.returncode, run.stdout + run.stderr
        found = re.search(r"verified \[(.*), (.*)\]", run.stdout)
        self.lower, self.upper = map(float, found.groups()) if found else (None, None)


def two_boxes(rank, mean=(0, 0, 0), deviations=(1, 1, 1), depth=7, reach=8.0):
    """Convex boxes; and the box of y at which they touch."""
    a, b = box_part("A", [0, 0, 0], [1, 1, 1]), box_part("B", [.25, .125, -.375], [1.25, 1.625, 1.5])
    lo = [(x - m) / d for x, m, d in zip([-.75, -.875, -1.375], mean, deviations)][:rank]
    hi = [(x - m) / d for x, m, d in zip([1.25, 1.625, 1.5], mean, deviations)][:rank]
    cells = split_cells([-reach] * rank, [reach] * rank, depth, judge_box(lo, hi, None, True))
    return certificate(header(rank, mean, deviations), [a, b], cells), lo, hi


class TrueCertificates(unittest.TestCase):
    def verify(self, lines, *options):
        answer = Answer(lines, *options)
        self.assertEqual(answer.code, 0, answer.text)
        return answer

    def test_two_boxes(self):
        for rank in (1, 2, 3):
            for mean, deviations in (((0, 0, 0), (1, 1, 1)), ((.5, -.25, .0625), (.5, .25, 2))):
                lines, lo, hi = two_boxes(rank, mean, deviations)
                answer = self.verify(lines)
                mass = box_mass(lo, hi)
                self.assertLessEqual(answer.lower, mass * (1 + 1e-13))
                self.assertGreaterEqual(answer.upper, mass * (1 - 1e-13))
                self.assertLess(answer.upper - answer.lower, 1e-12 * mass + 3e-14)

    def test_threads_say_the_same(self):
        lines, _, _ = two_boxes(3)
        one, two = self.verify(lines), self.verify(lines, "--threads", "2", "--progress")
        self.assertEqual((one.lower, one.upper), (two.lower, two.upper))

    def test_any_scale(self):
        for rank in (1, 2, 3):
            lines, _, _ = two_boxes(rank)
            answer = self.verify(lines)
            for scale in (2.0 ** 400, 2.0 ** -400):
                scaled = copy.deepcopy(lines)
                scaled[0]["deviations"] = [x * scale for x in scaled[0]["deviations"]]
                for part in scaled[1:3]:
                    part["vertices"] = [[x * scale for x in v] for v in part["vertices"]]
                    part["translation"] = [x * scale for x in part["translation"]]
                other = self.verify(scaled)
                self.assertEqual((other.lower, other.upper), (answer.lower, answer.upper))

    def test_probabilities_that_are_tiny(self):
        # So many deviations away that nothing of P is left beside 1.
        for distance in (12.0, 30.0):
            lines, lo, hi = two_boxes(3, (distance, 0, 0), (1, 1, 1), depth=24, reach=64.0)
            mass = box_mass(lo, hi)
            lines[-1]["upper"] = mass * (1 + 1e-11)
            answer = self.verify(lines)
            self.assertLess(mass, 1e-25)
            self.assertAlmostEqual(answer.lower / mass, 1, delta=1e-11)
            self.assertAlmostEqual(answer.upper / mass, 1, delta=1e-11)

    def test_whitening_turns_the_frame(self):
        c, s = 0.6, 0.8
        head = header(3, axes=[[c, s, 0], [-s, c, 0], [0, 0, 1]], whitening=IDENTITY)
        a, b = box_part("A", [0, 0, 0], [1, 1, 1]), box_part("B", [.25, .125, -.375], [1.25, 1.625, 1.5])
        lo, hi = [-.75, -.875, -1.375], [1.25, 1.625, 1.5]
        inner = judge_box([x + 1e-13 for x in lo], [x - 1e-13 for x in hi], None, True)
        outer = judge_box([x - 1e-13 for x in lo], [x + 1e-13 for x in hi], None, True)

        def judge(x, y, last):
            contact, free = inner(x, y, last), outer(x, y, last)
            if contact is None or free is None:
                return None if not last else {}
            return {**{k: v for k, v in contact.items() if k == "contact"},
                    **{k: v for k, v in free.items() if k == "free"}}
        cells = split_cells([-8.0] * 3, [8.0] * 3, 8, judge)
        answer = self.verify(certificate(head, [a, b], cells))
        mass = box_mass(lo, hi)
        self.assertAlmostEqual(answer.lower, mass, delta=2e-12)
        self.assertAlmostEqual(answer.upper, mass, delta=2e-12)
        # With the frame of the axes themselves the same claims are wrong.
        self.assertEqual(Answer(certificate({**head, "whitening": None}, [a, b], cells)).code, 1)

    def test_boxes_of_two_parts(self):
        lines, mass = boxes_of_two_parts(2)
        answer = self.verify(lines)
        self.assertLessEqual(answer.lower, mass)
        self.assertGreaterEqual(answer.upper, mass)
        self.assertLess(answer.upper - answer.lower, 0.2)

    def test_triangles(self):
        # A needle through a large triangle, moved along an axis: touches between the needle's ends.
        needle = mesh_part("A", [[0, 0, -1], [0, 0, 1], [.125, 0, 1]], [[0, 1, 2]])
        large = mesh_part("B", [[-9, -9, 0], [9, -9, 0], [0, 18, 0]], [[0, 1, 2]])
        head = header(1, axes=[[0, 0, 1], [1, 0, 0], [0, 1, 0]])
        cells = split_cells([-8.0], [8.0], 10, judge_box([-1], [1]))
        answer = self.verify(certificate(head, [needle, large], cells))
        mass = box_mass([-1], [1])
        self.assertAlmostEqual(answer.lower, mass, delta=1e-13)
        self.assertAlmostEqual(answer.upper, mass, delta=1e-13)
        # The same claims by pieces without an inside of L - K: both in the plane y = 0.
        flat = mesh_part("B", [[-9, 0, 0], [9, 0, 0], [0, 0, -.5]], [[0, 1, 2]])
        cell = {"cell": [-.25, .25], "contact": [{"planes": [], "by": {"pair": [0, 0]}}]}
        self.assertEqual(Answer(certificate(head, [needle, flat], [cell])).code, 1)

    def test_tetrahedra_in_a_plane_of_displacements(self):
        vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
        a = mesh_part("A", vertices, faces, convex=True)
        b = mesh_part("B", [[-x for x in v] for v in vertices], [f[::-1] for f in faces], convex=True)
        # L - K is the set -x for x, y, z >= 0 with sum 2 at most and each at most 1 or so: in the plane z = 0
        # all of -x, -y >= 0 with a sum of 2 at most where a cut by one plane says it exactly.
        plane = [1.0, 1.0, -2.0]
        cell = {"cell": [-1.0, -1.0, 0.0, 0.0], "contact": [{"planes": [], "by": {"pair": [0, 0]}}]}
        corner = {"cell": [-2.0, -1.0, -1.0, 0.0], "free": [plane],
                  "contact": [{"planes": [plane], "by": {"pair": [0, 0]}}]}
        other = {"cell": [-1.0, -2.0, 0.0, -1.0], "free": [plane],
                 "contact": [{"planes": [plane], "by": {"pair": [0, 0]}}]}
        outside = [{"cell": [0.0, -8.0, 8.0, 8.0], "free": True}, {"cell": [-8.0, -8.0, -2.0, 8.0], "free": True},
                   {"cell": [-2.0, 0.0, 0.0, 8.0], "free": True}, {"cell": [-2.0, -8.0, 0.0, -2.0], "free": True},
                   {"cell": [-2.0, -2.0, -1.0, -1.0], "free": True}]
        answer = self.verify(certificate(header(2), [a, b], [cell, corner, other, *outside]))
        steps = 20000  # of the midpoint rule for the triangle x, y < 0, x + y > -2
        mass = sum(math.exp(-x * x / 2) * (math.erf((2 - x) / math.sqrt(2)))
                   for x in ((k + .5) * 2 / steps for k in range(steps))) * 2 / steps / math.sqrt(8 * math.pi)
        self.assertAlmostEqual(answer.lower, mass, delta=1e-9)
        self.assertLess(answer.upper - answer.lower, 1e-13)

    def test_spheres(self):
        for solid in (False, True):
            lines, mass_inner, mass_outer = two_spheres(solid)
            answer = self.verify(lines)
            self.assertGreater(answer.lower, 0)
            self.assertLess(answer.lower, mass_outer)
            self.assertGreater(answer.upper, mass_inner)

    def test_balls(self):
        lines, mass = two_balls()
        answer = self.verify(lines)
        self.assertGreater(answer.lower, 0.35 * mass)
        self.assertLess(answer.lower, mass)
        self.assertGreater(answer.upper, mass)
        self.assertLess(answer.upper, 2 * mass)

    def test_what_is_swept_by_balls(self):
        draw = random.Random(3)
        for case in range(6):
            lines = swept_pair(draw, case)
            answer = self.verify(lines)
            self.assertGreater(answer.upper, answer.lower)
            self.assertGreater(sum("cell" in line and "contact" in line for line in lines), 0)

    def test_open_box_with_a_cap(self):
        answer = self.verify(open_box())
        self.assertAlmostEqual(answer.lower, box_mass([-.25] * 3, [.25] * 3), delta=1e-14)

    def test_solid_in_a_solid(self):
        lines = solid_in_solid()
        answer = self.verify(lines)
        self.assertAlmostEqual(answer.lower, 2 * box_mass([-.5] * 3, [.5, .5, 0]), delta=1e-13)
        lines[0]["contact"] = "surface"
        self.assertEqual(Answer(lines).code, 1)

    def test_masses_of_polytopes(self):
        # Boxes that never touch; free are half-spaces of a large cell along oblique directions at right angles.
        a, b = box_part("A", [0, 0, 0], [1, 1, 1]), box_part("B", [500, 0, 0], [501, 1, 1])
        for rank, normals in ((2, [[3, 4], [-4, 3]]), (3, [[1, 2, 2], [2, 1, -2], [-2, 2, -1]])):
            length = math.sqrt(sum(x * x for x in normals[0]))
            for levels in ([1.5, -2, .25], [6, 0, -1]):
                for count in range(1, rank + 1):
                    planes = [n + [length * t] for n, t in zip(normals, levels)][:count]
                    mass = math.prod(math.erfc(t / math.sqrt(2)) / 2 for t in levels[:count])
                    cell = {"cell": [-12.0] * rank + [11.0] * rank, "free": planes}
                    lines = certificate(header(rank), [a, b], [cell], upper=mass * (1 + 1e-11))
                    answer = self.verify(lines)
                    self.assertAlmostEqual(answer.upper / mass, 1, delta=2e-12)

    def test_touching_at_the_boundary_only(self):
        # Boxes that slide along each other touch always; by the next double apart they never do.
        for gap, code in ((0.0, 1), (2.0 ** -52, 0), (-2.0 ** -52, 1)):
            a, b = box_part("A", [0, 0, 0], [1, 1, 1]), box_part("B", [0, 0, 1 + gap], [1, 1, 2])
            lines = certificate(header(1), [a, b], [{"cell": [-.5, .5], "free": True}])
            self.assertEqual(Answer(lines).code, code)
        # A cell that ends where they begin to touch is free.
        a, b = box_part("A", [0, 0, 0], [1, 1, 1]), box_part("B", [1.5, 0, 0], [2, 1, 1])
        for convex in (True, False):
            a["convex"] = b["convex"] = convex
            for end, code in ((.5, 0), (math.nextafter(.5, 1), 1)):
                lines = certificate(header(3), [a, b], [{"cell": [-1, -.5, -.5, end, .5, .5], "free": True}])
                self.assertEqual(Answer(lines).code, code)

    def test_nothing_is_random(self):
        # P is 0 or 1 by the one displacement that there is; touching at the boundary is contact.
        cell = {"cell": []}
        for gap, contact in ((1e-300, False), (0.0, True), (-.5, True)):
            a, b = box_part("A", [0, 0, 0], [1, 1, 1]), box_part("B", [0, 0, gap], [1, 1, 1])
            head = {**header(0, mean=(.25, 0, -1)), "fcl_prob_certificate": 2}
            touching = {**cell, "contact": [{"planes": [], "by": {"pair": [0, 0]}}]}
            for claim, is_true in ((touching, contact), ({**cell, "free": True}, not contact)):
                answer = Answer(certificate(head, [a, b], [claim]))
                self.assertEqual(answer.code, 0 if is_true else 1, answer.text)
                if is_true:
                    self.assertEqual((answer.lower, answer.upper), (float(contact), float(contact)))
            self.assertEqual(Answer(certificate(head, [a, b], [cell, cell])).code, 1)
            self.assertEqual(Answer(certificate({**head, "fcl_prob_certificate": 1}, [a, b], [cell])).code, 2)


def boxes_of_two_parts(rank):
    """A is two boxes; contact is the union of two boxes of y that do not overlap. And P."""
    parts = [box_part("A", [0, 0, 0], [1, 1, 1]), box_part("A", [4, 0, 0], [4.5, 1, 1]),
             box_part("B", [.5, .25, .25], [1.25, .75, .5])]
    first, second = ([-.5, -.75, -.75], [1.25, .75, .5]), ([-4, -.75, -.75], [-2.75, .75, .5])
    judges = [judge_box(lo[:rank], hi[:rank], {"pair": [i, 0]}, True)
              for i, (lo, hi) in enumerate((first, second))]

    def judge(lo, hi, last):
        said = [one(lo, hi, False) for one in judges]
        if said[0] == {"free": True}:
            return judges[1](lo, hi, last)
        if said[1] == {"free": True}:
            return judges[0](lo, hi, last)
        return next((claim for claim in said if claim), {} if last else None)
    cells = split_cells([-8.0] * rank, [8.0] * rank, 8, judge)
    return (certificate(header(rank), parts, cells),
            sum(box_mass(lo[:rank], hi[:rank]) for lo, hi in (first, second)))


def two_spheres(solid, level=2, depth=12):
    radius, center = 1.0, [2.5, .25, .125]
    va, fa = sphere(radius, [0, 0, 0], level)
    vb, fb = sphere(radius, center, level)
    inner = 0.94  # of this level the faces' planes are farther away
    cells = split_cells([-6.0] * 3, [6.0] * 3, depth,
                        judge_spheres(va, vb, 1, 1, inner, [0, 0, 0], center, [1, 1, 1], solid))
    lines = certificate(header(contact="solid" if solid else "surface"),
                        [mesh_part("A", va, fa, solid), mesh_part("B", vb, fb, solid)], cells)
    distance = math.sqrt(sum(c * c for c in center))

    def mass(r):  # of a ball with this radius around a point at that distance, by its closed form
        def density(x):
            return math.exp(-x * x / 2) / math.sqrt(2 * math.pi)
        return (0.5 * (math.erf((r - distance) / math.sqrt(2)) + math.erf((r + distance) / math.sqrt(2)))
                - (density(r - distance) - density(r + distance)) / distance)
    return lines, mass(2 * inner), mass(2)


def swept_header(deviations):
    return {**header(len(deviations), (0, 0, 0), deviations), "fcl_prob_certificate": 2}


def two_balls():
    """At the same place: |ε| < 1.5 with standard normals."""
    cells = split_cells([-4.0] * 3, [4.0] * 3, 12, judge_swept([[0, 0, 0]], [[0, 0, 0]], 1.5, [1, 1, 1]))
    mass = math.erf(1.5 / math.sqrt(2)) - math.sqrt(2 / math.pi) * 1.5 * math.exp(-1.125)
    return certificate(swept_header([1, 1, 1]), [swept_part("A", [[0, 0, 0]], 1.0), swept_part("B", [[0, 0, 0]], 0.5)],
                       cells), mass


def swept_pair(draw, case):
    """A point or segment swept by a ball beside one, a triangle, or a box, all of them turned and moved at random."""
    def points(count):
        return [[draw.gauss(0, 0.6) for _ in range(3)] for _ in range(count)]
    swept, radius = points(1 + case % 2), draw.uniform(0.8, 1.2)
    kind = case // 2 % 3
    if kind == 0:
        core = points(1 + draw.randrange(2))
        other, more = swept_part("B", core, 0.25), 0.25
    elif kind == 1:
        core, more = points(3), 0.0
        other = mesh_part("B", core, [[0, 1, 2]])
    else:
        other, more = box_part("B", [-.5, -.25, -.125], [.25, .5, 1]), 0.0
        core = other["vertices"]
    deviations = [draw.uniform(0.5, 1.5) for _ in range(3 - case % 2)]
    cells = split_cells([-3.0] * len(deviations), [3.0] * len(deviations), 9,
                        judge_swept(swept, core, radius + more, deviations))
    return certificate(swept_header(deviations), [swept_part("A", swept, radius), other], cells)


def open_box():
    """A box without its lid, which is a cap, and a needle that comes through one of its sides."""
    box = box_part("B", [-1, -1, -1], [1, 1, 1], convex=False)
    lid = [[4, 5, 8], [5, 9, 8]]  # whose far corners are given once more
    box["triangles"] = [t for t in box["triangles"] if not set(t) <= {4, 5, 6, 7}]
    needle = mesh_part("A", [[0, 0, 0], [3, 0, 0], [3, .0625, 0]], [[0, 1, 2]])
    caps = {"caps": "B", "part": 0, "vertices": [[-1, 1, 1], [1, 1, 1]], "triangles": lid}
    cell = {"cell": [-.25] * 3 + [.25] * 3,
            "contact": [{"planes": [], "by": {"inside": "A", "vertex": 0, "outside": 1}}]}
    return certificate(header(), [needle, box], [cell], caps=[caps])


def solid_in_solid():
    a = box_part("A", [-.25] * 3, [.25] * 3, convex=False, solid=True)
    b = box_part("B", [-1] * 3, [1] * 3, convex=False, solid=True)
    cells = [{"cell": [-.5] * 3 + [.5, .5, 0.0], "contact": [{"planes": [], "by": {"contained": True}}]},
             {"cell": [-.5, -.5, 0.0] + [.5] * 3,
              "contact": [{"planes": [], "by": {"inside": "A", "vertex": 3, "outside": None}}]},
             {"cell": [1.25, -1, -1, 2, 1, 1], "free": True}]
    return certificate(header(contact="solid"), [a, b], cells)


def cells_of(lines, key):
    return [i for i, line in enumerate(lines) if "cell" in line and key(line)]


def has_planes(line):
    return isinstance(line.get("free"), list) or any(r["planes"] for r in line.get("contact", []))


def change_number(x, rng):
    """By the last bit, or by more."""
    kind = rng.randrange(4)
    if kind == 0:
        return math.nextafter(x, math.inf)
    if kind == 1:
        return math.nextafter(x, -math.inf)
    return x + rng.choice((-1, 1)) * 10.0 ** rng.uniform(-12, 0)


class Changes:
    """Each changes one thing in the lines; False if there is none of the kind."""
    @staticmethod
    def vertex_moved(lines, rng):
        part = rng.choice([line for line in lines if "part" in line])
        vertex = rng.choice(part["vertices"])
        k = rng.randrange(3)
        vertex[k] = change_number(vertex[k], rng)

    @staticmethod
    def translation_moved(lines, rng):
        part = rng.choice([line for line in lines if "part" in line])
        k = rng.randrange(3)
        part["translation"][k] = change_number(part["translation"][k], rng)

    @staticmethod
    def mean_or_deviation_changed(lines, rng):
        numbers = lines[0][rng.choice(("mean", "deviations"))]
        k = rng.randrange(len(numbers))
        numbers[k] = change_number(numbers[k], rng)

    @staticmethod
    def level_changed(lines, rng):
        line = lines[rng.choice(cells_of(lines, has_planes))]
        planes = [p for p in line["free"] if isinstance(line.get("free"), list)]
        planes += [p for region in line["contact"] for p in region["planes"]]
        plane = rng.choice(planes)
        plane[-1] = change_number(plane[-1], rng)

    @staticmethod
    def plane_dropped(lines, rng):
        line = lines[rng.choice(cells_of(lines, has_planes))]
        planes = rng.choice([line["free"]] + [region["planes"] for region in line["contact"]])
        planes.pop(rng.randrange(len(planes)))

    @staticmethod
    def plane_turned(lines, rng):
        line = lines[rng.choice(cells_of(lines, has_planes))]
        plane = rng.choice(rng.choice([line["free"]] + [region["planes"] for region in line["contact"]]))
        plane[:] = [-x for x in plane]

    @staticmethod
    def claim_flipped(lines, rng):
        i = rng.choice(cells_of(lines, lambda line: ("free" in line) != ("contact" in line)))
        line = lines[i]
        if "free" in line:
            line["contact"] = [{"planes": [], "by": {"pair": [0, 0]}}]
            del line["free"]
        else:
            line["free"] = True
            del line["contact"]

    @staticmethod
    def side_moved(lines, rng):
        line = lines[rng.choice(cells_of(lines, lambda _: True))]
        k = rng.randrange(len(line["cell"]))
        line["cell"][k] = change_number(line["cell"][k], rng)

    @staticmethod
    def cell_repeated(lines, rng):
        i = rng.choice(cells_of(lines, lambda _: True))
        lines.insert(-1, copy.deepcopy(lines[i]))
        lines[-1]["cells"] += 1

    @staticmethod
    def cell_dropped(lines, rng):
        lines.pop(rng.choice(cells_of(lines, lambda _: True)))
        lines[-1]["cells"] -= rng.randrange(2)

    @staticmethod
    def bound_bettered(lines, rng):
        last = lines[-1]
        key = rng.choice(("lower", "upper"))
        factor = 10.0 ** rng.uniform(-12, -1)
        last[key] *= 1 + factor if key == "lower" else 1 - factor

    @staticmethod
    def pair_changed(lines, rng):
        line = lines[rng.choice(cells_of(lines, lambda line: line.get("contact")))]
        pair = rng.choice(line["contact"])["by"]["pair"]
        if rng.randrange(3) == 0:
            pair.reverse()
        pair[rng.randrange(2)] += rng.choice((-1, 1, 1))

    @staticmethod
    def part_dropped(lines, rng):
        lines.pop(rng.choice([i for i, line in enumerate(lines) if "part" in line]))

    @staticmethod
    def triangle_dropped_or_turned(lines, rng):
        triangles = rng.choice([line for line in lines if "part" in line])["triangles"]
        i = rng.randrange(len(triangles))
        if rng.randrange(2):
            triangles[i] = triangles[i][::-1]
        else:
            triangles.pop(i)


class SeveralCertificates(unittest.TestCase):
    def test_any_of_them(self):
        first, lo, hi = two_boxes(2, depth=7)
        second, low, high = two_boxes(1, (30, 0, 0), depth=20, reach=64.0)
        second[0]["name"] = "far"
        p, q = box_mass(lo, hi), box_mass(low, high)
        second[-1]["upper"] = q * (1 + 1e-11)
        answer = Answer(first + second)
        self.assertEqual(answer.code, 0, answer.text)
        found = re.findall(r"verified \[(.*), (.*)\](.*)", answer.text)
        self.assertEqual(len(found), 3)
        self.assertIn('"far" lines ' + str(len(first) + 1), found[1][2])
        self.assertAlmostEqual(float(found[2][0]), p, delta=1e-12)
        # Both tiny: 1 - (1 - q)² is 2 q.
        lower, upper = map(float, re.findall(r"verified \[(.*), (.*)\] any", Answer(second + second).text)[0])
        self.assertAlmostEqual(lower / (2 * q), 1, delta=1e-11)
        self.assertAlmostEqual(upper / (2 * q), 1, delta=1e-11)
        # One that fails, or is cut off, fails all.
        second[-1]["lower"] = 1.1 * q
        self.assertEqual(Answer(first + second).code, 1)
        self.assertEqual(Answer(first + second[:-1]).code, 2)


class SmallChecker(unittest.TestCase):
    def run_on(self, lines):
        with tempfile.NamedTemporaryFile("w", suffix=".jsonl") as file:
            file.write("".join(json.dumps(x) + "\n" for x in lines))
            file.flush()
            return subprocess.run([sys.executable, PYTHON_VERIFIER, file.name], capture_output=True, text=True)

    def test_true(self):
        for rank in (1, 2, 3):
            run = self.run_on(two_boxes(rank, depth=4)[0])
            self.assertEqual(run.returncode, 0, run.stdout)
            self.assertNotRegex(run.stdout, "not checked: .*(free|contact)")
        run = self.run_on(two_spheres(True, depth=5)[0])
        self.assertEqual(run.returncode, 0, run.stdout)

    def test_changes(self):
        rng = random.Random(4)
        lines = two_boxes(2, depth=4)[0]
        refused = 0
        for name in ("level_changed", "plane_turned", "claim_flipped", "side_moved", "cell_repeated", "pair_changed"):
            for _ in range(4):
                changed = copy.deepcopy(lines)
                getattr(Changes, name)(changed, rng)
                code = self.run_on(changed).returncode
                refused += code != 0
                self.assertTrue(code != 0 or is_true(changed), name)
        print(f"verify.py: {refused} of 24 refused")


class BothCheckers(unittest.TestCase):
    """On coordinates of a coarse grid, where much touches at its boundary only, both have to say the same."""
    def test_random_triangles(self):
        sys.path.insert(0, os.path.dirname(PYTHON_VERIFIER))
        import verify
        rng = random.Random(int(os.environ.get("FCL_PROB_VERIFY_SEED", "5")))
        counts = collections.Counter()
        for k in range(int(os.environ.get("FCL_PROB_VERIFY_SCENES", "600"))):
            rank, free = 1 + k % 3, k % 2 == 0
            size = rng.choice((2, 3, 6))
            parts = [mesh_part(x, [[float(rng.randrange(-size, size + 1)) for _ in range(3)] for _ in range(3)],
                               [[0, 1, 2]]) for x in "AB"]
            for part in parts if k % 5 < 2 else []:  # a parallelepiped in place of the triangle
                turn = [[rng.randrange(-1, 2) for _ in range(3)] for _ in range(3)]
                if verify.dot(turn[0], verify.cross(turn[1], turn[2])) > 0:
                    side = [rng.randrange(1, 3) for _ in range(3)]
                    part.update(box_part(part["part"], [0, 0, 0], side), rotation=turn)
                    part["translation"] = [rng.randrange(-2, 3) for _ in range(3)]
            lo = [float(rng.randrange(-size, size)) for _ in range(rank)]
            step = rng.choice((1, 1, .25, 2, 2 ** -44))
            cell = lo + [x + step * rng.choice((1, 1, .5)) for x in lo]
            planes = [[float(rng.randrange(-2, 3)) for _ in range(rank + 1)] for _ in range(rng.randrange(3))]
            axes = [[float(rng.randrange(-2, 3)) for _ in range(3)] for _ in range(3)]
            if verify.dot(axes[0], verify.cross(axes[1], axes[2])) == 0:
                axes = IDENTITY
            mean = [rng.choice((0, .5, 1)) for _ in range(3)]
            claim = ({"free": planes or True} if free else
                     {"contact": [{"planes": planes, "by": {"pair": [0, 0]}}]})
            lines = certificate(header(rank, mean, rng.choice(((1, 1, 1), (2, .5, 1))), axes=axes), parts,
                                [{"cell": cell, **claim}])
            scene = verify.Scene(lines[0])
            for part in parts:
                scene.add(part)
            checker = verify.Checker(scene, 400)
            try:
                checker.cell(lines[-2])
                expected = 0
            except verify.Refused:
                expected = 1
            except ValueError:  # a plane without a normal
                expected = 2
            answer = Answer(lines)
            counts[("free" if free else "contact", expected)] += 1
            self.assertEqual(answer.code, expected, f"{lines}: {answer.text}")
        print("random triangles:", dict(counts))


class FalseCertificates(unittest.TestCase):
    def test_changes_of_boxes(self):
        count = int(os.environ.get("FCL_PROB_VERIFY_CHANGES", "40"))
        rng = random.Random(20261128)
        refused, passed = collections.Counter(), collections.Counter()
        scenes = [two_boxes(2, depth=5)[0], two_boxes(3, (.5, -.25, .0625), (.5, .25, 2), depth=5)[0],
                  boxes_of_two_parts(2)[0]]
        for lines in scenes:
            answer = Answer(lines)
            self.assertEqual(answer.code, 0, answer.text)
            # As tight as can be shown, so that nothing that is taken away goes unnoticed.
            lines[-1]["lower"], lines[-1]["upper"] = answer.lower, answer.upper
            self.assertTrue(is_true(lines))
        for name in [n for n in vars(Changes) if not n.startswith("_")]:
            for k in range(count):
                # Where the rank is below three a vertex may be moved without anything becoming false.
                lines = copy.deepcopy(scenes[1 if name == "vertex_moved" else k % len(scenes)])
                getattr(Changes, name)(lines, rng)
                answer = Answer(lines)
                (passed if answer.code == 0 else refused)[name] += 1
                if answer.code == 0:
                    self.assertTrue(is_true(lines), f"{name}: {answer.text}")
        for name in sorted(set(refused) | set(passed)):
            print(f"{name}: {refused[name]} refused, {passed[name]} harmless")

    def test_flips_of_spheres(self):
        rng = random.Random(1)
        for solid in (False, True):
            lines, _, _ = two_spheres(solid)
            for i in rng.sample(cells_of(lines, lambda line: "contact" in line), 4 if solid else 1):
                changed = copy.deepcopy(lines)
                del changed[i]["contact"]
                changed[i]["free"] = True
                self.assertEqual(Answer(changed).code, 1)
            for i in rng.sample(cells_of(lines, lambda line: "free" in line), 15):
                changed = copy.deepcopy(lines)
                del changed[i]["free"]
                by = rng.choice(({"pair": [rng.randrange(128), rng.randrange(128)]}, {"contained": True},
                                 {"inside": "A", "vertex": rng.randrange(66), "outside": rng.randrange(66)}))
                changed[i]["contact"] = [{"planes": [], "by": by}]
                self.assertEqual(Answer(changed).code, 1)

    def test_spheres_that_miss_a_triangle(self):
        rng = random.Random(2)
        for solid in (False, True):
            lines, _, _ = two_spheres(solid)
            lines[2]["triangles"].pop(rng.randrange(128))
            self.assertNotEqual(Answer(lines).code, 0)

    def test_radii_that_are_not_so(self):
        draw = random.Random(3)
        for case in range(6):
            lines = swept_pair(draw, case)
            # Cells may be within the box whatever is swept.
            for factor in (3.0,) if lines[2]["triangles"][1:] else (0.01, 3.0):
                changed = json.loads(json.dumps(lines))
                for part in changed[1:3]:
                    part["radius"] = factor * part.get("radius", 0)
                if not changed[2]["convex"]:
                    del changed[2]["radius"]
                self.assertEqual(Answer(changed).code, 1, (case, factor))
            # Version 1 knows no balls.
            lines[0]["fcl_prob_certificate"] = 1
            self.assertNotEqual(Answer(lines).code, 0)

    def test_changes_of_caps_and_needles(self):
        def change(where):
            lines = open_box()
            where(lines)
            return Answer(lines).code
        witness = lambda lines: lines[-2]["contact"][0]["by"]
        self.assertEqual(change(lambda lines: None), 0)
        self.assertEqual(change(lambda lines: lines.pop(3)), 1)  # no caps
        self.assertEqual(change(lambda lines: lines[3]["triangles"].pop()), 2)
        self.assertEqual(change(lambda lines: witness(lines).update(vertex=1, outside=0)), 1)
        self.assertEqual(change(lambda lines: witness(lines).update(outside=0)), 1)
        self.assertEqual(change(lambda lines: witness(lines).update(vertex=2)), 1)
        self.assertEqual(change(lambda lines: witness(lines).update(vertex=7)), 1)
        self.assertEqual(change(lambda lines: witness(lines).pop("outside")), 1)
        self.assertEqual(change(lambda lines: witness(lines).update(inside="B")), 1)
        # Through the lid rather than a side, where there is nothing.
        self.assertEqual(change(lambda lines: lines[1].update(
            vertices=[[0, 0, 0], [0, 0, 3], [.0625, 0, 3]])), 1)
        # The vertex may be on a side, or beyond.
        self.assertEqual(change(lambda lines: lines[-2].update(cell=[-.25] * 3 + [1.5, .25, .25])), 1)

    def test_solids_that_are_not_inside(self):
        for change in (lambda lines: lines[1].update(translation=[.5, 0, 0]),
                       lambda lines: lines[2].update(translation=[5, 0, 0]),
                       lambda lines: lines[2]["triangles"].reverse() or lines[2]["triangles"].pop(),
                       lambda lines: lines[-2].update(cell=[.75, -1, -1, 2, 1, 1]),
                       lambda lines: lines[-2].update(cell=[.51, -.2, -.2, .6, .2, .2]),
                       lambda lines: lines[-4]["contact"][0].update(by={"pair": [0, 0]}),
                       lambda lines: lines[2].update(solid=False)):
            lines = solid_in_solid()
            change(lines)
            self.assertNotEqual(Answer(lines).code, 0)

    def test_regions_that_overlap(self):
        lines, _, _ = two_boxes(2, depth=9)
        i = cells_of(lines, lambda line: line.get("contact") and not line["contact"][0]["planes"])[0]
        pair = {"pair": [0, 0]}
        middle = 0.5 * (lines[i]["cell"][0] + lines[i]["cell"][2])
        for level, code in ((middle, 0), (math.nextafter(middle, -9), 1)):
            lines[i]["contact"] = [{"planes": [[1.0, 0.0, middle]], "by": pair},
                                   {"planes": [[-1.0, 0.0, -level]], "by": pair}]
            self.assertEqual(Answer(lines).code, code)


class Malformed(unittest.TestCase):
    def test_files_that_are_cut_off(self):
        lines, _, _ = two_boxes(2, depth=5)
        text = "".join(json.dumps(line) + "\n" for line in lines)
        rng = random.Random(3)
        for _ in range(60):
            self.assertEqual(Answer(text[:rng.randrange(len(text) - 2)]).code, 2)
        self.assertEqual(Answer(text + text.splitlines()[-1]).code, 2)

    def test_radii(self):
        lines, _ = two_balls()
        for radius in (-1.0, "1", 1e400):
            lines[1]["radius"] = radius
            self.assertEqual(Answer(lines).code, 2)
        triangle = mesh_part("A", [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        lines[1] = {**triangle, "radius": 0.5}
        self.assertEqual(Answer(lines).code, 2)

    def test_planes_without_a_normal(self):
        # { 0·y < 0 } is empty: it would be free of anything, and leave nothing of the cell.
        a, b = box_part("A", [0, 0, 0], [1, 1, 1]), box_part("B", [0, 0, 0], [1, 1, 1])
        for rank in (0, 1, 2, 3):
            head = {**header(rank), "fcl_prob_certificate": 2}
            for level in (-1.0, 0.0, 1.0):
                sides = [-8.0] * rank + [8.0] * rank
                for cell in ({"free": [[0.0] * rank + [level]]},
                             {"contact": [{"planes": [[0.0] * rank + [level]], "by": {"pair": [0, 0]}}]}):
                    self.assertEqual(Answer(certificate(head, [a, b], [{"cell": sides, **cell}])).code, 2)

    def test_fields(self):
        lines, _, _ = two_boxes(2, depth=5)
        text = "".join(json.dumps(line) + "\n" for line in lines)
        for before, after in (('"cells": ', '"cells": 1'), ('"contact": "surface"', '"contact": "all"'),
                              ('certificate": 1', 'certificate": 3'), ('"convex": true', '"convex": 1'),
                              ('"mean": [0, ', '"mean": [1e999, '), ('"mean": [0, ', '"mean": ['),
                              ('[0, 2, 1]', '[0, 2, 8]'), ('[0, 2, 1]', '[0, 2, -1]'),
                              ('"pair"', '"pear"'), ('"lower": ', '"lower": null, "x": ')):
            self.assertIn(before, text)
            answer = Answer(text.replace(before, after, 1))
            self.assertEqual(answer.code, 2, f"{after}: {answer.text}")
            self.assertIn("line", answer.text)
        self.assertEqual(subprocess.run([VERIFIER, "/no/such/file"], capture_output=True).returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
