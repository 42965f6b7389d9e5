// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A robot from a model that urdfdom has parsed. Needs the headers of urdfdom (urdf_model), and of
// the library fcl_prob::robot what Robot needs.
#pragma once

#include <urdf_model/model.h>

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

#include "fcl_prob/robot.h"

namespace fcl_prob {
namespace detail {

/// Writes what of a model says where bodies are. urdf::exportURDF, which is there for that, writes
/// six digits, and turns what is pitched by nearly a right angle by up to 5 mrad.
class UrdfWriter {
 public:
  explicit UrdfWriter(const urdf::ModelInterface& model) {
    // Such that numbers read back as the same doubles, whatever the program's locale.
    text_.imbue(std::locale::classic());
    text_.precision(std::numeric_limits<double>::max_digits10);
    text_ << "<robot name=\"" << quoted(model.name_) << "\">\n";
    for (const auto& link : model.links_) write(*link.second);
    for (const auto& joint : model.joints_) write(*joint.second);
    text_ << "</robot>\n";
  }

  std::string text() const { return text_.str(); }

 private:
  static std::string quoted(const std::string& name) {
    std::string result;
    for (const char c : name) {
      if (c == '&' || c == '<' || c == '"' || c == '\n' || c == '\r' || c == '\t') {
        result += "&#" + std::to_string(static_cast<int>(c)) + ";";
      } else {
        result += c;
      }
    }
    return result;
  }

  void write(const char* attribute, const urdf::Vector3& v) {
    text_ << ' ' << attribute << "=\"" << v.x << ' ' << v.y << ' ' << v.z << '"';
  }

  void write(const char* attribute, const std::string& name) {
    text_ << ' ' << attribute << "=\"" << quoted(name) << '"';
  }

  void write(const char* attribute, double number) {
    text_ << ' ' << attribute << "=\"" << number << '"';
  }

  /// Roll is taken from what is left once the frame has been turned back by yaw and pitch: accurate
  /// where both turn about nearly the same axis, too.
  void writeOrigin(const urdf::Pose& pose) {
    urdf::Rotation q = pose.rotation;
    q.normalize();
    const double c = 1.0 - 2.0 * (q.y * q.y + q.z * q.z), s = 2.0 * (q.x * q.y + q.w * q.z);
    const double yaw = std::atan2(s, c), cy = std::cos(yaw), sy = std::sin(yaw);
    const double xz = 2.0 * (q.x * q.z + q.w * q.y), yz = 2.0 * (q.y * q.z - q.w * q.x);
    const double xy = 2.0 * (q.x * q.y - q.w * q.z), yy = 1.0 - 2.0 * (q.x * q.x + q.z * q.z);
    const double pitch = std::atan2(2.0 * (q.w * q.y - q.x * q.z), std::hypot(c, s));
    const double roll = std::atan2(sy * xz - cy * yz, cy * yy - sy * xy);
    text_ << "<origin";
    write("xyz", pose.position);
    write("rpy", urdf::Vector3(roll, pitch, yaw));
    text_ << "/>";
  }

  /// Of none nothing is written, which is refused where it is read.
  void writeShape(const urdf::Geometry* geometry) {
    text_ << "<geometry>";
    if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(geometry)) {
      text_ << "<sphere";
      write("radius", sphere->radius);
      text_ << "/>";
    } else if (const auto* box = dynamic_cast<const urdf::Box*>(geometry)) {
      text_ << "<box";
      write("size", box->dim);
      text_ << "/>";
    } else if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(geometry)) {
      text_ << "<cylinder";
      write("radius", cylinder->radius);
      write("length", cylinder->length);
      text_ << "/>";
    } else if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(geometry)) {
      text_ << "<mesh";
      write("filename", mesh->filename);
      write("scale", mesh->scale);
      text_ << "/>";
    }
    text_ << "</geometry>";
  }

  void write(const urdf::Collision& collision) {
    text_ << "<collision>";
    writeOrigin(collision.origin);
    writeShape(collision.geometry.get());
    text_ << "</collision>\n";
  }

  void write(const urdf::Link& link) {
    text_ << "<link";
    write("name", link.name);
    text_ << ">\n";
    for (const auto& collision : link.collision_array) write(*collision);
    // Programs that make models may set the only one alone.
    if (link.collision_array.empty() && link.collision) write(*link.collision);
    text_ << "</link>\n";
  }

  static const char* typeOf(const urdf::Joint& joint) {
    switch (joint.type) {
      case urdf::Joint::REVOLUTE:
        return "revolute";
      case urdf::Joint::CONTINUOUS:
        return "continuous";
      case urdf::Joint::PRISMATIC:
        return "prismatic";
      case urdf::Joint::FLOATING:
        return "floating";
      case urdf::Joint::PLANAR:
        return "planar";
      case urdf::Joint::FIXED:
        return "fixed";
      default:
        return "unknown";
    }
  }

  void write(const urdf::Joint& joint) {
    text_ << "<joint";
    write("name", joint.name);
    write("type", std::string(typeOf(joint)));
    text_ << "><parent";
    write("link", joint.parent_link_name);
    text_ << "/><child";
    write("link", joint.child_link_name);
    text_ << "/>";
    writeOrigin(joint.parent_to_joint_origin_transform);
    text_ << "<axis";
    write("xyz", joint.axis);
    text_ << "/>";
    if (joint.limits) {
      text_ << "<limit";
      write("lower", joint.limits->lower);
      write("upper", joint.limits->upper);
      write("velocity", joint.limits->velocity);
      text_ << "/>";
    }
    if (joint.mimic) {
      text_ << "<mimic";
      write("joint", joint.mimic->joint_name);
      write("multiplier", joint.mimic->multiplier);
      write("offset", joint.mimic->offset);
      text_ << "/>";
    }
    text_ << "</joint>\n";
  }

  std::ostringstream text_;
};

}  // namespace detail

/// The links with their collision elements and the joints of a model as the text of a URDF. Numbers
/// read back as they are; rotations, which a model has as quaternions, to about 1e-16.
inline std::string urdfText(const urdf::ModelInterface& model) {
  return detail::UrdfWriter(model).text();
}

/// The robot that a model of urdfdom, as its parser gives it, is of. Where its URDF is at hand,
/// Robot(file) and Robot::fromText() are better: urdfdom leaves out what it does not know, capsules
/// and misspelt elements for example, which these read or refuse, and they name its lines.
/// \throws as Robot::fromText(), with lines of urdfText()
inline Robot robotFromModel(const urdf::ModelInterface& model, const RobotOptions& options = {},
                            const std::string& folder = {}) {
  return Robot::fromText(urdfText(model), options, folder);
}

}  // namespace fcl_prob
