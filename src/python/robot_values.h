// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// States and motions of robots as Python gives them.
#pragma once

#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fcl_prob/robot.h"
#include "fcl_prob/robot_errors.h"

namespace fcl_prob::python {

namespace py = pybind11;

/// (k,) values of joints, or a dict of them by name. \throws py::type_error, and as Robot::values()
Eigen::VectorXd jointValues(const Robot& robot, py::handle value, const std::string& name);

/// (n, k), or a list of what jointValues() takes.
std::vector<Eigen::VectorXd> waypointsFrom(const Robot& robot, const py::object& value);

/// \param joint_error  (k, k) covariance, or a dict of standard deviations by name, or None
/// \param base_error   a PoseError, or None. \throws py::type_error, and as jointCovariance()
RobotErrors robotErrorsFrom(const Robot& robot, const py::object& joint_error,
                            const py::object& base_error);

/// Robot, in the module of robots.
void bindRobot(py::module_& module);

/// Self-collision, probable decisions and gradients, in the module of robots.
void bindDecisions(py::module_& module);

}  // namespace fcl_prob::python
