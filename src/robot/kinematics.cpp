// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/kinematics.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {
namespace {

bool isFixed(const UrdfJoint& joint) { return joint.type == UrdfJoint::Type::fixed; }

KDL::Vector kdlOf(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

KDL::Frame kdlOf(const fcl::Transform3d& pose) {
  const Eigen::Matrix3d& r = pose.linear();
  return {KDL::Rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1),
                        r(2, 2)),
          kdlOf(Eigen::Vector3d(pose.translation()))};
}

Eigen::Vector3d eigenOf(const KDL::Vector& v) { return {v.x(), v.y(), v.z()}; }

fcl::Transform3d transformOf(const KDL::Frame& frame) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(frame.M.data);
  pose.translation() = eigenOf(frame.p);
  return pose;
}

// A joint's frame is that of its link where the value is 0.
KDL::Segment segmentOf(const UrdfJoint& joint) {
  const KDL::Frame origin = kdlOf(joint.origin);
  if (isFixed(joint)) return KDL::Segment(joint.child, KDL::Joint(joint.name), origin);
  const auto type =
      joint.type == UrdfJoint::Type::prismatic ? KDL::Joint::TransAxis : KDL::Joint::RotAxis;
  const KDL::Joint kdl_joint(joint.name, origin.p, origin.M * kdlOf(joint.axis), type);
  return KDL::Segment(joint.child, kdl_joint, origin);
}

}  // namespace

Kinematics::Kinematics(const UrdfModel& model) {
  addJoints(model);
  link_index_[model.root] = 0;
  links_.push_back({KDL::Segment(), -1, -1});
  tree_.push_back({model.root});
  JointsOfLinks joints_of;
  for (const auto& [name, joint] : model.joints) joints_of[joint.parent].push_back(&joint);
  addLinks(model.root, 0, model, joints_of);
  for (const auto& [name, link] : model.links) {
    if (link_index_.count(name) > 0) continue;
    throw FileError(link.where + ": does not hang on the root link");
  }
}

void Kinematics::addJoints(const UrdfModel& model) {
  for (const auto& [name, joint] : model.joints) {
    if (isFixed(joint) || joint.mimic) continue;
    joint_index_[name] = static_cast<int>(joints_.size());
    const bool turns = joint.type != UrdfJoint::Type::prismatic;
    joints_.push_back({name, turns, joint.lower, joint.upper, joint.velocity});
  }
}

// Links are nested no deeper than there are links, of which readUrdf() allows a thousand.
void Kinematics::addLinks(const std::string& link, int parent, const UrdfModel& model,
                          const JointsOfLinks& joints_of) {
  const auto carried_by = joints_of.find(link);
  if (carried_by == joints_of.end()) return;
  for (const UrdfJoint* joint : carried_by->second) {
    CarriedLink carried{segmentOf(*joint), parent, -1};
    if (!isFixed(*joint)) follow(*joint, model, carried);
    // 0 to 0 is what limits are that nobody has given.
    if (carried.joint >= 0 && joint->mimic && joint->lower < joint->upper) {
      following_.push_back({joint->name, static_cast<std::size_t>(carried.joint), carried.factor,
                            carried.offset, joint->lower, joint->upper, joint->velocity,
                            joint->where});
    }
    const int index = static_cast<int>(links_.size());
    link_index_[joint->child] = index;
    links_.push_back(carried);
    tree_.push_back({joint->child, parent, !isFixed(*joint), joint->name});
    addLinks(joint->child, index, model, joints_of);
  }
}

void Kinematics::narrowLimits() {
  for (const FollowingJoint& one : following_) {
    if (one.factor == 0.0) continue;  // it stays where it is
    RobotJoint& joint = joints_[one.followed];
    const auto [lower, upper] =
        std::minmax({(one.lower - one.offset) / one.factor, (one.upper - one.offset) / one.factor});
    if (std::max(joint.lower, lower) > std::min(joint.upper, upper)) {
      throw FileError(one.where + ": no value that joint " + joint.name +
                      " may have, which it mimics, is within its limits");
    }
    joint.lower = std::max(joint.lower, lower);
    joint.upper = std::min(joint.upper, upper);
    if (!(one.velocity > 0.0)) continue;
    const double velocity = one.velocity / std::abs(one.factor);
    joint.velocity = joint.velocity > 0.0 ? std::min(joint.velocity, velocity) : velocity;
  }
}

// To the joint that moves by itself, through those that mimic others.
void Kinematics::follow(const UrdfJoint& joint, const UrdfModel& model,
                        CarriedLink& carried) const {
  const UrdfJoint* followed = &joint;
  for (std::size_t steps = 0; followed->mimic; ++steps) {
    const UrdfMimic& mimic = *followed->mimic;
    const auto next = model.joints.find(mimic.joint);
    if (next == model.joints.end() || isFixed(next->second)) {
      throw FileError(followed->where + ": mimics " + mimic.joint + ", which does not move");
    }
    if (steps > model.joints.size()) throw FileError(joint.where + ": mimics itself");
    carried.offset += carried.factor * mimic.offset;
    carried.factor *= mimic.multiplier;
    followed = &next->second;
  }
  if (!std::isfinite(carried.factor) || !std::isfinite(carried.offset)) {
    throw FileError(joint.where + ": what it mimics multiplies to " + numberText(carried.factor) +
                    " and " + numberText(carried.offset));
  }
  carried.joint = joint_index_.at(followed->name);
}

int Kinematics::linkIndex(const std::string& name) const {
  const auto found = link_index_.find(name);
  return found == link_index_.end() ? -1 : found->second;
}

std::vector<fcl::Transform3d> Kinematics::linkPoses(const Eigen::VectorXd& values) const {
  std::vector<KDL::Frame> frames{KDL::Frame::Identity()};
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const CarriedLink& link = links_[i];
    frames.push_back(frames[static_cast<std::size_t>(link.parent)] * link.poseInParent(values));
  }
  std::vector<fcl::Transform3d> poses;
  for (const KDL::Frame& frame : frames) poses.push_back(transformOf(frame));
  return poses;
}

std::vector<CarryingJoint> Kinematics::carryingJoints(int link,
                                                      const Eigen::VectorXd& values) const {
  std::vector<const CarriedLink*> outwards;
  for (int i = link; i > 0; i = links_[static_cast<std::size_t>(i)].parent) {
    outwards.insert(outwards.begin(), &links_[static_cast<std::size_t>(i)]);
  }
  std::vector<CarryingJoint> joints;
  KDL::Frame parent = KDL::Frame::Identity();
  for (const CarriedLink* carried : outwards) {
    if (carried->joint >= 0) {
      const KDL::Joint& joint = carried->segment.getJoint();
      joints.push_back({static_cast<std::size_t>(carried->joint), carried->factor, carried->offset,
                        joint.getType() == KDL::Joint::RotAxis,
                        eigenOf(parent.M * joint.JointAxis()),
                        eigenOf(parent * joint.JointOrigin())});
    }
    parent = parent * carried->poseInParent(values);
  }
  return joints;
}

}  // namespace fcl_prob::detail
