# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Pairs of boxes on which GJK and EPA have answered wrongly, with NaN, or not at all: aligned, nearly aligned, thin."""
import math
import random

from checks import Case
from truth import (axes_of, between, box_around_mass, boxes_touch_along, mass, plus, turn, turned, unit)

AXES = {"x": [1.0, 0.0, 0.0], "y": [0.0, 1.0, 0.0], "z": [0.0, 0.0, 1.0]}
STILL = [1.0, 0.0, 0.0, 0.0]
# As narrow as double precision gives it: the pairs here have exact masses.
EXACT = {"absolute_tolerance": 1e-15}


def rounded(values, digits=4):
    return [round(v, digits) for v in values]


def scene_of(a, b, displacement, request=None):
    def placed(box):
        return {"box": list(box[0]), "pose": list(box[1]) + list(box[2])}
    return {"a": placed(a), "b": placed(b), "displacement": displacement, "request": request or EXACT}


def along(name, a, b, direction, sigma):
    """Box a moves along one line, which is not always an axis of the world."""
    covariance = [sigma * sigma * direction[i] * direction[j] for i in range(3) for j in range(i, 3)]
    p = mass(boxes_touch_along(a, b, direction), sigma)
    if direction in AXES.values():
        displacement = {"sigma": [sigma * x for x in direction]}
    else:
        displacement = {"covariance": covariance}
    return Case(name, scene_of(a, b, displacement), (p,))


def still(name, a, b):
    p = mass(boxes_touch_along(a, b, AXES["x"]), 0)
    return Case(name, scene_of(a, b, {"sigma": [0, 0, 0]}), (p,))


def gaps():
    """Distances of aligned boxes that came out as those of corners: a gap along one axis at a time."""
    draw = random.Random(101)
    for k, axis in enumerate("xyz"):
        for deviations in (0.5, 2.5, 6.0):
            size_a, size_b = (rounded(draw.uniform(0.3, 2.0) for _ in range(3)) for _ in range(2))
            sigma = round(draw.uniform(0.05, 0.3), 4)
            offset = [0.0, 0.0, 0.0]
            offset[k] = 0.5 * (size_a[k] + size_b[k]) + deviations * sigma
            b = (size_b, rounded(draw.uniform(-3, 3) for _ in range(3)), STILL)
            a = (size_a, plus(b[1], offset), STILL)
            yield along(f"a gap of {deviations} deviations along {axis}", a, b, AXES[axis], sigma)


def all_axes():
    """The same with errors in all directions, in the world's axes and in those that both boxes have turned to."""
    draw = random.Random(102)
    for index in range(4):
        size_a, size_b = (rounded(draw.uniform(0.2, 1.5) for _ in range(3)) for _ in range(2))
        offset = rounded(draw.uniform(-1.5, 1.5) for _ in range(3))
        sigma = rounded(draw.uniform(0.1, 0.8) for _ in range(3))
        quaternion = STILL if index < 2 else turn([draw.gauss(0, 1) for _ in range(3)], draw.uniform(0.3, 3.0))
        p = box_around_mass(plus(size_a, size_b), offset, sigma)
        a = (size_a, turned(quaternion, offset), quaternion)
        displacement = {"sigma": sigma} if index < 2 else {"sigma": sigma, "sigma_axes": quaternion}
        yield Case(f"boxes turned alike, errors in all axes, {index}",
                   scene_of(a, (size_b, [0, 0, 0], quaternion), displacement), (p,))


def deep():
    """Aligned boxes deep in each other, one of them a thin rod or a sheet, where EPA found new vertices on a line."""
    draw = random.Random(103)
    for name, size in (("rod", [0.015, 0.41, 0.015]), ("sheet", [0.36, 0.002, 0.27]), ("cube", [0.1, 0.1, 0.1])):
        block = rounded(draw.uniform(0.25, 0.6) for _ in range(3))
        offset = [0.5 * draw.uniform(-0.9, 0.9) * (s + t) for s, t in zip(size, block)]
        place = rounded(draw.uniform(-1, 1) for _ in range(3))
        a, b = (size, plus(place, offset), STILL), (block, place, STILL)
        yield still(f"a {name} deep in a block", a, b)
        sigma = round(draw.uniform(0.05, 0.15), 4)
        p = box_around_mass(plus(size, block), offset, [sigma] * 3)
        yield Case(f"a {name} in a block, moved", scene_of(a, b, {"sigma": [sigma] * 3}), (p,))


def nearly_parallel():
    """Faces some thousandths to billionths of a radian from parallel, micrometres deep or apart."""
    draw = random.Random(104)
    for angle, depth in ((3e-3, 4e-5), (2e-4, 2e-5), (1e-6, -3e-5), (1e-9, 5e-6)):
        heading = round(draw.uniform(0.2, 1.2), 4)
        size_a, size_b = [0.21, 0.13, 0.3], [0.012, 0.7, 0.2]
        a_turn, b_turn = turn([0, 0, 1], heading + angle), turn([0, 0, 1], heading)
        # The two faces meet at the corner that the small turn brings forward.
        reach = 0.5 * size_a[0] * math.cos(angle) + 0.5 * size_a[1] * math.sin(angle) + 0.5 * size_b[0]
        normal = axes_of(b_turn)[0]
        a = (size_a, [(reach - depth) * x for x in normal], a_turn)
        b = (size_b, [0.0, 0.0, 0.0], b_turn)
        yield still(f"faces {angle} rad from parallel, {depth} m deep, at rest", a, b)
        for axis in "xy":
            yield along(f"faces {angle} rad from parallel, {depth} m deep, along {axis}", a, b, AXES[axis], 2.5e-4)


def plates():
    """A thin plate and a box at any angle, deep, touching or apart: degenerate triangles, NaN for nearest points."""
    draw = random.Random(105)
    for index in range(4):
        plate = rounded([draw.uniform(0.4, 3), draw.uniform(0.4, 6), draw.uniform(0.005, 0.05)])
        size = rounded(draw.uniform(0.04, 0.4) for _ in range(3))
        quaternion = unit([draw.gauss(0, 1) for _ in range(4)])
        a = (plate, rounded(draw.uniform(-1, 1) for _ in range(3)), STILL)
        # Beside the edge of the plate or above it, in turn.
        edge = 0.5 * plate[0] if index % 2 else 0.3 * plate[0]
        height = 0.45 * sum(size) * (0.2 if index % 2 else 0.8)
        b = (size, plus(a[1], [edge + 0.3 * size[0], 0.1, height]), quaternion)
        sigma = round(draw.uniform(0.01, 0.05), 4)
        yield still(f"plate {index} and a turned box", a, b)
        for axis in "xyz":
            yield along(f"plate {index} and a turned box along {axis}", a, b, AXES[axis], sigma)


def equally_turned():
    """Equal cubes turned alike whose faces or edges just touch: the origin is on the surface of what GJK looks at."""
    draw = random.Random(106)
    for index, shift in enumerate(([1, 0, 0], [0, 1, 0.25], [0.5, -0.5, 1])):
        side = round(draw.uniform(0.2, 0.8), 3)
        quaternion = turn([draw.gauss(0, 1) for _ in range(3)], round(draw.uniform(0.1, 0.6), 4))
        b = ([side] * 3, [2, round(draw.uniform(-1, 1), 3), 1.5], quaternion)
        a = ([side] * 3, plus(b[1], turned(quaternion, [side * s for s in shift])), quaternion)
        for axis in "xyz":
            yield along(f"equal cubes that just touch, {index}, along {axis}", a, b, AXES[axis], 0.02)


def quarter_turns():
    """A small box whose axes are those of the world in another order, beside a long wall."""
    draw = random.Random(107)
    for index, quaternion in enumerate(([0.5, 0.5, 0.5, 0.5], [0.5, -0.5, 0.5, -0.5], [0.5, 0.5, -0.5, 0.5])):
        wall, size = [4.4, 0.09, 1.9], [0.11, 0.25, 0.42]
        sides = [sum(abs(axis[i]) * s for axis, s in zip(axes_of(quaternion), size)) for i in range(3)]
        sigma, deviations = 0.012, round(draw.uniform(0.5, 3), 3)
        b = (wall, rounded(draw.uniform(-1, 1) for _ in range(3)), STILL)
        a = (size, plus(b[1], [1.1, -0.5 * (sides[1] + wall[1]) - deviations * sigma, -0.4]), quaternion)
        p = between(deviations, deviations + (sides[1] + wall[1]) / sigma)
        yield Case(f"quarter turns {index} beside a wall", scene_of(a, b, {"sigma": [0, sigma, 0]}), (p,))


def cases():
    for family in (gaps, all_axes, deep, nearly_parallel, plates, equally_turned, quarter_turns):
        yield from family()
