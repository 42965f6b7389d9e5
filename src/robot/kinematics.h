// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where the links of a robot are (Orocos KDL).
#pragma once

#include <fcl/common/types.h>
#include <urdf_model/model.h>

#include <kdl/segment.hpp>
#include <map>
#include <string>
#include <vector>

#include "fcl_prob/robot.h"

namespace fcl_prob::detail {

class Kinematics {
 public:
  /// \throws FileError
  Kinematics(const urdf::ModelInterface& model, const std::string& path);

  /// Those that move by themselves, by name.
  const std::vector<RobotJoint>& joints() const { return joints_; }

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

  void addJoints(const urdf::ModelInterface& model, const std::string& path);
  void addLinks(const urdf::Link& link, int parent, const urdf::ModelInterface& model,
                const std::string& path);
  void follow(const urdf::Joint& joint, const urdf::ModelInterface& model, const std::string& path,
              CarriedLink& carried) const;

  std::vector<RobotJoint> joints_;
  std::map<std::string, int> joint_index_;
  std::vector<CarriedLink> links_;  ///< parents before what they carry; the root first
  std::vector<RobotLink> tree_;     ///< the same links, as the robot tells them
  std::map<std::string, int> link_index_;
};

}  // namespace fcl_prob::detail
