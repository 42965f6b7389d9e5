// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/robot.h"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <utility>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "geometry/validation.h"
#include "io/file_content.h"
#include "io/import_notes.h"
#include "robot/joint_indices.h"
#include "robot/kinematics.h"
#include "robot/prepared_robot.h"
#include "robot/urdf_shapes.h"
#include "robot/xml_elements.h"

namespace fcl_prob {

namespace {

constexpr double kTurn = boost::math::double_constants::two_pi;

/// Radians or metres: what a limit is exceeded by in a file that gives values to six decimals.
/// More would take states that a joint cannot reach, less refuses a planner's own files.
constexpr double kBeyondLimits = 1e-6;

}  // namespace

struct Robot::Implementation {
  struct Kept {
    std::once_flag once;
    std::shared_ptr<const detail::PreparedRobot> bodies;
    std::shared_ptr<Kept> before;  ///< of the robot with all bodies but the last one

    const std::shared_ptr<const detail::PreparedRobot>& of(const std::vector<RobotBody>& all) {
      std::call_once(once, [&] {
        const bool has_more = before != nullptr;
        const auto fewer = has_more ? before->of({all.begin(), all.end() - 1}) : nullptr;
        bodies = std::make_shared<const detail::PreparedRobot>(all, fewer.get());
      });
      return bodies;
    }
  };

  Implementation(detail::UrdfModel model, detail::UrdfSource of, const RobotOptions& given)
      : name(model.name),
        kinematics(model),
        bodies(detail::bodiesOf(model, of, given)),
        source(std::move(of)),
        options(given),
        notes(std::move(model.notes)) {
    if (!source.file.empty()) source.content.clear();
    if (!options.allow_outside_limits) kinematics.narrowLimits();
    for (const RobotBody& body : bodies) links.push_back(kinematics.linkIndex(body.link));
  }

  static std::shared_ptr<const Implementation> read(detail::UrdfSource source,
                                                    const RobotOptions& options) {
    detail::validatePose(options.base, "the robot's base");
    auto model = detail::readUrdf(source);
    return std::make_shared<const Implementation>(std::move(model), std::move(source), options);
  }

  void validate(const Eigen::VectorXd& values) const {
    const auto& joints = kinematics.joints();
    if (static_cast<std::size_t>(values.size()) != joints.size()) {
      throw InvalidRequest(name + " has " + std::to_string(joints.size()) + " joints but " +
                           std::to_string(values.size()) + " values");
    }
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      if (std::isfinite(values[i])) continue;
      throw InvalidRequest("joint " + joints[static_cast<std::size_t>(i)].name + ": its value is " +
                           detail::numberText(values[i]));
    }
  }

  void requireWithinLimits(const Eigen::VectorXd& values) const {
    validate(values);
    if (options.allow_outside_limits) return;
    for (std::size_t i = 0; i < kinematics.joints().size(); ++i) {
      const RobotJoint& joint = kinematics.joints()[i];
      const double value = values[static_cast<Eigen::Index>(i)];
      if (value >= joint.lower - kBeyondLimits && value <= joint.upper + kBeyondLimits) continue;
      const std::string unit = joint.turns ? " rad" : " m";
      throw InvalidRequest("joint " + joint.name + ": its value is " + detail::numberText(value) +
                           unit + ", beyond its limits " + detail::numberText(joint.lower) +
                           " to " + detail::numberText(joint.upper) + unit +
                           followingText(i, value) +
                           (joint.turns && std::fabs(value) > kTurn ? ": are these degrees?" : "") +
                           " (allow_outside_limits takes it all the same)");
    }
  }

  /// The joints that mimic one and would be beyond their limits.
  std::string followingText(std::size_t joint, double value) const {
    std::string text;
    for (const detail::FollowingJoint& one : kinematics.following()) {
      const double at = one.factor * value + one.offset;
      if (one.followed != joint || (at >= one.lower && at <= one.upper)) continue;
      text += "; joint " + one.name + ", which mimics it, has " + detail::numberText(one.lower) +
              " to " + detail::numberText(one.upper);
    }
    return text;
  }

  /// Sums of lengths near the largest double, however they come about.
  void requireFinite(const fcl::Transform3d& pose, const std::string& what) const {
    if (pose.matrix().allFinite()) return;
    throw InvalidPose(name + ": the joints place " + what + " at a pose that is not finite");
  }

  void attach(AttachedObject object) {
    const std::string what = "attached object " + object.name;
    const int link = kinematics.linkIndex(object.link);
    if (link < 0) throw InvalidRequest(what + ": " + name + " has no link " + object.link);
    for (const std::string& touched : object.touch_links) {
      if (kinematics.linkIndex(touched) < 0) {
        throw InvalidRequest(what + ": " + name + " has no link " + touched);
      }
    }
    const auto has_its_name = [&](const RobotBody& body) { return body.name() == object.name; };
    if (object.name.empty() || std::any_of(bodies.begin(), bodies.end(), has_its_name)) {
      throw InvalidRequest(what + ": its name is empty or another body's");
    }
    detail::validateGeometry(object.geometry.get(), what);
    detail::validatePose(object.in_link, what);
    const auto before = std::exchange(kept, std::make_shared<Kept>());
    kept->before = before;
    bodies.push_back(
        {object.link, object.geometry, object.in_link, object.name, object.coordinate_error});
    links.push_back(link);
    detail::addNotes(object.notes, notes);
    attached.push_back(std::move(object));
  }

  std::string name;
  detail::Kinematics kinematics;
  std::vector<RobotBody> bodies;
  std::vector<AttachedObject> attached;
  std::vector<int> links;     ///< of the bodies
  detail::UrdfSource source;  ///< with what is in it unless it is a file
  std::shared_ptr<Kept> kept = std::make_shared<Kept>();
  RobotOptions options;
  std::vector<std::string> notes;
};

Robot::Robot(const std::string& urdf_file, const RobotOptions& options)
    : Robot(Implementation::read({urdf_file, detail::fileContent(urdf_file, detail::kMostXmlBytes),
                                  (std::filesystem::path(".") / urdf_file).parent_path().string()},
                                 options)) {}

Robot Robot::fromText(const std::string& urdf_text, const RobotOptions& options,
                      const std::string& folder) {
  return Robot(Implementation::read({{}, urdf_text, folder}, options));
}

Robot::Robot(std::shared_ptr<const Implementation> implementation)
    : implementation_(std::move(implementation)) {}

std::shared_ptr<const detail::PreparedRobot> Robot::prepared() const {
  return implementation_->kept->of(implementation_->bodies);
}

Robot Robot::withAttached(AttachedObject object) const {
  auto more = std::make_shared<Implementation>(*implementation_);
  more->attach(std::move(object));
  return Robot(std::move(more));
}

const std::string& Robot::name() const { return implementation_->name; }
const std::string& Robot::urdf() const { return implementation_->source.file; }
const std::string& Robot::urdfText() const { return implementation_->source.content; }
const std::string& Robot::folder() const { return implementation_->source.folder; }
const RobotOptions& Robot::options() const { return implementation_->options; }
const std::vector<RobotJoint>& Robot::joints() const {
  return implementation_->kinematics.joints();
}
const std::vector<RobotBody>& Robot::bodies() const { return implementation_->bodies; }
const std::vector<AttachedObject>& Robot::attached() const { return implementation_->attached; }
const std::vector<RobotLink>& Robot::links() const { return implementation_->kinematics.links(); }

const std::vector<std::string>& Robot::notes() const { return implementation_->notes; }

std::vector<std::string> Robot::linksWithoutBody() const {
  std::vector<std::string> names;
  for (const RobotLink& link : links()) {
    const auto is_its = [&link](const RobotBody& body) {
      return body.link == link.name && body.object.empty();
    };
    if (std::none_of(bodies().begin(), bodies().end(), is_its)) names.push_back(link.name);
  }
  return names;
}

std::vector<std::shared_ptr<const fcl::CollisionGeometryd>> Robot::geometries() const {
  std::vector<std::shared_ptr<const fcl::CollisionGeometryd>> result;
  for (const RobotBody& body : bodies()) result.push_back(body.geometry);
  return result;
}

Eigen::VectorXd Robot::values(const std::map<std::string, double>& by_name) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(joints().size()));
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    const RobotJoint& joint = joints()[static_cast<std::size_t>(i)];
    result[i] = std::clamp(0.0, joint.lower, joint.upper);
  }
  for (const auto& [name, value] : by_name) result[detail::jointIndex(*this, name)] = value;
  implementation_->validate(result);
  return result;
}

void Robot::validate(const Eigen::VectorXd& values) const { implementation_->validate(values); }

void Robot::requireWithinLimits(const Eigen::VectorXd& values) const {
  implementation_->requireWithinLimits(values);
}

bool Robot::isWithinLimits(const Eigen::VectorXd& values) const {
  implementation_->validate(values);
  for (std::size_t i = 0; i < joints().size(); ++i) {
    const double value = values[static_cast<Eigen::Index>(i)];
    if (value < joints()[i].lower || value > joints()[i].upper) return false;
  }
  return true;
}

std::vector<fcl::Transform3d> Robot::poses(const Eigen::VectorXd& values) const {
  implementation_->validate(values);
  const std::vector<fcl::Transform3d> links = implementation_->kinematics.linkPoses(values);
  std::vector<fcl::Transform3d> result;
  for (std::size_t i = 0; i < bodies().size(); ++i) {
    const auto link = static_cast<std::size_t>(implementation_->links[i]);
    result.push_back(implementation_->options.base * links[link] * bodies()[i].in_link);
    implementation_->requireFinite(result.back(), bodies()[i].name());
  }
  return result;
}

std::vector<CarryingJoint> Robot::carryingJoints(std::size_t body,
                                                 const Eigen::VectorXd& values) const {
  implementation_->validate(values);
  if (body >= bodies().size()) {
    throw InvalidRequest(implementation_->name + " has " + std::to_string(bodies().size()) +
                         " bodies, none with number " + std::to_string(body));
  }
  auto joints = implementation_->kinematics.carryingJoints(implementation_->links[body], values);
  for (CarryingJoint& joint : joints) {
    joint.axis = implementation_->options.base.linear() * joint.axis;
    joint.point = implementation_->options.base * joint.point;
    if (joint.axis.allFinite() && joint.point.allFinite()) continue;
    throw InvalidPose(name() + ": joint " + this->joints()[joint.joint].name +
                      " is not at a finite place");
  }
  return joints;
}

fcl::Transform3d Robot::linkPose(const std::string& link, const Eigen::VectorXd& values) const {
  implementation_->validate(values);
  const int index = implementation_->kinematics.linkIndex(link);
  if (index < 0) throw InvalidRequest(implementation_->name + " has no link " + link);
  const fcl::Transform3d pose =
      implementation_->options.base *
      implementation_->kinematics.linkPoses(values)[static_cast<std::size_t>(index)];
  implementation_->requireFinite(pose, link);
  return pose;
}

}  // namespace fcl_prob
