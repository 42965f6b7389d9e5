// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "python/robot_values.h"

#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/displacements.h"

namespace fcl_prob::python {
namespace {

/// A (k, k) covariance, or a dict of standard deviations by name.
Eigen::MatrixXd jointErrorFrom(const Robot& robot, const py::object& value) {
  if (value.is_none()) return {};
  if (py::isinstance<py::dict>(value)) {
    try {
      return jointCovariance(robot, value.cast<std::map<std::string, double>>());
    } catch (const py::cast_error&) {
      throw py::type_error("joint_error must have a number for each name, not " + textOf(value));
    }
  }
  const Numbers numbers(value, "joint_error");
  const std::size_t count = robot.joints().size();
  const auto size = static_cast<std::ptrdiff_t>(count);
  if (!numbers.hasShape({size, size})) numbers.refuseShape("(k, k) for k joints");
  Eigen::MatrixXd covariance(size, size);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = numbers.at(i, j);
    }
  }
  return covariance;
}

PoseError baseErrorFrom(const py::object& value) {
  const Randomness randomness = randomnessFrom(value, "base_error");
  if (const auto* error = std::get_if<PoseError>(&randomness)) return *error;
  throw py::type_error("base_error must be a PoseError, not " + textOf(value));
}

}  // namespace

RobotErrors robotErrorsFrom(const Robot& robot, const py::object& joint_error,
                            const py::object& base_error) {
  RobotErrors errors;
  errors.joints = jointErrorFrom(robot, joint_error);
  if (!base_error.is_none()) errors.base = baseErrorFrom(base_error);
  return errors;
}

Eigen::VectorXd jointValues(const Robot& robot, py::handle value, const std::string& name) {
  if (py::isinstance<py::dict>(value)) {
    try {
      return robot.values(value.cast<std::map<std::string, double>>());
    } catch (const py::cast_error&) {
      throw py::type_error(name + " must have a number for each name, not " + textOf(value));
    }
  }
  const Numbers numbers(value, name);
  if (numbers.dimensions() != 1) numbers.refuseShape("(k,), a value for each joint");
  Eigen::VectorXd values(static_cast<Eigen::Index>(numbers.size(0)));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = numbers.at(static_cast<std::size_t>(i));
  robot.validate(values);
  return values;
}

std::vector<Eigen::VectorXd> waypointsFrom(const Robot& robot, const py::object& value) {
  if (!py::isinstance<py::iterable>(value)) {
    throw py::type_error("waypoints must be an array (n, k) or a list, not " + textOf(value));
  }
  std::vector<Eigen::VectorXd> waypoints;
  for (const py::handle one : py::reinterpret_borrow<py::iterable>(value)) {
    waypoints.push_back(
        jointValues(robot, one, "waypoints[" + std::to_string(waypoints.size()) + "]"));
  }
  return waypoints;
}

}  // namespace fcl_prob::python
