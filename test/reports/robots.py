# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""URDFs as people have them: namespaces, elements of simulators, macros that were not expanded, faults of all kinds.

The robot is a mast on a slide with a ball at its end, above a floor whose height is known up to an error."""
import math

from checks import Case
from truth import below, dot, turn, turned, unit

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
RADIUS, MAST, SIGMA = 0.085, 0.4, 0.015
TILT = 0.7
INERTIAL = '<inertial><mass value="1.5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
BALL = f'<collision name="tip"><origin xyz="0 0 {MAST}"/><geometry><sphere radius="{RADIUS}"/></geometry></collision>'
LIMIT = '<limit lower="-1" upper="1" effort="9" velocity="1"/>'


def joint(name="slide", kind="prismatic", parent="base", child="mast", inner="", limit=LIMIT):
    return (f'<joint name="{name}" type="{kind}"><origin xyz="0 0 -0.1"/><parent link="{parent}"/>'
            f'<child link="{child}"/><axis xyz="0 0 1"/>{limit}{inner}</joint>')


def link(name, inner):
    return f'<link name="{name}">{inner}</link>'


def urdf(ball=BALL, joints=None, more="", attributes="", head='<?xml version="1.0"?>\n', inertial=INERTIAL):
    """A base, a slide and the mast; a case changes one part of it."""
    parts = [link("base", inertial), link("mast", inertial + ball), joint() if joints is None else joints, more]
    return head + f'<robot name="lift" {attributes}>\n' + "\n".join(parts) + "\n</robot>\n"


def scene_of(joints, name="lift.urdf"):
    floor = {"name": "floor", "halfspace": {"normal": [0, 0, 1], "offset": 0}, "displacement": {"sigma": [0, 0, SIGMA]}}
    return {"robot": {"urdf": name, "base": [0, 0, -0.2]}, "obstacles": [floor], "joints": joints}


# Where the slide is unless a case says so: the ball is then 1.7 deviations above the floor.
LOWERED = 0.01


def read(name, text, gap=None, joints=None):
    gap = LOWERED - 0.3 + MAST - RADIUS if gap is None else gap
    joints = {"slide": LOWERED} if joints is None else joints
    return Case(name, scene_of(joints), (below(-gap / SIGMA),), files={"lift.urdf": text.encode()}, command="path")


def refused(name, text, *words, joints=None):
    content = text if isinstance(text, bytes) else text.encode()
    return Case(name, scene_of({} if joints is None else joints), words=words, files={"lift.urdf": content},
                command="path")


def dialects():
    yield read("as it is", urdf())
    yield read("a namespace of xacro that is not used", urdf(attributes=XACRO))
    yield read("a default namespace", urdf(attributes='xmlns="http://www.ros.org"'))
    yield read("a byte order mark and a comment", "\ufeff" + urdf(more="<!-- 50 % & more: <link> -->"))
    yield read("no declaration", urdf(head=""))
    yield read("carriage returns", urdf().replace("\n", "\r\n"))
    simulators = ('<gazebo reference="mast"><mu1>0.3</mu1><material>Gazebo/Blue</material></gazebo>'
                  '<ros2_control name="all" type="system"><hardware><plugin>a/b</plugin></hardware>'
                  '<joint name="slide"><command_interface name="position"/></joint></ros2_control>'
                  '<transmission name="t"><type>SimpleTransmission</type><joint name="slide"/></transmission>'
                  '<material name="blue"><color rgba="0 0 1 1"/></material>')
    yield read("elements of simulators and controllers", urdf(more=simulators))
    yield read("an inertia that is no number", urdf(inertial=INERTIAL.replace('ixx="1"', 'ixx="nan"')))
    yield read("no mass at all", urdf(inertial=""))
    visual = '<visual><geometry><mesh filename="package://not_there/mast.dae"/></geometry></visual>'
    yield read("a visual mesh that is not there", urdf(ball=visual + BALL))
    spaced = BALL.replace(f'"0 0 {MAST}"', f'"  0 +0.0\t\n{MAST:e} "')
    yield read("numbers with signs, exponents and line ends", urdf(ball=spaced))
    yield read("a second ball that counts", urdf(ball=BALL.replace(str(MAST), str(MAST + 0.3)) + BALL))


def kinematics():
    """Values of joints, mimicry and turns, against the place of the ball."""
    turning = urdf(ball=BALL, joints=joint(kind="revolute", name="hinge").replace('xyz="0 0 1"', 'xyz="0 3 0"'))
    for angle in (0.15, -0.28):
        up = turned(turn([0, 1, 0], angle), [0, 0, MAST])[2]
        yield read(f"a hinge at {angle}", turning, up - 0.3 - RADIUS, {"hinge": angle})
    more = (link("rider", "") + joint("follow", parent="mast", child="rider",
                                      inner='<mimic joint="slide" multiplier="-0.5" offset="0.02"/>'))
    riding = urdf(ball="", more=more.replace('<link name="rider">', '<link name="rider">' + BALL))
    follows = -0.5 * LOWERED + 0.02 - 0.1
    yield read("a joint that mimics", riding.replace(str(MAST), "0.5"),
               -0.3 + LOWERED + follows + 0.5 - RADIUS)
    axis = unit([1, -2, 2])
    oblique = joint().replace('xyz="0 0 1"', 'xyz="1 -2 2"')
    yield read("a slide along an oblique axis", urdf(joints=oblique),
               -0.3 + LOWERED * dot(axis, [0, 0, 1]) + MAST - RADIUS)


def turned_bodies():
    """Shapes with a place and angles of their own."""
    length = 0.22
    capsule, cylinder = (f'<{kind} radius="0.05" length="{length}"/>' for kind in ("capsule", "cylinder"))
    tilted = f'<collision><origin xyz="0 0 0.45" rpy="{TILT} 0 1.1"/><geometry>{capsule}</geometry></collision>'
    yield read("a tilted capsule", urdf(ball=tilted), LOWERED - 0.3 + 0.45 - 0.05 - 0.5 * length * math.cos(TILT))
    reach = 0.5 * length * math.cos(TILT) + 0.05 * math.sin(TILT)
    yield read("a tilted cylinder", urdf(ball=tilted.replace(capsule, cylinder)), LOWERED - 0.3 + 0.45 - reach)
    sides = (0.1, 0.2, 0.3)
    # Of fixed axes in the order x, y, z: the height of a corner is the third row of the product of turns.
    row = turned(turn([1, 0, 0], -TILT), turned(turn([0, 1, 0], -0.4), [0, 0, 1]))
    reach = 0.5 * sum(s * abs(x) for s, x in zip(sides, row))
    box = (f'<collision><origin xyz="0 0 0.5" rpy="{TILT} 0.4 1.1"/><geometry>'
           f'<box size="{sides[0]} {sides[1]} {sides[2]}"/></geometry></collision>')
    yield read("a box turned about all axes", urdf(ball=box), LOWERED - 0.3 + 0.5 - reach)


def macros():
    """Xacro that was not run: parts of the robot would be missing."""
    expanded = "xacro has not been run"
    yield refused("a property left", urdf(ball=BALL.replace(f'"{RADIUS}"', '"${tip_radius}"')), "lift.urdf", "line 4",
                  "${tip_radius}", expanded)
    yield refused("an expression in a place", urdf(ball=BALL.replace(str(MAST), "${2*h}")), "line 4", "${2*h}",
                  expanded)
    yield refused("nothing but a macro", f'<robot name="lift" {XACRO}>\n<xacro:mast name="m"/>\n</robot>', "line 2",
                  "xacro:mast", expanded)
    yield refused("a macro beside", urdf(more='<xacro:gripper side="left"/>', attributes=XACRO), "line 6",
                  "xacro:gripper", expanded)
    yield refused("a condition", urdf(more=f'<xacro:if value="true">{link("x", "")}</xacro:if>', attributes=XACRO),
                  "xacro:if", expanded)
    yield refused("another file", urdf(more='<include filename="more.urdf"/>'), "line 6", "include")


def faulty_bodies():
    place = f'"0 0 {MAST}"'
    for name, ball, words in (
            ("a collision without geometry", '<collision><origin xyz="0 0 1"/></collision>', ("mast", "0 geometries")),
            ("commas between numbers", BALL.replace(place, f'"0, 0, {MAST}"'), ("mast", "xyz", "three numbers")),
            ("a decimal comma", BALL.replace(place, '"0 0 0,4"'), ("mast", "0 0 0,4", "three numbers")),
            ("two numbers", BALL.replace(place, '"0 0.4"'), ("mast", "xyz", "three numbers")),
            ("a place that is no number", BALL.replace(place, '"0 0 nan"'), ("mast", "xyz")),
            ("a radius with a unit", BALL.replace(f'"{RADIUS}"', '"85mm"'), ("mast", "radius", "85mm")),
            ("a radius of nothing", BALL.replace(f'"{RADIUS}"', '"0"'), ("mast", "radius")),
            ("a shape that is not known", BALL.replace("sphere", "torus"), ("mast", "torus")),
            ("two shapes", BALL.replace("</geometry>", '<box size="1 1 1"/></geometry>'), ("mast", "geometry")),
            ("a collision spelled wrongly", BALL.replace("collision", "colision"), ("mast", "colision")),
            ("a collision within a visual", f"<visual>{BALL}</visual>", ("mast", "collision")),
            ("an attribute spelled wrongly", BALL.replace("xyz", "xzy"), ("mast", "xzy")),
            ("a mesh that is not there",
             '<collision><geometry><mesh filename="arm/tip.stl"/></geometry></collision>', ("tip.stl",)),
            ("a mesh of a package that is not there",
             '<collision><geometry><mesh filename="package://no_such/tip.stl"/></geometry></collision>',
             ("no_such",))):
        yield refused(name, urdf(ball=ball), "lift.urdf", *words)


def faulty_trees():
    lost = link("lost", BALL)
    for name, text, words in (
            ("two roots", urdf(more=lost), ("lost", "one root")),
            ("a link that is there twice", urdf(more=link("mast", BALL)), ("mast", "line 6", "twice")),
            ("a joint that is there twice", urdf(more=lost + joint(child="lost")), ("slide", "line 6", "twice")),
            ("a joint without limits", urdf(joints=joint(limit="")), ("slide", "limit")),
            ("a limit the wrong way round", urdf(joints=joint(limit='<limit lower="1" upper="-1"/>')),
             ("slide", "limit")),
            ("a joint to nowhere", urdf(joints=joint(child="boom")), ("slide", "boom")),
            ("a joint from nowhere", urdf(joints=joint(parent="rail")), ("slide", "rail")),
            ("a loop", urdf(more=joint("back", parent="mast", child="base")), ("root",)),
            ("a link on two joints", urdf(more=joint("again")), ("mast", "more than one joint")),
            ("a joint of unknown type", urdf(joints=joint(kind="screw")), ("slide", "screw")),
            ("a joint without type", urdf(joints=joint().replace(' type="prismatic"', "")), ("slide", "type")),
            ("an axis of nothing", urdf(joints=joint().replace('xyz="0 0 1"', 'xyz="0 0 0"')), ("slide", "axis")),
            ("mimicry of nobody", urdf(joints=joint(inner='<mimic joint="nobody"/>')), ("slide", "nobody")),
            ("no links", '<robot name="lift"></robot>', ("link",)),
            ("cut off", urdf()[:-20], ("no URDF",)),
            ("a document type", urdf(head='<!DOCTYPE robot [<!ENTITY r "0.085">]>\n'), ("document type",)),
            ("an attribute that is there twice", urdf().replace('name="base"', 'name="base" name="x"'), ("line 3",))):
        yield refused(name, text, "lift.urdf", *words)


def faulty_states():
    hinge = urdf(joints=joint("hinge", "revolute", limit='<limit lower="-1.5" upper="1.5" effort="1" velocity="1"/>'))
    yield refused("degrees for radians", hinge, "hinge", "45", "1.5", joints={"hinge": 45})
    yield refused("a joint that is not there", urdf(), "elbow", joints={"elbow": 0.1})
    yield Case("a URDF that is not there", scene_of({}, "gone.urdf"), words=("gone.urdf",), command="path")


def cases():
    for family in (dialects, kinematics, turned_bodies, macros, faulty_bodies, faulty_trees, faulty_states):
        yield from family()
