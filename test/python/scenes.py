# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""What several tests ask about."""
import math
import os
import pathlib

import numpy as np
import pytest

import fcl_prob

SOURCE_DIR = pathlib.Path(os.environ["FCL_PROB_SOURCE_DIR"])
DATA = SOURCE_DIR / "data"

needs_io = pytest.mark.skipif(os.environ["FCL_PROB_WITH_IO"] == "0", reason="built without assimp")
needs_robot = pytest.mark.skipif(os.environ["FCL_PROB_WITH_ROBOT"] == "0", reason="built without robots")
needs_planning = pytest.mark.skipif(os.environ["FCL_PROB_WITH_PLANNING"] == "0", reason="built without planning")
needs_command = pytest.mark.skipif("FCL_PROB_CLI" not in os.environ, reason="built without the command")

PART = fcl_prob.Box(0.4, 0.3, 0.2)
FIXTURE = fcl_prob.Box(0.4, 0.4, 0.25)
ERROR = fcl_prob.GaussianDisplacement.from_standard_deviations([0.08, 0.05, 0.02])


def normal(x: float) -> float:
    """P(N(0, 1) < x), also far out."""
    return 0.5 * math.erfc(-x / math.sqrt(2.0))


def boxes_truth(distance: float) -> float:
    """P of PART at (distance, 0, 0) touching FIXTURE with ERROR: a product of intervals."""

    def within(half: float, mean: float, sigma: float) -> float:
        return normal((half - mean) / sigma) - normal((-half - mean) / sigma)

    return within(0.4, distance, 0.08) * within(0.35, 0.0, 0.05) * within(0.225, 0.0, 0.02)


def pose(x: float, y: float = 0.0, z: float = 0.0) -> np.ndarray:
    result = np.eye(4)
    result[:3, 3] = x, y, z
    return result


def box_mesh(x: float, y: float, z: float) -> tuple:
    """Vertices and triangles of a closed box."""
    vertices = np.array([[i, j, k] for i in (-x, x) for j in (-y, y) for k in (-z, z)]) / 2.0
    triangles = np.array(
        [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
        + [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    )
    return vertices, triangles


def torus(rings: int = 24, sides: int = 12) -> fcl_prob.Mesh:
    """A mesh that is not convex, 0.4 m across."""
    u, v = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    a, b = 2 * np.pi * u / rings, 2 * np.pi * v / sides
    around = 0.15 + 0.05 * np.cos(b)
    vertices = np.stack([around * np.cos(a), around * np.sin(a), 0.05 * np.sin(b)], axis=-1)

    def index(i, j):
        return (i % rings) * sides + j % sides

    first = np.stack([index(u, v), index(u + 1, v), index(u + 1, v + 1)], axis=-1)
    second = np.stack([index(u, v), index(u + 1, v + 1), index(u, v + 1)], axis=-1)
    return fcl_prob.Mesh(vertices.reshape(-1, 3), np.concatenate([first, second]).reshape(-1, 3))
