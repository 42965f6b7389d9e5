# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
import os
from typing import Any, Mapping, Optional, Sequence, Tuple, Union

from ._core import (
    GaussianDisplacement,
    GaussianMixture,
    Geometry,
    PoseError,
    ProbabilityResult,
    QueryProgress,
    TruncatedGaussian,
)
from ._types import AnyMesh, FloatArray, Numbers

Values = Union[Numbers, Mapping[str, float]]
Translation = Union[GaussianDisplacement, GaussianMixture, TruncatedGaussian]
Body = Union[Geometry, AnyMesh]
Bodies = Union[Body, list[Tuple[Body, Numbers]]]
Prediction = Sequence[Tuple[float, Numbers, GaussianDisplacement]]
Obstacle = Union[
    Tuple[str, Bodies, Translation],
    Tuple[str, Bodies, Translation, Optional[Numbers]],
    Tuple[str, Bodies, Translation, Optional[Numbers], Prediction],
]

class Robot:
    def __init__(
        self,
        urdf: Union[str, os.PathLike[str]],
        packages: Mapping[str, str] = ...,
        links: Sequence[str] = ...,
        base: Optional[Numbers] = None,
        allow_outside_limits: bool = False,
    ) -> None: ...
    @staticmethod
    def from_text(
        urdf_text: str,
        packages: Mapping[str, str] = ...,
        links: Sequence[str] = ...,
        base: Optional[Numbers] = None,
        allow_outside_limits: bool = False,
        folder: Union[None, str, os.PathLike[str]] = None,
    ) -> Robot: ...
    @property
    def name(self) -> str: ...
    @property
    def joints(self) -> list[str]: ...
    @property
    def limits(self) -> FloatArray: ...
    @property
    def velocities(self) -> FloatArray: ...
    @property
    def bodies(self) -> list[Tuple[str, str, Geometry, FloatArray]]: ...
    def carrying_joints(
        self, body: int, values: Values
    ) -> list[Tuple[str, float, bool, FloatArray, FloatArray]]: ...
    @property
    def links(self) -> list[str]: ...
    @property
    def links_without_body(self) -> list[str]: ...
    @property
    def notes(self) -> list[str]: ...
    def values(self, by_name: Mapping[str, float]) -> FloatArray: ...
    def poses(self, values: Values) -> list[FloatArray]: ...
    def link_pose(self, link: str, values: Values) -> FloatArray: ...
    def with_attached(
        self,
        name: str,
        link: str,
        geometry: Union[Geometry, AnyMesh],
        pose: Optional[Numbers] = None,
        touch_links: Sequence[str] = ...,
    ) -> Robot: ...

class RobotResult:
    @property
    def probability(self) -> float: ...
    @property
    def lower(self) -> float: ...
    @property
    def upper(self) -> float: ...
    @property
    def estimate(self) -> Optional[float]: ...
    @property
    def standard_error(self) -> Optional[float]: ...
    @property
    def confidence_interval(self) -> Optional[Tuple[float, float]]: ...
    @property
    def decision(self) -> Optional[str]: ...
    @property
    def status(self) -> str: ...
    @property
    def parts(self) -> list[ProbabilityResult]: ...
    @property
    def plan(self) -> list[str]: ...
    @property
    def by_waypoint(self) -> list[Tuple[float, float]]: ...
    @property
    def any_dependence(self) -> Optional[Tuple[float, float]]: ...
    @property
    def swept_band(self) -> Optional[float]: ...
    @property
    def far_bodies(self) -> int: ...
    @property
    def far_upper(self) -> float: ...
    def to_dict(self) -> dict[str, Any]: ...
    def __float__(self) -> float: ...

class RobotQuery:
    def __init__(
        self,
        robot: Robot,
        obstacles: Sequence[Obstacle],
        allowed: Sequence[Tuple[str, str]] = ...,
    ) -> None: ...
    @property
    def robot(self) -> Robot: ...
    def with_obstacles(self, obstacles: Sequence[Obstacle]) -> RobotQuery: ...
    def at(self, time: float) -> RobotQuery: ...
    def decide_states(
        self,
        states: Union[Numbers, Sequence[Values]],
        threshold: float,
        chance_of_error: Optional[float] = None,
        *,
        joint_error: Union[None, Numbers, Mapping[str, float]] = None,
        base_error: Optional[PoseError] = None,
        contact: str = "fcl",
        time_limit: Optional[float] = None,
        max_cells: int = ...,
        max_memory: int = ...,
        seed: int = 1,
        threads: int = 1,
        on_progress: Optional[QueryProgress] = None,
    ) -> list[str]: ...
    def state(
        self,
        values: Values,
        *,
        joint_error: Union[None, Numbers, Mapping[str, float]] = None,
        base_error: Optional[PoseError] = None,
        method: str = "auto",
        contact: str = "fcl",
        relative_tolerance: float = 0.01,
        absolute_tolerance: float = 1e-6,
        threshold: Optional[float] = None,
        time_limit: Optional[float] = None,
        max_cells: int = ...,
        max_memory: int = ...,
        confidence: float = 0.99,
        samples: int = ...,
        seed: int = 1,
        threads: int = 1,
        gradient: bool = False,
        on_progress: Optional[QueryProgress] = None,
    ) -> RobotResult: ...
    def motion(
        self,
        waypoints: Union[Numbers, Sequence[Values]],
        errors: str = "persistent",
        largest_step: Optional[float] = None,
        between: str = "ignored",
        *,
        joint_error: Union[None, Numbers, Mapping[str, float]] = None,
        base_error: Optional[PoseError] = None,
        method: str = "auto",
        contact: str = "fcl",
        relative_tolerance: float = 0.01,
        absolute_tolerance: float = 1e-6,
        threshold: Optional[float] = None,
        time_limit: Optional[float] = None,
        max_cells: int = ...,
        max_memory: int = ...,
        confidence: float = 0.99,
        samples: int = ...,
        seed: int = 1,
        threads: int = 1,
        gradient: bool = False,
        on_progress: Optional[QueryProgress] = None,
    ) -> RobotResult: ...

    def certified(
        self,
        waypoints: Union[Numbers, Sequence[Values]],
        *,
        method: str = "auto",
        contact: str = "fcl",
        relative_tolerance: float = 0.01,
        absolute_tolerance: float = 1e-6,
        threshold: Optional[float] = None,
        time_limit: Optional[float] = None,
        max_cells: int = ...,
        max_memory: int = ...,
        confidence: float = 0.99,
        samples: int = ...,
        seed: int = 1,
        threads: int = 1,
        gradient: bool = False,
        on_progress: Optional[QueryProgress] = None,
    ) -> Tuple[RobotResult, str]: ...

    def decide_probably(
        self,
        waypoints: Union[Numbers, Sequence[Values]],
        threshold: float,
        chance_of_error: float,
        *,
        contact: str = "fcl",
        time_limit: Optional[float] = None,
        max_cells: int = ...,
        max_memory: int = ...,
        seed: int = 1,
        on_progress: Optional[QueryProgress] = None,
    ) -> ProbableResult: ...
    def gradient(
        self,
        waypoints: Union[Numbers, Sequence[Values]],
        *,
        lines: int = 4096,
        seed: int = 1,
        threads: int = 1,
        time_limit: Optional[float] = None,
        on_progress: Optional[QueryProgress] = None,
    ) -> JointGradient: ...

class JointGradient:
    @property
    def probability(self) -> float: ...
    @property
    def standard_error(self) -> float: ...
    @property
    def gradient(self) -> FloatArray: ...
    @property
    def gradient_standard_error(self) -> FloatArray: ...
    @property
    def lines(self) -> int: ...
    @property
    def status(self) -> str: ...

class ProbableResult:
    @property
    def decision(self) -> str: ...
    @property
    def chance_of_error(self) -> float: ...
    @property
    def certified(self) -> Tuple[float, float]: ...
    @property
    def probable(self) -> Tuple[float, float]: ...
    @property
    def status(self) -> str: ...
    @property
    def cells(self) -> int: ...
    @property
    def samples(self) -> int: ...

class SelfCollision:
    def __init__(
        self, robot: Robot, srdf: Optional[Union[str, os.PathLike[str]]] = None
    ) -> None: ...
    @property
    def pairs(self) -> list[Tuple[str, str]]: ...
    def collides(self, values: Values) -> bool: ...
    def collisions(self, values: Values) -> list[Tuple[str, str]]: ...
    def probability(
        self,
        values: Values,
        joint_error: Union[Numbers, Mapping[str, float]],
        *,
        relative_tolerance: float = 0.01,
        absolute_tolerance: float = 1e-6,
        threshold: Optional[float] = None,
        time_limit: Optional[float] = None,
        confidence: float = 0.99,
        samples: int = 10000,
        seed: int = 1,
        threads: int = 1,
        on_progress: Optional[QueryProgress] = None,
    ) -> ProbabilityResult: ...

class RobotGroup:
    @property
    def joints(self) -> list[str]: ...
    @property
    def links(self) -> list[str]: ...
    @property
    def states(self) -> dict[str, dict[str, float]]: ...

def load_groups(srdf: Union[str, os.PathLike[str]], robot: Robot) -> dict[str, RobotGroup]: ...
def load_robot_scene(path: Union[str, os.PathLike[str]]) -> Tuple[RobotQuery, FloatArray]: ...
