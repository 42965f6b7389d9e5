# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
from typing import Callable, Mapping, Optional, Sequence, Tuple, Union

from ._core import PoseError
from ._robot import RobotQuery, SelfCollision, Values
from ._types import FloatArray, Numbers

PlanProgress = Callable[[int, float, bool], Optional[bool]]

class Plan:
    @property
    def status(self) -> str: ...
    @property
    def waypoints(self) -> FloatArray: ...
    @property
    def length(self) -> float: ...
    @property
    def states(self) -> int: ...
    @property
    def state_threshold(self) -> float: ...
    @property
    def largest(self) -> Tuple[float, float]: ...
    @property
    def motion(self) -> Tuple[float, float]: ...

class TimedPlan:
    @property
    def status(self) -> str: ...
    @property
    def times(self) -> FloatArray: ...
    @property
    def waypoints(self) -> FloatArray: ...
    @property
    def arrival(self) -> float: ...
    @property
    def length(self) -> float: ...
    @property
    def states(self) -> int: ...
    @property
    def largest(self) -> Tuple[float, float]: ...
    @property
    def likeliest_time(self) -> float: ...

def plan(
    query: RobotQuery,
    start: Values,
    goal: Values,
    threshold: float,
    self_collision: Optional[SelfCollision] = None,
    motion_threshold: Optional[float] = None,
    *,
    joints: Sequence[str] = ...,
    joint_error: Union[None, Numbers, Mapping[str, float]] = None,
    base_error: Optional[PoseError] = None,
    largest_step: float = 0.05,
    seed: int = 1,
    max_states: int = 200_000,
    time_limit: Optional[float] = None,
    shorten: bool = True,
    descend: bool = True,
    max_cells: int = 2_000,
    on_progress: Optional[PlanProgress] = None,
) -> Plan: ...
def plan_in_time(
    query: RobotQuery,
    start: Values,
    goal: Values,
    threshold: float,
    self_collision: Optional[SelfCollision] = None,
    *,
    joints: Sequence[str] = ...,
    joint_error: Union[None, Numbers, Mapping[str, float]] = None,
    base_error: Optional[PoseError] = None,
    largest_step: float = 0.05,
    largest_time_step: float = 0.05,
    start_time: float = 0.0,
    hold: float = 0.0,
    latest: Optional[float] = None,
    velocities: Mapping[str, float] = ...,
    velocity_scale: float = 1.0,
    seed: int = 1,
    max_states: int = 200_000,
    time_limit: Optional[float] = None,
    shorten: bool = True,
    max_cells: int = 2_000,
    on_progress: Optional[PlanProgress] = None,
) -> TimedPlan: ...
