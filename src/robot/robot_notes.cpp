// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/robot_notes.h"

#include <algorithm>

#include "base/constants.h"
#include "fcl_prob/exceptions.h"
#include "io/import_notes.h"

namespace fcl_prob::detail {
namespace {

double leastDeviationOf(const Displacement& displacement) {
  if (const auto* gaussian = std::get_if<GaussianDisplacement>(&displacement)) {
    return leastDeviation(*gaussian);
  }
  if (const auto* truncated = std::get_if<TruncatedGaussian>(&displacement)) {
    return leastDeviation(truncated->gaussian());
  }
  double least = kInfinity;
  for (const auto& component : std::get<GaussianMixture>(displacement).components()) {
    least = std::min(least, leastDeviation(component.displacement));
  }
  return least;
}

double leastDeviationOf(const Obstacle& obstacle) {
  if (obstacle.over_time.empty()) return leastDeviationOf(obstacle.displacement);
  double least = kInfinity;
  for (const ObstacleState& state : obstacle.over_time) {
    least = std::min(least, leastDeviationOf(state.displacement));
  }
  return least;
}

}  // namespace

std::vector<std::string> standingNotes(const Robot& robot, const std::vector<Obstacle>& obstacles) {
  std::vector<std::string> notes = robot.notes();
  for (const Obstacle& obstacle : obstacles) addNotes(obstacle.notes, notes);
  std::string names;
  for (const std::string& link : robot.linksWithoutBody()) {
    names += (names.empty() ? "" : ", ") + link;
  }
  const bool all_taken = robot.options().links.empty();
  const std::string which =
      all_taken ? "links without a body" : "links that are left out or have no body";
  if (!names.empty()) notes.push_back(which + ", which nothing touches: " + names);
  return notes;
}

std::vector<std::string> precisionNotes(const Robot& robot, const std::vector<Obstacle>& obstacles,
                                        double tolerance) {
  std::vector<std::string> notes;
  const auto add = [&](const std::string& subject, double coordinate_error, double deviation) {
    const auto note = precisionNote(subject, coordinate_error, deviation, tolerance);
    if (note) notes.push_back(*note);
  };
  double of_robot = 0.0, least = kInfinity;
  for (const RobotBody& body : robot.bodies()) {
    of_robot = std::max(of_robot, body.coordinate_error);
  }
  for (const Obstacle& obstacle : obstacles) least = std::min(least, leastDeviationOf(obstacle));
  add("meshes of the robot are", of_robot, least);
  for (const Obstacle& obstacle : obstacles) {
    add("the file of obstacle " + obstacle.name + " is", obstacle.coordinate_error,
        leastDeviationOf(obstacle));
  }
  return notes;
}

std::vector<std::string> allNotes(const RobotQuery& query, double tolerance) {
  std::vector<std::string> notes = standingNotes(query.robot(), query.obstacles());
  addNotes(precisionNotes(query.robot(), query.obstacles(), tolerance), notes);
  return notes;
}

void requireWithinLimits(const Robot& robot, const std::vector<Eigen::VectorXd>& waypoints) {
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    try {
      robot.requireWithinLimits(waypoints[i]);
    } catch (const InvalidRequest& error) {
      if (waypoints.size() == 1) throw;
      throw InvalidRequest("waypoint " + std::to_string(i) + ": " + error.what());
    }
  }
}

}  // namespace fcl_prob::detail
