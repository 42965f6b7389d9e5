# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Plans, robots as data, and obstacles that are predicted over time."""
import pickle

import numpy as np
import pytest
from scenes import DATA, needs_planning, needs_robot

import fcl_prob

CART = """<robot name="cart"><link name="base"/>
  <joint name="x" type="prismatic"><parent link="base"/><child link="slide"/>
    <axis xyz="1 0 0"/><limit lower="-2" upper="2" effort="1" velocity="0.5"/></joint>
  <link name="slide"/>
  <joint name="y" type="prismatic"><parent link="slide"/><child link="ball"/>
    <axis xyz="0 1 0"/><limit lower="-0.3" upper="0.3" effort="1" velocity="0.5"/></joint>
  <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
</robot>"""


def error(sigma):
    return fcl_prob.GaussianDisplacement(sigma**2 * np.eye(3))


@pytest.fixture
def cart(tmp_path):
    path = tmp_path / "cart.urdf"
    path.write_text(CART)
    return fcl_prob.Robot(path)


def comer():
    prediction = [(0, [1.5, 0, 0], error(0.01)), (4, [0, 0, 0], error(0.03)), (15, [0, 5, 0], error(0.08))]
    return ("comer", fcl_prob.Sphere(0.2), error(0.01), None, prediction)


@needs_robot
def test_robots_are_data():
    robot = fcl_prob.Robot(DATA / "arm.urdf", links=["hand", "left_finger"], base=[1.0, 2.0, 3.0])
    robot = robot.with_attached("rod", "hand", fcl_prob.Box(0.02, 0.02, 0.3), [0.1, 0, 0], ["left_finger"])
    again = pickle.loads(pickle.dumps(robot))
    values = robot.values({"turn": 0.3, "elbow": 0.6})
    assert again.joints == robot.joints and again.links == robot.links
    assert all((one == other).all() for one, other in zip(again.poses(values), robot.poses(values)))
    name, link, geometry, pose = again.bodies[-1]
    assert (name, link, pose[0, 3]) == ("rod", "hand", 0.1) and isinstance(geometry, fcl_prob.Box)
    assert fcl_prob.SelfCollision(again).collides(values) == fcl_prob.SelfCollision(robot).collides(values)
    assert robot.velocities[robot.joints.index("shoulder")] == 2


@needs_robot
def test_robots_of_texts_are_those_of_files(cart, tmp_path):
    robot = fcl_prob.Robot.from_text(CART, base=[1.0, 2.0, 3.0])
    of_file = fcl_prob.Robot(tmp_path / "cart.urdf", base=[1.0, 2.0, 3.0])
    assert (robot.poses([0.5, 0.1])[0] == of_file.poses([0.5, 0.1])[0]).all()
    capsule = CART.replace('<sphere radius="0.1"/>', '<capsule radius="0.1" length="0.3"/>')
    assert isinstance(fcl_prob.Robot.from_text(capsule).bodies[0][2], fcl_prob.Capsule)
    (tmp_path / "cart.urdf").unlink()
    again = pickle.loads(pickle.dumps(robot.with_attached("rod", "slide", fcl_prob.Box(0.1, 0.1, 0.1))))
    assert (again.poses([0.5, 0.1])[0] == robot.poses([0.5, 0.1])[0]).all() and len(again.bodies) == 2
    with_mesh = CART.replace('<sphere radius="0.1"/>', '<mesh filename="tetrahedron.off"/>')
    with pytest.raises(fcl_prob.FileError, match="the URDF text: line 7: .*tetrahedron.off: is relative"):
        fcl_prob.Robot.from_text(with_mesh)
    faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
    (tmp_path / "tetrahedron.off").write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + faces)
    meshed = pickle.loads(pickle.dumps(fcl_prob.Robot.from_text(with_mesh, folder=tmp_path)))
    assert isinstance(meshed.bodies[0][2], fcl_prob.Mesh)
    with pytest.raises(fcl_prob.FileError, match="the URDF text: no URDF"):
        fcl_prob.Robot.from_text("")
    with pytest.raises(TypeError):
        fcl_prob.Robot.from_text(3)


@needs_robot
def test_packages_are_those_of_ros(tmp_path, monkeypatch):
    (tmp_path / "share" / "cart").mkdir(parents=True)
    text = CART.replace('<sphere radius="0.1"/>', '<mesh filename="package://cart/none.off"/>')
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/nowhere:{tmp_path}")
    with pytest.raises(fcl_prob.FileError, match=f"{tmp_path}/share/cart/none.off: no such file"):
        fcl_prob.Robot.from_text(text)
    monkeypatch.setenv("AMENT_PREFIX_PATH", "/nowhere")
    with pytest.raises(fcl_prob.FileError, match="package cart.*there is no /nowhere/share/cart"):
        fcl_prob.Robot.from_text(text)


@needs_robot
def test_groups_of_an_srdf(cart, tmp_path):
    srdf = tmp_path / "cart.srdf"
    srdf.write_text("""<robot name="cart"><group name="side"><chain base_link="slide" tip_link="ball"/></group>
      <group name="both"><group name="side"/><joint name="x"/></group>
      <group_state name="home" group="both"><joint name="x" value="-1"/></group_state></robot>""")
    groups = fcl_prob.load_groups(srdf, cart)
    assert groups["side"].joints == ["y"] and groups["side"].links == ["ball"] and groups["side"].states == {}
    assert groups["both"].joints == ["x", "y"] and groups["both"].states == {"home": {"x": -1.0}}
    assert (cart.values(groups["both"].states["home"]) == [-1, 0]).all()
    with pytest.raises(fcl_prob.FileError, match="its name is cart, not arm"):
        fcl_prob.load_groups(srdf, fcl_prob.Robot(DATA / "arm.urdf"))


@needs_planning
def test_a_plan_moves_the_joints_of_a_group(cart, tmp_path):
    (tmp_path / "cart.srdf").write_text('<robot name="cart"><group name="along"><joint name="x"/></group></robot>')
    query = fcl_prob.RobotQuery(cart, [("far", fcl_prob.Sphere(0.2), error(0.01), [0, 5, 0])])
    joints = fcl_prob.load_groups(tmp_path / "cart.srdf", cart)["along"].joints
    plan = fcl_prob.plan(query, {"x": -1, "y": 0.1}, {"x": 1, "y": 0.1}, 0.02, joints=joints)
    assert plan.status == "solved" and (plan.waypoints[:, 1] == 0.1).all()


@needs_robot
def test_jacobians_are_made_of_carrying_joints(cart):
    robot = fcl_prob.Robot(DATA / "arm.urdf")
    values, step = robot.values({"turn": 0.3, "shoulder": 0.4, "elbow": 0.6}), 1e-6
    body = robot.links.index("hand")
    for joint, factor, turns, axis, point in robot.carrying_joints(body, values):
        moved = values.copy()
        moved[robot.joints.index(joint)] += step
        x = robot.poses(values)[body][:3, 3]
        change = (robot.poses(moved)[body][:3, 3] - x) / step
        expected = factor * (np.cross(axis, x - point) if turns else axis)
        assert np.allclose(change, expected, atol=1e-5)
    assert [joint for joint, *_ in cart.carrying_joints(0, [0, 0])] == ["x", "y"]


@needs_robot
def test_obstacles_are_predicted(cart):
    query = fcl_prob.RobotQuery(cart, [comer()])
    there = query.at(2.0).state([0.75, 0], relative_tolerance=1e-6)
    away = query.at(2.0).state([-0.5, 0])
    assert there.lower > 0.99 and away.upper < 1e-9
    middle = fcl_prob.RobotQuery(cart, [("comer", fcl_prob.Sphere(0.2), error(np.sqrt(5e-4)), [0.75, 0, 0])])
    assert middle.state([0.4, 0]).probability == pytest.approx(query.at(2.0).state([0.4, 0]).probability, rel=1e-6)
    assert query.robot.joints == cart.joints
    with pytest.raises(fcl_prob.InvalidRequest, match="not at 16 s"):
        query.at(16)
    name, geometry, displacement, pose, prediction = comer()
    with pytest.raises(fcl_prob.InvalidRequest, match="times have to increase"):
        fcl_prob.RobotQuery(cart, [(name, geometry, displacement, pose, prediction[::-1])])
    with pytest.raises(TypeError, match="time must be a number"):
        fcl_prob.RobotQuery(cart, [(name, geometry, displacement, pose, [("now", None, displacement)])])


@needs_planning
def test_plans_in_time(cart):
    query = fcl_prob.RobotQuery(cart, [comer()])
    plan = fcl_prob.plan_in_time(query, {"x": -1}, {"x": 1}, 0.02, hold=0.5, seed=3)
    assert plan.status == "solved" and plan.largest[1] <= 0.02
    assert plan.times[0] == 0 and plan.times[-1] == pytest.approx(plan.arrival + 0.5)
    assert (np.abs(np.diff(plan.waypoints, axis=0)).max(axis=1) <= 0.5 * np.diff(plan.times) * (1 + 1e-6)).all()
    for time, values in zip(plan.times, plan.waypoints):
        assert query.at(time).state(values).lower < 0.02
    slow = fcl_prob.plan_in_time(query, {"x": -1}, {"x": 1}, 0.02, velocities={"x": 0.2})
    assert slow.arrival >= 10
    told = []
    stopped = fcl_prob.plan_in_time(query, {"x": -1}, {"x": 1}, 0.02,
                                    on_progress=lambda *now: told.append(now) or False)
    assert stopped.status == "cancelled" and len(stopped.waypoints) == 0 and len(told[0]) == 3
    with pytest.raises(TypeError, match="pace"):
        fcl_prob.plan_in_time(query, {"x": -1}, {"x": 1}, 0.02, pace=2)
    with pytest.raises(TypeError, match="hold cannot be"):
        fcl_prob.plan_in_time(query, {"x": -1}, {"x": 1}, 0.02, hold="long")


@needs_planning
def test_plans_past_what_stays():
    robot = fcl_prob.Robot(DATA / "arm.urdf")
    ball = ("ball", fcl_prob.Sphere(0.06), error(0.02), [0.45, 0.0, 0.35])
    query = fcl_prob.RobotQuery(robot, [ball])
    self_collision = fcl_prob.SelfCollision(robot, DATA / "arm.srdf")
    start, goal = {"turn": -0.8, "elbow": 0.6}, {"turn": 0.8, "elbow": 0.6}
    plan = fcl_prob.plan(query, start, goal, 0.05, self_collision, largest_step=0.1, max_states=5000)
    assert plan.status == "solved" and plan.largest[1] <= 0.05
    assert (plan.waypoints[0] == robot.values(start)).all() and (plan.waypoints[-1] == robot.values(goal)).all()
    assert plan.motion[0] <= plan.motion[1] and plan.state_threshold == 0.05
    wide = fcl_prob.plan(query, start, goal, 0.05, self_collision, largest_step=0.1, max_states=5000,
                         joint_error={"turn": 0.01})
    assert wide.status == "solved" and wide.motion == (0.0, 1.0) and wide.largest[1] <= 0.05
    decisions = query.decide_states(wide.waypoints, 0.05, joint_error={"turn": 0.01})
    assert set(decisions) == {"certainly-below"}
    none = fcl_prob.plan(query, start, goal, 0.05, self_collision, max_states=1)
    assert none.status == "state-limit" and none.waypoints.shape[0] == 0
