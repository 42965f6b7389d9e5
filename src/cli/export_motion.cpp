// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/export_motion.h"

#include <algorithm>
#include <iostream>

#include "base/known_text.h"
#include "cli/motion_scene.h"
#include "cli/number_text.h"
#include "cli/output.h"
#include "cli/prepared_scene.h"
#include "cli/run.h"
#include "fcl_prob/robot_scene.h"
#include "geometry/geometry_kind.h"
#include "io/strict_json.h"

namespace fcl_prob::cli {
namespace {

RobotScene drawnSceneOf(const MotionExportArguments& arguments) {
  RobotScene scene = loadRobotScene(arguments.scene);
  if (!arguments.motion.empty()) scene.waypoints = loadWaypoints(arguments.motion);
  if (arguments.largest_step) scene.largest_step = arguments.largest_step;
  scene.robot.allow_outside_limits |= arguments.allow_outside_limits;
  if (scene.waypoints.empty()) {
    throw InvalidRequest("--motion: is missing, and " + arguments.scene + " has no waypoints");
  }
  return scene;
}

/// The numbers behind the colours, and what is not in the picture.
void tell(const RobotQuery& query, const std::vector<MotionState>& shown) {
  for (const MotionState& state : shown) {
    std::cerr << "fcl_prob: waypoint " << state.waypoint << ": P "
              << detail::relationText(state.result.estimate, state.result.any) << ", certainly in "
              << intervalText(state.result.any) << '\n';
  }
  for (const Obstacle& obstacle : query.obstacles()) {
    if (detail::kindOf(*obstacle.geometry) != detail::GeometryKind::unbounded) continue;
    std::cerr << "fcl_prob: " << onOneLine(obstacle.name) << " is unbounded and not drawn\n";
  }
}

}  // namespace

bool isRobotScene(const std::string& path) { return detail::parseJsonFile(path).contains("robot"); }

int exportMotion(const MotionExportArguments& arguments) {
  const RobotScene scene = drawnSceneOf(arguments);
  requireExactRobot(scene, "a picture");
  const RobotQuery query = loadRobotQuery(scene);
  const std::vector<Eigen::VectorXd> waypoints = waypointsOf(scene, query.robot());
  const std::vector<MotionState> states = statesOf(query, waypoints, scene.request);
  const std::vector<MotionState> shown = chosenFrom(states, arguments.poses);
  writeFile(arguments.output,
            gltfOf(motionScene(query, waypoints, shown, !arguments.still), arguments.form));
  tell(query, shown);
  const bool stopped = std::any_of(states.begin(), states.end(), [](const MotionState& state) {
    return stoppedByLimit(state.result.status);
  });
  return stopped ? kStopped : kAnswered;
}

}  // namespace fcl_prob::cli
