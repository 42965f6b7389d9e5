// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/urdf_elements.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

const std::string kNotExpanded =
    ": xacro has not been run on this file, parts of the robot are missing";

/// What says nothing of where bodies are: the URDF's own elements, those that simulators, planners
/// and controllers have added, and what is often put beside the `gazebo` element that it belongs
/// in.
const std::set<std::string>& harmlessElements() {
  static const std::set<std::string> all{
      // URDF
      "calibration", "dynamics", "inertial", "material", "safety_controller", "sensor",
      "transmission", "visual", "self_collision_checking", "verbose", "contact_coefficients",
      "joint_properties", "projector", "color", "texture", "mass", "inertia",
      // ros_control, Gazebo
      "gazebo", "plugin", "ros2_control", "controller", "hardwareInterface", "actuator",
      "mechanicalReduction", "mu", "mu1", "mu2", "kp", "kd", "selfCollide", "self_collide",
      "gravity", "turnGravityOff", "dampingFactor", "velocity_decay", "maxVel", "maxContacts",
      "minDepth", "fdir1", "laserRetro", "laser_retro", "kinematic", "surface", "max_contacts",
      "provideFeedback", "implicitSpringDamper", "preserveFixedJoint", "disableFixedJointLumping",
      "stopCfm", "stopErp", "springStiffness", "springReference", "physics", "friction", "damping",
      // PyBullet, MuJoCo, Drake
      "contact", "audio_source", "mujoco", "collision_checking", "frame", "force_element",
      "collision_filter_group",
      // SRDF within a URDF
      "group", "group_state", "end_effector", "virtual_joint", "passive_joint",
      "disable_collisions", "enable_collisions", "disable_default_collisions", "joint_property",
      "link_sphere_approximation",
      // who made it
      "author", "license", "description", "comment", "version"};
  return all;
}

/// What is a part of the robot in whatever namespace it is, and what brings in other files.
bool isStructure(const std::string& name) {
  static const std::set<std::string> all{"robot",    "link",   "joint",  "collision",
                                         "geometry", "origin", "parent", "child",
                                         "axis",     "limit",  "mimic",  "include"};
  return all.count(name) > 0;
}

/// A collision element with a shape, as those of links have one, at any depth.
const XmlElement* hiddenCollision(const XmlElement& element) {
  for (const XmlElement& child : element.children) {
    const auto is_geometry = [](const XmlElement& one) { return one.name == "geometry"; };
    if (child.name == "collision" &&
        std::any_of(child.children.begin(), child.children.end(), is_geometry)) {
      return &child;
    }
    if (const XmlElement* deeper = hiddenCollision(child)) return deeper;
  }
  return nullptr;
}

std::string lineText(const std::string& path, const XmlElement& element) {
  return path + ": line " + std::to_string(element.line) + ": ";
}

/// Of an element that is not among those that are read.
void requireHarmless(const XmlElement& element, const std::string& path, const std::string& owner) {
  const std::string what = lineText(path, element) + owner + ": the element " + element.fullName();
  if (element.of_xacro) throw FileError(what + kNotExpanded);
  const bool known = element.prefix.empty() ? harmlessElements().count(element.name) > 0
                                            : !isStructure(element.name);
  if (!known) {
    throw FileError(what + " is not known here: what it stands for would be missing");
  }
  // Simulators' own descriptions, which are not of the robot, are full of them.
  if (element.name == "gazebo" || !element.prefix.empty()) return;
  if (const XmlElement* hidden = hiddenCollision(element)) {
    throw FileError(lineText(path, *hidden) + owner + ": a collision element within " +
                    element.fullName() + ", where it would be missing");
  }
}

/// xacro's expressions are no values.
void requireExpanded(const XmlElement& element, const std::string& path, const std::string& owner) {
  for (const XmlAttribute& attribute : element.attributes) {
    const bool is_expression = attribute.value.find("${") != std::string::npos ||
                               attribute.value.find("$(") != std::string::npos;
    if (!is_expression && attribute.name.rfind("xacro:", 0) != 0) continue;
    throw FileError(lineText(path, element) + owner + ": " + attribute.name + " is " +
                    inQuotes(attribute.value) + kNotExpanded);
  }
}

}  // namespace

UrdfContainer::UrdfContainer(const std::string& path, const XmlElement& element, std::string name,
                             const std::vector<std::string>& expected)
    : path_(path), element_(element), name_(std::move(name)) {
  for (const std::string& one : expected) found_[one];
  requireExpanded(element, path, name_);
  for (const XmlElement& child : element.children) {
    const auto one = found_.find(child.name);
    if (one != found_.end() && child.prefix.empty()) {
      one->second.push_back(&child);
    } else {
      requireHarmless(child, path_, name_);
    }
  }
}

std::string UrdfContainer::where() const { return lineText(path_, element_) + name_; }

void UrdfContainer::fail(const std::string& fault) const {
  throw FileError(where() + ": " + fault);
}

const std::string& UrdfContainer::text(const std::string& attribute) const {
  const std::string* value = element_.attribute(attribute);
  if (value == nullptr || value->empty()) fail("has no " + attribute);
  return *value;
}

const std::vector<const XmlElement*>& UrdfContainer::all(const std::string& name) const {
  return found_.at(name);
}

const XmlElement* UrdfContainer::atMostOne(const std::string& name) const {
  const auto& several = all(name);
  if (several.size() > 1) {
    throw FileError(lineText(path_, *several[1]) + name_ + ": has " +
                    std::to_string(several.size()) + " elements " + name + ", at most one");
  }
  return several.empty() ? nullptr : several[0];
}

const XmlElement& UrdfContainer::one(const std::string& name) const {
  const XmlElement* element = atMostOne(name);
  if (element == nullptr) fail("has no element " + name);
  return *element;
}

UrdfValues::UrdfValues(const std::string& path, const XmlElement& element, const std::string& name,
                       const std::vector<std::string>& attributes)
    : where_(lineText(path, element) + name), element_(element) {
  requireExpanded(element, path, name);
  for (const XmlAttribute& attribute : element.attributes) {
    const auto known = std::find(attributes.begin(), attributes.end(), attribute.name);
    if (known != attributes.end() || attribute.name.find(':') != std::string::npos) continue;
    fail("the attribute " + attribute.name + " is not known here: what it says would be missing");
  }
  if (element.has_text) fail("has text where only attributes count");
  for (const XmlElement& child : element.children) {
    requireHarmless(child, path, name);
  }
}

void UrdfValues::fail(const std::string& fault) const { throw FileError(where_ + ": " + fault); }

const std::string& UrdfValues::text(const std::string& attribute) const {
  const std::string* value = element_.attribute(attribute);
  if (value == nullptr || value->empty()) fail("has no " + attribute);
  return *value;
}

double UrdfValues::number(const std::string& attribute, std::optional<double> otherwise) const {
  if (otherwise && !has(attribute)) return *otherwise;
  const std::string& told = text(attribute);
  const std::vector<std::string_view> words = splitWords(told);
  const auto value = words.size() == 1 ? parseNumber(words[0]) : std::nullopt;
  if (!value) fail(attribute + " is " + inQuotes(told) + ", must be a number");
  if (!std::isfinite(*value)) fail(attribute + " is " + inQuotes(told) + ", must be finite");
  return *value;
}

double UrdfValues::positive(const std::string& attribute) const {
  const double value = number(attribute);
  if (!(value > 0.0)) fail(attribute + " must be > 0, is " + numberText(value));
  return value;
}

Eigen::Vector3d UrdfValues::vector(const std::string& attribute,
                                   std::optional<Eigen::Vector3d> otherwise) const {
  if (otherwise && !has(attribute)) return *otherwise;
  const std::string& told = text(attribute);
  const std::vector<std::string_view> words = splitWords(told);
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = words.size() == 3 ? parseNumber(words[i]) : std::nullopt;
    if (!value) fail(attribute + " is " + inQuotes(told) + ", must be three numbers");
    if (!std::isfinite(*value)) fail(attribute + " is " + inQuotes(told) + ", must be finite");
    result[static_cast<Eigen::Index>(i)] = *value;
  }
  return result;
}

}  // namespace fcl_prob::detail
