"""What is true of a certificate of boxes along the axes: decided by fractions, independently of the checker."""
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
from fractions import Fraction

from make import BOX_FACES, IDENTITY, box_mass

SLACK = 1e-13


def as_box(part):
    """Its sides, exactly; None if it is no box along the axes, or not all of one."""
    points = [[Fraction(x) + Fraction(t) for x, t in zip(v, part["translation"])] for v in part["vertices"]]
    if part["rotation"] != IDENTITY or not part["convex"] or len(points) != 8:
        return None
    lo, hi = [[pick(p[k] for p in points) for k in range(3)] for pick in (min, max)]
    expected = [[(hi if i >> k & 1 else lo)[k] for k in range(3)] for i in range(8)]
    return (lo, hi) if points == expected and all(a < b for a, b in zip(lo, hi)) else None


def clip(lo, hi, planes, sign):
    """The box `cell ∩ {sign (m·y - t) > 0}` for planes along the axes; None if it is empty."""
    lo, hi = list(lo), list(hi)
    for *normal, level in planes:
        axes = [i for i, n in enumerate(normal) if n != 0]
        if len(axes) != 1:
            raise ValueError("not along an axis")
        i = axes[0]
        bound = Fraction(level) / Fraction(normal[i])
        if (normal[i] > 0) == (sign > 0):
            lo[i] = max(lo[i], bound)
        else:
            hi[i] = min(hi[i], bound)
    return (lo, hi) if all(a < b for a, b in zip(lo, hi)) else None


def contact_boxes(lines):
    """The sets of y at which pieces touch, by pairs; None where there is something other than boxes."""
    head, parts = lines[0], [line for line in lines if "part" in line]
    rank = len(head["axes"])
    if any(head["axes"][i] != IDENTITY[i] for i in range(rank)) or head["whitening"] is not None:
        return None
    boxes = {"A": [], "B": []}
    for part in parts:
        boxes[part["part"]].append(as_box(part))
    if None in boxes["A"] + boxes["B"] or min(head["deviations"]) <= 0:
        return None
    result = {}
    for i, (a_lo, a_hi) in enumerate(boxes["A"]):
        for j, (b_lo, b_hi) in enumerate(boxes["B"]):
            lo = [b - a - Fraction(m) for a, b, m in zip(a_hi, b_lo, head["mean"])]
            hi = [b - a - Fraction(m) for a, b, m in zip(a_lo, b_hi, head["mean"])]
            if any(lo[k] > 0 or hi[k] < 0 for k in range(rank, 3)):
                continue
            deviations = [Fraction(d) for d in head["deviations"]]
            result[i, j] = ([x / d for x, d in zip(lo, deviations)], [x / d for x, d in zip(hi, deviations)])
    return result


def overlap(a, b):
    return all(max(p, q) < min(r, s) for p, q, r, s in zip(a[0], b[0], a[1], b[1]))


def is_true(lines):
    """Whether all that the certificate says is true and shown by its witnesses."""
    rank = len(lines[0]["axes"])
    cells = [line for line in lines if "cell" in line]
    touch = contact_boxes(lines)
    if touch is None or "lower" not in lines[-1] or lines[-1]["cells"] != len(cells):
        return False
    lower, upper = 0.0, 1.0
    boxes = []
    for cell in cells:
        sides = [Fraction(x) for x in cell["cell"]]
        box = sides[:rank], sides[rank:]
        if any(a >= b for a, b in zip(*box)):
            return False
        boxes.append(box)
        try:
            free = cell.get("free", False)
            sets = [box] if free is True else [clip(*box, [plane], -1) for plane in free or []]
            regions = [(clip(*box, region["planes"], 1), region["by"]["pair"])
                       for region in cell.get("contact", [])]
            rest = None if free is True else clip(*box, free or [], 1)
        except ValueError:
            return False
        if any(overlap(s, t) for s in sets if s for t in touch.values()):
            return False
        for region, pair in regions:
            if region is None:
                continue
            inside = touch.get(tuple(pair))
            if inside is None or any(a < c or b > d for a, b, c, d in zip(*region, *inside)):
                return False
            lower += box_mass(*[[float(x) for x in side] for side in region])
        if len([r for r, _ in regions if r]) > 1:
            return False  # not made here
        upper -= box_mass(*[[float(x) for x in side] for side in box])
        if rest:
            upper += box_mass(*[[float(x) for x in side] for side in rest])
    boxes.sort()
    for i, box in enumerate(boxes):
        for other in boxes[i + 1:]:
            if other[0][0] >= box[1][0]:
                break
            if overlap(box, other):
                return False
    return lines[-1]["lower"] <= lower * (1 + SLACK) and lines[-1]["upper"] >= upper * (1 - SLACK) - SLACK
