# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""How likely is it that two shapes collide, when the position of one of them is only known up to a
Gaussian error? Lengths are metres, angles radians, frames the world frame.

    import fcl_prob
    part, fixture = fcl_prob.Box(0.4, 0.3, 0.2), fcl_prob.Box(0.4, 0.4, 0.25)
    error = fcl_prob.GaussianDisplacement.from_standard_deviations([0.08, 0.05, 0.02])
    print(fcl_prob.collision_probability(part, fixture, error, pose_a=[0.5, 0, 0]))

`load_mesh` needs the assimp library, `Robot` and what goes with it libxml2 and Orocos KDL, and `plan` OMPL and
NLopt: none is touched before it is used.
"""
from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from ._core import (
    BatchResult,
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    GaussianDisplacement,
    GaussianMixture,
    Geometry,
    GroupQuery,
    Halfspace,
    Mesh,
    MotionGradient,
    Plane,
    PoseError,
    PreparedQuery,
    ProbabilityResult,
    Sphere,
    TruncatedGaussian,
    __version__,
    certified_probability,
    collision_probabilities,
    collision_probability,
)
from ._errors import (
    Error,
    FileError,
    Interrupted,
    InvalidDistribution,
    InvalidGeometry,
    InvalidPose,
    InvalidRequest,
    OpenMesh,
    UnsupportedGeometry,
)

if TYPE_CHECKING:
    from ._io import load_mesh
    from ._planning import Plan, TimedPlan, plan, plan_in_time
    from ._robot import (
        JointGradient,
        ProbableResult,
        Robot,
        RobotGroup,
        RobotQuery,
        RobotResult,
        SelfCollision,
        load_groups,
        load_robot_scene,
    )

__all__ = [
    "BatchResult",
    "Box",
    "Capsule",
    "Cone",
    "Cylinder",
    "Ellipsoid",
    "Error",
    "FileError",
    "GaussianDisplacement",
    "GaussianMixture",
    "Geometry",
    "GroupQuery",
    "Halfspace",
    "Interrupted",
    "InvalidDistribution",
    "InvalidGeometry",
    "InvalidPose",
    "InvalidRequest",
    "JointGradient",
    "Mesh",
    "MotionGradient",
    "OpenMesh",
    "Plan",
    "Plane",
    "PoseError",
    "PreparedQuery",
    "ProbabilityResult",
    "ProbableResult",
    "Robot",
    "RobotGroup",
    "RobotQuery",
    "RobotResult",
    "SelfCollision",
    "Sphere",
    "TimedPlan",
    "TruncatedGaussian",
    "UnsupportedGeometry",
    "__version__",
    "certified_probability",
    "collision_probabilities",
    "collision_probability",
    "load_groups",
    "load_mesh",
    "load_robot_scene",
    "plan",
    "plan_in_time",
]

# Each in an extension module of its own, with libraries of its own.
_LATER = {
    "load_mesh": "_io",
    "JointGradient": "_robot",
    "ProbableResult": "_robot",
    "Robot": "_robot",
    "RobotGroup": "_robot",
    "RobotQuery": "_robot",
    "RobotResult": "_robot",
    "SelfCollision": "_robot",
    "load_groups": "_robot",
    "load_robot_scene": "_robot",
    "Plan": "_planning",
    "TimedPlan": "_planning",
    "plan": "_planning",
    "plan_in_time": "_planning",
}


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        module = importlib.import_module(f".{_LATER[name]}", __name__)
    except ImportError as error:
        raise ImportError(
            f"fcl_prob.{name} needs a part that this build or machine does not have: {error}"
        ) from error
    value = getattr(module, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
