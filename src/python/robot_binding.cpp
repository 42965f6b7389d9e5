// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Robots from URDFs, and what they are made of.
#include <pybind11/stl.h>

#include "fcl_prob/robot.h"
#include "python/arrays.h"
#include "python/geometries.h"
#include "python/pickled.h"
#include "python/robot_values.h"

namespace fcl_prob::python {
namespace {

using Packages = std::map<std::string, std::string>;
using Names = std::vector<std::string>;

/// What loads files, without the GIL. \param text  of the URDF; null: it is in the file
Robot robotFrom(const std::string& file, const std::string* text, const std::string& folder,
                const RobotOptions& options) {
  const py::gil_scoped_release released;
  return text == nullptr ? Robot(file, options) : Robot::fromText(*text, options, folder);
}

Robot loadRobot(const py::object& file, const Packages& packages, const Names& links,
                const py::object& base, bool allow_outside_limits) {
  return robotFrom(pathFrom(file), nullptr, {},
                   {packages, links, poseFrom(base, "base"), allow_outside_limits});
}

Robot robotOfText(const std::string& text, const Packages& packages, const Names& links,
                  const py::object& base, bool allow_outside_limits, const py::object& folder) {
  return robotFrom({}, &text, folder.is_none() ? "" : pathFrom(folder),
                   {packages, links, poseFrom(base, "base"), allow_outside_limits});
}

Robot withAttached(const Robot& robot, const std::string& name, const std::string& link,
                   const py::object& geometry, const py::object& pose,
                   const std::vector<std::string>& touch_links) {
  const Geometry body = geometryFrom(geometry, "geometry");
  const ReadingNotes reading = readingNotesOf(*body);
  return robot.withAttached({name, link, body, poseFrom(pose, "pose"), touch_links,
                             reading.coordinate_error, reading.notes});
}

/// The files are read again, a text that is the URDF is kept.
py::tuple robotState(const Robot& robot) {
  const RobotOptions& options = robot.options();
  py::list attached;
  for (const AttachedObject& one : robot.attached()) {
    attached.append(py::make_tuple(one.name, one.link,
                                   std::const_pointer_cast<fcl::CollisionGeometryd>(one.geometry),
                                   arrayOf(one.in_link.matrix()), one.touch_links));
  }
  return py::make_tuple(robot.urdf(), options.packages, options.links,
                        arrayOf(options.base.matrix()), options.allow_outside_limits, attached,
                        robot.urdfText(), robot.folder());
}

Robot robotMadeAgain(const py::tuple& state) {
  const auto text = state[6].cast<std::string>();
  Robot robot = robotFrom(state[0].cast<std::string>(), text.empty() ? nullptr : &text,
                          state[7].cast<std::string>(),
                          {state[1].cast<Packages>(), state[2].cast<Names>(),
                           poseFrom(state[3], "base"), state[4].cast<bool>()});
  for (const py::handle one : state[5].cast<py::list>()) {
    const auto of = one.cast<py::tuple>();
    robot = withAttached(robot, of[0].cast<std::string>(), of[1].cast<std::string>(), of[2], of[3],
                         of[4].cast<Names>());
  }
  return robot;
}

/// (name, link, geometry, pose in the link) of every body.
py::list bodiesOf(const Robot& robot) {
  py::list bodies;
  for (const RobotBody& body : robot.bodies()) {
    bodies.append(py::make_tuple(body.name(), body.link,
                                 std::const_pointer_cast<fcl::CollisionGeometryd>(body.geometry),
                                 arrayOf(body.in_link.matrix())));
  }
  return bodies;
}

py::list carryingJoints(const Robot& robot, std::size_t body, const py::object& values) {
  py::list joints;
  for (const CarryingJoint& one :
       robot.carryingJoints(body, jointValues(robot, values, "values"))) {
    joints.append(py::make_tuple(robot.joints()[one.joint].name, one.factor, one.turns,
                                 vectorArray(one.axis), vectorArray(one.point)));
  }
  return joints;
}

}  // namespace

void bindRobot(py::module_& module) {
  py::class_<Robot, std::shared_ptr<Robot>>(
      module, "Robot",
      "Robot(urdf, packages={}, links=[], base=None, allow_outside_limits=False): joints and\n"
      "collision elements of a robot.\n\n"
      "packages: the folder of each package or model that the URDF names; links: those whose\n"
      "collision elements are taken, all if there are none; base: pose of the root link, (4, 4),\n"
      "metres, world frame; allow_outside_limits: queries answer for states beyond the limits of\n"
      "joints, too, which they refuse otherwise (InvalidRequest). Immutable. Raises FileError,\n"
      "InvalidPose.")
      .def(py::init(&loadRobot), py::arg("urdf"), py::arg("packages") = Packages(),
           py::arg("links") = Names(), py::arg("base") = py::none(),
           py::arg("allow_outside_limits") = false)
      .def_static("from_text", &robotOfText, py::arg("urdf_text"), py::arg("packages") = Packages(),
                  py::arg("links") = Names(), py::arg("base") = py::none(),
                  py::arg("allow_outside_limits") = false, py::arg("folder") = py::none(),
                  "From the text of a URDF, as of ROS's robot_description. folder: what names of\n"
                  "meshes are relative to. Raises as Robot(), naming lines of the text.")
      .def_property_readonly("name", &Robot::name)
      .def_property_readonly(
          "joints",
          [](const Robot& robot) {
            py::list names;
            for (const RobotJoint& joint : robot.joints()) names.append(joint.name);
            return names;
          },
          "Names of the joints that move, in the order of their values.")
      .def_property_readonly(
          "limits",
          [](const Robot& robot) {
            Eigen::MatrixXd limits(robot.joints().size(), 2);
            for (Eigen::Index i = 0; i < limits.rows(); ++i) {
              const RobotJoint& joint = robot.joints()[i];
              limits.row(i) << joint.lower, joint.upper;
            }
            return arrayOf(limits);
          },
          "(k, 2) float64, radians or metres.")
      .def_property_readonly(
          "velocities",
          [](const Robot& robot) {
            std::vector<double> velocities;
            for (const RobotJoint& joint : robot.joints()) velocities.push_back(joint.velocity);
            return arrayOf(velocities);
          },
          "(k,) float64, radians or metres per second; 0 where the URDF has none.")
      .def_property_readonly(
          "bodies", &bodiesOf,
          "Collision elements and what is attached: tuples (name, link, geometry, pose in the\n"
          "link, (4, 4), metres).")
      .def("carrying_joints", &carryingJoints, py::arg("body"), py::arg("values"),
           "What the Jacobian of bodies[body] is made of, from the root outwards: tuples (joint,\n"
           "factor, turns, axis, point), the axis and a point on it in the world frame, metres; a\n"
           "point x of the body moves by factor * axis × (x - point) per radian, or by factor *\n"
           "axis per metre.")
      .def_property_readonly(
          "links",
          [](const Robot& robot) {
            py::list links;
            for (const RobotBody& body : robot.bodies()) links.append(body.link);
            return links;
          },
          "The link of each collision element.")
      .def_property_readonly("links_without_body", &Robot::linksWithoutBody,
                             "Links that have no collision element here: nothing touches them.")
      .def_property_readonly("notes", &Robot::notes,
                             "What of the URDF may be meant otherwise than it was read, and what\n"
                             "was passed over in files of its meshes.")
      .def(
          "values",
          [](const Robot& robot, const py::dict& by_name) {
            return vectorArray(jointValues(robot, by_name, "by_name"));
          },
          py::arg("by_name"), "(k,) float64 from values by name; the others are 0.")
      .def(
          "poses",
          [](const Robot& robot, const py::object& values) {
            py::list poses;
            for (const auto& pose : robot.poses(jointValues(robot, values, "values"))) {
              poses.append(arrayOf(pose.matrix()));
            }
            return poses;
          },
          py::arg("values"), "A (4, 4) for each collision element, metres, world frame.")
      .def(
          "link_pose",
          [](const Robot& robot, const std::string& link, const py::object& values) {
            return arrayOf(robot.linkPose(link, jointValues(robot, values, "values")).matrix());
          },
          py::arg("link"), py::arg("values"), "(4, 4), metres, world frame.")
      .def("with_attached", &withAttached, py::arg("name"), py::arg("link"), py::arg("geometry"),
           py::arg("pose") = py::none(), py::arg("touch_links") = std::vector<std::string>(),
           "The robot with an object that a link carries at `pose` in the link's frame; it may\n"
           "touch the links named. Raises InvalidRequest, InvalidPose.")
      .def(pickledAs<const Robot&>(&robotState, &robotMadeAgain))
      .def("__repr__", [](const Robot& robot) {
        return "<Robot " + robot.name() + " with " + std::to_string(robot.joints().size()) +
               " joints and " + std::to_string(robot.bodies().size()) + " collision elements>";
      });
}

}  // namespace fcl_prob::python
