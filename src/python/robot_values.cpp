// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "python/robot_values.h"

#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/geometries.h"

namespace fcl_prob::python {

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
