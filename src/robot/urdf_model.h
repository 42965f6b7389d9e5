// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a URDF says of where the bodies of a robot are.
#pragma once

#include <fcl/common/types.h>

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fcl_prob::detail {

struct UrdfBox {
  Eigen::Vector3d size;  ///< metres
};
struct UrdfSphere {
  double radius;  ///< metres
};
struct UrdfCylinder {
  double radius;  ///< metres
  double length;
};
/// A cylinder with half a ball at both ends, which are not part of its length.
struct UrdfCapsule {
  double radius;  ///< metres
  double length;
};
struct UrdfMesh {
  std::string file;  ///< as the URDF has it
  Eigen::Vector3d scale;
};
using UrdfShape = std::variant<UrdfBox, UrdfSphere, UrdfCylinder, UrdfCapsule, UrdfMesh>;

struct UrdfCollision {
  std::string where;  ///< begins messages: "arm.urdf: line 12: link hand: collision 0"
  UrdfShape shape;
  fcl::Transform3d in_link;
};

struct UrdfLink {
  std::string where;
  std::vector<UrdfCollision> collisions;
};

/// Its value is `multiplier` times that of another joint, and `offset`.
struct UrdfMimic {
  std::string joint;
  double multiplier = 1.0;
  double offset = 0.0;
};

struct UrdfJoint {
  enum class Type { fixed, revolute, continuous, prismatic };
  std::string where;
  std::string name;
  Type type = Type::fixed;
  std::string parent;
  std::string child;
  fcl::Transform3d origin = fcl::Transform3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit
  double lower = 0.0;                               ///< infinite for a continuous joint
  double upper = 0.0;
  double velocity = 0.0;  ///< of the limit; 0: not given
  std::optional<UrdfMimic> mimic;
};

/// A tree: every joint has two links of the robot, every link but the root one joint above it.
struct UrdfModel {
  std::string name;
  std::string root;
  std::map<std::string, UrdfLink> links;
  std::map<std::string, UrdfJoint> joints;

  /// What may be meant otherwise than it is read, and what is told of its meshes: sentences for
  /// people.
  std::vector<std::string> notes;
};

struct UrdfSource {
  std::string file;  ///< path; empty: it never was in a file
  std::string content;
  std::string folder;  ///< what names of meshes are relative to; empty: there is none
  std::string name = file.empty() ? "the URDF text" : file;  ///< begins messages
};

/// Nothing that has a meaning for where bodies are is left out: an element or attribute that is
/// neither read nor known to be of no meaning for that is refused.
/// \throws FileError "file: line n: element: fault"
UrdfModel readUrdf(const UrdfSource& source);

}  // namespace fcl_prob::detail
