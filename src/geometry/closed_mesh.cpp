// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/closed_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "fcl_prob/exceptions.h"
#include "geometry/directed_edges.h"
#include "geometry/ray_crossing.h"
#include "geometry/surface_caps.h"

namespace fcl_prob::detail {
namespace {

/// A rotation with no special angles: edges that line up along the axes in a typical mesh do not
/// line up with the rays here, which would make their signs uncertain.
Eigen::Matrix3d genericRotation() {
  return Eigen::Quaterniond(0.8142, 0.2931, 0.4127, -0.2839).normalized().toRotationMatrix();
}

/// The first vertex of every part that hangs together by corners.
std::vector<Eigen::Vector3d> onePointAPart(const MeshView& mesh,
                                           const SurfaceComponents& components) {
  std::vector<Eigen::Vector3d> points(components.count);
  for (int v = mesh.vertex_count; v-- > 0;) {
    if (components.of_vertex[v] >= 0) points[components.of_vertex[v]] = mesh.vertices[v];
  }
  return points;
}

}  // namespace

// Triangles with two equal corners have no inside to bound and cancel out of the pairing.
WeldedSurface::WeldedSurface(const MeshView& mesh) : welded(weldVertices(mesh)) {
  std::vector<DirectedEdge> edges;
  triangles.reserve(mesh.triangle_count);
  edges.reserve(3 * static_cast<std::size_t>(mesh.triangle_count));
  for (int t = 0; t < mesh.triangle_count; ++t) {
    const std::array<int, 3> corners = weldedCorners(welded, mesh.triangles[t]);
    if (anyEqual(corners)) continue;
    triangles.push_back(t);
    addSides(corners, t, edges);
  }
  pairing = pairEdges(std::move(edges));
  if (triangles.empty()) pairing.fault = "every triangle is degenerate";
}

std::optional<std::string> opennessOf(const MeshView& mesh) {
  return WeldedSurface(mesh).pairing.fault;
}

ClosedMesh::ClosedMesh(const MeshView& mesh, const std::string& name)
    : ClosedMesh(mesh, WeldedSurface(mesh), name) {}

ClosedMesh::ClosedMesh(const MeshView& mesh, const WeldedSurface& surface,
                       const std::string& name) {
  if (surface.pairing.fault) {
    throw OpenMesh(name + " is not a closed mesh: " + *surface.pairing.fault);
  }
  SurfaceComponents components = componentsOf(mesh, surface.welded);
  part_points_ = onePointAPart(mesh, components);
  part_of_vertex_ = std::move(components.of_vertex);

  BoxTree::Box bounds;
  for (int t : surface.triangles) {
    for (int k = 0; k < 3; ++k) bounds.extend(mesh.vertex(t, k));
  }
  centre_ = bounds.center();
  const Eigen::Matrix3d rotation = genericRotation();
  std::vector<BoxTree::Box> boxes;
  boxes.reserve(surface.triangles.size());
  triangles_.reserve(surface.triangles.size());
  for (int t : surface.triangles) {
    Triangle triangle;
    BoxTree::Box box;
    for (int k = 0; k < 3; ++k) {
      triangle.corners[k] = rotation * (mesh.vertex(t, k) - centre_);
      box.extend(triangle.corners[k]);
      radius_ = std::max(radius_, triangle.corners[k].cwiseAbs().maxCoeff());
    }
    triangles_.push_back(triangle);
    boxes.push_back(box);
  }
  tree_ = BoxTree(boxes);
}

// Along each axis to the nearer end, the shortest first: it meets the fewest triangles.
std::array<ClosedMesh::Ray, 3> ClosedMesh::raysFrom(const Eigen::Vector3d& point) const {
  std::array<Ray, 3> rays;
  const BoxTree::Box& bounds = tree_.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    const double above = bounds.max()[axis] - point[axis];
    const double below = point[axis] - bounds.min()[axis];
    rays[axis] = {axis, above <= below, std::min(above, below)};
  }
  std::sort(rays.begin(), rays.end(),
            [](const Ray& one, const Ray& other) { return one.length < other.length; });
  return rays;
}

// The ray of `point` along one axis of the rotated frame meets the triangles whose projections
// contain it; the winding number is the sum of the signs of those ahead, mirrored at the point for
// a ray downwards: that turns the ray around, but not the normals. Vertices and point are known to
// `margin` only (subtraction and rotation round), so an answer counts only if no move by `margin`
// can change any of the signs: then the winding number of the mesh as given is the same, since
// moving from one to the other never carries the surface across the point's ray.
std::optional<int> ClosedMesh::windingAlong(const Ray& ray, const Eigen::Vector3d& point,
                                            double margin) const {
  BoxTree::Box around(point.array() - 4 * margin, point.array() + 4 * margin);
  (ray.upwards ? around.max() : around.min())[ray.axis] = ray.upwards ? kInfinity : -kInfinity;
  const double sign = ray.upwards ? 1.0 : -1.0;
  int winding = 0;
  const bool certain = tree_.visitBox(around, [&](int item) {
    std::array<Eigen::Vector3d, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = sign * (triangles_[item].corners[k] - point);
    const auto crossing = rayCrossing(corners, ray.axis, margin);
    winding += crossing.value_or(0);
    return crossing.has_value();
  });
  return certain ? std::optional<int>(winding) : std::nullopt;
}

Containment ClosedMesh::contains(const Eigen::Vector3d& point, double error) const {
  const Eigen::Vector3d relative = point - centre_;
  const double reach = relative.cwiseAbs().maxCoeff();
  if (!(reach <= 2 * radius_ + 2 * error)) {
    return std::isfinite(reach) ? Containment::outside : Containment::unknown;
  }
  const double largest =
      std::max({radius_, centre_.cwiseAbs().maxCoeff(), point.cwiseAbs().maxCoeff()});
  // Rotated, an error in three coordinates is one of up to √3 in each.
  const double margin = 16 * std::numeric_limits<double>::epsilon() * largest + 2 * error;
  const Eigen::Vector3d rotated = genericRotation() * relative;
  for (const Ray& ray : raysFrom(rotated)) {
    if (const auto winding = windingAlong(ray, rotated, margin)) {
      return *winding != 0 ? Containment::inside : Containment::outside;
    }
  }
  return Containment::unknown;
}

}  // namespace fcl_prob::detail
