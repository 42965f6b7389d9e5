// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/outer_mesh.h"

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

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/convex_faces.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// An inscribed polygon of n sides leaves out (π/n)²/2 of the radius; the polyhedron twice that.
int segmentsFor(double radius, double tolerance) {
  const double wanted = kPi * std::sqrt(radius / std::max(tolerance, 1e-12 * radius));
  return static_cast<int>(std::clamp(std::ceil(wanted), 12.0, 256.0));
}

void addQuad(TriangleMesh& mesh, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  mesh.triangles.emplace_back(a, b, c);
  mesh.triangles.emplace_back(a, c, d);
}

/// A stack of regular polygons of `segments` vertices between two poles. Rings go from the top (+z)
/// down.
struct Ring {
  double radius;
  double z;
};

TriangleMesh stackOfRings(double top, const std::vector<Ring>& rings, double bottom, int segments) {
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0, 0, top);
  for (const Ring& ring : rings) {
    for (int j = 0; j < segments; ++j) {
      const double angle = 2 * kPi * j / segments;
      mesh.vertices.emplace_back(ring.radius * std::cos(angle), ring.radius * std::sin(angle),
                                 ring.z);
    }
  }
  mesh.vertices.emplace_back(0, 0, bottom);
  const std::size_t last = mesh.vertices.size() - 1;
  const auto at = [segments](std::size_t ring, int j) {
    return 1 + ring * static_cast<std::size_t>(segments) + static_cast<std::size_t>(j % segments);
  };
  for (int j = 0; j < segments; ++j) {
    mesh.triangles.emplace_back(0, at(0, j), at(0, j + 1));
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
      addQuad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    mesh.triangles.emplace_back(at(rings.size() - 1, j), last, at(rings.size() - 1, j + 1));
  }
  return mesh;
}

/// A convex polyhedron around the unit ball. The number of rings is even, so that none is on the
/// equator and the faces there are upright.
TriangleMesh unitBall(int segments) {
  const int rings = 2 * ((segments + 3) / 4);
  std::vector<Ring> circles;
  for (int i = 0; i < rings; ++i) {
    const double theta = kPi * (i + 1) / (rings + 1);
    circles.push_back({std::sin(theta), std::cos(theta)});
  }
  TriangleMesh mesh = stackOfRings(1, circles, -1, segments);
  double inner = 1.0;  // radius of the ball inside
  for (const fcl::Triangle& t : mesh.triangles) {
    const Eigen::Vector3d& p = mesh.vertices[t[0]];
    const Eigen::Vector3d normal =
        (mesh.vertices[t[1]] - p).cross(mesh.vertices[t[2]] - p).normalized();
    inner = std::min(inner, normal.dot(p));
  }
  for (Eigen::Vector3d& v : mesh.vertices) v /= inner;
  return mesh;
}

TriangleMesh ellipsoidMesh(const Eigen::Vector3d& radii, double tolerance) {
  TriangleMesh mesh = unitBall(segmentsFor(radii.maxCoeff(), tolerance));
  for (Eigen::Vector3d& v : mesh.vertices) v = v.cwiseProduct(radii);
  return mesh;
}

/// The ball drawn out along z: since its faces at the equator are upright, that is its sum with a
/// segment.
TriangleMesh capsuleMesh(const fcl::Capsuled& capsule, double tolerance) {
  TriangleMesh mesh = unitBall(segmentsFor(capsule.radius, tolerance));
  for (Eigen::Vector3d& v : mesh.vertices) {
    v *= capsule.radius;
    v.z() += std::copysign(0.5 * capsule.lz, v.z());
  }
  return mesh;
}

TriangleMesh cylinderMesh(const fcl::Cylinderd& cylinder, double tolerance) {
  const int segments = segmentsFor(cylinder.radius, tolerance);
  const double radius = cylinder.radius / std::cos(kPi / segments);
  const double half = 0.5 * cylinder.lz;
  return stackOfRings(half, {{radius, half}, {radius, -half}}, -half, segments);
}

TriangleMesh coneMesh(const fcl::Coned& cone, double tolerance) {
  const int segments = segmentsFor(cone.radius, tolerance);
  const double half = 0.5 * cone.lz;
  return stackOfRings(half, {{cone.radius / std::cos(kPi / segments), -half}}, -half, segments);
}

// Normals outwards.
void addBox(TriangleMesh& mesh, const Eigen::Vector3d& lo, const Eigen::Vector3d& hi) {
  const std::size_t first = mesh.vertices.size();
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.emplace_back((corner & 1) ? hi.x() : lo.x(), (corner & 2) ? hi.y() : lo.y(),
                               (corner & 4) ? hi.z() : lo.z());
  }
  constexpr std::size_t kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : kQuads) {
    addQuad(mesh, first + q[0], first + q[1], first + q[2], first + q[3]);
  }
}

TriangleMesh convexMesh(const fcl::Convexd& convex) {
  TriangleMesh mesh;
  mesh.vertices = convex.getVertices();
  for (const std::vector<int>& face : decodeFaces(convex, "Convex")) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      mesh.triangles.emplace_back(face[0], face[i], face[i + 1]);
    }
  }
  return mesh;
}

TriangleMesh octreeMesh(const fcl::OcTreed& tree) {
  TriangleMesh mesh;
  for (const std::array<double, 6>& cell : tree.toBoxes()) {
    const Eigen::Vector3d centre(cell[0], cell[1], cell[2]);
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * cell[3]);
    addBox(mesh, centre - half, centre + half);
  }
  return mesh;
}

/// The part of the slab offset - depth <= normal·x <= offset that is near the centre.
TriangleMesh slabMesh(const Eigen::Vector3d& normal, double offset, double depth,
                      const OuterMeshRequest& request) {
  const double above = normal.dot(request.centre) - offset;
  const Eigen::Vector3d foot = request.centre - above * normal;
  Eigen::Matrix3d axes;
  axes.col(2) = normal;
  axes.col(0) = normal.unitOrthogonal();
  axes.col(1) = normal.cross(axes.col(0));
  TriangleMesh mesh;
  const double side = request.reach;
  if (depth > 0.0) {
    addBox(mesh, {-side, -side, -depth}, {side, side, 0.0});
  } else {
    mesh.vertices = {{-side, -side, 0}, {side, -side, 0}, {side, side, 0}, {-side, side, 0}};
    addQuad(mesh, 0, 1, 2, 3);
  }
  for (Eigen::Vector3d& v : mesh.vertices) v = foot + axes * v;
  return mesh;
}

TriangleMesh halfspaceMesh(const fcl::Halfspaced& halfspace, const OuterMeshRequest& request) {
  const double above = halfspace.signedDistance(request.centre);
  return slabMesh(halfspace.n, halfspace.d, std::max(0.0, -above) + request.reach, request);
}

}  // namespace

TriangleMesh outerMesh(const fcl::CollisionGeometryd& geometry, const OuterMeshRequest& request) {
  if (kindOf(geometry) == GeometryKind::mesh) return triangleMesh(meshView(geometry));
  switch (geometry.getNodeType()) {
    case fcl::GEOM_BOX: {
      const Eigen::Vector3d half = 0.5 * static_cast<const fcl::Boxd&>(geometry).side;
      TriangleMesh mesh;
      addBox(mesh, -half, half);
      return mesh;
    }
    case fcl::GEOM_SPHERE:
      return ellipsoidMesh(
          Eigen::Vector3d::Constant(static_cast<const fcl::Sphered&>(geometry).radius),
          request.tolerance);
    case fcl::GEOM_ELLIPSOID:
      return ellipsoidMesh(static_cast<const fcl::Ellipsoidd&>(geometry).radii, request.tolerance);
    case fcl::GEOM_CAPSULE:
      return capsuleMesh(static_cast<const fcl::Capsuled&>(geometry), request.tolerance);
    case fcl::GEOM_CONE:
      return coneMesh(static_cast<const fcl::Coned&>(geometry), request.tolerance);
    case fcl::GEOM_CYLINDER:
      return cylinderMesh(static_cast<const fcl::Cylinderd&>(geometry), request.tolerance);
    case fcl::GEOM_CONVEX:
      return convexMesh(static_cast<const fcl::Convexd&>(geometry));
    case fcl::GEOM_TRIANGLE: {
      const auto& triangle = static_cast<const fcl::TrianglePd&>(geometry);
      return {{triangle.a, triangle.b, triangle.c}, {fcl::Triangle(0, 1, 2)}};
    }
    case fcl::GEOM_HALFSPACE:
      return halfspaceMesh(static_cast<const fcl::Halfspaced&>(geometry), request);
    case fcl::GEOM_PLANE: {
      const auto& plane = static_cast<const fcl::Planed&>(geometry);
      return slabMesh(plane.n, plane.d, 0.0, request);
    }
    case fcl::GEOM_OCTREE:
      return octreeMesh(static_cast<const fcl::OcTreed&>(geometry));
    default:
      throw UnsupportedGeometry(nodeTypeName(geometry.getNodeType()) + " has no surface");
  }
}

}  // namespace fcl_prob::detail
