// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A scene of the audit as plain data, which can be drawn, changed, simplified, written and asked.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob_audit {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using fcl_prob::TriangleMesh;

enum class Kind {
  box,
  sphere,
  ellipsoid,
  capsule,
  cone,
  cylinder,
  convex,
  triangle,
  halfspace,
  plane,
  mesh,
  octree
};
constexpr int kKinds = 12;

/// The bounding volumes of a mesh's tree.
enum class Tree { aabb, obb, rss, obbrss, kios, kdop16, kdop18, kdop24 };
constexpr int kTrees = 8;

/// A cell of an octree: [index, index + 1] · resolution.
struct Voxel {
  std::array<int, 3> index;
  bool occupied;
};

/// A geometry, in its own frame, metres.
struct Shape {
  Kind kind = Kind::box;
  Vector3d sizes = Vector3d::Ones();  ///< sides or radii; (radius, length, 0) of the round ones
  TriangleMesh mesh;                  ///< mesh; convex: its hull's faces; triangle: the only one
  Tree tree = Tree::obbrss;
  Vector3d normal = Vector3d::UnitZ();  ///< halfspace, plane; a unit vector
  double offset = 0.0;
  double resolution = 1.0;  ///< octree
  std::vector<Voxel> voxels;
  // FCL's fields of occupancy.
  double cost_density = 1.0;
  double threshold_occupied = 1.0;
  double threshold_free = 0.0;

  bool isUnbounded() const { return kind == Kind::halfspace || kind == Kind::plane; }
  /// As fcl::collide has it, what is not occupied is never hit; of an octree only its cells count.
  bool isOccupied() const { return kind == Kind::octree || cost_density >= threshold_occupied; }
};

struct Member {
  Shape shape;
  fcl::Transform3d pose = fcl::Transform3d::Identity();
};

/// A Gaussian as it is handed to the library.
struct Displacement {
  Vector3d sigma = Vector3d::Ones();
  Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();
  Vector3d mean = Vector3d::Zero();
  bool by_matrix = false;           ///< passed as a covariance matrix
  std::optional<Matrix3d> rotated;  ///< by rotated(), perhaps up to 1e-9 off a rotation
};

/// What is asked.
enum class Question { pair, group, manager, batch };

/// FCL's broad-phase managers.
enum class ManagerKind { naive, ssap, sap, interval_tree, dynamic_tree, dynamic_tree_array, hash };
constexpr int kManagers = 7;

struct ManagerQuestion {
  ManagerKind kind = ManagerKind::naive;
  double culling_probability = 1e-12;
  bool within = false;  ///< all pairs of B's members, instead of A's first one against them
  /// Members of B (by index) that are registered a second time.
  std::vector<int> registered_twice;
};

/// Both groups have one member, but for groups; of a manager B holds the members.
struct Scene {
  std::string family;
  std::uint64_t seed = 0;
  std::uint64_t index = 0;
  Question question = Question::pair;
  std::vector<Member> a, b;
  /// One, or the components of a mixture with their weights; for managers of A (first) and of all
  /// of B (second); for batches one a waypoint.
  std::vector<Displacement> displacements;
  std::vector<double> weights;
  std::optional<double> truncation;
  ManagerQuestion manager;
  fcl_prob::ProbabilityRequest request;
  /// Calls of on_progress after which it says stop.
  std::optional<int> cancel_after;

  bool isMixture() const { return question == Question::pair && !weights.empty(); }
};

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

Geometry makeGeometry(const Shape& shape);
fcl_prob::GaussianDisplacement makeDisplacement(const Displacement& displacement);

/// Half the diagonal of the shape's box around its frame's origin, roughly; 0 if it is unbounded.
double extentOf(const Shape& shape);

std::string nameOf(Kind kind);
std::string nameOf(ManagerKind kind);

/// Everything that the scene is, in words with 17 digits.
std::string textOf(const Scene& scene);

}  // namespace fcl_prob_audit
