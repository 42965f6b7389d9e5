# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""What the package raises. Every message names the offending value; nothing is silently repaired."""
from __future__ import annotations

from typing import TYPE_CHECKING, Union

if TYPE_CHECKING:
    from ._core import BatchResult, ProbabilityResult


class Error(Exception):
    """Base of all errors of this package, but for what Python itself raises (TypeError, ...)."""


class InvalidDistribution(Error, ValueError):
    """A mean or covariance that is not finite, symmetric and positive semidefinite; weights that are
    no distribution."""


class InvalidPose(Error, ValueError):
    """A pose that is not finite or not rigid."""


class InvalidGeometry(Error, ValueError):
    """A geometry that is empty, or has vertices that are not finite or indices out of range."""


class UnsupportedGeometry(Error, ValueError):
    """A geometry, or a pair of geometries, that the chosen method cannot handle."""


class OpenMesh(Error, ValueError):
    """contact='solid' was asked of a mesh that is not closed."""


class InvalidRequest(Error, ValueError):
    """A field of a request that is out of its range, or fields that contradict each other."""


class FileError(Error, OSError):
    """A file that cannot be read, or is not what it says it is."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a query. `result` is what was certain by then: its interval is valid."""

    def __init__(self, result: Union["ProbabilityResult", "BatchResult"]) -> None:
        super().__init__(f"interrupted; by then: {result!r}")
        self.result = result

    def __reduce__(self) -> tuple[type[Interrupted], tuple[object]]:
        return type(self), (self.result,)
