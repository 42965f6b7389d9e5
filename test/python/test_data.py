# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""What is passed in and out: arrays of every layout, other people's meshes, pickles, errors."""
import copy
import json
import pickle
import warnings

import numpy as np
import pytest
from scenes import ERROR, FIXTURE, PART, box_mesh, pose, torus

import fcl_prob

VERTICES, TRIANGLES = box_mesh(0.4, 0.3, 0.2)


def answer(mesh, at=(0.5, 0.0, 0.0)):
    result = fcl_prob.collision_probability(mesh, FIXTURE, ERROR, at)
    return result.lower, result.upper


def test_layouts_of_arrays_do_not_matter():
    expected = answer(fcl_prob.Mesh(VERTICES, TRIANGLES))
    padded = np.full((16, 6), np.nan)
    padded[::2, ::2] = VERTICES
    read_only = VERTICES.copy()
    read_only.flags.writeable = False
    backwards = VERTICES[::-1].copy()[::-1]
    for vertices in (np.asfortranarray(VERTICES), padded[::2, ::2], read_only, backwards, VERTICES.tolist()):
        for triangles in (TRIANGLES.astype(np.uint8), np.asfortranarray(TRIANGLES), TRIANGLES[::1], TRIANGLES.tolist()):
            assert answer(fcl_prob.Mesh(vertices, triangles)) == expected
    swapped = VERTICES.astype(">f8")
    assert answer(fcl_prob.Mesh(swapped, TRIANGLES.astype(">i4"))) == expected
    halves = np.round(VERTICES * 64) / 64
    assert answer(fcl_prob.Mesh(halves.astype(np.float32), TRIANGLES)) == answer(fcl_prob.Mesh(halves, TRIANGLES))
    many = np.stack([pose(0.5), pose(0.6)])
    for poses in (many, np.asfortranarray(many), many.transpose(0, 2, 1).copy().transpose(0, 2, 1)):
        batch = fcl_prob.collision_probabilities(PART, FIXTURE, ERROR, poses)
        assert batch.lower[1] == answer(PART, pose(0.6))[0]
    assert answer(PART, [0.5, 0, 0, 2, 0, 0, 0]) == answer(PART, pose(0.5)) == answer(PART, (0.5, 0, 0))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PendingDeprecationWarning)
        assert answer(PART, np.matrix(pose(0.5))) == answer(PART, pose(0.5))


def test_six_numbers_of_a_pose_are_angles_about_fixed_axes():
    (sx, sy, sz), (cx, cy, cz) = np.sin([0.4, -0.7, 1.1]), np.cos([0.4, -0.7, 1.1])
    turned = pose(0.5)
    about_z, about_y = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]]), np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    turned[:3, :3] = about_z @ about_y @ [[1, 0, 0], [0, cx, -sx], [0, sx, cx]]
    six = [0.5, 0, 0, 0.4, -0.7, 1.1]
    assert answer(PART, six) == pytest.approx(answer(PART, turned), rel=1e-9)
    assert answer(PART, six) != pytest.approx(answer(PART, pose(0.5)), rel=1e-3)
    batch = fcl_prob.collision_probabilities(PART, FIXTURE, ERROR, [six, [0.6, 0, 0, 0, 0, 0]])
    assert batch.lower.tolist() == [answer(PART, six)[0], answer(PART, pose(0.6))[0]]


def test_a_ros_covariance_is_flat_or_square():
    ros = np.diag([1e-4, 2e-4, 3e-4, 1e-3, 2e-3, 3e-3])
    ros[0, 5] = ros[5, 0] = 1e-4
    flat, square = (fcl_prob.PoseError.from_ros_covariance(form) for form in (ros.ravel(), ros))
    assert np.array_equal(flat.covariance, ros) and np.array_equal(square.covariance, ros)
    assert flat.convention == "world"


def test_memory_is_looked_at_where_it_lies():
    mesh = fcl_prob.Mesh(VERTICES, TRIANGLES)
    assert np.array_equal(mesh.vertices, VERTICES) and np.array_equal(mesh.triangles, TRIANGLES)
    assert mesh.vertices.__array_interface__["data"][0] == mesh.vertices.__array_interface__["data"][0]
    with pytest.raises(ValueError):
        mesh.vertices[0, 0] = 1.0
    kept = mesh.vertices
    del mesh
    assert np.array_equal(kept, VERTICES)
    # What is changed afterwards is not the mesh's.
    mine = VERTICES.copy()
    mesh = fcl_prob.Mesh(mine, TRIANGLES)
    mine[:] = np.nan
    assert np.array_equal(mesh.vertices, VERTICES)


class LikeTrimesh:
    vertices = VERTICES.view(np.ndarray)
    faces = TRIANGLES


class Vector3dVector(list):
    """Not an array, but numpy.asarray makes one of it, as of Open3D's."""


class LikeOpen3d:
    vertices = Vector3dVector(VERTICES.tolist())
    triangles = Vector3dVector(TRIANGLES.tolist())


@pytest.mark.parametrize("mesh", [LikeTrimesh(), LikeOpen3d(), LikeOpen3d])
def test_meshes_of_others(mesh):
    expected = answer(fcl_prob.Mesh(VERTICES, TRIANGLES))
    assert answer(mesh) == answer(fcl_prob.Mesh(mesh)) == expected
    assert fcl_prob.GroupQuery([mesh], [FIXTURE]).collision_probability(ERROR, [pose(0.5)]).lower == expected[0]


def data():
    ros = np.diag([1e-4, 2e-4, 3e-4, 1e-3, 2e-3, 3e-3])
    turned = fcl_prob.GaussianDisplacement(np.array([[0.3, 0.1, 0], [0.1, 0.2, 0.05], [0, 0.05, 0.1]]), [0.1, 0, 0])
    c, s = np.cos(0.3), np.sin(0.3)
    error = fcl_prob.PoseError(ros, "body", np.full(6, 0.01))
    return [
        *(PART, fcl_prob.Ellipsoid(1, 2, 3), fcl_prob.Sphere(0.1), fcl_prob.Capsule(0.1, 0.2)),
        *(fcl_prob.Cone(0.1, 0.2), fcl_prob.Cylinder(0.1, 0.2), fcl_prob.Halfspace([1, 2, 3], 0.1)),
        *(fcl_prob.Plane([3, 2, 1], 0.3), fcl_prob.Mesh(VERTICES, TRIANGLES), torus()),
        *(fcl_prob.GaussianDisplacement(), ERROR, turned, turned.reversed(), turned.with_mean([1, 2, 3])),
        turned.rotated(np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])),
        fcl_prob.GaussianDisplacement.from_standard_deviations([1e-3, 2e-3, 0], [0.9, 0.1, 0.2, 0.3], [1, 0, 0]),
        fcl_prob.GaussianDisplacement.from_independent(turned, ERROR),
        fcl_prob.GaussianMixture([0.1, 0.2, 0.7], [ERROR, turned, turned.reversed()]),
        fcl_prob.TruncatedGaussian(turned, 2.5),
        *(error, fcl_prob.PoseError.from_ros_covariance(ros)),
        fcl_prob.PoseError.from_standard_deviations([1e-3] * 3, [1e-2] * 3, "world-exponential"),
        fcl_prob.PoseError.from_independent(turned, np.eye(3) * 1e-4),
        fcl_prob.PoseError.between_bodies(error, pose(1), error, None),
    ]


def attributes(value):
    names = [name for name in dir(value) if not name.startswith("_")]
    return {name: getattr(value, name) for name in names if not callable(getattr(value, name))}


@pytest.mark.parametrize("value", data(), ids=repr)
def test_data_is_pickled_to_the_bit(value):
    for again in (pickle.loads(pickle.dumps(value)), copy.deepcopy(value)):
        assert type(again) is type(value) and repr(again) == repr(value)
        for name, one in attributes(value).items():
            other = getattr(again, name)
            if isinstance(one, np.ndarray):
                assert np.array_equal(one, other), name
            elif not name.startswith(("gaussian", "displacements")):
                assert one == other, name


def test_results_are_pickled_and_become_json():
    single = fcl_prob.collision_probability(torus(), FIXTURE, ERROR, [0.4, 0, 0], method="estimate", gradient=True)
    batch = fcl_prob.collision_probabilities(PART, FIXTURE, ERROR, np.zeros((3, 3)))
    again = pickle.loads(pickle.dumps(single))
    assert again == single and again.to_dict() == single.to_dict()
    assert json.loads(json.dumps(single.to_dict())) == single.to_dict()
    assert np.array_equal(pickle.loads(pickle.dumps(batch)).lower, batch.lower)
    assert float(single) == single.estimate
    for word in ("P = ", "standard error", "certified in [", "estimate: "):
        assert word in repr(single)
    assert single != batch and single != 3
    interrupted = pickle.loads(pickle.dumps(fcl_prob.Interrupted(single)))
    assert interrupted.result == single


class Gripper(fcl_prob.Box):
    def __init__(self, opening):
        super().__init__(0.1, opening, 0.1)
        self.opening = opening


class Unfinished(fcl_prob.Box):
    def __init__(self):
        pass


def test_classes_of_others():
    gripper = Gripper(0.2)
    assert answer(gripper) == answer(fcl_prob.Box(0.1, 0.2, 0.1))
    again = pickle.loads(pickle.dumps(gripper))
    assert type(again) is Gripper and again.opening == 0.2 and answer(again) == answer(gripper)
    with pytest.raises(TypeError, match="__init__"):
        Unfinished()


class Faulty:
    """Whose own faults come out instead of being taken for something else."""

    faces = TRIANGLES

    @property
    def vertices(self):
        raise ZeroDivisionError

    def __array__(self, *arguments, **keywords):
        raise ZeroDivisionError


class Unspeakable:
    def __repr__(self):
        raise ZeroDivisionError


NOT_FINITE = VERTICES.copy()
NOT_FINITE[3, 1] = np.inf

REFUSED = [
    (ValueError, r"\(n, 3\), not \(8, 2\)", lambda: fcl_prob.Mesh(VERTICES[:, :2], TRIANGLES)),
    (ValueError, r"\(m, 3\), not \(12, 2\)", lambda: fcl_prob.Mesh(VERTICES, TRIANGLES[:, :2])),
    (ValueError, r"not \(\)", lambda: fcl_prob.Mesh(3.0, TRIANGLES)),
    (fcl_prob.InvalidGeometry, "triangles.0. has the index -1", lambda: fcl_prob.Mesh(VERTICES, [[0, 1, -1]])),
    (fcl_prob.InvalidGeometry, "triangles.1. has the index 8", lambda: fcl_prob.Mesh(VERTICES, [[0, 1, 2], [0, 8, 2]])),
    (fcl_prob.InvalidGeometry, str(2**64 - 1), lambda: fcl_prob.Mesh(VERTICES, np.array([[0, 1, 2**64 - 1]], np.uint64))),
    (TypeError, "float64", lambda: fcl_prob.Mesh(VERTICES, TRIANGLES * 1.0)),
    (TypeError, "complex128", lambda: fcl_prob.Mesh(VERTICES * 1j, TRIANGLES)),
    (TypeError, "bool", lambda: fcl_prob.Mesh(VERTICES > 0, TRIANGLES)),
    (TypeError, "<U", lambda: fcl_prob.Mesh([["a", "b", "c"]], TRIANGLES)),
    (TypeError, "real numbers", lambda: fcl_prob.Mesh([[0, 1, 2], [3]], TRIANGLES)),
    (TypeError, "not None", lambda: fcl_prob.Mesh(None)),
    (TypeError, "vertices and faces or triangles", lambda: answer("a mesh")),
    (fcl_prob.InvalidGeometry, "vertex 3", lambda: fcl_prob.Mesh(NOT_FINITE, TRIANGLES)),
    (fcl_prob.InvalidGeometry, "no triangles", lambda: fcl_prob.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))),
    (fcl_prob.InvalidGeometry, "no triangles", lambda: fcl_prob.Mesh([], [])),
    (fcl_prob.InvalidGeometry, "-1", lambda: fcl_prob.Box(1, -1, 1)),
    (fcl_prob.InvalidGeometry, "nan", lambda: fcl_prob.Sphere(float("nan"))),
    (fcl_prob.InvalidGeometry, "normal", lambda: fcl_prob.Plane([0, 0, 0], 1)),
    (fcl_prob.InvalidDistribution, "negative eigenvalue: -1", lambda: fcl_prob.GaussianDisplacement(-np.eye(3))),
    (fcl_prob.InvalidDistribution, "2 weights", lambda: fcl_prob.GaussianMixture([0.5, 0.5], [ERROR])),
    (fcl_prob.InvalidDistribution, "", lambda: fcl_prob.GaussianMixture([], [])),
    (fcl_prob.InvalidDistribution, "", lambda: fcl_prob.TruncatedGaussian(ERROR, -1)),
    (fcl_prob.InvalidRequest, "'up'", lambda: fcl_prob.PoseError(np.eye(6), "up")),
    (ValueError, r"\(6, 6\), not \(3, 3\)", lambda: fcl_prob.PoseError(np.eye(3))),
    (fcl_prob.InvalidPose, "pose_a", lambda: answer(PART, 2 * np.eye(4))),
    (fcl_prob.InvalidPose, "pose_a", lambda: answer(PART, [np.nan, 0, 0])),
    (fcl_prob.InvalidPose, "quaternion", lambda: answer(PART, [0, 0, 0, 0, 0, 0, 0])),
    (ValueError, r"\(5,\)", lambda: answer(PART, [1, 2, 3, 4, 5])),
    (fcl_prob.InvalidPose, "pose_a: an angle of 90 radians", lambda: answer(PART, [0, 0, 0, 90, 0, 0])),
    (ValueError, r"\(35,\)", lambda: fcl_prob.PoseError.from_ros_covariance(np.zeros(35))),
    (TypeError, "pose_a", lambda: answer(PART, {})),
    (ZeroDivisionError, "", lambda: fcl_prob.Mesh(Faulty())),
    (ZeroDivisionError, "", lambda: answer(PART, Faulty())),
    (TypeError, "of type Unspeakable", lambda: answer(Unspeakable())),
    (TypeError, "dtype.'O'", lambda: answer(PART, np.array(None))),
    (TypeError, "dtype", lambda: answer(PART, np.zeros(3, [("x", "f8")]))),
    (TypeError, "a list of geometries", lambda: fcl_prob.GroupQuery(3, [PART])),
    (TypeError, r"group_a\[1\]", lambda: fcl_prob.GroupQuery([PART, "x"], [PART])),
    (fcl_prob.InvalidGeometry, "no members", lambda: fcl_prob.GroupQuery([], [PART])),
    (fcl_prob.InvalidGeometry, "-1", lambda: fcl_prob.Sphere.__new__(fcl_prob.Sphere).__setstate__(((-1.0,), {}))),
    (TypeError, "displacement", lambda: fcl_prob.collision_probability(PART, FIXTURE, np.eye(3))),
]


@pytest.mark.parametrize("kind, words, call", REFUSED)
def test_what_is_wrong_is_said(kind, words, call):
    with pytest.raises(kind, match=words):
        call()


REQUESTS = [
    (TypeError, "unexpected keyword argument 'tolerance'", {"tolerance": 1}),
    (TypeError, "unexpected keyword argument '.udc00'", {"\udc00": 1}),
    (TypeError, "method must be a name", {"method": "\udc00"}),
    (TypeError, "samples must be a whole number", {"samples": np.array([5])}),
    (TypeError, "threshold must be a number, not 'high'", {"threshold": "high"}),
    (TypeError, "samples must be a whole number, not 1.5", {"samples": 1.5}),
    (TypeError, "method must be a name, not 3", {"method": 3}),
    (TypeError, "on_progress must be callable", {"on_progress": 3}),
    (fcl_prob.InvalidRequest, "method is 'magic'", {"method": "magic"}),
    (fcl_prob.InvalidRequest, "contact is 'soft'", {"contact": "soft"}),
    (fcl_prob.InvalidRequest, "samples is -1", {"samples": -1}),
    (fcl_prob.InvalidRequest, f"seed is {2**70}", {"seed": 2**70}),
    (fcl_prob.InvalidRequest, "threads is 0", {"threads": 0}),
    (fcl_prob.InvalidRequest, f"threads is {2**32}", {"threads": 2**32}),
    (fcl_prob.InvalidRequest, "relative_tolerance is nan", {"relative_tolerance": float("nan")}),
    (fcl_prob.InvalidRequest, "threshold is 2", {"threshold": 2}),
    (fcl_prob.InvalidRequest, "time_limit is -1", {"time_limit": -1}),
]


@pytest.mark.parametrize("kind, words, request_", REQUESTS)
def test_what_is_wrong_with_a_request_is_said(kind, words, request_):
    query = fcl_prob.PreparedQuery(PART, FIXTURE)
    for ask in (query.collision_probability, query.collision_probabilities):
        with pytest.raises(kind, match=words):
            ask(ERROR, **request_)


def test_the_offending_one_of_many_is_named():
    query = fcl_prob.PreparedQuery(PART, FIXTURE)
    poses = np.tile(np.eye(4), (5, 1, 1))
    poses[3, 0, 0] = 2.0
    with pytest.raises(fcl_prob.InvalidPose, match=r"pose_a\[3\]"):
        query.collision_probabilities(ERROR, poses)
    covariances = np.tile(np.eye(3), (5, 1, 1))
    covariances[4, 1, 1] = np.nan
    with pytest.raises(fcl_prob.InvalidDistribution, match=r"covariances\[4\]"):
        query.collision_probabilities(covariances=covariances)
    with pytest.raises(TypeError, match=r"displacement\[1\]"):
        query.collision_probabilities([ERROR, None])
    for means in (np.zeros(2), np.zeros((4, 3)), np.zeros((5, 6))):
        with pytest.raises(ValueError, match="means"):
            query.collision_probabilities(covariances=np.tile(np.eye(3), (5, 1, 1)), means=means)
    with pytest.raises(fcl_prob.OpenMesh):
        fcl_prob.collision_probabilities(fcl_prob.Mesh(VERTICES, TRIANGLES[:5]), PART, ERROR, contact="solid")
    with pytest.raises(fcl_prob.UnsupportedGeometry):
        fcl_prob.collision_probability(torus(), PART, ERROR, method="exact")


def test_every_error_is_of_the_package():
    for name in ("InvalidDistribution", "InvalidPose", "InvalidGeometry", "UnsupportedGeometry", "OpenMesh", "FileError"):
        assert issubclass(getattr(fcl_prob, name), fcl_prob.Error)
    assert issubclass(fcl_prob.InvalidRequest, ValueError) and issubclass(fcl_prob.FileError, OSError)
    assert issubclass(fcl_prob.Interrupted, KeyboardInterrupt)
