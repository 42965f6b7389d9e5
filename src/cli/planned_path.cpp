// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/planned_path.h"

#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

using nlohmann::ordered_json;

ordered_json byJoint(const Eigen::VectorXd& values, const Robot& robot) {
  ordered_json json;
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    json[robot.joints()[i].name] = values[static_cast<Eigen::Index>(i)];
  }
  return json;
}

std::string csvLine(const Eigen::VectorXd& values) {
  std::string line;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    line += (i > 0 ? "," : "") + nlohmann::json(values[i]).dump();
  }
  return line + "\n";
}

/// What is known of the largest P of a state: by the decisions alone, where a limit ended the plan
/// before more was asked.
std::string largestText(const Bounds& largest, double threshold) {
  if (largest.lower > 0.0 || largest.upper < threshold) {
    return "certainly in " + intervalText(largest);
  }
  return "certainly below " + numberText(threshold, 6) + ", as decided; nothing nearer is known";
}

/// \param known  [0, 1] where nothing is
std::string motionText(const Bounds& known) {
  const bool unknown = known.lower <= 0.0 && known.upper >= 1.0;
  return unknown ? "unknown, a limit was reached first" : "certainly in " + intervalText(known);
}

}  // namespace

ordered_json planJson(const CertifiedPlan& plan, const Robot& robot) {
  const bool solved = plan.path.status == PlanningStatus::solved;
  ordered_json json{{"status", toString(plan.path.status)},
                    {"states", plan.path.states},
                    {"state_threshold", plan.state_threshold}};
  json["waypoints"] = ordered_json::array();
  if (!solved) return json;
  json["length"] = plan.path.length;
  json["planned_length"] = plan.path.planned_length;
  json["shortened"] = plan.path.shortened;
  json["descended"] = plan.descended;
  json["largest"] = {
      {"lower", plan.largest.lower}, {"upper", plan.largest.upper}, {"state", plan.likeliest}};
  json["motion"] = {{"lower", plan.motion.lower}, {"upper", plan.motion.upper}};
  for (const Eigen::VectorXd& values : plan.path.waypoints) {
    json["waypoints"].push_back(byJoint(values, robot));
  }
  return json;
}

std::string planCsv(const CertifiedPlan& plan, const Robot& robot) {
  std::string text;
  for (const RobotJoint& joint : robot.joints()) text += (text.empty() ? "" : ",") + joint.name;
  text += "\n";
  for (const Eigen::VectorXd& values : plan.path.waypoints) text += csvLine(values);
  return text;
}

std::string planText(const CertifiedPlan& plan, const Robot& robot) {
  std::string text = "status: " + toString(plan.path.status) + "\n" +
                     std::to_string(plan.path.states) + " states tested, those with P below " +
                     numberText(plan.state_threshold, 6) + " taken\n";
  if (plan.path.status != PlanningStatus::solved) return text;
  text += std::to_string(plan.path.waypoints.size()) + " waypoints, length " +
          numberText(plan.path.length, 6) + " in joint space, " +
          numberText(plan.path.planned_length, 6) + " before it was shortened\n";
  if (plan.descended) text += "moved along the gradient of P to get below its threshold\n";
  text += "largest P of a state: " + largestText(plan.largest, plan.state_threshold) + "\n";
  text += "P of the whole motion, the same errors all along: " + motionText(plan.motion) + "\n";
  return text + planCsv(plan, robot);
}

ordered_json planJson(const TimedPlan& plan, const Robot& robot) {
  ordered_json json{{"status", toString(plan.status)}, {"states", plan.states}};
  json["waypoints"] = ordered_json::array();
  if (plan.status != PlanningStatus::solved) return json;
  json["arrival"] = plan.arrival;
  json["length"] = plan.length;
  json["shortened"] = plan.shortened;
  json["largest"] = {
      {"lower", plan.largest.lower}, {"upper", plan.largest.upper}, {"time", plan.likeliest_time}};
  for (const TimedWaypoint& waypoint : plan.waypoints) {
    ordered_json entry{{"time", waypoint.time}};
    entry.update(byJoint(waypoint.values, robot));
    json["waypoints"].push_back(std::move(entry));
  }
  return json;
}

std::string planCsv(const TimedPlan& plan, const Robot& robot) {
  std::string text = "time";
  for (const RobotJoint& joint : robot.joints()) text += "," + joint.name;
  text += "\n";
  for (const TimedWaypoint& waypoint : plan.waypoints) {
    text += nlohmann::json(waypoint.time).dump() + "," + csvLine(waypoint.values);
  }
  return text;
}

std::string planText(const TimedPlan& plan, const Robot& robot, double threshold) {
  std::string text = "status: " + toString(plan.status) + "\n" + std::to_string(plan.states) +
                     " states asked for, each at its time, P of each below " +
                     numberText(threshold, 6) + " or refused\n";
  if (plan.status != PlanningStatus::solved) return text;
  text += std::to_string(plan.waypoints.size()) + " waypoints, at the goal after " +
          numberText(plan.arrival - plan.waypoints.front().time, 6) + " s, length " +
          numberText(plan.length, 6) + " in joint space\n";
  text += "largest P of a state, at " + numberText(plan.likeliest_time, 6) +
          " s: " + largestText(plan.largest, threshold) + "\n";
  return text + planCsv(plan, robot);
}

}  // namespace fcl_prob::cli
