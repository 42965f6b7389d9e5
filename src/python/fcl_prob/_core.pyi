# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
from typing import Any, Callable, List, Optional, Sequence, Tuple, Union

from ._types import AnyMesh, FloatArray, IntArray, NameArray, Numbers

__version__: str

class Geometry: ...

class Mesh(Geometry):
    def __init__(self, vertices: Union[Numbers, AnyMesh], triangles: Optional[Numbers] = None) -> None: ...
    @property
    def vertices(self) -> FloatArray: ...
    @property
    def triangles(self) -> IntArray: ...
    @property
    def notes(self) -> List[str]: ...
    @property
    def coordinate_error(self) -> float: ...

class Box(Geometry):
    def __init__(self, x: float, y: float, z: float) -> None: ...
    @property
    def sides(self) -> FloatArray: ...

class Ellipsoid(Geometry):
    def __init__(self, x: float, y: float, z: float) -> None: ...
    @property
    def radii(self) -> FloatArray: ...

class Sphere(Geometry):
    def __init__(self, radius: float) -> None: ...
    @property
    def radius(self) -> float: ...

class Capsule(Geometry):
    def __init__(self, radius: float, length: float) -> None: ...
    @property
    def radius(self) -> float: ...
    @property
    def length(self) -> float: ...

class Cone(Geometry):
    def __init__(self, radius: float, length: float) -> None: ...
    @property
    def radius(self) -> float: ...
    @property
    def length(self) -> float: ...

class Cylinder(Geometry):
    def __init__(self, radius: float, length: float) -> None: ...
    @property
    def radius(self) -> float: ...
    @property
    def length(self) -> float: ...

class Halfspace(Geometry):
    def __init__(self, normal: Numbers, offset: float) -> None: ...
    @property
    def normal(self) -> FloatArray: ...
    @property
    def offset(self) -> float: ...

class Plane(Geometry):
    def __init__(self, normal: Numbers, offset: float) -> None: ...
    @property
    def normal(self) -> FloatArray: ...
    @property
    def offset(self) -> float: ...

class GaussianDisplacement:
    def __init__(self, covariance: Numbers = ..., mean: Optional[Numbers] = None) -> None: ...
    @staticmethod
    def from_standard_deviations(
        standard_deviations: Numbers, axes: Optional[Numbers] = None, mean: Optional[Numbers] = None
    ) -> GaussianDisplacement: ...
    @staticmethod
    def from_independent(of_a: GaussianDisplacement, of_b: GaussianDisplacement) -> GaussianDisplacement: ...
    @property
    def mean(self) -> FloatArray: ...
    @property
    def covariance(self) -> FloatArray: ...
    @property
    def standard_deviations(self) -> FloatArray: ...
    @property
    def axes(self) -> FloatArray: ...
    @property
    def rank(self) -> int: ...
    def with_mean(self, mean: Numbers) -> GaussianDisplacement: ...
    def reversed(self) -> GaussianDisplacement: ...
    def rotated(self, rotation: Numbers) -> GaussianDisplacement: ...

class GaussianMixture:
    def __init__(self, weights: Sequence[float], displacements: Sequence[GaussianDisplacement]) -> None: ...
    @property
    def weights(self) -> FloatArray: ...
    @property
    def displacements(self) -> list[GaussianDisplacement]: ...

class TruncatedGaussian:
    def __init__(self, gaussian: GaussianDisplacement, deviations: float) -> None: ...
    @property
    def gaussian(self) -> GaussianDisplacement: ...
    @property
    def deviations(self) -> float: ...

class PoseError:
    def __init__(self, covariance: Numbers, convention: str = "world", mean: Optional[Numbers] = None) -> None: ...
    @staticmethod
    def from_standard_deviations(
        translation: Numbers, rotation: Numbers, convention: str = "world"
    ) -> PoseError: ...
    @staticmethod
    def from_independent(
        translation: GaussianDisplacement, rotation_covariance: Numbers, convention: str = "world"
    ) -> PoseError: ...
    @staticmethod
    def from_ros_covariance(covariance: Numbers) -> PoseError: ...
    @staticmethod
    def between_bodies(
        of_a: PoseError, pose_a: Optional[Numbers], of_b: PoseError, pose_b: Optional[Numbers]
    ) -> PoseError: ...
    @property
    def covariance(self) -> FloatArray: ...
    @property
    def mean(self) -> FloatArray: ...
    @property
    def convention(self) -> str: ...
    @property
    def rotation_rank(self) -> int: ...

Displacement = Union[GaussianDisplacement, GaussianMixture, TruncatedGaussian, PoseError]
QueryProgress = Callable[[Tuple[float, float], float, float], Optional[bool]]
BatchProgress = Callable[[int, int], Optional[bool]]

class ProbabilityResult:
    @property
    def probability(self) -> float: ...
    @property
    def lower(self) -> Optional[float]: ...
    @property
    def upper(self) -> Optional[float]: ...
    @property
    def estimate(self) -> Optional[float]: ...
    @property
    def standard_error(self) -> Optional[float]: ...
    @property
    def confidence_interval(self) -> Optional[Tuple[float, float]]: ...
    @property
    def gradient(self) -> Optional[FloatArray]: ...
    @property
    def gradient_lower(self) -> Optional[FloatArray]: ...
    @property
    def gradient_upper(self) -> Optional[FloatArray]: ...
    @property
    def gradient_standard_error(self) -> Optional[FloatArray]: ...
    @property
    def decision(self) -> Optional[str]: ...
    @property
    def status(self) -> str: ...
    @property
    def method(self) -> str: ...
    @property
    def plan(self) -> list[str]: ...
    @property
    def statistics(self) -> dict[str, Any]: ...
    def to_dict(self) -> dict[str, Any]: ...
    def __float__(self) -> float: ...

class BatchResult:
    @property
    def probability(self) -> FloatArray: ...
    @property
    def lower(self) -> FloatArray: ...
    @property
    def upper(self) -> FloatArray: ...
    @property
    def estimate(self) -> FloatArray: ...
    @property
    def standard_error(self) -> FloatArray: ...
    @property
    def gradient(self) -> FloatArray: ...
    @property
    def status(self) -> NameArray: ...
    @property
    def decision(self) -> NameArray: ...
    @property
    def done(self) -> int: ...
    @property
    def cancelled(self) -> bool: ...
    @property
    def path(self) -> Tuple[float, float]: ...
    def to_dict(self) -> dict[str, Any]: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> Optional[ProbabilityResult]: ...

def certified_probability(
    a: Union[Geometry, AnyMesh],
    b: Union[Geometry, AnyMesh],
    displacement: GaussianDisplacement,
    pose_a: Optional[Numbers] = None,
    pose_b: Optional[Numbers] = None,
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
    band_a: Union[float, Tuple[float, float]] = 0.0,
    band_b: Union[float, Tuple[float, float]] = 0.0,
    on_progress: Optional[QueryProgress] = None,
) -> Tuple[ProbabilityResult, str]: ...
def collision_probability(
    a: Union[Geometry, AnyMesh],
    b: Union[Geometry, AnyMesh],
    displacement: Displacement,
    pose_a: Optional[Numbers] = None,
    pose_b: Optional[Numbers] = None,
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
    band_a: Union[float, Tuple[float, float]] = 0.0,
    band_b: Union[float, Tuple[float, float]] = 0.0,
    on_progress: Optional[QueryProgress] = None,
) -> ProbabilityResult: ...
def collision_probabilities(
    a: Union[Geometry, AnyMesh],
    b: Union[Geometry, AnyMesh],
    displacement: Union[Displacement, Sequence[Displacement], None] = None,
    pose_a: Optional[Numbers] = None,
    pose_b: Optional[Numbers] = None,
    *,
    covariances: Optional[Numbers] = None,
    means: Optional[Numbers] = None,
    convention: str = "world",
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
    threads: int = ...,
    gradient: bool = False,
    band_a: Union[float, Tuple[float, float]] = 0.0,
    band_b: Union[float, Tuple[float, float]] = 0.0,
    on_progress: Optional[BatchProgress] = None,
) -> BatchResult: ...

class PreparedQuery:
    def __init__(self, a: Union[Geometry, AnyMesh], b: Union[Geometry, AnyMesh]) -> None: ...
    def collision_probability(
        self,
        displacement: Displacement,
        pose_a: Optional[Numbers] = None,
        pose_b: Optional[Numbers] = None,
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
        band_a: Union[float, Tuple[float, float]] = 0.0,
        band_b: Union[float, Tuple[float, float]] = 0.0,
        on_progress: Optional[QueryProgress] = None,
    ) -> ProbabilityResult: ...
    def collision_probabilities(
        self,
        displacement: Union[Displacement, Sequence[Displacement], None] = None,
        pose_a: Optional[Numbers] = None,
        pose_b: Optional[Numbers] = None,
        *,
        covariances: Optional[Numbers] = None,
        means: Optional[Numbers] = None,
        convention: str = "world",
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
        threads: int = ...,
        gradient: bool = False,
        band_a: Union[float, Tuple[float, float]] = 0.0,
        band_b: Union[float, Tuple[float, float]] = 0.0,
        on_progress: Optional[BatchProgress] = None,
    ) -> BatchResult: ...

class GroupQuery:
    def __init__(
        self, group_a: Sequence[Union[Geometry, AnyMesh]], group_b: Sequence[Union[Geometry, AnyMesh]]
    ) -> None: ...
    def collision_probability(
        self,
        displacement: Displacement,
        poses_a: Optional[Numbers] = None,
        poses_b: Optional[Numbers] = None,
        *,
        frame: Optional[Numbers] = None,
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
        band_a: Union[float, Tuple[float, float]] = 0.0,
        band_b: Union[float, Tuple[float, float]] = 0.0,
        on_progress: Optional[QueryProgress] = None,
    ) -> ProbabilityResult: ...
    def motion_gradient(
        self,
        displacement: GaussianDisplacement,
        poses_a: Optional[Numbers] = None,
        poses_b: Optional[Numbers] = None,
        *,
        velocities: Optional[Numbers] = None,
        contact: str = "fcl",
        lines: int = 4096,
        seed: int = 1,
        threads: int = 1,
        time_limit: Optional[float] = None,
        on_progress: Optional[QueryProgress] = None,
    ) -> MotionGradient: ...

class MotionGradient:
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
