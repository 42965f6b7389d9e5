# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Meshes within meshes, margins around them, and files with more than one body."""
import random

from boxes import STILL, rounded
from bricks import TRIANGLES, brick_questions, corner_question, corners, obj, shell_question, text_of
from checks import Case
from truth import between, box_around_mass, shell_mass, turn, turned


def centred(half):
    return obj([-h for h in half], half).encode()


def inside():
    """A mesh wholly within another: as surfaces they touch where the walls meet, as solids they overlap there, too.
    Both are turned alike, with errors that are the same in all directions."""
    draw = random.Random(301)
    for index in range(3):
        small, large = ([draw.uniform(*r) for _ in range(3)] for r in ((0.04, 0.15), (0.5, 1.2)))
        offset = [draw.uniform(-0.6, 0.6) * (b - a) for a, b in zip(small, large)]
        quaternion = STILL if index < 1 else turn([draw.gauss(0, 1) for _ in range(3)], 0.9)
        files = {"small.obj": centred(small), "large.obj": centred(large)}
        low = [-b for b in large]
        shell = shell_mass(low, large, small, offset, [0.4] * 3)
        solid = box_around_mass([2 * (a + b) for a, b in zip(small, large)], offset, [0.4] * 3)
        a = {"mesh": "small.obj", "pose": turned(quaternion, offset) + list(quaternion)}
        b = {"mesh": "large.obj", "pose": [0, 0, 0] + list(quaternion)}
        for contact, moved, still in (("fcl", shell, 0.0), ("solid", solid, 1.0)):
            request = {"contact": contact, "relative_tolerance": 1e-3}
            for name, p, sigma in (("moved", moved, 0.4), ("at rest", still, 0.0)):
                scene = {"a": a, "b": b, "displacement": {"sigma": [sigma] * 3}, "request": request}
                yield Case(f"a mesh within a mesh, {index}, {contact}, {name}", scene, (p,), files=files,
                           width=1e-3, narrow=1e-6)


def within_shape():
    """A mesh within a box that is a shape, which is solid whatever is asked for; and the box within the mesh."""
    small, large = [0.08, 0.05, 0.11], [0.7, 0.9, 0.6]
    for which, p in (("a mesh within a box", 1.0), ("a box within a mesh", 0.0)):
        meshed, boxed = (small, large) if p else (large, small)
        scene = {"a": {"mesh": "brick.obj", "pose": [0.1, -0.2, 0.15]}, "b": {"box": [2 * h for h in boxed]},
                 "displacement": {"sigma": [0, 0, 0]}}
        yield Case(f"{which}, at rest", scene, (p,), files={"brick.obj": centred(meshed)})


def margins():
    """A margin around meshes that was not kept: the interval has to hold P of the shapes and of those within it.
    The faces are parallel and overlap, so the distance along their normal is that of the bodies."""
    draw = random.Random(302)
    for index in range(6):
        k = index % 3
        half = rounded(draw.uniform(0.2, 0.7) for _ in range(3))
        margin, sigma = round(draw.uniform(0.05, 0.8), 3), 0.1
        # For the last, the shapes themselves are out of reach, and lie exactly above each other.
        gap = margin + draw.uniform(-2, 2) * sigma if index < 5 else 1.0
        margin = margin if index < 5 else 0.95
        pose = [0.07 * h if index < 5 else 0.0 for h in half]
        pose[k] = 2 * half[k] + gap
        far = 4 * half[k] + gap
        plain = between(gap / sigma, far / sigma)
        near = between((gap - margin) / sigma, (far + margin) / sigma)
        scene = {"a": {"mesh": "brick.obj", "pose": pose}, "b": {"mesh": "brick.obj"},
                 "displacement": {"sigma": [sigma * float(i == k) for i in range(3)]}}
        scene["ab"[index % 2]]["band"] = [margin, 0]
        yield Case(f"a margin of {margin} m around a mesh, {index}", scene, (plain, near),
                   files={"brick.obj": centred(half)}, narrow=1e-6)


def two_bricks():
    return [([-0.5, 0.25, 0.125], [0.75, 1.0, 0.875]), ([4.5, -0.25, 0.0], [5.5, 1.25, 1.0])]


def obj_of_two(bricks):
    text = "".join(f"o part{i}\n" + obj(low, high, 1 + 8 * i) for i, (low, high) in enumerate(bricks))
    return {"two.obj": text.encode()}


def stl_of_two(bricks):
    text = ""
    for i, (low, high) in enumerate(bricks):
        at = corners(low, high)
        text += f"solid part {i}\n"
        for t in TRIANGLES:
            loop = "".join(f" vertex {text_of(at[c])}\n" for c in t)
            text += f"facet normal 0 0 0\nouter loop\n{loop}endloop\nendfacet\n"
        text += f"endsolid part {i}\n"
    return {"two.stl": text.encode()}


def off_of_two(bricks):
    points = [p for low, high in bricks for p in corners(low, high)]
    faces = [[8 * i + c for c in t] for i in range(2) for t in TRIANGLES]
    text = f"OFF\n{len(points)} {len(faces)} 0\n" + "".join(text_of(p) + "\n" for p in points)
    return {"two.off": (text + "".join(f"3 {a} {b} {c}\n" for a, b, c in faces)).encode()}


def two_in_one_file():
    """Two bodies in one file, of which some readers keep the first or the last."""
    bricks = two_bricks()
    for files in (obj_of_two(bricks), stl_of_two(bricks), off_of_two(bricks)):
        mesh, = files
        for which, (low, high) in zip(("first", "second"), bricks):
            place = [0.5 * (l + h) for l, h in zip(low, high)]
            yield shell_question(f"{mesh}: beside the {which} body", bricks, mesh, files, place, [0.125, 0.0625, 0.25],
                                 [0.3, 0.4, 0.35])
        # Corners of both together: each is that of another body.
        for which, sign, (low, high) in (("first", -1, bricks[0]), ("second", 1, bricks[1])):
            yield corner_question(f"{mesh}: the corner of the {which} body", low, high, mesh, files,
                                  [3.0 * sign, 0.3, -0.2])


def far_from_origin():
    """Coordinates of kilometres with details of millimetres, which single precision would round."""
    draw = random.Random(303)
    base = [4186.0, -2750.5, 310.25]
    low = [b + draw.uniform(0, 0.01) for b in base]
    high = [l + draw.uniform(0.6, 1.4) for l in low]
    yield from brick_questions("a brick kilometres away", low, high, "far.obj", {"far.obj": obj(low, high).encode()})


def cases():
    for family in (inside, within_shape, margins, two_in_one_file, far_from_origin):
        yield from family()
