// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <pybind11/stl.h>

#include "fcl_prob/joint_gradient.h"
#include "fcl_prob/probable_decision.h"
#include "fcl_prob/robot_groups.h"
#include "fcl_prob/self_collision.h"
#include "python/arrays.h"
#include "python/results.h"
#include "python/robot_values.h"
#include "python/running.h"

namespace fcl_prob::python {
namespace {

std::shared_ptr<SelfCollision> makeSelfCollision(const Robot& robot, const py::object& srdf) {
  if (srdf.is_none()) return std::make_shared<SelfCollision>(robot);
  const std::string file = pathFrom(srdf);
  const py::gil_scoped_release released;
  return std::make_shared<SelfCollision>(robot, loadAllowedPairs(file, robot));
}

py::list namesOf(const Robot& robot, const std::vector<BodyPair>& pairs) {
  py::list names;
  for (const BodyPair& pair : pairs) {
    names.append(
        py::make_tuple(robot.bodies()[pair.first].name(), robot.bodies()[pair.second].name()));
  }
  return names;
}

void bindSelfCollision(py::module_& module) {
  py::class_<SelfCollision, std::shared_ptr<SelfCollision>>(
      module, "SelfCollision",
      "SelfCollision(robot, srdf=None): a robot's bodies against each other by fcl::collide,\n"
      "and how likely they touch. srdf: a file that tells which links may touch. Raises FileError.")
      .def(py::init(&makeSelfCollision), py::arg("robot"), py::arg("srdf") = py::none())
      .def_property_readonly(
          "pairs", [](const SelfCollision& self) { return namesOf(self.robot(), self.pairs()); },
          "Names of the bodies that are looked at.")
      .def(
          "collides",
          [](const SelfCollision& self, const py::object& values) {
            return self.collides(jointValues(self.robot(), values, "values"));
          },
          py::arg("values"))
      .def(
          "collisions",
          [](const SelfCollision& self, const py::object& values) {
            return namesOf(self.robot(),
                           self.collisions(jointValues(self.robot(), values, "values")));
          },
          py::arg("values"), "Names of the bodies that touch.")
      .def(
          "probability",
          [](const SelfCollision& self, const py::object& values, const py::object& joint_error,
             const py::kwargs& request) {
            const Eigen::VectorXd at = jointValues(self.robot(), values, "values");
            const RobotErrors errors = robotErrorsFrom(self.robot(), joint_error, py::none());
            return answer(questionFrom(request),
                          [&](const ProbabilityRequest& of, ProbabilityResult& result) {
                            result = self.probability(at, errors.joints, of);
                          });
          },
          py::arg("values"), py::arg("joint_error"),
          "ProbabilityResult: how likely any of the pairs touch, counted over errors of the "
          "joints\n"
          "(as of RobotQuery.state). Keywords: those of a request.");
}

void bindGroups(py::module_& module) {
  using G = RobotGroup;
  py::class_<G>(module, "RobotGroup", "Joints that an SRDF names together, and states of them.")
      .def_readonly("joints", &G::joints, "Those that move by themselves, in the robot's order.")
      .def_readonly("links", &G::links, "Links that hang on a joint of the group.")
      .def_readonly("states", &G::states, "By name: values of joints by name, radians or metres.");
  module.def(
      "load_groups",
      [](const py::object& srdf, const Robot& robot) { return loadGroups(pathFrom(srdf), robot); },
      py::arg("srdf"), py::arg("robot"), "The groups of an SRDF by name. Raises FileError.");
}

void bindGradient(py::module_& module) {
  using G = JointGradient;
  py::class_<G>(module, "JointGradient",
                "P at any of some waypoints, and how it changes with the joints: estimates.")
      .def_property_readonly("probability", [](const G& g) { return g.probability; })
      .def_property_readonly("standard_error", [](const G& g) { return g.standard_error; })
      .def_property_readonly(
          "gradient", [](const G& g) { return arrayOf(g.gradient.transpose()); },
          "(n, k) float64: a row a waypoint, 1/radian or 1/metre.")
      .def_property_readonly(
          "gradient_standard_error",
          [](const G& g) { return arrayOf(g.gradient_standard_error.transpose()); })
      .def_readonly("lines", &G::lines, "Random lines that were drawn.")
      .def_property_readonly(
          "status", [](const G& g) { return toString(g.status); },
          "'sampled', 'time-limit' or 'cancelled'.")
      .def("__repr__", [](const G& g) {
        return "<JointGradient of " + std::to_string(g.gradient.cols()) + " waypoints, " +
               std::to_string(g.lines) + " lines>";
      });
}

}  // namespace

void bindDecisions(py::module_& module) {
  using R = ProbableResult;
  py::class_<R>(module, "ProbableResult", "What is certified and what is probable, side by side.")
      .def_property_readonly(
          "decision", [](const R& r) { return toString(r.decision); },
          "'undecided', 'certainly-below', 'certainly-above', 'probably-below' or\n"
          "'probably-above'.")
      .def_readonly("chance_of_error", &R::chance_of_error,
                    "Of being wrong with this decision; 0 for a certain one.")
      .def_property_readonly(
          "certified", [](const R& r) { return pairOf(r.certified); }, "(lower, upper), certified.")
      .def_property_readonly(
          "probable", [](const R& r) { return pairOf(r.probable); },
          "(lower, upper), but for the chance that was stated.")
      .def_property_readonly("status", [](const R& r) { return toString(r.status); })
      .def_property_readonly("cells", [](const R& r) { return r.cells; })
      .def_property_readonly("samples", [](const R& r) { return r.samples; })
      .def("__repr__", [](const R& r) {
        return "<ProbableResult " + toString(r.decision) + ": " + toString(r.status) + ">";
      });
  bindSelfCollision(module);
  bindGroups(module);
  bindGradient(module);
}

}  // namespace fcl_prob::python
