# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Answers: against closed forms, and against the command's to the last bit."""
import json
import math
import os
import pickle
import struct
import subprocess

import numpy as np
import pytest
from scenes import DATA, ERROR, FIXTURE, PART, box_mesh, boxes_truth, needs_command, needs_io, needs_robot, normal, pose, torus

import fcl_prob


@pytest.mark.parametrize("distance", [0.0, 0.35, 0.5, 0.9, 1.5])
def test_boxes_have_their_closed_form(distance):
    truth = boxes_truth(distance)
    result = fcl_prob.collision_probability(PART, FIXTURE, ERROR, pose_a=[distance, 0, 0])
    assert result.lower <= truth * (1 + 1e-12) and truth <= result.upper * (1 + 1e-12)
    assert result.probability == pytest.approx(truth, rel=1e-9)
    mesh = fcl_prob.Mesh(*box_mesh(0.4, 0.3, 0.2))
    of_mesh = fcl_prob.collision_probability(
        mesh, FIXTURE, ERROR, pose(distance), method="interval", relative_tolerance=1e-3, absolute_tolerance=1e-30
    )
    assert of_mesh.lower <= truth * (1 + 1e-12) and truth <= of_mesh.upper * (1 + 1e-12)


def test_halfspace_with_every_kind_of_displacement():
    ball, floor = fcl_prob.Sphere(0.1), fcl_prob.Halfspace([0, 0, 2], 0.0)
    at = [0, 0, 0.2]
    gaussian = fcl_prob.GaussianDisplacement(np.diag([1.0, 1.0, 0.01]))
    ask = lambda displacement, **request: fcl_prob.collision_probability(ball, floor, displacement, at, **request)
    assert ask(gaussian).probability == pytest.approx(normal(-1.0), rel=1e-9)
    mixture = fcl_prob.GaussianMixture([0.25, 0.75], [gaussian, gaussian.with_mean([0, 0, 0.1])])
    assert ask(mixture).probability == pytest.approx(0.25 * normal(-1) + 0.75 * normal(-2), rel=1e-2)
    upright = fcl_prob.GaussianDisplacement(np.diag([0, 0, 0.01]))
    truncated = fcl_prob.TruncatedGaussian(upright, 2.0)
    truth = (normal(-1) - normal(-2)) / (1 - 2 * normal(-2))
    result = ask(truncated, relative_tolerance=1e-6)
    assert result.lower - 1e-12 <= truth <= result.upper + 1e-12
    # A ball turns without moving.
    turning = fcl_prob.PoseError.from_standard_deviations([1, 1, 0.1], [0.1, 0.1, 0.1])
    assert ask(turning).probability == pytest.approx(normal(-1.0), rel=0.05)
    banded = ask(gaussian, band_a=0.02)
    assert (banded.lower, banded.upper) == pytest.approx((normal(-1.2), normal(-0.8)), rel=1e-6)
    banded = ask(gaussian, band_b=(0.02, 0))
    assert (banded.lower, banded.upper) == pytest.approx((normal(-1.0), normal(-0.8)), rel=1e-6)
    with pytest.raises(TypeError):
        ask(gaussian, band_a=(0.1,))
    with pytest.raises(fcl_prob.InvalidRequest):
        ask(gaussian, band_a=-0.1)
    result = ask(gaussian, gradient=True)
    density = np.exp(-0.5) / np.sqrt(2 * np.pi)
    assert result.gradient == pytest.approx([0, 0, -density / 0.1], abs=1e-9)


def test_prepared_queries_groups_and_batches_agree_with_single_calls():
    rng = np.random.default_rng(7)
    mesh = torus()
    query = fcl_prob.PreparedQuery(mesh, FIXTURE)
    poses = np.stack([pose(*p) for p in rng.uniform(0.2, 0.4, (40, 3))])
    spread = rng.normal(size=(40, 3, 3)) * 0.02
    covariances = spread @ spread.transpose(0, 2, 1)
    for threads in (1, 2, 7):
        batch = query.collision_probabilities(pose_a=poses, covariances=covariances, threads=threads)
        assert len(batch) == 40 and batch.done == 40 and not batch.cancelled
        for i in range(40):
            single = fcl_prob.collision_probability(
                mesh, FIXTURE, fcl_prob.GaussianDisplacement(covariances[i]), poses[i]
            )
            assert (batch.lower[i], batch.upper[i]) == (single.lower, single.upper)
            assert batch.status[i] == single.status and batch[i].method == single.method
    assert batch.path[0] == batch.lower.max()
    group = fcl_prob.GroupQuery([mesh], [FIXTURE])
    of_group = group.collision_probability(fcl_prob.GaussianDisplacement(covariances[0]), poses[:1])
    assert of_group.lower == batch.lower[0]


def test_group_is_no_less_than_its_members():
    group = fcl_prob.GroupQuery([PART, fcl_prob.Sphere(0.1)], [FIXTURE])
    both = group.collision_probability(ERROR, np.stack([pose(0.5), pose(0.4)]), method="interval")
    for shape, at in ((PART, 0.5), (fcl_prob.Sphere(0.1), 0.4)):
        one = fcl_prob.collision_probability(shape, FIXTURE, ERROR, pose(at))
        assert both.upper >= one.lower
    turning = fcl_prob.PoseError.from_standard_deviations([0.08, 0.05, 0.02], [0.01, 0.01, 0.01])
    turned = group.collision_probability(turning, np.stack([pose(0.5), pose(0.4)]), frame=pose(0.5))
    assert abs(turned.estimate - both.probability) < 0.1


def test_group_changes_as_its_members_move():
    poses = np.stack([pose(0.5), pose(0.4)])
    group = fcl_prob.GroupQuery([PART, fcl_prob.Sphere(0.1)], [FIXTURE])
    moved = group.motion_gradient(ERROR, poses, lines=8192, seed=3)
    assert moved.gradient.shape == moved.gradient_standard_error.shape == (12,)
    both = group.collision_probability(ERROR, poses, gradient=True, relative_tolerance=1e-3)
    assert abs(moved.probability - both.probability) < 5 * moved.standard_error + 1e-3
    # All moved alike is a mean that moves.
    alike = np.zeros((2, 6, 3))
    alike[:, :3] = np.eye(3)
    as_one = group.motion_gradient(ERROR, poses, velocities=alike, lines=8192, seed=3)
    assert np.allclose(as_one.gradient, moved.gradient[:3] + moved.gradient[6:9])
    errors = 5 * as_one.gradient_standard_error + 0.01
    assert np.all(np.abs(as_one.gradient - both.gradient) < errors)
    told = []
    stopped = group.motion_gradient(ERROR, poses, on_progress=lambda *now: told.append(now) or False)
    assert moved.status == "sampled" and stopped.status == "cancelled" and stopped.lines < 4096
    assert len(told) == 1 and told[0][0] == (0, 1) and 0 < told[0][1] < 1
    with pytest.raises(ValueError, match=r"velocities must have the shape \(2, 6, k\)"):
        group.motion_gradient(ERROR, poses, velocities=np.zeros((2, 3)))
    with pytest.raises(fcl_prob.InvalidRequest):
        group.motion_gradient(ERROR, poses, contact="touching")


def test_batches_of_pose_errors():
    covariances = np.stack([np.diag([1e-4] * 3 + [s] * 3) for s in (0.0, 1e-4, 1e-3)])
    batch = fcl_prob.collision_probabilities(PART, FIXTURE, covariances=covariances, pose_a=[0.41, 0, 0])
    query = fcl_prob.PreparedQuery(PART, FIXTURE)
    for i in range(3):
        single = query.collision_probability(fcl_prob.PoseError(covariances[i]), [0.41, 0, 0])
        assert batch[i].estimate == single.estimate and batch[i].lower == single.lower
    assert batch.lower[0] == pytest.approx(normal(-1), rel=1e-9)


def test_shapes_of_batches():
    ask = lambda **arguments: fcl_prob.collision_probabilities(PART, FIXTURE, **arguments)
    one = ask(displacement=ERROR, pose_a=[0.5, 0, 0])
    assert len(one) == 1 and one.lower[0] == one[-1].lower
    assert len(ask(displacement=[ERROR] * 3)) == 3
    assert len(ask(displacement=ERROR, pose_b=np.zeros((5, 3)))) == 5
    assert len(ask(displacement=ERROR, pose_b=np.tile([0, 0, 0, 1, 0, 0, 0], (6, 1)))) == 6
    assert len(ask(covariances=np.eye(3), means=np.zeros((4, 3)))) == 4
    empty = ask(displacement=ERROR, pose_a=np.zeros((0, 4, 4)))
    assert len(empty) == 0 and empty.lower.shape == (0,) and empty.status.shape == (0,)
    assert empty.path == (0.0, 0.0) and empty.gradient.shape == (0, 3)
    with pytest.raises(ValueError, match="40 of pose_a, but 3 of displacements"):
        ask(displacement=[ERROR] * 3, pose_a=np.zeros((40, 3)))
    with pytest.raises(TypeError, match="either displacement or covariances"):
        ask()
    with pytest.raises(IndexError):
        one[1]


def command(*arguments):
    run = subprocess.run([os.environ["FCL_PROB_CLI"], *arguments], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


@needs_command
@needs_io
@pytest.mark.parametrize(
    "request_", [{}, {"method": "estimate", "seed": 5}, {"method": "monte-carlo", "samples": 500}, {"threshold": 0.05}]
)
def test_answers_are_those_of_the_command_to_the_bit(request_):
    a, b = str(DATA / "gripper_finger.off"), str(DATA / "mug.obj")
    options = [f"--{name.replace('_', '-')}={value}" for name, value in request_.items()]
    of_command = command(
        "check", a, b, "--pose-a=-0.06,0,0.135,1,-1,0,0", "--sigma=0.004,0.003,0.002", "--json", *options
    )
    error = fcl_prob.GaussianDisplacement.from_standard_deviations([0.004, 0.003, 0.002])
    arguments = (fcl_prob.load_mesh(a), fcl_prob.load_mesh(b), error, [-0.06, 0, 0.135, 1, -1, 0, 0])
    for result in (
        fcl_prob.collision_probability(*arguments, **request_),
        fcl_prob.collision_probabilities(*arguments, **request_)[0],
    ):
        for key in ("lower", "upper", "estimate", "standard_error", "decision", "method", "status"):
            assert getattr(result, key) == of_command[key], key
        assert result.statistics["cells"] == of_command["statistics"]["cells"]


@needs_command
@needs_robot
def test_robots_are_those_of_the_command_to_the_bit():
    of_command = command("path", "--scene", str(DATA / "arm_path.json"), "--json", "--tolerance=0.2", "--threshold=0.9")
    query, waypoints = fcl_prob.load_robot_scene(DATA / "arm_path.json")
    result = query.motion(waypoints, relative_tolerance=0.2, threshold=0.9)
    assert (result.lower, result.upper) == (of_command["lower"], of_command["upper"])
    assert len(waypoints) == of_command["waypoints"]


@needs_robot
def test_robot_from_parts():
    robot = fcl_prob.Robot(DATA / "arm.urdf")
    assert len(robot.poses(np.zeros(len(robot.joints)))) == len(robot.links)
    values = robot.values({"turn": 0.2})
    assert values[robot.joints.index("turn")] == 0.2
    ball = ("ball", fcl_prob.Sphere(0.05), ERROR, [0.5, 0, 0.2])
    query = fcl_prob.RobotQuery(robot, [ball])
    result = query.state({"turn": 0.2}, method="interval", relative_tolerance=0.2)
    assert 0.0 <= result.lower <= result.upper <= 1.0 and len(result.parts) == 1
    assert result.to_dict()["lower"] == result.lower
    with pytest.raises(fcl_prob.InvalidRequest, match="nowhere"):
        query.state({"nowhere": 1.0})
    with pytest.raises(TypeError, match="a number for each name"):
        query.state({"turn": "left"})
    assert robot.links_without_body == ["tool"] and robot.notes == []
    assert len(result.plan) == 1 and "tool" in result.plan[0]
    allowing = fcl_prob.RobotQuery(fcl_prob.Robot(DATA / "arm.urdf", allow_outside_limits=True), [ball])
    beyond = {"elbow": 45.0}
    told = "joint elbow: its value is 45 rad, beyond its limits -2.4 to 2.4 rad.*degrees"
    for ask in ("state", "motion", "gradient"):
        argument = beyond if ask == "state" else [{}, beyond]
        with pytest.raises(fcl_prob.InvalidRequest, match=told):
            getattr(query, ask)(argument)
        getattr(allowing, ask)(argument)
    with pytest.raises(fcl_prob.InvalidRequest, match=told):
        query.decide_probably([beyond], 0.5, 0.01)
    with pytest.raises(fcl_prob.InvalidRequest, match=told):
        fcl_prob.SelfCollision(robot).collides(beyond)
    with pytest.raises(ValueError, match="null byte"):
        fcl_prob.Robot("a\0b")
    with pytest.raises(TypeError, match="obstacles\\[0\\]"):
        fcl_prob.RobotQuery(robot, [fcl_prob.Sphere(1)])
    with pytest.raises(fcl_prob.FileError):
        fcl_prob.Robot(DATA / "mug.obj")


@needs_io
@needs_robot
def test_what_was_said_when_a_mesh_was_read_is_told_with_answers(tmp_path):
    record = np.dtype([("numbers", "<f4", 12), ("attribute", "<u2")])
    vertices, triangles = box_mesh(0.1, 0.1, 0.1)
    records = np.zeros(len(triangles), record)
    records["numbers"][:, 3:] = np.asarray(vertices)[np.asarray(triangles)].reshape(-1, 9)
    file = tmp_path / "longer.stl"
    file.write_bytes(bytes(80) + struct.pack("<I", len(records)) + records.tobytes() + b"more")
    mesh = fcl_prob.load_mesh(file)
    assert len(mesh.notes) == 1 and "longer.stl" in mesh.notes[0]
    assert mesh.coordinate_error == 0.0 and fcl_prob.Mesh(vertices, triangles).notes == []
    assert pickle.loads(pickle.dumps(mesh)).notes == mesh.notes
    robot = fcl_prob.Robot(DATA / "arm.urdf")
    for body in (mesh, [(mesh, np.eye(4)), (fcl_prob.Sphere(0.05), np.eye(4))]):
        result = fcl_prob.RobotQuery(robot, [("box", body, ERROR, [0.5, 0, 0.2])]).state({})
        assert mesh.notes[0] in result.plan
    carrying = robot.with_attached("held", robot.links[-1], mesh)
    assert mesh.notes[0] in carrying.notes


@needs_command
@needs_robot
def test_motions_between_waypoints_are_those_of_the_command_to_the_bit():
    of_command = command("path", "--scene", str(DATA / "arm_path.json"), "--json", "--tolerance=0.3", "--threshold=0.9", "--between")
    query, waypoints = fcl_prob.load_robot_scene(DATA / "arm_path.json")
    result = query.motion(waypoints, relative_tolerance=0.3, threshold=0.9, between="swept")
    assert (result.lower, result.upper) == (of_command["lower"], of_command["upper"])
    assert result.swept_band > 0.0 and result.by_waypoint == [] and result.any_dependence is None
    some = query.motion(waypoints, relative_tolerance=0.3)
    assert some.swept_band is None and some.lower <= result.upper
    with pytest.raises(fcl_prob.InvalidRequest, match="between is 'all'"):
        query.motion(waypoints, between="all")
    with pytest.raises(fcl_prob.InvalidRequest):
        query.motion(waypoints, "independent", between="swept")


@needs_robot
def test_any_dependence_holds_what_independence_gives():
    query, waypoints = fcl_prob.load_robot_scene(DATA / "arm_path.json")
    independent = query.motion(waypoints, "independent", relative_tolerance=0.3)
    lower, upper = independent.any_dependence
    assert len(independent.by_waypoint) == len(waypoints)
    assert lower <= independent.lower and independent.upper <= upper
    assert max(low for low, _ in independent.by_waypoint) <= independent.upper
    asked = query.motion(waypoints, "any-dependence", relative_tolerance=0.3)
    assert asked.lower <= independent.upper and asked.upper >= independent.lower


@needs_robot
def test_probable_decisions_are_told_from_certain_ones():
    query, waypoints = fcl_prob.load_robot_scene(DATA / "arm_path.json")
    certified = query.motion(waypoints, relative_tolerance=0.1)
    for threshold in (0.3 * certified.lower, min(1.0, 3.0 * certified.upper)):
        result = query.decide_probably(waypoints, threshold, 1e-3, seed=3)
        assert result.decision.endswith("below" if threshold > certified.upper else "above")
        assert result.chance_of_error == (0.0 if result.decision.startswith("certainly") else 1e-3)
        assert result.certified[0] <= certified.upper and result.certified[1] >= certified.lower
    with pytest.raises(fcl_prob.InvalidRequest, match="chance"):
        query.decide_probably(waypoints, 0.05, 2.0)


@needs_robot
def test_gradients_for_joints_go_with_differences():
    query, waypoints = fcl_prob.load_robot_scene(DATA / "arm_path.json")
    waypoints = np.array(waypoints)
    found = query.gradient(waypoints, lines=20000, seed=2)
    assert found.gradient.shape == found.gradient_standard_error.shape == waypoints.shape
    assert found.lines >= 20000
    # All waypoints moved at once, along the joint that matters most.
    joint = int(np.argmax(abs(found.gradient.sum(axis=0))))
    step = np.zeros(waypoints.shape[1])
    step[joint] = 2e-3
    behind, before = (query.motion(w, relative_tolerance=1e-3) for w in (waypoints + step, waypoints - step))
    slope = (float(behind) - float(before)) / 4e-3
    error = np.linalg.norm(found.gradient_standard_error[:, joint])
    assert abs(found.gradient[:, joint].sum() - slope) < 5 * error + 0.05 * abs(slope)
    with pytest.raises(fcl_prob.InvalidRequest, match="lines"):
        query.gradient(waypoints, lines=1)
    told = []
    stopped = query.gradient(waypoints, on_progress=lambda *now: told.append(now) or False)
    assert found.status == "sampled" and stopped.status == "cancelled" and stopped.lines < found.lines
    assert len(told) == 1 and told[0][0] == (0, 1) and 0 < told[0][1] < 1


@needs_robot
def test_attached_objects_and_self_collision():
    robot = fcl_prob.Robot(DATA / "arm.urdf")
    rod = fcl_prob.Cylinder(0.01, 0.3)
    holding = robot.with_attached("rod", "hand", rod, [0.09, 0, 0], ["left_finger", "right_finger"])
    assert len(holding.links) == len(robot.links) + 1 and holding.links[-1] == "hand"
    straight = holding.values({"grip": 0.0})
    lenient = fcl_prob.SelfCollision(holding, DATA / "arm.srdf")
    assert ("left_finger", "rod") not in lenient.collisions(straight)
    assert not fcl_prob.SelfCollision(robot, DATA / "arm.srdf").collides(straight)
    assert len(lenient.pairs) < len(fcl_prob.SelfCollision(holding).pairs)
    strict = fcl_prob.SelfCollision(robot.with_attached("rod", "hand", rod, [0.09, 0, 0]))
    assert ("left_finger", "rod") in strict.collisions(straight)
    assert ("left_finger", "rod") in strict.pairs and strict.collides(straight)
    counted = lenient.probability(straight, {"grip": 0.02, "bend": 0.2}, samples=500, seed=4)
    assert counted.method == "monte-carlo" and counted.statistics["samples"] <= 500
    low, high = counted.confidence_interval
    assert low <= counted.estimate <= high and counted.standard_error > 0
    with pytest.raises(fcl_prob.InvalidRequest, match="counted"):
        lenient.probability(straight, {"grip": 0.02}, method="interval")
    with pytest.raises(fcl_prob.InvalidRequest, match="foot"):
        robot.with_attached("rod", "foot", rod)
    with pytest.raises(fcl_prob.FileError):
        fcl_prob.SelfCollision(robot, DATA / "arm.urdf.srdf")


@needs_robot
def test_obstacles_of_a_robot_have_bodies_and_may_be_touched():
    robot = fcl_prob.Robot(DATA / "arm.urdf")
    error = fcl_prob.GaussianDisplacement.from_standard_deviations([0.03, 0.02, 0.04])
    lamp = [(fcl_prob.Sphere(0.1), [0, 0, 0]), (fcl_prob.Cylinder(0.03, 0.5), [0, 0, -0.3])]
    values = robot.values({"turn": 0.35, "shoulder": 0.15, "elbow": 0.3})
    query = fcl_prob.RobotQuery(robot, [("lamp", lamp, error, [0.55, 0.25, 0.35])])
    ball = query.with_obstacles([("ball", fcl_prob.Sphere(0.1), error, [0.55, 0.25, 0.35])])
    assert query.state(values).lower > ball.state(values).upper
    allowed = fcl_prob.RobotQuery(robot, [("lamp", lamp, error, [0.55, 0.25, 0.35])], allowed=[("*", "l?mp")])
    assert allowed.state(values).upper == 0
    with pytest.raises(fcl_prob.InvalidRequest):
        fcl_prob.RobotQuery(robot, [("lamp", lamp, error)], allowed=[("nobody", "lamp")])
    with pytest.raises(TypeError):
        fcl_prob.RobotQuery(robot, [("lamp", [fcl_prob.Sphere(0.1)], error)])
    states = np.tile(values, (3, 1))
    states[2, robot.joints.index("turn")] = -1.5
    assert query.decide_states(states, 0.05, threads=2) == ["certainly-above"] * 2 + ["certainly-below"]
    assert set(query.decide_states(states, 0.05, 1e-6)) <= {"certainly-above", "probably-above", "certainly-below"}


@needs_robot
def test_errors_of_joints_and_base():
    robot = fcl_prob.Robot(DATA / "arm.urdf")
    error = fcl_prob.GaussianDisplacement.from_standard_deviations([0.03, 0.02, 0.04])
    query = fcl_prob.RobotQuery(robot, [("ball", fcl_prob.Sphere(0.1), error, [0.55, 0.25, 0.35])])
    values = robot.values({"turn": 0.7, "shoulder": 0.15, "elbow": 0.3})
    exact = query.state(values)
    by_name = query.state(values, joint_error={"turn": 0.1}, relative_tolerance=0.05)
    assert by_name.estimate is not None and by_name.estimate != exact.probability
    lower, upper = by_name.confidence_interval
    assert 0 < lower < by_name.estimate < upper < 1 and exact.confidence_interval is None
    assert by_name.to_dict()["confidence_interval"] == (lower, upper)
    covariance = np.zeros((len(robot.joints), len(robot.joints)))
    covariance[robot.joints.index("turn"), robot.joints.index("turn")] = 0.1**2
    assert query.state(values, joint_error=covariance, relative_tolerance=0.05).estimate == by_name.estimate
    further = robot.values({"turn": 0.8, "shoulder": 0.15, "elbow": 0.3})
    way = query.motion([values, further], joint_error={"turn": 0.1}, relative_tolerance=0.05)
    assert way.estimate > by_name.estimate - 3 * by_name.standard_error
    with pytest.raises(fcl_prob.InvalidRequest):
        query.motion([values], errors="independent", joint_error={"turn": 0.1})
    base = fcl_prob.PoseError.from_standard_deviations([0.05] * 3, [0.0] * 3)
    assert query.state(values, base_error=base, relative_tolerance=0.05).probability > 0
    with pytest.raises(fcl_prob.InvalidRequest):
        query.state(values, joint_error={"nowhere": 0.1})
    for wrong in ({"joint_error": {"turn": "far"}}, {"base_error": error}):
        with pytest.raises(TypeError):
            query.state(values, **wrong)
    with pytest.raises(ValueError):
        query.state(values, joint_error=np.eye(2))


def test_certificates():
    box = fcl_prob.Box(0.2, 0.2, 0.2)
    error = fcl_prob.GaussianDisplacement.from_standard_deviations([0.1, 0.1, 0.1])
    result, certificate = fcl_prob.certified_probability(box, box, error, pose_a=[0.25, 0, 0])
    lines = [json.loads(line) for line in certificate.splitlines()]
    assert lines[0]["fcl_prob_certificate"] == 1 and lines[0]["deviations"] == [0.1, 0.1, 0.1]
    assert (lines[-1]["lower"], lines[-1]["upper"]) == (result.lower, result.upper)
    assert lines[-1]["cells"] == sum("cell" in line for line in lines)
    _, of_ball = fcl_prob.certified_probability(fcl_prob.Sphere(0.1), box, error, pose_a=[0.25, 0, 0])
    assert [json.loads(line).get("radius") for line in of_ball.splitlines()[1:3]] == [0.1, None]
    with pytest.raises(fcl_prob.UnsupportedGeometry, match="Cone"):
        fcl_prob.certified_probability(fcl_prob.Cone(0.1, 0.2), box, error)


def test_contained_is_a_product_of_masses_within_a_box():
    ball, box = fcl_prob.Sphere(0.1), fcl_prob.Box(1.0, 0.8, 0.6)
    error = fcl_prob.GaussianDisplacement.from_standard_deviations([0.2, 0.3, 0.1])
    result = fcl_prob.collision_probability(ball, box, error, contact="contained")
    truth = 1.0
    for room, sigma in ((0.4, 0.2), (0.3, 0.3), (0.2, 0.1)):
        truth *= math.erf(room / sigma / math.sqrt(2))
    assert result.lower <= truth <= result.upper
    assert result.upper - result.lower < 0.011 * truth
    with pytest.raises(fcl_prob.UnsupportedGeometry, match="object B"):
        fcl_prob.collision_probability(ball, ball, error, contact="contained")
