// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/export_motion.h"

#include <algorithm>
#include <iostream>
#include <iterator>
#include <numeric>

#include "base/known_text.h"
#include "cli/drawn_shapes.h"
#include "cli/gltf_file.h"
#include "cli/motion_states.h"
#include "cli/number_text.h"
#include "cli/output.h"
#include "cli/picture_colours.h"
#include "cli/prepared_scene.h"
#include "cli/run.h"
#include "fcl_prob/robot_scene.h"
#include "geometry/geometry_kind.h"
#include "io/strict_json.h"
#include "robot/moving_obstacle.h"

namespace fcl_prob::cli {
namespace {

using MeshPointer = std::shared_ptr<const TriangleMesh>;

constexpr double kSecondsOfMotion = 4.0;

/// Between two times viewers move bodies along straight lines: with steps of so many radians what
/// turns 1 m away is within 0.3 mm of where it should be.
constexpr double kStepOfAnimation = 0.05;

/// Of an ellipsoid's axes to its longest one: a flat one could not be seen from its edge, nor a
/// line at all.
constexpr double kThinnest = 0.01;

const Colour kMoving(0.2F, 0.24F, 0.32F, 1.0F);

/// What moves is drawn over what it passes, and leaves that to be seen.
Colour faint(const Colour& colour) { return {colour[0], colour[1], colour[2], 0.4F}; }

using Poses = std::vector<fcl::Transform3d>;

/// Whether a body is the same set of points at both poses, as a base or a turret that turns around
/// its axis is.
bool isSamePlace(const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& a,
                 const fcl::Transform3d& b) {
  constexpr double kSame = 1e-9;
  if ((a.translation() - b.translation()).norm() > kSame) return false;
  const fcl::NODE_TYPE type = geometry.getNodeType();
  if (type == fcl::GEOM_SPHERE) return true;
  const bool round =
      type == fcl::GEOM_CYLINDER || type == fcl::GEOM_CAPSULE || type == fcl::GEOM_CONE;
  const Eigen::Matrix3d difference = a.linear() - b.linear();
  return (round ? difference.col(2).norm() : difference.norm()) <= kSame;
}

/// Positions of the states, the likeliest first.
std::vector<std::size_t> byLikelihood(const std::vector<MotionState>& states) {
  std::vector<std::size_t> order(states.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return states[a].result.probability() > states[b].result.probability();
  });
  return order;
}

/// All bodies of an obstacle that have an end; null if none has.
MeshPointer drawnObstacle(const Obstacle& obstacle) {
  TriangleMesh all;
  const auto add = [&all](const fcl::CollisionGeometryd& geometry, const fcl::Transform3d& pose) {
    if (detail::kindOf(geometry) == detail::GeometryKind::unbounded) return;
    append(drawnGeometry(geometry), pose, all);
  };
  add(*obstacle.geometry, fcl::Transform3d::Identity());
  for (const ObstacleBody& body : obstacle.more) add(*body.geometry, body.in_obstacle);
  return all.triangles.empty() ? nullptr : std::make_shared<const TriangleMesh>(std::move(all));
}

class MotionScene {
 public:
  MotionScene(const RobotQuery& query, const std::vector<Eigen::VectorXd>& waypoints)
      : query_(query), waypoints_(waypoints) {
    for (const RobotBody& body : query.robot().bodies()) {
      bodies_.push_back(std::make_shared<const TriangleMesh>(drawnGeometry(*body.geometry)));
    }
    for (const Obstacle& obstacle : query.obstacles()) {
      obstacles_.push_back(drawnObstacle(obstacle));
    }
  }

  /// What takes up the same place in several states is drawn once, in the colour of the likeliest
  /// of them: a viewer would show their colours in patches.
  void addStates(const std::vector<MotionState>& shown) {
    std::vector<MeshGroup> groups;
    for (const MotionState& state : shown) groups.push_back(groupOf(state));
    std::vector<Poses> drawn(bodies_.size());
    for (const std::size_t i : byLikelihood(shown)) {
      const Poses poses = query_.robot().poses(waypoints_[shown[i].waypoint]);
      for (std::size_t k = 0; k < poses.size(); ++k) {
        const auto is_here = [&](const fcl::Transform3d& other) {
          return isSamePlace(*body(k).geometry, poses[k], other);
        };
        if (std::any_of(drawn[k].begin(), drawn[k].end(), is_here)) continue;
        drawn[k].push_back(poses[k]);
        groups[i].members.push_back(
            {body(k).name(), bodies_[k], heat(shown[i].result.probability()), poses[k]});
      }
    }
    std::move(groups.begin(), groups.end(), std::back_inserter(scene_.groups));
  }

  void addObstacles(const std::vector<MotionState>& shown) {
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
      if (!obstacles_[i]) continue;
      const Obstacle& obstacle = query_.obstacles()[i];
      if (obstacle.over_time.empty()) {
        addObstacle(i, obstacle.name, shown[likeliestOf(shown)].waypoint);
        continue;
      }
      for (const MotionState& state : shown) {
        addObstacle(i, obstacle.name + ", " + atWaypoint(state), state.waypoint);
      }
    }
  }

  void addMovement() {
    const auto steps = detail::stepsBetween(waypoints_, kStepOfAnimation);
    MeshGroup group{"motion", {}, {}};
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      group.members.push_back({body(k).name(), bodies_[k], faint(kMoving)});
    }
    for (const Eigen::VectorXd& values : interpolated(waypoints_, kStepOfAnimation)) {
      const Poses poses = query_.robot().poses(values);
      for (std::size_t k = 0; k < poses.size(); ++k) group.members[k].path.push_back(poses[k]);
    }
    removeStanding(group.members);
    for (std::size_t i = 0; i < obstacles_.size(); ++i) addMovingObstacle(i, steps, group);
    if (group.members.empty()) return;
    for (PlacedMesh& member : group.members) member.pose = member.path.front();
    scene_.groups.push_back(std::move(group));
    const std::vector<double> times = timesOfWaypoints();
    for (const detail::WaypointStep& step : steps) {
      scene_.times.push_back(detail::timeOf(step, times));
    }
  }

  AnimatedScene scene() && { return std::move(scene_); }

 private:
  static std::string atWaypoint(const MotionState& state) {
    return "waypoint " + std::to_string(state.waypoint);
  }

  static const GaussianDisplacement& errorOf(const ObstacleState& state) {
    return std::get<GaussianDisplacement>(state.displacement);  // robot scenes know no others
  }

  static fcl::Transform3d expectedPose(const ObstacleState& state) {
    fcl::Transform3d pose = state.pose;
    return pose.pretranslate(errorOf(state).mean());
  }

  const RobotBody& body(std::size_t index) const { return query_.robot().bodies()[index]; }

  static MeshGroup groupOf(const MotionState& state) {
    const RobotResult& result = state.result;
    MeshGroup group{
        atWaypoint(state) + ": P " + detail::relationText(result.estimate, result.any), {}, {}};
    group.notes = {{"waypoint", state.waypoint},
                   {"probability", result.probability()},
                   {"lower", result.any.lower},
                   {"upper", result.any.upper}};
    return group;
  }

  /// Of all bodies, those that take up the same place at all times.
  void removeStanding(std::vector<PlacedMesh>& members) const {
    std::vector<PlacedMesh> moving;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const Poses& path = members[k].path;
      const auto is_elsewhere = [&](const fcl::Transform3d& pose) {
        return !isSamePlace(*body(k).geometry, path.front(), pose);
      };
      if (std::any_of(path.begin(), path.end(), is_elsewhere)) {
        moving.push_back(std::move(members[k]));
      }
    }
    members = std::move(moving);
  }

  TriangleMesh robotAt(std::size_t waypoint) const {
    const Poses poses = query_.robot().poses(waypoints_[waypoint]);
    TriangleMesh all;
    for (std::size_t i = 0; i < poses.size(); ++i) append(*bodies_[i], poses[i], all);
    return all;
  }

  void addObstacle(std::size_t index, const std::string& name, std::size_t waypoint) {
    const ObstacleState state = detail::stateAt(query_.obstacles()[index], waypoint);
    const fcl::Transform3d pose = expectedPose(state);
    MeshGroup group{name, {{name, obstacles_[index], touchedColour(), pose}}, {}};
    const GaussianDisplacement& error = errorOf(state);
    if (error.rank() > 0) {
      const Eigen::Vector3d& deviations = error.standardDeviations();
      const auto visible = GaussianDisplacement::fromStandardDeviations(
          deviations.cwiseMax(kThinnest * deviations[0]), Eigen::Quaterniond(error.axes()));
      const Eigen::Vector3d centre =
          nearestPoint(moved(*obstacles_[index], pose), robotAt(waypoint));
      for (const int k : {1, 2, 3}) {
        group.members.push_back(
            {name + ", " + std::to_string(k) + " sigma",
             std::make_shared<const TriangleMesh>(drawnEllipsoid(visible, k, centre)),
             ellipsoidColour(k)});
      }
    }
    scene_.groups.push_back(std::move(group));
  }

  /// Seconds since the first; where obstacles are predicted those of the motion.
  std::vector<double> timesOfWaypoints() const {
    const auto& obstacles = query_.obstacles();
    const auto predicted = std::find_if(
        obstacles.begin(), obstacles.end(),
        [](const Obstacle& obstacle) { return detail::isPredicted(obstacle.over_time); });
    const double last = static_cast<double>(waypoints_.size() - 1);
    std::vector<double> times;
    for (std::size_t i = 0; i < waypoints_.size(); ++i) {
      times.push_back(predicted == obstacles.end()
                          ? kSecondsOfMotion * static_cast<double>(i) / last
                          : *predicted->over_time[i].time - *predicted->over_time[0].time);
    }
    return times;
  }

  void addMovingObstacle(std::size_t index, const std::vector<detail::WaypointStep>& steps,
                         MeshGroup& group) const {
    const Obstacle& obstacle = query_.obstacles()[index];
    if (!obstacles_[index] || obstacle.over_time.empty()) return;
    PlacedMesh moving{obstacle.name, obstacles_[index], faint(touchedColour())};
    for (const ObstacleState& state : detail::statesAt(obstacle.over_time, steps)) {
      moving.path.push_back(expectedPose(state));
    }
    group.members.push_back(std::move(moving));
  }

  const RobotQuery& query_;
  const std::vector<Eigen::VectorXd>& waypoints_;
  std::vector<MeshPointer> bodies_;
  std::vector<MeshPointer> obstacles_;  ///< null: cannot be drawn
  AnimatedScene scene_;
};

/// The robot at the waypoints of `shown`, each coloured by its probability (what takes up the same
/// place at several of them, once, by the largest); the obstacles where they are expected, each
/// with its ellipsoids of 1, 2 and 3 sigma around the point of it that is nearest to the robot at
/// the likeliest of these waypoints (one that moves: at all of them); and, if `animated`, what of
/// the robot and the obstacles moves between the waypoints, faint. Unbounded obstacles are left
/// out.
/// \param shown  at least one
AnimatedScene motionScene(const RobotQuery& query, const std::vector<Eigen::VectorXd>& waypoints,
                          const std::vector<MotionState>& shown, bool animated) {
  MotionScene scene(query, waypoints);
  scene.addStates(shown);
  scene.addObstacles(shown);
  if (animated && waypoints.size() > 1) scene.addMovement();
  return std::move(scene).scene();
}

RobotScene drawnSceneOf(const MotionExportArguments& arguments) {
  RobotScene scene = loadRobotScene(arguments.scene);
  if (!arguments.motion.empty()) loadMotion(arguments.motion, scene);
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
