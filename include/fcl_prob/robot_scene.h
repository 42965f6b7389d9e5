// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A robot, its obstacles and a motion, as a JSON file (docs/robots.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fcl_prob/robot_query.h"
#include "fcl_prob/scene_io.h"
#include "fcl_prob/self_collision.h"

namespace fcl_prob {

struct RobotScene {
  /// A robot that stands still, as an obstacle.
  struct StandingRobot {
    std::string urdf;  ///< path
    RobotOptions options;
    std::map<std::string, double> joints;
  };

  struct PlacedObstacle {
    std::string name;
    SceneObject object;                  ///< a mesh still in its file; only its pose counts with:
    std::vector<SceneObject> bodies;     ///< several, in the frame of the obstacle, or
    std::optional<StandingRobot> robot;  ///< one whose root link is where the obstacle is
    GaussianDisplacement displacement;   ///< of the obstacle, metres, world frame
    /// Of one that moves: one a waypoint of the file, or with times.
    std::vector<ObstacleState> over_time;
  };

  /// As AttachedObject; the pose of the object is that in the link's frame.
  struct CarriedObject {
    std::string name;
    std::string link;
    SceneObject object;  ///< a mesh still in its file
    std::vector<std::string> touch_links;
  };

  /// What is to be planned: a motion from one state to another.
  struct Plan {
    /// Values of joints by name, or the name of a state of the group.
    using State = std::variant<std::map<std::string, double>, std::string>;
    State start;
    State goal;
    std::vector<std::string> joints;         ///< that may move; none named: all, or
    std::string group;                       ///< those of a group of the SRDF
    std::optional<double> motion_threshold;  ///< of the whole motion
    std::uint64_t seed = 1;
    std::optional<std::size_t> max_states;

    /// Of a plan in time, as in TimedPlanningRequest.
    std::optional<double> largest_time_step;
    double start_time = 0.0;
    double hold = 0.0;
    std::optional<double> latest;
    std::map<std::string, double> velocities;
    double velocity_scale = 1.0;
  };

  std::string urdf;  ///< path
  std::string srdf;  ///< path of what says which links may touch; empty: nothing does
  RobotOptions robot;
  std::vector<CarriedObject> attached;
  std::vector<PlacedObstacle> obstacles;
  std::vector<AllowedContact> allowed;

  /// Standard deviations by name or, of the joints that are named, a covariance.
  struct JointError {
    std::map<std::string, double> sigma;
    std::vector<std::string> joints;
    Eigen::MatrixXd covariance;
  };
  std::optional<JointError> joint_error;
  std::optional<PoseError> base_error;
  /// One is a state; none with a plan. Beside joints `time`, seconds, where obstacles are
  /// predicted.
  std::vector<std::map<std::string, double>> waypoints;
  std::optional<Plan> plan;
  ErrorsOverTime errors = ErrorsOverTime::persistent;
  BetweenWaypoints between = BetweenWaypoints::ignored;
  std::optional<double> largest_step;  ///< as interpolated() takes it
  ProbabilityRequest request;          ///< defaults where the file says nothing
};

/// Reads a scene file. Paths are relative to its folder; neither the URDF nor the meshes are read.
/// \throws FileError as loadScene()
RobotScene loadRobotScene(const std::string& path);

/// The waypoints of a CSV file, whose first line names the joints, or of a JSON file: an object
/// with a list `waypoints`, as `fcl_prob plan` writes both. Of the rest of the object only
/// `largest_step` counts, at which a plan was looked at: a number > 0. \throws FileError
std::vector<std::map<std::string, double>> loadWaypoints(const std::string& path);

/// These in place of the scene's own, and the file's `largest_step` unless the scene has one.
/// \throws FileError
void loadMotion(const std::string& path, RobotScene& scene);

/// Reads the robot that the scene names, with what is attached to it. \throws FileError,
/// InvalidGeometry, InvalidRequest
Robot loadRobot(const RobotScene& scene);

/// Whether an obstacle is predicted over time: then a plan is one in time.
bool isPredicted(const RobotScene& scene);

/// Reads what the scene names; obstacles that move have a state at each of waypointsOf(), predicted
/// ones that of its time, or as they are where there are no waypoints. \throws FileError,
/// InvalidGeometry, InvalidRequest
RobotQuery loadRobotQuery(const RobotScene& scene);

/// Errors of the robot that the scene names. \throws InvalidRequest, InvalidDistribution
RobotErrors errorsOf(const RobotScene& scene, const Robot& robot);

/// \param what  begins the message \throws InvalidRequest if the scene names errors of the robot
void requireExactRobot(const RobotScene& scene, const std::string& what);

/// The joints that the plan may move, those of its group if it names one; none: all of them.
/// \throws FileError as loadGroups(); InvalidRequest for a group that is not there, or of which no
///         joint moves by itself
std::vector<std::string> plannedJoints(const RobotScene& scene, const Robot& robot);

/// Where the plan starts and ends, in the order of the robot's joints.
/// \throws as Robot::values(), and as plannedJoints() for the name of a state that its group lacks
std::pair<Eigen::VectorXd, Eigen::VectorXd> plannedEnds(const RobotScene& scene,
                                                        const Robot& robot);

/// The scene's robot against itself, with the pairs that its SRDF allows. \throws FileError
SelfCollision loadSelfCollision(const RobotScene& scene, const Robot& robot);

/// The waypoints as values in the order of the robot's joints, with those between them if the scene
/// asks for them. \throws InvalidRequest for a name that is no joint, or a value beyond its limits
std::vector<Eigen::VectorXd> waypointsOf(const RobotScene& scene, const Robot& robot);

}  // namespace fcl_prob
