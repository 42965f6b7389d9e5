// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/validation.h"

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fcl_prob/exceptions.h"
#include "geometry/convex_faces.h"
#include "geometry/length.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {
namespace {

constexpr double kRigidTolerance = 1e-9;

std::string text(const Eigen::Vector3d& v) {
  std::ostringstream out;
  out << '(' << v[0] << ", " << v[1] << ", " << v[2] << ')';
  return out.str();
}

void requirePositive(double size, const char* what, const std::string& name) {
  if (size > 0.0 && size <= kLargestLength) return;
  std::ostringstream out;
  out << name << ": " << what << " is " << size << ", must be positive and at most "
      << kLargestLength;
  throw InvalidGeometry(out.str());
}

void requirePosition(const Eigen::Vector3d& point, const std::string& what,
                     const std::string& name) {
  if (isPosition(point)) return;
  std::ostringstream out;
  out << name << ": " << what << " is " << text(point) << ", must be within " << kLargestLength
      << " of the origin";
  throw InvalidGeometry(out.str());
}

void requireFinished(const MeshView& mesh, const std::string& name) {
  if (mesh.build_state == fcl::BVH_BUILD_STATE_PROCESSED ||
      mesh.build_state == fcl::BVH_BUILD_STATE_UPDATED) {
    return;
  }
  if (mesh.build_state == fcl::BVH_BUILD_STATE_EMPTY) {
    throw InvalidGeometry(name + ": the mesh is empty (beginModel was never called)");
  }
  throw InvalidGeometry(name + ": the mesh is unfinished (endModel, endReplaceModel or " +
                        "endUpdateModel is missing; build_state is " +
                        std::to_string(mesh.build_state) + ")");
}

void validateTriangle(const MeshView& mesh, int triangle, const std::string& name) {
  for (int corner = 0; corner < 3; ++corner) {
    const std::size_t index = mesh.triangles[triangle][corner];
    if (index < static_cast<std::size_t>(mesh.vertex_count)) continue;
    throw InvalidGeometry(name + ": triangle " + std::to_string(triangle) + " refers to vertex " +
                          std::to_string(index) + ", but there are only " +
                          std::to_string(mesh.vertex_count));
  }
}

void validatePlane(const Eigen::Vector3d& normal, double offset, const std::string& name) {
  if (!(std::abs(normal.norm() - 1.0) <= kRigidTolerance)) {
    throw InvalidGeometry(name + ": the normal " + text(normal) + " does not have length 1");
  }
  if (!(std::abs(offset) <= kLargestLength)) {
    std::ostringstream out;
    out << name << ": the offset d is " << offset << ", must be at most " << kLargestLength;
    throw InvalidGeometry(out.str());
  }
}

void validateOcTree(const fcl::OcTreed& tree, const std::string& name) {
  if (tree.getRoot() == nullptr) throw InvalidGeometry(name + ": the octree is empty");
}

template <typename RoundShape>
void requireRadiusAndLength(const RoundShape& shape, const std::string& name) {
  requirePositive(shape.radius, "the radius", name);
  requirePositive(shape.lz, "the length lz", name);
}

void requireSides(const Eigen::Vector3d& sides, const char* const (&what)[3],
                  const std::string& name) {
  for (int i = 0; i < 3; ++i) requirePositive(sides[i], what[i], name);
}

void validateTriangleShape(const fcl::TrianglePd& triangle, const std::string& name) {
  requirePosition(triangle.a, "vertex a", name);
  requirePosition(triangle.b, "vertex b", name);
  requirePosition(triangle.c, "vertex c", name);
}

void validateShape(const fcl::CollisionGeometryd& geometry, const std::string& name) {
  switch (geometry.getNodeType()) {
    case fcl::GEOM_BOX:
      return requireSides(static_cast<const fcl::Boxd&>(geometry).side,
                          {"side x", "side y", "side z"}, name);
    case fcl::GEOM_SPHERE:
      return requirePositive(static_cast<const fcl::Sphered&>(geometry).radius, "the radius", name);
    case fcl::GEOM_ELLIPSOID:
      return requireSides(static_cast<const fcl::Ellipsoidd&>(geometry).radii,
                          {"radius x", "radius y", "radius z"}, name);
    case fcl::GEOM_CAPSULE:
      return requireRadiusAndLength(static_cast<const fcl::Capsuled&>(geometry), name);
    case fcl::GEOM_CONE:
      return requireRadiusAndLength(static_cast<const fcl::Coned&>(geometry), name);
    case fcl::GEOM_CYLINDER:
      return requireRadiusAndLength(static_cast<const fcl::Cylinderd&>(geometry), name);
    case fcl::GEOM_CONVEX:
      return validateConvex(static_cast<const fcl::Convexd&>(geometry), name);
    case fcl::GEOM_TRIANGLE:
      return validateTriangleShape(static_cast<const fcl::TrianglePd&>(geometry), name);
    case fcl::GEOM_HALFSPACE: {
      const auto& halfspace = static_cast<const fcl::Halfspaced&>(geometry);
      return validatePlane(halfspace.n, halfspace.d, name);
    }
    case fcl::GEOM_PLANE: {
      const auto& plane = static_cast<const fcl::Planed&>(geometry);
      return validatePlane(plane.n, plane.d, name);
    }
    case fcl::GEOM_OCTREE:
      return validateOcTree(static_cast<const fcl::OcTreed&>(geometry), name);
    default:
      throw UnsupportedGeometry(name + ": " + nodeTypeName(geometry.getNodeType()));
  }
}

}  // namespace

void validateMeshView(const MeshView& mesh, const std::string& name) {
  requireFinished(mesh, name);
  if (mesh.vertex_count <= 0 || mesh.vertices == nullptr) {
    throw InvalidGeometry(name + ": the mesh has no vertices");
  }
  if (mesh.triangle_count <= 0 || mesh.triangles == nullptr) {
    throw InvalidGeometry(name + ": the mesh is a point cloud of " +
                          std::to_string(mesh.vertex_count) + " vertices without triangles");
  }
  if (mesh.node_count <= 0) {
    throw InvalidGeometry(name + ": the mesh has no bounding volume tree");
  }
  for (int i = 0; i < mesh.vertex_count; ++i) {
    if (!isPosition(mesh.vertices[i])) {
      requirePosition(mesh.vertices[i], "vertex " + std::to_string(i), name);
    }
  }
  for (int i = 0; i < mesh.triangle_count; ++i) validateTriangle(mesh, i, name);
}

void validateGeometry(const fcl::CollisionGeometryd* geometry, const std::string& name) {
  if (geometry == nullptr) throw InvalidGeometry(name + ": the geometry is null");
  const std::string full_name = name + " (" + nodeTypeName(geometry->getNodeType()) + ")";
  if (kindOf(*geometry) == GeometryKind::mesh) {
    validateMeshView(meshView(*geometry), full_name);
  } else {
    validateShape(*geometry, full_name);
  }
}

void requireMeasurable(double size_a, double size_b) {
  const double larger = std::max(size_a, size_b);
  if (larger >= kLeastSize || larger == 0.0) return;
  std::ostringstream out;
  out << "both objects are smaller than " << kLeastSize << " m, the larger one is " << larger
      << " m: squares of such lengths are no numbers";
  throw InvalidGeometry(out.str());
}

void validatePose(const fcl::Transform3d& pose, const std::string& name) {
  const Eigen::Vector3d translation = pose.translation();
  const Eigen::Matrix3d rotation = pose.linear();
  if (!isPosition(translation)) {
    throw InvalidPose("pose of " + name + ": the translation is " + text(translation));
  }
  if (!rotation.allFinite()) {
    throw InvalidPose("pose of " + name + ": the rotation matrix is not finite");
  }
  const double deviation =
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double determinant = rotation.determinant();
  if (deviation <= kRigidTolerance && determinant > 0.0) return;
  std::ostringstream out;
  out << "pose of " << name << " is not rigid: its matrix R has |R'R - 1| = " << deviation
      << " and determinant " << determinant;
  throw InvalidPose(out.str());
}

}  // namespace fcl_prob::detail
