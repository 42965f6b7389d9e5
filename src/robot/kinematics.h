// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where the links of a robot are (Orocos KDL).
#pragma once

#include <fcl/common/types.h>

#include <kdl/segment.hpp>
#include <map>
#include <string>
#include <vector>

#include "fcl_prob/robot.h"
#include "robot/urdf_model.h"

namespace fcl_prob::detail {

/// A joint that follows another one, and its own limits.
struct FollowingJoint {
  std::string name;
  std::size_t followed;  ///< the joint that moves by itself
  double factor;         ///< its value is so many times that of `followed`,
  double offset;         ///< and this
  double lower;
  double upper;
  double velocity;    ///< see RobotJoint
  std::string where;  ///< begins messages
};

class Kinematics {
 public:
  /// \throws FileError
  explicit Kinematics(const UrdfModel& model);

  /// Those that move by themselves, by name.
  const std::vector<RobotJoint>& joints() const { return joints_; }

  /// Those with limits of their own that follow others.
  const std::vector<FollowingJoint>& following() const { return following_; }

  /// To where joints that follow are within their limits, too. \throws FileError if that is nowhere
  void narrowLimits();

  /// In the order of linkPoses().
  const std::vector<RobotLink>& links() const { return tree_; }

  /// Index of a link in linkPoses(); -1 if there is none of that name.
  int linkIndex(const std::string& name) const;

  /// Relative to the root link. \param values  one a joint
  std::vector<fcl::Transform3d> linkPoses(const Eigen::VectorXd& values) const;

  /// Those between the root link and a link, relative to the former.
  std::vector<CarryingJoint> carryingJoints(int link, const Eigen::VectorXd& values) const;

 private:
  /// A link with the joint that carries it: at `factor` times the value of `joint` plus `offset`.
  struct CarriedLink {
    KDL::Segment segment;
    int parent;
    int joint;  ///< -1: it does not move
    double factor = 1.0;
    double offset = 0.0;

    /// Of a copy: KDL's joints keep the last pose asked for, which threads would overwrite
    /// (orocos_kinematics_dynamics issue 373).
    KDL::Frame poseInParent(const Eigen::VectorXd& values) const {
      return KDL::Segment(segment).pose(joint < 0 ? 0.0 : factor * values[joint] + offset);
    }
  };

  using JointsOfLinks = std::map<std::string, std::vector<const UrdfJoint*>>;

  void addJoints(const UrdfModel& model);
  void addLinks(const std::string& link, int parent, const UrdfModel& model,
                const JointsOfLinks& joints_of);
  void follow(const UrdfJoint& joint, const UrdfModel& model, CarriedLink& carried) const;

  std::vector<RobotJoint> joints_;
  std::vector<FollowingJoint> following_;
  std::map<std::string, int> joint_index_;
  std::vector<CarriedLink> links_;  ///< parents before what they carry; the root first
  std::vector<RobotLink> tree_;     ///< the same links, as the robot tells them
  std::map<std::string, int> link_index_;
};

}  // namespace fcl_prob::detail
