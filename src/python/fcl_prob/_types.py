# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Types of what the package takes and gives; nothing here is needed at run time."""
from __future__ import annotations

from typing import Any, Protocol, Union

import numpy
import numpy.typing

FloatArray = numpy.typing.NDArray[numpy.float64]
IntArray = numpy.typing.NDArray[numpy.int64]
NameArray = numpy.typing.NDArray[numpy.str_]

Numbers = numpy.typing.ArrayLike
"""Real numbers: arrays of any layout, lists."""


class MeshWithFaces(Protocol):
    """As trimesh.Trimesh."""

    @property
    def vertices(self) -> Any: ...

    @property
    def faces(self) -> Any: ...


class MeshWithTriangles(Protocol):
    """As Open3D's TriangleMesh."""

    @property
    def vertices(self) -> Any: ...

    @property
    def triangles(self) -> Any: ...


AnyMesh = Union[MeshWithFaces, MeshWithTriangles]
