// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A robot from its URDF. In the library fcl_prob::robot, the only part that needs libxml2 and
// KDL.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace fcl_prob {

namespace detail {
struct PreparedRobot;
class RobotAmongObstacles;
}  // namespace detail

struct RobotOptions {
  /// The folder of each package or model: what stands for `package://NAME` and `model://NAME` in
  /// the names of meshes. One that is not named here is the folder of that name in which the URDF
  /// is, if there is one; or else, of a package, where ROS finds it: `share/NAME` in the folders of
  /// the environment's AMENT_PREFIX_PATH, then those of ROS_PACKAGE_PATH.
  std::map<std::string, std::string> packages;

  /// The links whose collision elements are taken; none named: all of them.
  std::vector<std::string> links;

  /// Pose of the root link, metres, world frame.
  fcl::Transform3d base = fcl::Transform3d::Identity();

  /// Answer for states beyond the limits of joints, too, which are refused otherwise.
  bool allow_outside_limits = false;
};

/// A joint that moves by itself: mimic joints follow others, fixed ones do not move.
struct RobotJoint {
  std::string name;
  bool turns = true;  ///< its value is in radians; else it slides, in metres
  /// Limits, also those of joints that mimic it, unless states beyond them are allowed; infinite
  /// for a continuous joint.
  double lower = 0.0;
  double upper = 0.0;
  /// No faster in either direction, radians or metres per second, nor are joints that mimic it;
  /// 0: the URDF does not say. Only what plans in time asks for it.
  double velocity = 0.0;
};

/// A link, and how it hangs on the one that carries it.
struct RobotLink {
  std::string name;
  int parent = -1;         ///< index in Robot::links(), below its own; the root link has none
  bool moves = false;      ///< relative to its parent: the joint between them is not fixed
  std::string joint = {};  ///< name of that joint; of the root link empty
};

/// A collision element of a link, or an object attached to it.
struct RobotBody {
  std::string link;
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  fcl::Transform3d in_link = fcl::Transform3d::Identity();  ///< metres
  std::string object = {};  ///< name of the attached object; empty: the link itself

  /// Of a mesh: as TriangleMesh::coordinate_error, metres.
  double coordinate_error = 0.0;

  const std::string& name() const { return object.empty() ? link : object; }
};

/// Something that a link carries from now on: a grasped can.
struct AttachedObject {
  std::string name;
  std::string link;  ///< that carries it
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  fcl::Transform3d in_link = fcl::Transform3d::Identity();  ///< metres

  /// Links that it may touch, besides the one that carries it (SelfCollision).
  std::vector<std::string> touch_links = {};

  /// Of a mesh: as in TriangleMesh. Both are told with answers, and nothing depends on them.
  double coordinate_error = 0.0;  ///< metres
  std::vector<std::string> notes = {};
};

/// One of the joints that carry a body, where all joints have certain values. With v the value of
/// joints()[joint], that of this one changes by `factor` times what v changes by: a point x of the
/// body then moves by factor * axis × (x - point) per radian of v, or by factor * axis per metre.
struct CarryingJoint {
  std::size_t joint = 0;
  double factor = 1.0;  ///< of a mimic joint; else 1
  double offset = 0.0;  ///< of a mimic joint, radians or metres: its value is factor times that of
                        ///< `joint`, and this
  bool turns = true;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit, world frame
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on the axis, metres, world frame
};

/// The joints and collision elements of a robot. Values of joints are given in the order of
/// joints(), radians or metres. Immutable: copies share what they hold, and every member may be
/// called from several threads.
class Robot {
 public:
  /// Reads a URDF and the meshes that its collision elements name (paths are relative to its
  /// folder). Neither is trusted: documents with a DOCTYPE, deeper than 64 elements or larger than
  /// 16 MiB are refused, and meshes are read in a process of their own.
  ///
  /// Elements that say nothing of where bodies are, as `visual` and `gazebo` are known to, and
  /// those of a namespace of their own are ignored. Any other that is not read here is refused, a
  /// misspelt one or a macro of xacro: what it stands for would be missing (docs/robots.md).
  /// \throws FileError naming the file, the line and the element: no URDF, an element or attribute
  ///         that is not known, a joint type other than fixed, revolute, continuous and prismatic,
  ///         a mimic joint that follows itself or never is within its limits, a value that is no
  ///         finite number, a size that is not > 0, a link on two joints or on none but the root, a
  ///         package without folder, a link in `options` that is not there, no collision element;
  ///         as loadMesh() for its meshes; InvalidPose for the base
  explicit Robot(const std::string& urdf_file, const RobotOptions& options = {});

  /// The same from the text of a URDF, as ROS has it in the parameter robot_description. Messages
  /// begin with "the URDF text" where they begin with the name of a file otherwise.
  /// \param folder  where the URDF would be: what names of meshes are relative to. Empty: nowhere,
  ///                and a name that is relative is refused
  /// \throws as the constructor
  static Robot fromText(const std::string& urdf_text, const RobotOptions& options = {},
                        const std::string& folder = {});

  /// The same robot with an object that moves with a link: the last of its bodies. A query that
  /// was made before does not know of it.
  /// \throws InvalidRequest for a link that is not there, or a name that is empty or another
  /// body's;
  ///         InvalidPose, InvalidGeometry, UnsupportedGeometry
  Robot withAttached(AttachedObject object) const;

  const std::string& name() const;

  /// What it was read from, so that it can be read again: the path of a file, or, where that is
  /// empty, a text. And what names of meshes are relative to, as fromText() takes it.
  const std::string& urdf() const;
  const std::string& urdfText() const;
  const std::string& folder() const;
  const RobotOptions& options() const;

  const std::vector<RobotJoint>& joints() const;

  /// Those of the links, then what is attached to them.
  const std::vector<RobotBody>& bodies() const;
  const std::vector<AttachedObject>& attached() const;

  /// All links, with or without collision elements; parents before what they carry.
  const std::vector<RobotLink>& links() const;

  /// Links that no body is of, because the URDF has no collision element for them or they are not
  /// among those that were taken: nothing can touch them.
  std::vector<std::string> linksWithoutBody() const;

  /// What of the URDF may be meant otherwise than it was read, in sentences: limits of joints and
  /// angles beyond a whole turn, which probably are degrees. Then TriangleMesh::notes of the meshes
  /// that it names and of what is attached.
  const std::vector<std::string>& notes() const;

  /// The geometries of the bodies, as GroupQuery takes them.
  std::vector<std::shared_ptr<const fcl::CollisionGeometryd>> geometries() const;

  /// Values in the order of joints() from values by name; what is not named is 0, or the limit
  /// nearest to that. \throws InvalidRequest for a name that is no joint, or a value that is not
  /// finite
  Eigen::VectorXd values(const std::map<std::string, double>& by_name) const;

  /// \throws InvalidRequest if there is not one finite value a joint
  void validate(const Eigen::VectorXd& values) const;

  /// \throws InvalidRequest as validate(), and naming the joint, its value and its limits for one
  ///         that is beyond them by more than 1e-6 (radians or metres), as files with few digits
  ///         are not; RobotOptions::allow_outside_limits: for none
  void requireWithinLimits(const Eigen::VectorXd& values) const;

  /// Whether no value is beyond its limits. \throws InvalidRequest as validate()
  bool isWithinLimits(const Eigen::VectorXd& values) const;

  /// Poses of the bodies, metres, world frame. Limits are not looked at.
  /// \throws InvalidRequest as validate(); InvalidPose if one is not finite
  std::vector<fcl::Transform3d> poses(const Eigen::VectorXd& values) const;

  /// The joints between the root link and a body that are not fixed, from the root outwards: what
  /// the body's Jacobian is made of. \throws InvalidRequest as validate(), or for a body that is
  /// not there; InvalidPose
  std::vector<CarryingJoint> carryingJoints(std::size_t body, const Eigen::VectorXd& values) const;

  /// Pose of a link, with or without collision elements. \throws InvalidRequest as validate(), or
  /// for a link that is not there; InvalidPose
  fcl::Transform3d linkPose(const std::string& link, const Eigen::VectorXd& values) const;

 private:
  friend class detail::RobotAmongObstacles;

  struct Implementation;

  /// What queries keep of the bodies: made by the first of them.
  std::shared_ptr<const detail::PreparedRobot> prepared() const;

  explicit Robot(std::shared_ptr<const Implementation> implementation);
  std::shared_ptr<const Implementation> implementation_;
};

}  // namespace fcl_prob
