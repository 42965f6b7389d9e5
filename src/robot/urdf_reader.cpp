// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>
#include <set>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "robot/urdf_elements.h"
#include "robot/urdf_model.h"

namespace fcl_prob::detail {
namespace {

constexpr double kTurn = boost::math::double_constants::two_pi;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostLinks = 1000;

/// Roll, pitch and yaw turn about the axes x, y and z of the frame that holds the other one, in
/// that order.
Eigen::Matrix3d rotationOf(const Eigen::Vector3d& angles) {
  const Eigen::Vector3d half = 0.5 * angles;
  const double cx = std::cos(half.x()), cy = std::cos(half.y()), cz = std::cos(half.z());
  const double sx = std::sin(half.x()), sy = std::sin(half.y()), sz = std::sin(half.z());
  Eigen::Quaterniond rotation(cx * cy * cz + sx * sy * sz, sx * cy * cz - cx * sy * sz,
                              cx * sy * cz + sx * cy * sz, cx * cy * sz - sx * sy * cz);
  // Twice, as urdfdom and who used it did: poses keep their last bits.
  rotation.coeffs() /= std::sqrt(rotation.x() * rotation.x() + rotation.y() * rotation.y() +
                                 rotation.z() * rotation.z() + rotation.w() * rotation.w());
  return rotation.normalized().toRotationMatrix();
}

class UrdfReader {
 public:
  explicit UrdfReader(const std::string& path) : path_(path) {}

  UrdfModel read(const XmlElement& document) {
    const UrdfContainer robot(path_, document, "robot", {"link", "joint"});
    model_.name = robot.text("name");
    for (const XmlElement* element : robot.all("link")) readLink(*element);
    for (const XmlElement* element : robot.all("joint")) readJoint(*element);
    if (model_.links.empty()) robot.fail("no URDF: has no link");
    if (model_.links.size() > kMostLinks) {
      robot.fail(std::to_string(model_.links.size()) + " links, at most " +
                 std::to_string(kMostLinks));
    }
    findRoot(robot);
    return std::move(model_);
  }

 private:
  /// What is told of an element before its name is known to be there.
  static std::string named(const char* kind, const XmlElement& element) {
    const std::string* name = element.attribute("name");
    return name == nullptr ? kind : kind + (" " + *name);
  }

  fcl::Transform3d originOf(const UrdfContainer& owner, const std::string& name) {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    const XmlElement* element = owner.atMostOne("origin");
    if (element == nullptr) return pose;
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    const UrdfValues origin(path_, *element, name + ": origin", {"xyz", "rpy"});
    const Eigen::Vector3d angles = origin.vector("rpy", zero);
    pose.linear() = rotationOf(angles);
    pose.translation() = origin.vector("xyz", zero);
    if (angles.cwiseAbs().maxCoeff() > kTurn) {
      model_.notes.push_back(origin.where() + ": rpy " + numberText(angles) +
                             " is more than a turn: probably degrees, read as radians");
    }
    return pose;
  }

  const XmlElement& shapeElementOf(const UrdfContainer& collision, const std::string& name) const {
    static const std::vector<std::string> kinds{"box", "sphere", "cylinder", "capsule", "mesh"};
    const auto& geometries = collision.all("geometry");
    if (geometries.size() != 1) {
      collision.fail(std::to_string(geometries.size()) + " geometries, must be one");
    }
    const UrdfContainer geometry(path_, *geometries[0], name + ": geometry", kinds);
    std::vector<const XmlElement*> shapes;
    for (const std::string& kind : kinds) {
      const auto& of_kind = geometry.all(kind);
      shapes.insert(shapes.end(), of_kind.begin(), of_kind.end());
    }
    if (shapes.size() != 1) {
      geometry.fail("has " + std::to_string(shapes.size()) +
                    " of box, sphere, cylinder, capsule and mesh, must be one");
    }
    return *shapes[0];
  }

  UrdfShape shapeOf(const XmlElement& element, const std::string& name) const {
    if (element.name == "sphere") {
      return UrdfSphere{UrdfValues(path_, element, name, {"radius"}).positive("radius")};
    }
    if (element.name == "box") {
      const UrdfValues box(path_, element, name, {"size"});
      const Eigen::Vector3d size = box.vector("size");
      if (!(size.array() > 0.0).all()) {
        box.fail("size must be > 0, is " + numberText(size));
      }
      return UrdfBox{size};
    }
    if (element.name == "mesh") {
      const UrdfValues mesh(path_, element, name, {"filename", "scale"});
      const Eigen::Vector3d scale = mesh.vector("scale", Eigen::Vector3d(1, 1, 1));
      if ((scale.array() == 0.0).any()) mesh.fail("scale must not be 0");
      return UrdfMesh{mesh.text("filename"), scale};
    }
    const UrdfValues round(path_, element, name, {"radius", "length"});
    const double radius = round.positive("radius"), length = round.positive("length");
    if (element.name == "capsule") return UrdfCapsule{radius, length};
    return UrdfCylinder{radius, length};
  }

  void readLink(const XmlElement& element) {
    const UrdfContainer link(path_, element, named("link", element), {"collision"});
    const std::string& name = link.text("name");
    const auto [entry, is_new] = model_.links.try_emplace(name);
    if (!is_new) link.fail("is there twice, also as " + entry->second.where);
    entry->second.where = link.where();
    std::size_t count = 0;
    for (const XmlElement* one : link.all("collision")) {
      const std::string which = "link " + name + ": collision " + std::to_string(count++);
      const UrdfContainer collision(path_, *one, which, {"origin", "geometry"});
      const XmlElement& shape = shapeElementOf(collision, which);
      const std::string where = path_ + ": line " + std::to_string(shape.line) + ": " + which;
      entry->second.collisions.push_back(
          {where, shapeOf(shape, which), originOf(collision, which)});
    }
  }

  static UrdfJoint::Type typeOf(const UrdfContainer& joint) {
    const std::string& type = joint.text("type");
    if (type == "fixed") return UrdfJoint::Type::fixed;
    if (type == "revolute") return UrdfJoint::Type::revolute;
    if (type == "continuous") return UrdfJoint::Type::continuous;
    if (type == "prismatic") return UrdfJoint::Type::prismatic;
    joint.fail("its type is " + type + ", none of fixed, revolute, continuous and prismatic");
  }

  std::string linkOf(const UrdfContainer& joint, const std::string& name, const char* end) const {
    const UrdfValues values(path_, joint.one(end), name + ": " + end, {"link"});
    const std::string& link = values.text("link");
    if (model_.links.count(link) == 0) values.fail("there is no link " + link);
    return link;
  }

  void readJoint(const XmlElement& element) {
    const UrdfContainer container(path_, element, named("joint", element),
                                  {"origin", "parent", "child", "axis", "limit", "mimic"});
    const std::string& name = container.text("name");
    const auto [entry, is_new] = model_.joints.try_emplace(name);
    if (!is_new) container.fail("is there twice, also as " + entry->second.where);
    const std::string told = "joint " + name;
    UrdfJoint& joint = entry->second;
    joint.where = container.where();
    joint.name = name;
    joint.type = typeOf(container);
    joint.parent = linkOf(container, told, "parent");
    joint.child = linkOf(container, told, "child");
    joint.origin = originOf(container, told);
    readAxis(container, told, joint);
    readLimit(container, told, joint);
    readMimic(container, told, joint);
  }

  void readAxis(const UrdfContainer& container, const std::string& name, UrdfJoint& joint) const {
    const XmlElement* element = container.atMostOne("axis");
    if (element == nullptr || joint.type == UrdfJoint::Type::fixed) return;
    const UrdfValues values(path_, *element, name + ": axis", {"xyz"});
    const Eigen::Vector3d axis = values.vector("xyz");
    const double length = axis.norm();
    if (!(length > 1e-6 && std::isfinite(length))) {
      values.fail("its length is " + numberText(length));
    }
    joint.axis = axis.normalized();
  }

  void readLimit(const UrdfContainer& container, const std::string& name, UrdfJoint& joint) {
    const XmlElement* element = container.atMostOne("limit");
    const bool turns = joint.type == UrdfJoint::Type::revolute;
    const bool has_range = turns || joint.type == UrdfJoint::Type::prismatic;
    if (!has_range) {
      joint.lower = -kUnlimited;
      joint.upper = kUnlimited;
      if (element == nullptr || joint.type == UrdfJoint::Type::fixed) return;
    }
    if (element == nullptr) container.fail("has no limit");
    const UrdfValues limit(
        path_, *element, name + ": limit",
        {"lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"});
    joint.velocity = limit.number("velocity", 0.0);
    if (joint.velocity < 0.0) limit.fail("velocity is below 0: " + numberText(joint.velocity));
    if (!has_range) return;
    joint.lower = limit.number("lower", 0.0);
    joint.upper = limit.number("upper", 0.0);
    const std::string both = numberText(joint.lower) + " to " + numberText(joint.upper);
    if (joint.lower > joint.upper) limit.fail("lower is above upper: " + both);
    if (turns && std::max(-joint.lower, joint.upper) > kTurn) {
      model_.notes.push_back(limit.where() + ": " + both +
                             " is more than a turn: probably degrees, read as radians");
    }
  }

  void readMimic(const UrdfContainer& container, const std::string& name, UrdfJoint& joint) const {
    const XmlElement* element = container.atMostOne("mimic");
    if (element == nullptr) return;
    const UrdfValues mimic(path_, *element, name + ": mimic", {"joint", "multiplier", "offset"});
    joint.mimic = {mimic.text("joint"), mimic.number("multiplier", 1.0),
                   mimic.number("offset", 0.0)};
  }

  void findRoot(const UrdfContainer& robot) {
    std::set<std::string> carried;
    for (const auto& [name, joint] : model_.joints) {
      if (carried.insert(joint.child).second) continue;
      throw FileError(joint.where + ": link " + joint.child + " hangs on more than one joint");
    }
    for (const auto& [name, link] : model_.links) {
      if (carried.count(name) > 0) continue;
      if (!model_.root.empty()) {
        throw FileError(link.where + ": hangs on no joint, nor does link " + model_.root +
                        ": a robot has one root");
      }
      model_.root = name;
    }
    if (model_.root.empty()) robot.fail("has no root link: all of them hang on each other");
  }

  const std::string& path_;
  UrdfModel model_;
};

}  // namespace

UrdfModel readUrdf(const UrdfSource& source) {
  return UrdfReader(source.name).read(readRobotXml(source.content, source.name, "URDF"));
}

}  // namespace fcl_prob::detail
