// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The extension module fcl_prob._planning: motions of robots, which take OMPL and NLopt.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "fcl_prob/certified_planning.h"
#include "fcl_prob/timed_planning.h"
#include "python/arrays.h"
#include "python/results.h"
#include "python/robot_values.h"
#include "python/running.h"

namespace fcl_prob::python {
namespace {

py::object rowsOf(const std::vector<Eigen::VectorXd>& waypoints) {
  Eigen::MatrixXd rows(waypoints.size(), waypoints.empty() ? 0 : waypoints[0].size());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    rows.row(i) = waypoints[static_cast<std::size_t>(i)];
  }
  return arrayOf(rows);
}

std::vector<Eigen::VectorXd> valuesOf(const TimedPlan& plan) {
  std::vector<Eigen::VectorXd> values;
  for (const TimedWaypoint& waypoint : plan.waypoints) values.push_back(waypoint.values);
  return values;
}

py::object timesOf(const TimedPlan& plan) {
  Eigen::VectorXd times(plan.waypoints.size());
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    times[i] = plan.waypoints[static_cast<std::size_t>(i)].time;
  }
  return vectorArray(times);
}

/// Keywords that are of the plan; the others are of its states.
class PlanKeywords {
 public:
  explicit PlanKeywords(const py::kwargs& keywords) : left_(keywords.attr("copy")()) {}

  /// Leaves the default where it is not given.
  template <class T>
  void take(const char* name, T& into) {
    if (!left_.contains(name)) return;
    const py::object value = left_.attr("pop")(name);
    try {
      into = value.cast<T>();
    } catch (const py::cast_error&) {
      throw py::type_error(std::string(name) + " cannot be " + textOf(value));
    }
  }

  PlanningRequest planning() {
    PlanningRequest request;
    take("joints", request.joints);
    take("largest_step", request.largest_step);
    take("seed", request.seed);
    take("max_states", request.max_states);
    take("time_limit", request.time_limit);
    take("shorten", request.shorten);
    return request;
  }

  /// What decides states. A planner asks for thousands, and those that are hard are not needed.
  Question states(double threshold) {
    constexpr std::size_t kCellsOfState = 2'000;
    if (!left_.contains("max_cells")) left_["max_cells"] = kCellsOfState;
    left_["threshold"] = threshold;
    return questionFrom(py::reinterpret_borrow<py::kwargs>(left_));
  }

 private:
  py::dict left_;
};

/// Where plans begin and end, as Python gives it.
struct Ends {
  const py::object& start;
  const py::object& goal;
  const std::shared_ptr<SelfCollision>& self_collision;
};

/// Runs a plan without the GIL; on_progress has the states asked for so far, seconds, and whether a
/// path is being shortened.
template <class Plan, class Request>
Plan planned(const RobotQuery& query, const Ends& ends, Request request, Question question,
             Plan (*plan)(const RobotQuery&, const SelfCollision&, const Eigen::VectorXd&,
                          const Eigen::VectorXd&, const Request&)) {
  const Eigen::VectorXd from = jointValues(query.robot(), ends.start, "start");
  const Eigen::VectorXd to = jointValues(query.robot(), ends.goal, "goal");
  const SelfCollision self =
      ends.self_collision ? *ends.self_collision : SelfCollision(query.robot());
  Interruption interruption(std::move(question.on_progress));
  request.state = std::move(question.request);
  request.planning.on_progress = [&](const PlanningProgress& now) {
    return interruption.goOn(
        [&] { return py::make_tuple(now.states, now.seconds, now.shortening); });
  };
  std::optional<Plan> result;
  {
    const py::gil_scoped_release released;
    result = plan(query, self, from, to, request);
  }
  interruption.raise([&] { return py::cast(*result); });
  return std::move(*result);
}

/// Takes these keywords, too.
RobotErrors errorsOf(const RobotQuery& query, PlanKeywords& given) {
  py::object joint_error = py::none(), base_error = py::none();
  given.take("joint_error", joint_error);
  given.take("base_error", base_error);
  return robotErrorsFrom(query.robot(), joint_error, base_error);
}

CertifiedPlan plan(const RobotQuery& query, const py::object& start, const py::object& goal,
                   double threshold, const std::shared_ptr<SelfCollision>& self_collision,
                   const std::optional<double>& motion_threshold, const py::kwargs& keywords) {
  PlanKeywords given(keywords);
  CertifiedPlanningRequest request;
  request.motion_threshold = motion_threshold;
  given.take("descend", request.descend);
  request.errors = errorsOf(query, given);
  request.planning = given.planning();
  return planned(query, {start, goal, self_collision}, std::move(request), given.states(threshold),
                 &planCertified);
}

TimedPlan planTimed(const RobotQuery& query, const py::object& start, const py::object& goal,
                    double threshold, const std::shared_ptr<SelfCollision>& self_collision,
                    const py::kwargs& keywords) {
  PlanKeywords given(keywords);
  TimedPlanningRequest request;
  given.take("largest_time_step", request.largest_time_step);
  given.take("start_time", request.start_time);
  given.take("hold", request.hold);
  given.take("latest", request.latest);
  given.take("velocities", request.velocities);
  given.take("velocity_scale", request.velocity_scale);
  request.errors = errorsOf(query, given);
  request.planning = given.planning();
  return planned(query, {start, goal, self_collision}, std::move(request), given.states(threshold),
                 &planInTime);
}

void bindPlans(py::module_& module) {
  using C = CertifiedPlan;
  py::class_<C>(module, "Plan", "A motion every state of which is below a threshold (plan()).")
      .def_property_readonly("status", [](const C& p) { return toString(p.path.status); })
      .def_property_readonly(
          "waypoints", [](const C& p) { return rowsOf(p.path.waypoints); },
          "(n, k) float64; between two of them values are linear. Empty unless solved.")
      .def_property_readonly("length", [](const C& p) { return p.path.length; })
      .def_property_readonly("states", [](const C& p) { return p.path.states; })
      .def_property_readonly("state_threshold", [](const C& p) { return p.state_threshold; })
      .def_property_readonly(
          "largest", [](const C& p) { return pairOf(p.largest); },
          "(lower, upper) of the largest P of a state, certified.")
      .def_property_readonly(
          "motion", [](const C& p) { return pairOf(p.motion); },
          "(lower, upper) of P that any state touches, errors being the same all along.")
      .def("__repr__", [](const C& p) {
        return "<Plan " + toString(p.path.status) + " with " +
               std::to_string(p.path.waypoints.size()) + " waypoints>";
      });
  using T = TimedPlan;
  py::class_<T>(module, "TimedPlan", "A motion in time (plan_in_time()).")
      .def_property_readonly("status", [](const T& p) { return toString(p.status); })
      .def_property_readonly("times", &timesOf, "(n,) float64, seconds.")
      .def_property_readonly(
          "waypoints", [](const T& p) { return rowsOf(valuesOf(p)); }, "(n, k) float64.")
      .def_property_readonly("arrival", [](const T& p) { return p.arrival; })
      .def_property_readonly("length", [](const T& p) { return p.length; })
      .def_property_readonly("states", [](const T& p) { return p.states; })
      .def_property_readonly(
          "largest", [](const T& p) { return pairOf(p.largest); },
          "(lower, upper) of the largest P of a state, certified.")
      .def_property_readonly("likeliest_time", [](const T& p) { return p.likeliest_time; })
      .def("__repr__", [](const T& p) {
        return "<TimedPlan " + toString(p.status) + " with " + std::to_string(p.waypoints.size()) +
               " waypoints>";
      });
}

}  // namespace
}  // namespace fcl_prob::python

PYBIND11_MODULE(_planning, module) {
  namespace py = pybind11;
  // Of which robots and queries are.
  py::module_::import("fcl_prob._robot");
  fcl_prob::python::bindPlans(module);
  module.def(
      "plan", &fcl_prob::python::plan, py::arg("query"), py::arg("start"), py::arg("goal"),
      py::arg("threshold"), py::arg("self_collision") = py::none(),
      py::arg("motion_threshold") = py::none(),
      "A motion of the query's robot, every state of which does not touch the robot itself\n"
      "and has a P that is certainly below the threshold (Plan).\n\n"
      "self_collision: a SelfCollision; None: of the robot without an SRDF.\n"
      "motion_threshold: P of the whole motion stays below it, too. keywords: joints (names\n"
      "of those that may move), largest_step (radians, metres), seed, max_states,\n"
      "time_limit (seconds, of the plan), shorten, descend, joint_error and base_error (as of\n"
      "RobotQuery.state); of a state as\n"
      "collision_probability, max_cells being 2,000. on_progress(states, seconds,\n"
      "shortening) returns False to stop.");
  module.def("plan_in_time", &fcl_prob::python::planTimed, py::arg("query"), py::arg("start"),
             py::arg("goal"), py::arg("threshold"), py::arg("self_collision") = py::none(),
             "The same among obstacles with predictions, each state at its time (TimedPlan).\n\n"
             "keywords, besides: largest_time_step, start_time, hold and latest (seconds),\n"
             "velocities (by joint, radians or metres per second, in place of the URDF's),\n"
             "velocity_scale.");
}
