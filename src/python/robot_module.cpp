// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The extension module fcl_prob._robot: robots from URDFs, which take libxml2 and Orocos KDL.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <sstream>

#include "base/decision.h"
#include "base/known_text.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_query.h"
#include "fcl_prob/robot_scene.h"
#include "python/arrays.h"
#include "python/displacements.h"
#include "python/geometries.h"
#include "python/results.h"
#include "python/robot_values.h"
#include "python/running.h"
#include "robot/motion_names.h"

namespace fcl_prob::python {
namespace {

std::string reprOf(const RobotResult& result) {
  std::ostringstream text;
  text.precision(6);
  text << "<RobotResult P " << detail::relationText(result.estimate, result.any);
  if (result.standard_error) text << " ± " << *result.standard_error << " (standard error)";
  text << ", certified in [" << result.any.lower << ", " << result.any.upper << "]";
  if (result.decision != Decision::none) text << ", decision " << toString(result.decision);
  text << ": " << toString(result.status) << ">";
  return text.str();
}

py::list pairsOf(const std::vector<Bounds>& bounds) {
  py::list pairs;
  for (const Bounds& one : bounds) pairs.append(pairOf(one));
  return pairs;
}

void bindResult(py::module_& module) {
  using R = RobotResult;
  py::class_<R>(module, "RobotResult", "P(any body of the robot touches any obstacle).")
      .def_property_readonly("probability", &R::probability)
      .def_property_readonly(
          "lower", [](const R& r) { return r.any.lower; }, "Certified.")
      .def_property_readonly(
          "upper", [](const R& r) { return r.any.upper; }, "Certified.")
      .def_property_readonly("estimate", [](const R& r) { return orNone(r.estimate); })
      .def_property_readonly("standard_error", [](const R& r) { return orNone(r.standard_error); })
      .def_property_readonly(
          "confidence_interval", [](const R& r) { return pairOf(r.confidence_interval); },
          "With errors of joints or base: (lower, upper), covers P with the stated confidence.")
      .def_property_readonly("decision", [](const R& r) { return decisionOf(r.decision); })
      .def_property_readonly("status", [](const R& r) { return toString(r.status); })
      .def_property_readonly(
          "parts", [](const R& r) { return r.parts; },
          "ProbabilityResults by obstacle; with independent errors by waypoint, "
          "and for each by obstacle.")
      .def_property_readonly(
          "by_waypoint", [](const R& r) { return pairsOf(r.by_waypoint); },
          "Unless errors are persistent: (lower, upper) at each waypoint.")
      .def_property_readonly(
          "any_dependence", [](const R& r) { return pairOf(r.any_dependence); },
          "Unless errors are persistent: (lower, upper) whatever the errors at one waypoint have\n"
          "to do with those at another.")
      .def_property_readonly(
          "swept_band", [](const R& r) { return orNone(r.swept_band); },
          "Between waypoints: no point is farther from where it was looked at, metres.")
      .def_property_readonly("far_bodies", [](const R& r) { return r.far_bodies; })
      .def_property_readonly("far_upper", [](const R& r) { return r.far_upper; })
      .def_readonly(
          "plan", &R::plan,
          "What was left out and what may be meant otherwise: links without a body, notes.")
      .def("to_dict",
           [](const py::object& result) {
             py::dict dict;
             for (const char* name :
                  {"probability", "lower", "upper", "estimate", "standard_error",
                   "confidence_interval", "decision", "status", "by_waypoint", "any_dependence",
                   "swept_band", "far_bodies", "far_upper", "plan"}) {
               dict[name] = result.attr(name);
             }
             py::list parts;
             for (const py::handle part : result.attr("parts"))
               parts.append(part.attr("to_dict")());
             dict["parts"] = parts;
             return dict;
           })
      .def("__float__", &R::probability)
      .def("__repr__", &reprOf);
}

void addReadingNotes(const fcl::CollisionGeometryd& geometry, Obstacle& obstacle) {
  const ReadingNotes reading = readingNotesOf(geometry);
  obstacle.coordinate_error = std::max(obstacle.coordinate_error, reading.coordinate_error);
  obstacle.notes.insert(obstacle.notes.end(), reading.notes.begin(), reading.notes.end());
}

/// One geometry, or a list of tuples (geometry, pose) in the frame of the obstacle.
void bodiesFrom(py::handle value, const std::string& name, Obstacle& obstacle) {
  if (!py::isinstance<py::list>(value)) {
    obstacle.geometry = geometryFrom(value, name);
    addReadingNotes(*obstacle.geometry, obstacle);
    return;
  }
  const fcl::Transform3d frame = obstacle.pose;
  for (const py::handle one : py::reinterpret_borrow<py::list>(value)) {
    if (!py::isinstance<py::tuple>(one) || py::len(one) != 2) {
      throw py::type_error(name + ": a body must be a tuple (geometry, pose), not " + textOf(one));
    }
    const auto body = py::reinterpret_borrow<py::tuple>(one);
    const fcl::Transform3d pose = frame * poseFrom(body[1], name + ": pose of a body");
    const auto geometry = geometryFrom(body[0], name);
    addReadingNotes(*geometry, obstacle);
    if (obstacle.geometry) {
      obstacle.more.push_back({geometry, obstacle.pose.inverse() * pose});
    } else {
      obstacle.geometry = geometry;
      obstacle.pose = pose;
    }
  }
  if (!obstacle.geometry) throw InvalidRequest(name + " has no bodies");
}

/// Tuples (time, pose, displacement).
std::vector<ObstacleState> predictionFrom(py::handle value, const std::string& name) {
  std::vector<ObstacleState> states;
  for (const py::handle one : value) {
    if (!py::isinstance<py::tuple>(one) || py::len(one) != 3) {
      throw py::type_error(name + ": a state must be a tuple (time, pose, displacement), not " +
                           textOf(one));
    }
    const auto parts = py::reinterpret_borrow<py::tuple>(one);
    const Randomness error = randomnessFrom(parts[2], name + ": displacement");
    const auto* gaussian = std::get_if<GaussianDisplacement>(&error);
    if (gaussian == nullptr) {
      throw py::type_error(name + ": a state has a GaussianDisplacement, not " + textOf(parts[2]));
    }
    try {
      states.push_back({poseFrom(parts[1], name + ": pose"), *gaussian, parts[0].cast<double>()});
    } catch (const py::cast_error&) {
      throw py::type_error(name + ": time must be a number, not " + textOf(parts[0]));
    }
  }
  return states;
}

/// (name, geometry, displacement), with a pose behind these, and a prediction behind that.
Obstacle obstacleFrom(py::handle value, std::size_t number) {
  const std::string name = "obstacles[" + std::to_string(number) + "]";
  if (!py::isinstance<py::tuple>(value) || py::len(value) < 3 || py::len(value) > 5 ||
      !py::isinstance<py::str>(py::reinterpret_borrow<py::tuple>(value)[0])) {
    throw py::type_error(name +
                         " must be a tuple (name, geometry, displacement), (name, geometry, "
                         "displacement, pose) or (name, geometry, displacement, pose, "
                         "prediction), not " +
                         textOf(value));
  }
  const auto parts = py::reinterpret_borrow<py::tuple>(value);
  const Randomness randomness = randomnessFrom(parts[2], name + ": displacement");
  if (std::holds_alternative<PoseError>(randomness)) {
    throw py::type_error(name + ": an obstacle has a displacement, not a PoseError");
  }
  Obstacle obstacle;
  if (parts.size() > 3) obstacle.pose = poseFrom(parts[3], name + ": pose");
  if (parts.size() > 4) obstacle.over_time = predictionFrom(parts[4], name + ": prediction");
  bodiesFrom(parts[1], name, obstacle);
  obstacle.name = parts[0].cast<std::string>();
  const auto set = [&obstacle](const auto& error) {
    if constexpr (!std::is_same_v<decltype(error), const PoseError&>) obstacle.displacement = error;
  };
  std::visit(set, randomness);
  return obstacle;
}

std::vector<Obstacle> obstaclesFrom(const py::list& obstacles) {
  std::vector<Obstacle> all;
  for (const py::handle one : obstacles) all.push_back(obstacleFrom(one, all.size()));
  return all;
}

std::shared_ptr<RobotQuery> makeQuery(
    const Robot& robot, const py::list& obstacles,
    const std::vector<std::pair<std::string, std::string>>& allowed) {
  std::vector<Obstacle> all = obstaclesFrom(obstacles);
  std::vector<AllowedContact> contacts;
  for (const auto& [body, obstacle] : allowed) contacts.push_back({body, obstacle});
  const py::gil_scoped_release released;
  return std::make_shared<RobotQuery>(robot, std::move(all), std::move(contacts));
}

std::shared_ptr<RobotQuery> withObstacles(const RobotQuery& query, const py::list& obstacles) {
  std::vector<Obstacle> all = obstaclesFrom(obstacles);
  const py::gil_scoped_release released;
  return std::make_shared<RobotQuery>(query.withObstacles(std::move(all)));
}

RobotResult state(const RobotQuery& query, const py::object& values, const py::object& joint_error,
                  const py::object& base_error, const py::kwargs& request) {
  const Eigen::VectorXd at = jointValues(query.robot(), values, "values");
  const RobotErrors errors = robotErrorsFrom(query.robot(), joint_error, base_error);
  return run<RobotResult>(questionFrom(request), [&](const ProbabilityRequest& of) {
    return query.state(at, errors, of);
  });
}

py::list decideStates(const RobotQuery& query, const py::object& states, double threshold,
                      const std::optional<double>& chance_of_error, const py::object& joint_error,
                      const py::object& base_error, const py::kwargs& request) {
  const RobotErrors errors = robotErrorsFrom(query.robot(), joint_error, base_error);
  const std::vector<Eigen::VectorXd> all = waypointsFrom(query.robot(), states);
  Eigen::MatrixXd columns(query.robot().joints().size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = all[i];
  const auto decisions =
      run<std::vector<ProbableDecision>>(questionFrom(request), [&](ProbabilityRequest of) {
        of.threshold = threshold;
        return query.decideStates(columns, errors, of, chance_of_error);
      });
  py::list names;
  for (const ProbableDecision one : decisions) names.append(toString(one));
  return names;
}

ErrorsOverTime errorsFrom(const std::string& name) {
  if (const auto errors = detail::valueOf(detail::kErrorsOverTime, name)) return *errors;
  throw InvalidRequest("errors is '" + name +
                       "', must be 'persistent', 'independent' or 'any-dependence'");
}

BetweenWaypoints betweenFrom(const std::string& name) {
  if (const auto between = detail::valueOf(detail::kBetweenWaypoints, name)) return *between;
  throw InvalidRequest("between is '" + name + "', must be 'ignored' or 'swept'");
}

RobotResult motion(const RobotQuery& query, const py::object& waypoints, const std::string& errors,
                   const std::optional<double>& largest_step, const std::string& between,
                   const py::object& joint_error, const py::object& base_error,
                   const py::kwargs& request) {
  const RobotErrors of_robot = robotErrorsFrom(query.robot(), joint_error, base_error);
  std::vector<Eigen::VectorXd> all = waypointsFrom(query.robot(), waypoints);
  if (largest_step) all = interpolated(all, *largest_step);
  const ErrorsOverTime over_time = errorsFrom(errors);
  const BetweenWaypoints in_between = betweenFrom(between);
  if (!of_robot.none() &&
      (over_time != ErrorsOverTime::persistent || in_between != BetweenWaypoints::ignored)) {
    throw InvalidRequest("joint_error and base_error are the same at all waypoints");
  }
  return run<RobotResult>(questionFrom(request), [&](const ProbabilityRequest& of) {
    return of_robot.none() ? query.motion(all, over_time, of, in_between)
                           : query.motion(all, of_robot, of);
  });
}

py::tuple certify(const RobotQuery& query, const py::object& waypoints, const py::kwargs& request) {
  const std::vector<Eigen::VectorXd> all = waypointsFrom(query.robot(), waypoints);
  std::ostringstream certificate;
  RobotResult result = run<RobotResult>(questionFrom(request), [&](const ProbabilityRequest& of) {
    return query.certified(all, of, certificate);
  });
  return py::make_tuple(std::move(result), certificate.str());
}

ProbableResult decideProbably(const RobotQuery& query, const py::object& waypoints,
                              double threshold, double chance_of_error, const py::kwargs& request) {
  const std::vector<Eigen::VectorXd> all = waypointsFrom(query.robot(), waypoints);
  return run<ProbableResult>(questionFrom(request), [&](const ProbabilityRequest& of) {
    return query.decideProbably(all, threshold, chance_of_error, of);
  });
}

JointGradient gradient(const RobotQuery& query, const py::object& waypoints, std::size_t lines,
                       std::uint64_t seed, unsigned threads,
                       const std::optional<double>& time_limit, const py::object& on_progress) {
  const std::vector<Eigen::VectorXd> all = waypointsFrom(query.robot(), waypoints);
  MotionGradientRequest request;
  request.lines = lines;
  request.seed = seed;
  request.threads = threads;
  request.time_limit = time_limit;
  return runRequest<JointGradient, MotionGradientRequest>(
      request, progressFrom(on_progress),
      [&](const MotionGradientRequest& of) { return query.gradient(all, of); });
}

/// What a robot's scene file asks: (query, waypoints (n, k)).
py::tuple loadScene(const py::object& path) {
  const std::string name = pathFrom(path);
  std::shared_ptr<RobotQuery> query;
  std::vector<Eigen::VectorXd> waypoints;
  {
    const py::gil_scoped_release released;
    const RobotScene scene = loadRobotScene(name);
    requireExactRobot(scene, "a query without the errors of the robot");
    query = std::make_shared<RobotQuery>(loadRobotQuery(scene));
    waypoints = waypointsOf(scene, query->robot());
  }
  Eigen::MatrixXd rows(waypoints.size(), query->robot().joints().size());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = waypoints[i];
  return py::make_tuple(query, arrayOf(rows));
}

void bindQuery(py::module_& module) {
  py::class_<RobotQuery, std::shared_ptr<RobotQuery>>(
      module, "RobotQuery",
      "RobotQuery(robot, obstacles): a robot among obstacles, each a tuple (name, geometry,\n"
      "displacement), with a pose or a pose and a prediction behind these: displacements of the\n"
      "obstacle, world frame, independent of one another. May be used by several threads.")
      .def(py::init(&makeQuery), py::arg("robot"), py::arg("obstacles"),
           py::arg("allowed") = std::vector<std::pair<std::string, std::string>>(),
           "geometry may be a list of (geometry, pose): bodies that move as one. prediction: a\n"
           "list of (time, pose, displacement), seconds, increasing; see at(). allowed: (body,\n"
           "obstacle) names or patterns whose contact counts for nothing.")
      .def_property_readonly(
          "robot", [](const RobotQuery& query) { return std::make_shared<Robot>(query.robot()); })
      .def(
          "at",
          [](const RobotQuery& query, double time) {
            return std::make_shared<RobotQuery>(query.at(time));
          },
          py::arg("time"),
          "The same robot among the obstacles as they are predicted for a time, seconds: linear\n"
          "between the states given. Raises InvalidRequest for a time beyond them.")
      .def("with_obstacles", &withObstacles, py::arg("obstacles"),
           "The same robot among other obstacles; what was prepared of those of the same name and\n"
           "geometries is shared.")
      .def("state", &state, py::arg("values"), py::kw_only(), py::arg("joint_error") = py::none(),
           py::arg("base_error") = py::none(),
           "In one state: (k,) values of the joints, or a dict of them by name. joint_error:\n"
           "standard deviations by name or a (k, k) covariance, base_error: a PoseError; with\n"
           "either an estimate, or for method 'interval' a certified interval. request: as\n"
           "collision_probability takes it; method 'auto', 'interval' or 'estimate'.")
      .def("decide_states", &decideStates, py::arg("states"), py::arg("threshold"),
           py::arg("chance_of_error") = py::none(), py::kw_only(),
           py::arg("joint_error") = py::none(), py::arg("base_error") = py::none(),
           "Whether P in each state (n, k) is below the threshold: names as of ProbableResult,\n"
           "certain ones unless a chance of error is given. joint_error, base_error: as of "
           "state().\n"
           "request: limits and threads.")
      .def(
          "motion", &motion, py::arg("waypoints"), py::arg("errors") = "persistent",
          py::arg("largest_step") = py::none(), py::arg("between") = "ignored", py::kw_only(),
          py::arg("joint_error") = py::none(), py::arg("base_error") = py::none(),
          "At any of the waypoints (n, k). errors: 'persistent', drawn once, 'independent', drawn\n"
          "anew at each, or 'any-dependence'. largest_step: add waypoints such that no joint "
          "moves\n"
          "further at once (radians, metres). between: 'swept' for all times between waypoints,\n"
          "too, certified (persistent errors only). joint_error, base_error: as of state(), the\n"
          "same at all waypoints; an estimate.")
      .def("certified", &certify, py::arg("waypoints"),
           "At any of the waypoints (n, k), persistent errors, as an interval that somebody else\n"
           "can check: (RobotResult, certificates as text, one an obstacle, for fcl_prob_verify).")
      .def("decide_probably", &decideProbably, py::arg("waypoints"), py::arg("threshold"),
           py::arg("chance_of_error"),
           "Whether P at any of the waypoints (n, k), persistent errors, is below the threshold:\n"
           "certain, or right but for a chance (ProbableResult). request: seed and limits.")
      .def(
          "gradient", &gradient, py::arg("waypoints"), py::kw_only(), py::arg("lines") = 4096,
          py::arg("seed") = 1, py::arg("threads") = 1, py::arg("time_limit") = py::none(),
          py::arg("on_progress") = py::none(),
          "How P at any of the waypoints (n, k), persistent errors, changes with the joint values\n"
          "at each (JointGradient): an estimate from random lines. on_progress and Ctrl-C as in\n"
          "GroupQuery.motion_gradient.");
  module.def("load_robot_scene", &loadScene, py::arg("path"),
             "The RobotQuery and the waypoints (n, k) of a scene file (docs/robots.md).");
}

}  // namespace
}  // namespace fcl_prob::python

PYBIND11_MODULE(_robot, module) {
  // Of which geometries, displacements and results are.
  pybind11::module_::import("fcl_prob._core");
  fcl_prob::python::bindRobot(module);
  fcl_prob::python::bindDecisions(module);
  fcl_prob::python::bindResult(module);
  fcl_prob::python::bindQuery(module);
}
