# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Cylinders, capsules, cones, ellipsoids and balls: crashes of the narrow phase, turned shapes beside half-spaces,
fingers that touched across a gap, kilometres."""
import math
import random

from boxes import AXES, STILL, rounded
from checks import Case
from truth import (axes_of, below, boxes_touch_along, cross, disc_and_rectangle_touch, disc_meets_line, dot, mass, plus,
                   reach_along, turn, turned, unit)

# Six digits are promised of curved pairs.
CURVED = {"relative_tolerance": 1e-6, "absolute_tolerance": 1e-12}
WIDTH = {"width": 2e-6, "narrow": 1e-12}


def placed(kind, size, pose):
    return {kind: size, "pose": list(pose)}


def question(name, a, b, displacement, p):
    scene = {"a": a, "b": b, "displacement": displacement, "request": CURVED}
    return Case(name, scene, (p,), **WIDTH)


def flat(direction, sigma):
    """Errors along one horizontal direction only, x of axes turned about z."""
    angle = math.atan2(direction[1], direction[0])
    return {"sigma": [sigma, 0, 0], "sigma_axes": turn([0, 0, 1], angle)}


def cylinder_beside_box():
    """An upright cylinder beside an upright box whose sides have turned: a disc and a rectangle, seen from above."""
    draw = random.Random(201)
    for index in range(6):
        radius, half = round(draw.uniform(0.05, 0.25), 3), rounded([draw.uniform(0.02, 0.3) for _ in range(2)])
        heading, spin = draw.uniform(-3, 3), draw.uniform(-3, 3)
        box_turn = turn([0, 0, 1], heading)
        # Towards a side for even numbers, past a corner for odd ones.
        beside = 0.6 * radius if index % 2 else -0.5 * half[1]
        away = [-(half[0] + math.sqrt(radius ** 2 - max(beside, 0.0) ** 2) + 0.03), half[1] + beside]
        way = [1.0, 0.0] if index < 2 else unit([draw.uniform(0.8, 1), draw.uniform(-0.3, 0.3)])
        touching = disc_and_rectangle_touch(radius, half, [-x for x in away], way)
        place = turned(box_turn, away + [0.0])
        direction = turned(box_turn, way + [0.0])
        a = placed("cylinder", {"radius": radius, "length": 0.2}, place + turn([0, 0, 1], spin))
        b = placed("box", [2 * half[0], 2 * half[1], 1.4], [0, 0, 0.3] + box_turn)
        yield question(f"cylinder {index} beside a turned box", a, b, flat(direction, 0.02), mass(touching, 0.02))
        if index < 2:
            at_rest = {"sigma": [0, 0, 0]}
            yield question(f"cylinder {index} beside a turned box, at rest", a, b, at_rest, mass(touching, 0))


def grazing():
    """A ball at the side of a cylinder, nanometres to micrometres apart or within: two discs, seen from above."""
    draw = random.Random(202)
    for index, gap in enumerate((-3e-7, 4e-6, -5e-9, 0.0)):
        ball, radius, sigma = (round(draw.uniform(0.02, 0.09), 4) for _ in range(3))
        sigma = 0.02 * sigma
        heading = draw.uniform(-3, 3)
        out = [math.cos(heading), math.sin(heading), 0.0]
        place = [(ball + radius + gap) * x for x in out]
        for way, name in ((0.0, "radially"), (1.3, "obliquely")):
            direction = [math.cos(heading + way), math.sin(heading + way)]
            p = mass(disc_meets_line(ball + radius, [-x for x in place[:2]], direction), sigma)
            a = placed("sphere", ball, plus(place, [0, 0, 0.1]))
            b = placed("cylinder", {"radius": radius, "length": 0.7}, [0, 0, 0])
            yield question(f"a ball {gap} m beside a cylinder, {index}, {name}", a, b, flat(direction, sigma), p)


def capsule_above_box():
    """The lower end of a tilted capsule above or deep below a box's top; its quaternion is of any length."""
    draw = random.Random(203)
    for index, deviations in enumerate((1.2, 3.5, -0.7, -50.0)):
        radius, long, sigma = 12.0, 31.5, 0.4
        quaternion = turn([draw.gauss(0, 1), draw.gauss(0, 1), 0], draw.uniform(0.3, 1.1))
        up = axes_of(quaternion)[2]
        height = 20.0 + 0.5 * long * abs(up[2]) + radius + deviations * sigma
        # The lower end is above the middle of the top.
        place = [0.5 * long * up[0], 0.5 * long * up[1], height]
        b = placed("box", [90.0, 70.0, 40.0], [0, 0, 0])
        for scale in (1.0, round(draw.uniform(0.3, 8.0), 3)):
            pose = place + [scale * x for x in quaternion]
            a = placed("capsule", {"radius": radius, "length": long}, pose)
            yield question(f"capsule {index} above a box, quaternion of length {scale}", a, b,
                           {"sigma": [0, 0, sigma]}, below(-deviations))
        if deviations < -10:
            for name, displacement in (("moved", {"sigma": [sigma] * 3}), ("at rest", {"sigma": [0, 0, 0]})):
                yield question(f"capsule {index} deep in a box, {name}", a, b, displacement, 1.0)


def capsules_of_kilometres():
    """Two crossing capsules of thousands of metres that move along the common normal of their axes."""
    draw = random.Random(204)
    for index, depth in enumerate((-30.0, 0.5, 70.0)):
        radii, lengths = (4100.5, 2750.25), (9000.0, 7400.0)
        turns = [turn([draw.gauss(0, 1) for _ in range(3)], draw.uniform(0.5, 1.5)) for _ in range(2)]
        normal = unit(cross(axes_of(turns[0])[2], axes_of(turns[1])[2]))
        place = [(sum(radii) - depth) * x for x in normal]
        # Not their middles are nearest but points a little beside them.
        shifted = plus(place, axes_of(turns[0])[2], 820.0)
        a = placed("capsule", {"radius": radii[0], "length": lengths[0]}, shifted + turns[0])
        b = placed("capsule", {"radius": radii[1], "length": lengths[1]}, [0, 0, 0] + turns[1])
        sigma = 40.0
        covariance = [sigma ** 2 * normal[i] * normal[j] for i in range(3) for j in range(i, 3)]
        p = mass((depth - 2 * sum(radii), depth), sigma)
        yield question(f"capsules of kilometres, {depth} m deep", a, b, {"covariance": covariance}, p)
        at_rest = {"sigma": [0, 0, 0]}
        yield question(f"capsules of kilometres, {depth} m deep, at rest", a, b, at_rest, float(depth > 0))
        if depth > 50:
            yield question("capsules of kilometres, deep, moved a metre", a, b, {"sigma": [1, 1, 1]}, 1.0)


SHAPES = {"cylinder": {"radius": 0.12, "length": 0.26}, "capsule": {"radius": 0.07, "length": 0.15},
          "cone": {"radius": 0.11, "length": 0.24}, "box": [0.18, 0.3, 0.22], "ellipsoid": [0.13, 0.21, 0.08],
          "sphere": 0.13}


def shapes_and_halfspaces():
    """Any shape beside a half-space: upright, over head and tilted both ways. Only the cone knows which way is up."""
    draw = random.Random(205)
    for kind, size in SHAPES.items():
        tilt = turn([draw.gauss(0, 1), draw.gauss(0, 1), 0], 0.55)
        over = turn([1, 0, 0], math.pi)
        head = [draw.uniform(-0.2, 0.2), 0.1]
        for name, quaternion in (("upright", STILL), ("over head", [0.0, 1.0, 0.0, 0.0]), ("tilted", tilt),
                                 ("tilted, over head", product(tilt, over))):
            reach = reach_along(kind, size, quaternion, [0, 0, -1.0])
            sigma, height = 0.025, 0.165
            a = placed(kind, size, head + [height] + list(quaternion))
            b = {"halfspace": {"normal": [0, 0, 2.5], "offset": 0}}
            yield question(f"{kind} {name} above a half-space", a, b, {"sigma": [0, 0, sigma]},
                           below((reach - height) / sigma))
        yield beside_oblique(kind, size, tilt, draw)


def product(p, q):
    """The rotation q, then p."""
    w, v = p[0] * q[0] - dot(p[1:], q[1:]), cross(p[1:], q[1:])
    return [w] + plus(plus(v, q[1:], p[0]), p[1:], q[0])


def beside_oblique(kind, size, quaternion, draw):
    """A plane of any direction, errors in all: only those along its normal count, and both sides of it touch."""
    normal = unit([draw.gauss(0, 1) for _ in range(3)])
    sigma = rounded(draw.uniform(0.01, 0.06) for _ in range(3))
    deviation = math.sqrt(sum((n * s) ** 2 for n, s in zip(normal, sigma)))
    place, offset = rounded(draw.uniform(-1, 1) for _ in range(3)), 0.4
    front = reach_along(kind, size, quaternion, [-n for n in normal])
    back = reach_along(kind, size, quaternion, normal)
    # One to two deviations in front of the plane.
    place = plus(place, normal, offset + front + draw.uniform(1, 2) * deviation - dot(normal, place))
    away = dot(normal, place) - offset
    b = {"plane": {"normal": normal, "offset": offset}}
    return question(f"{kind} in front of an oblique plane", placed(kind, size, place + list(quaternion)), b,
                    {"sigma": sigma}, mass((-back - away, front - away), deviation))


def fingers():
    """Thin cylinders like fingers, tilted in one plane and moved in it. Both are symmetric about that plane, and so is
    their difference: it is enough to look at their sections, which are rectangles."""
    for tilt in (0.1, 0.23):
        for name, tilts in (("towards each other", (tilt, -tilt)), ("one of them", (0.0, tilt)),
                            ("alike", (-tilt, -tilt)), ("apart", (-tilt, tilt))):
            radius, long, sigma = 0.008, 0.11, 0.004
            turns = [turn([0, 1, 0], t) for t in tilts]
            away = [-0.02 - long * tilt, 0.0, 0.012]
            section = [2 * radius, 1.0, long]
            p = mass(boxes_touch_along((section, away, turns[0]), (section, [0, 0, 0], turns[1]), AXES["x"]), sigma)
            size = {"radius": radius, "length": long}
            yield question(f"fingers tilted by {tilt}, {name}", placed("cylinder", size, away + turns[0]),
                           placed("cylinder", size, [0, 0, 0] + turns[1]), {"sigma": [sigma, 0, 0]}, p)


def cases():
    for family in (cylinder_beside_box, grazing, capsule_above_box, capsules_of_kilometres, shapes_and_halfspaces,
                   fingers):
        yield from family()
