// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/kinematics.h"

#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "robot/urdf_values.h"

namespace fcl_prob::detail {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

std::string placeOf(const std::string& path, const urdf::Joint& joint) {
  return path + ": joint " + joint.name;
}

bool isFixed(const urdf::Joint& joint) { return joint.type == urdf::Joint::FIXED; }

RobotJoint limitsOf(const urdf::Joint& joint, const std::string& where) {
  switch (joint.type) {
    case urdf::Joint::CONTINUOUS:
      return {joint.name, true, -kUnlimited, kUnlimited};
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::PRISMATIC:
      break;
    default:
      throw FileError(where + ": its type is none of fixed, revolute, continuous and prismatic");
  }
  if (!joint.limits) throw FileError(where + ": has no limits");
  const double lower = joint.limits->lower, upper = joint.limits->upper;
  if (!std::isfinite(lower) || !std::isfinite(upper) || lower > upper) {
    throw FileError(where + ": limits " + numberText(lower) + " to " + numberText(upper));
  }
  return {joint.name, joint.type == urdf::Joint::REVOLUTE, lower, upper};
}

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
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.linear()(i, j) = frame.M(i, j);
    pose.translation()[i] = frame.p(i);
  }
  return pose;
}

// A joint's frame is that of its link where the value is 0.
KDL::Segment segmentOf(const urdf::Joint& joint, const std::string& where) {
  const KDL::Frame origin = kdlOf(poseOf(joint.parent_to_joint_origin_transform, where));
  if (isFixed(joint)) {
    return KDL::Segment(joint.child_link_name, KDL::Joint(joint.name), origin);
  }
  const Eigen::Vector3d axis = vectorOf(joint.axis, where + ": axis");
  const double length = axis.norm();
  if (!(length > 1e-6 && std::isfinite(length))) {
    throw FileError(where + ": its axis has length " + numberText(length));
  }
  const auto type =
      joint.type == urdf::Joint::PRISMATIC ? KDL::Joint::TransAxis : KDL::Joint::RotAxis;
  const KDL::Joint kdl_joint(joint.name, origin.p, origin.M * kdlOf(axis.normalized()), type);
  return KDL::Segment(joint.child_link_name, kdl_joint, origin);
}

}  // namespace

Kinematics::Kinematics(const urdf::ModelInterface& model, const std::string& path) {
  addJoints(model, path);
  link_index_[model.getRoot()->name] = 0;
  links_.push_back({KDL::Segment(), -1, -1});
  tree_.push_back({model.getRoot()->name});
  addLinks(*model.getRoot(), 0, model, path);
  for (const auto& [name, link] : model.links_) {
    if (link_index_.count(name) == 0) {
      throw FileError(path + ": link " + name + " does not hang on the root link");
    }
  }
}

void Kinematics::addJoints(const urdf::ModelInterface& model, const std::string& path) {
  for (const auto& [name, joint] : model.joints_) {
    if (isFixed(*joint)) continue;
    const RobotJoint limits = limitsOf(*joint, placeOf(path, *joint));
    if (joint->mimic) continue;
    joint_index_[name] = static_cast<int>(joints_.size());
    joints_.push_back(limits);
  }
}

// Links are nested no deeper than there are links, of which parseUrdf() allows a thousand.
void Kinematics::addLinks(const urdf::Link& link, int parent, const urdf::ModelInterface& model,
                          const std::string& path) {
  for (const auto& child : link.child_links) {
    // urdfdom allows that, and loops of links, too.
    if (link_index_.count(child->name) > 0) {
      throw FileError(path + ": link " + child->name + " hangs on more than one joint");
    }
    const urdf::Joint& joint = *child->parent_joint;
    CarriedLink carried{segmentOf(joint, placeOf(path, joint)), parent, -1};
    if (!isFixed(joint)) follow(joint, model, path, carried);
    const int index = static_cast<int>(links_.size());
    link_index_[child->name] = index;
    links_.push_back(carried);
    tree_.push_back({child->name, parent, !isFixed(joint)});
    addLinks(*child, index, model, path);
  }
}

// To the joint that moves by itself, through those that mimic others.
void Kinematics::follow(const urdf::Joint& joint, const urdf::ModelInterface& model,
                        const std::string& path, CarriedLink& carried) const {
  const urdf::Joint* followed = &joint;
  for (std::size_t steps = 0; followed->mimic; ++steps) {
    const urdf::JointMimic& mimic = *followed->mimic;
    const auto next = model.joints_.find(mimic.joint_name);
    if (next == model.joints_.end() || isFixed(*next->second)) {
      throw FileError(placeOf(path, *followed) + ": mimics " + mimic.joint_name +
                      ", which does not move");
    }
    if (steps > model.joints_.size()) throw FileError(placeOf(path, joint) + ": mimics itself");
    if (!std::isfinite(mimic.multiplier) || !std::isfinite(mimic.offset)) {
      throw FileError(placeOf(path, *followed) + ": multiplier or offset is not finite");
    }
    carried.offset += carried.factor * mimic.offset;
    carried.factor *= mimic.multiplier;
    followed = next->second.get();
  }
  if (!std::isfinite(carried.factor) || !std::isfinite(carried.offset)) {
    throw FileError(placeOf(path, joint) + ": what it mimics multiplies to " +
                    numberText(carried.factor) + " and " + numberText(carried.offset));
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
