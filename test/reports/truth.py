# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""What the answers are compared with: closed forms in plain Python, none of them from the library."""
import math


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus(a, b, factor=1.0):
    """a + factor b"""
    return [x + factor * y for x, y in zip(a, b)]


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return [x / length(a) for x in a]


def turn(axis, angle):
    """The quaternion w, x, y, z of a rotation about an axis."""
    return [math.cos(angle / 2)] + [math.sin(angle / 2) * x for x in unit(axis)]


def axes_of(quaternion):
    """The turned x, y and z axes: the columns of the rotation matrix."""
    w, x, y, z = unit(quaternion)
    return [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
            [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
            [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]]


def turned(quaternion, v):
    columns = axes_of(quaternion)
    return [sum(columns[k][i] * v[k] for k in range(3)) for i in range(3)]


def below(x):
    """The standard normal distribution function."""
    return 0.5 * math.erfc(-x / math.sqrt(2))


def between(low, high):
    """Mass of the standard normal distribution; from the nearer tail, so that small ones keep their digits."""
    if high <= low:
        return 0.0
    return below(-low) - below(-high) if low > 0 else below(high) - below(low)


def mass(interval, sigma):
    """P that a displacement of this deviation along a line is in the interval; of none: whether 0 is in it."""
    low, high = interval
    if sigma == 0:
        return float(low <= 0 <= high)
    return between(low / sigma, high / sigma)


def box_axes(box):
    """The half sides of a box (size, centre, quaternion), as vectors."""
    return [[0.5 * s * x for x in axis] for s, axis in zip(box[0], axes_of(box[2]))]


def boxes_touch_along(a, b, direction):
    """The t for which box a moved by t direction touches box b: every one of the 15 axes of the separating axis
    theorem allows an interval of t."""
    sides_a, sides_b = box_axes(a), box_axes(b)
    normals = [unit(s) for s in sides_a + sides_b]
    for s in sides_a:
        for t in sides_b:
            n = cross(unit(s), unit(t))
            # Parallel edges have no axis of their own: the faces' axes say all.
            if length(n) > 1e-9:
                normals.append(unit(n))
    apart = plus(a[1], b[1], -1.0)
    low, high = -math.inf, math.inf
    for n in normals:
        reach = sum(abs(dot(n, s)) for s in sides_a + sides_b)
        start, speed = dot(n, apart), dot(n, direction)
        if abs(speed) < 1e-12:
            if abs(start) > reach:
                return (0.0, -1.0)
            continue
        ends = sorted(((-reach - start) / speed, (reach - start) / speed))
        low, high = max(low, ends[0]), min(high, ends[1])
    return (low, high)


def disc_meets_line(radius, centre, direction):
    """The t for which t direction is in a disc or ball, an empty interval if there is none."""
    along = dot(centre, direction)
    squared = radius * radius - dot(centre, centre) + along * along
    if squared < 0:
        return (math.inf, -math.inf)
    return (along - math.sqrt(squared), along + math.sqrt(squared))


def rectangle_meets_line(half, centre, direction):
    low, high = -math.inf, math.inf
    for h, c, d in zip(half, centre, direction):
        if abs(d) < 1e-15:
            if abs(c) > h:
                return (math.inf, -math.inf)
            continue
        ends = sorted(((c - h) / d, (c + h) / d))
        low, high = max(low, ends[0]), min(high, ends[1])
    return (low, high) if low <= high else (math.inf, -math.inf)


def hull(intervals):
    return (min(i[0] for i in intervals), max(i[1] for i in intervals))


def disc_and_rectangle_touch(radius, half, centre, direction):
    """The t for which a disc, moved from the origin by t direction, touches a rectangle along the axes. Within the
    rounded rectangle, which is convex, a line meets two rectangles and the discs of the corners."""
    x, y = half
    pieces = [rectangle_meets_line((x + radius, y), centre, direction),
              rectangle_meets_line((x, y + radius), centre, direction)]
    pieces += [disc_meets_line(radius, (centre[0] + i * x, centre[1] + j * y), direction)
               for i in (-1, 1) for j in (-1, 1)]
    return hull(pieces)


def reach_of(shape, size, n):
    """The support function of a shape about its own centre, n a unit vector in the frame of the shape."""
    rim = math.hypot(n[0], n[1])
    if shape == "sphere":
        return size
    if shape == "box":
        return sum(0.5 * s * abs(x) for s, x in zip(size, n))
    if shape == "ellipsoid":
        return math.sqrt(sum((s * x) ** 2 for s, x in zip(size, n)))
    radius, half = size["radius"], 0.5 * size["length"]
    if shape == "cylinder":
        return radius * rim + half * abs(n[2])
    if shape == "capsule":
        return radius + half * abs(n[2])
    if shape == "cone":  # the tip above, the disc below
        return max(half * n[2], radius * rim - half * n[2])
    raise ValueError(shape)


def reach_along(shape, size, quaternion, n):
    """The same for a turned shape and a direction of the world."""
    return reach_of(shape, size, [dot(axis, n) for axis in axes_of(quaternion)])


def box_around_mass(sizes, offset, sigmas):
    """P that two boxes along the axes touch: size sums, offset of the moved one, a deviation for each axis."""
    p = 1.0
    for s, o, sigma in zip(sizes, offset, sigmas):
        p *= mass((-0.5 * s - o, 0.5 * s - o), sigma)
    return p


def shell_mass(low, high, half, centre, sigmas):
    """P that a box of these half sides, moved, touches the surface of the brick from low to high: it overlaps the
    brick and is not wholly inside."""
    outer, inner = 1.0, 1.0
    for l, h, r, c, s in zip(low, high, half, centre, sigmas):
        outer *= mass((l - r - c, h + r - c), s)
        inner *= mass((l + r - c, h - r - c), s)
    return outer - inner
