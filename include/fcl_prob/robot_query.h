// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The probability that a robot, in one state or along a motion, touches what was perceived.
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/joint_gradient.h"
#include "fcl_prob/mixture.h"
#include "fcl_prob/probability_result.h"
#include "fcl_prob/probable_decision.h"
#include "fcl_prob/robot.h"
#include "fcl_prob/robot_errors.h"

namespace fcl_prob {

namespace detail {
class RobotAmongObstacles;
}

/// Where an obstacle is at one waypoint of a motion, or at a time, and how well that is known.
struct ObstacleState {
  fcl::Transform3d pose = fcl::Transform3d::Identity();  ///< metres, world frame
  Displacement displacement = GaussianDisplacement();    ///< as Obstacle::displacement
  std::optional<double> time = std::nullopt;             ///< seconds
};

/// One more body of an obstacle.
struct ObstacleBody {
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  fcl::Transform3d in_obstacle = fcl::Transform3d::Identity();  ///< metres, obstacle's frame
};

/// Something that the robot may touch, with the error of where it was perceived.
struct Obstacle {
  std::string name;
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  fcl::Transform3d pose = fcl::Transform3d::Identity();  ///< metres, world frame
  /// Of the obstacle, metres, world frame; independent of that of every other one.
  Displacement displacement = GaussianDisplacement();

  /// Of one that moves, or that is known less and less well: one state a waypoint of the motion,
  /// which count instead of `pose` and `displacement`; or a prediction, states each of which has a
  /// later time than the one before (see RobotQuery::at()). Empty: it stays.
  std::vector<ObstacleState> over_time = {};

  /// Of a mesh: as in TriangleMesh. Both are told with answers, and nothing depends on them.
  double coordinate_error = 0.0;  ///< metres
  std::vector<std::string> notes = {};

  /// Further bodies that move with `geometry`, which is in the obstacle's frame as it is: the same
  /// displacement is that of all of them.
  std::vector<ObstacleBody> more = {};
};

/// All bodies of a robot in one state as one obstacle, as a person whose URDF is known.
/// \param values  of the joints of `robot`, whose base says where it is
/// \throws InvalidRequest as Robot::requireWithinLimits()
Obstacle obstacleOf(const std::string& name, const Robot& robot, const Eigen::VectorXd& values,
                    Displacement displacement);

/// Bodies of the robot that may touch obstacles: their contact counts for nothing, as that of a
/// base with the floor it stands on. Names, or patterns of a shell (`*`, `?`, `[a-c]`): those of
/// RobotBody::name() and Obstacle::name.
struct AllowedContact {
  std::string body;
  std::string obstacle;
};

/// What the errors of an obstacle at one waypoint have to do with those at another one.
enum class ErrorsOverTime {
  /// The obstacle was perceived once: its error is the same all along. One that moves may then only
  /// shift, and its covariance may not change.
  persistent,
  independent,    ///< drawn anew at every waypoint
  any_dependence  ///< anything: bounds that hold whatever it is
};

/// Whether a motion is its waypoints only, or all of the way from each to the next.
enum class BetweenWaypoints {
  ignored,  ///< what is between them is not looked at
  swept     ///< the joints move linearly, in continuous time; the interval is certified for that
};

/// P(any body of the robot touches any obstacle).
struct RobotResult {
  /// Certified, rounding included.
  Bounds any{0.0, 1.0};

  /// With ProbabilityMethod::estimate: not certified, with its standard error.
  std::optional<double> estimate;
  std::optional<double> standard_error;

  /// Of an estimate over errors of the robot: covers P with ProbabilityRequest::confidence.
  std::optional<Bounds> confidence_interval;

  Decision decision = Decision::none;
  ProbabilityStatus status = ProbabilityStatus::converged;

  /// By obstacle, in their order; unless errors are persistent: by waypoint, and for each by
  /// obstacle. Empty `upper` where the decision did not need it.
  std::vector<ProbabilityResult> parts;

  /// Bodies at waypoints that are so far away that together they are no likelier to touch than
  /// `far_upper`, which is part of `any`: no triangle of them was looked at.
  std::size_t far_bodies = 0;
  double far_upper = 0.0;

  /// Unless errors are persistent: P that anything is touched at each waypoint, and bounds on P for
  /// the motion that hold whatever the errors of an obstacle at one waypoint have to do with those
  /// at another one: of the worst waypoint and of their sum.
  std::vector<Bounds> by_waypoint;
  std::optional<Bounds> any_dependence;

  /// Between waypoints: no point of a body that is not far is ever farther from where it is in a
  /// state that was looked at, metres. Steps of bodies with such a state.
  std::optional<double> swept_band;
  std::size_t swept_steps = 0;

  /// What was left out and what may be meant otherwise, in sentences: Robot::notes(), notes of the
  /// obstacles' meshes, meshes in single precision where that is not negligible, links without a
  /// body.
  std::vector<std::string> plan;

  /// The single number to use: the estimate if there is one, else the middle of the interval.
  double probability() const { return estimate ? *estimate : any.middle(); }
};

/// A robot among obstacles. All bodies of the robot share the displacement of an obstacle, so that
/// one partition works on the union of them; obstacles are combined as independent events.
///
/// Const and thread-safe after construction.
class RobotQuery {
 public:
  /// \throws InvalidRequest without an obstacle, for an allowed contact of a body or obstacle that
  ///         is not there, or times of an obstacle that do not increase; InvalidPose,
  ///         InvalidGeometry, UnsupportedGeometry
  RobotQuery(const Robot& robot, std::vector<Obstacle> obstacles,
             std::vector<AllowedContact> allowed = {});
  ~RobotQuery();
  RobotQuery(RobotQuery&&) noexcept;
  RobotQuery& operator=(RobotQuery&&) noexcept;

  const Robot& robot() const;
  const std::vector<Obstacle>& obstacles() const;
  const std::vector<AllowedContact>& allowed() const;

  /// What the query is made of, for other parts of this library.
  const detail::RobotAmongObstacles& among() const;

  /// The same robot among other obstacles. What was prepared is shared, that of obstacles of the
  /// same name and geometries (by pointer), too: one that has only moved costs microseconds.
  /// Allowed contacts stay, whether or not their obstacles are there. \throws as the constructor
  RobotQuery withObstacles(std::vector<Obstacle> obstacles) const;

  /// The same robot among the obstacles as they are predicted for a time, seconds: between two
  /// states of Obstacle::over_time positions, mean displacements and covariances are linear, and
  /// orientations on the shortest turn. Obstacles without times are as they were. Microseconds.
  /// \throws InvalidRequest for an obstacle that nothing is predicted of at that time, or between
  ///         displacements that are not Gaussian
  RobotQuery at(double time) const;

  /// States and waypoints are refused where a joint is beyond its limits, unless the robot was
  /// loaded to allow that: every member throws InvalidRequest as Robot::requireWithinLimits().
  ///
  /// In one state. The tolerances, the threshold and the limits are those of the whole answer.
  /// \param request  method automatic, interval or estimate
  /// \throws InvalidRequest, OpenMesh, UnsupportedGeometry as GroupQuery
  RobotResult state(const Eigen::VectorXd& values, const ProbabilityRequest& request) const;

  /// In one state that is known up to errors of the joints and the base: P over these and all
  /// displacements. An estimate, whose threshold is decided with ProbabilityRequest::confidence;
  /// `any` is [0, 1] but where the errors turn out to be none. For method interval a certified one,
  /// by half-spaces and bands: as narrow as was asked for only where the errors move them by much
  /// less than the obstacles' deviations. Values that are drawn may be beyond the limits of joints.
  /// There is no answer by obstacle. Where no errors are given: as state().
  /// \param request  method automatic, interval, estimate or monte_carlo
  /// \throws InvalidDistribution for a covariance that is none, or not of the robot's joints;
  ///         UnsupportedGeometry where contact with some obstacles only is allowed; InvalidRequest
  ///         for a displacement that is not Gaussian or an obstacle that moves; as state()
  RobotResult state(const Eigen::VectorXd& values, const RobotErrors& errors,
                    const ProbabilityRequest& request) const;

  /// At any of the waypoints, with persistent errors, as a certified interval that somebody else
  /// can check: see certifiedProbability(). One certificate an obstacle, those that no body may
  /// touch left out. No body is left out as far.
  /// \throws UnsupportedGeometry for obstacles whose displacement is not Gaussian; as
  ///         certifiedProbability() and motion()
  RobotResult certified(const std::vector<Eigen::VectorXd>& waypoints,
                        const ProbabilityRequest& request, std::ostream& certificate) const;

  /// At any of the waypoints, or at any time between them, too.
  /// Persistent errors: the mass of the union over time of what the robot sweeps, one group query
  /// an obstacle; at least the largest P of a waypoint, at most their sum.
  ///
  /// Obstacles that move, linearly between waypoints, take part in that. Errors of any dependence:
  /// `any` is RobotResult::any_dependence, as wide as that is, and the tolerance that of each
  /// waypoint.
  ///
  /// With what is between them `lower` is that of states on the way, and `upper` is widened by how
  /// far the points of a body can move besides. Steps are halved until the tolerance is met or, if
  /// there is one, the threshold decided, or a limit reached (`resolution_limit`: they are as short
  /// as they get); far_bodies then counts steps of bodies. \throws InvalidRequest without a
  /// waypoint, or unless an obstacle that moves has a state at each;
  ///         with persistent errors for one that turns or whose covariance changes; with any
  ///         dependence for method estimate; for what is between waypoints with other than
  ///         persistent errors, which would be drawn without end, or method estimate; as state()
  RobotResult motion(const std::vector<Eigen::VectorXd>& waypoints, ErrorsOverTime errors,
                     const ProbabilityRequest& request,
                     BetweenWaypoints between = BetweenWaypoints::ignored) const;

  /// At any of the waypoints, the errors of joints, base and obstacles being the same at each: an
  /// estimate, as that of one state. \throws as state() with errors; InvalidRequest for method
  ///         interval, of more than one waypoint
  RobotResult motion(const std::vector<Eigen::VectorXd>& waypoints, const RobotErrors& errors,
                     const ProbabilityRequest& request) const;

  /// On which side of a threshold P is at any of the waypoints, with persistent errors, from
  /// whatever tells it first: bounds, lines drawn beside bodies that are convex meshes (or nearly),
  /// or motion(). What lines decided is wrong with a chance of at most `chance_of_error`, however
  /// often they were looked at; a certain decision is never. (Obstacles without such lines,
  /// unbounded ones and those with a displacement that is not Gaussian are decided by motion().)
  /// \param request  method automatic; its limits and its seed count, tolerances do not \throws
  /// InvalidRequest for a chance that is not in (0, 1), another method, and as motion()
  ProbableResult decideProbably(const std::vector<Eigen::VectorXd>& waypoints, double threshold,
                                double chance_of_error, const ProbabilityRequest& request) const;

  /// On which side of the request's threshold P is in each of many states, as a planner asks: a
  /// column a state. Limits are those of a state, but for the time, which is that of the call; its
  /// threads share the states, and do not change what is answered. Once `on_progress` says no the
  /// states that are left are undecided; it is called by one thread at a time.
  /// \param chance_of_error  of every state that is decided otherwise than certainly, as
  ///         decideProbably(); none: all are certain or undecided
  /// \throws InvalidRequest without a threshold, or as state() and decideProbably()
  std::vector<ProbableDecision> decideStates(
      const Eigen::MatrixXd& states, const ProbabilityRequest& request,
      std::optional<double> chance_of_error = std::nullopt) const;

  /// The same where the robot is known up to errors of its joints and base only. What is told as
  /// below is so by half-spaces in the space of displacements and errors together, in a millisecond
  /// a state. \throws as state() with errors
  std::vector<ProbableDecision> decideStates(
      const Eigen::MatrixXd& states, const RobotErrors& errors, const ProbabilityRequest& request,
      std::optional<double> chance_of_error = std::nullopt) const;

  /// P at any of the waypoints, with persistent errors, and how it changes with the joint values at
  /// each: estimates. Bodies that are likelier than 1e-12 to touch an obstacle take part.
  /// \throws InvalidRequest for a truncated displacement, as GroupQuery::motionGradient() for the
  ///         request, and as motion()
  JointGradient gradient(const std::vector<Eigen::VectorXd>& waypoints,
                         const MotionGradientRequest& request = {}) const;

  /// At the waypoints, persistent, for each body of the robot by itself: which links carry the
  /// probability. \throws as motion()
  std::vector<RobotResult> byBody(const std::vector<Eigen::VectorXd>& waypoints,
                                  const ProbabilityRequest& request) const;

 private:
  struct Implementation;
  explicit RobotQuery(std::unique_ptr<const Implementation> implementation);
  std::unique_ptr<const Implementation> implementation_;
};

/// Waypoints with so many more between them, linear in the joints, that no joint value changes by
/// more than `largest_step` (radians or metres) from one to the next.
/// \throws InvalidRequest if the step is not > 0 or the waypoints differ in size
std::vector<Eigen::VectorXd> interpolated(const std::vector<Eigen::VectorXd>& waypoints,
                                          double largest_step);

}  // namespace fcl_prob
