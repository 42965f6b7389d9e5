// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/nearly_convex.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "base/left_out.h"
#include "convex/cut_polytope.h"
#include "convex/face_set.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/triangle_mesh.h"
#include "geometry/directed_edges.h"
#include "geometry/enclosed_volume.h"
#include "geometry/surface_caps.h"
#include "scene/core_cuts.h"
#include "scene/mesh_reach.h"

namespace fcl_prob::detail {
namespace {

// Planes are held against all triangles.
constexpr int kMostCutTriangles = 5'000;

// Of a mesh with more edges that are concave no hull is made.
constexpr double kMostConcave = 0.25;

// The core is worth its planes if it has at least this share of the hull.
constexpr double kLeastCoreShare = 0.85;

TriangleMesh surfaceOf(const ConvexPolytope& polytope) {
  TriangleMesh mesh;
  mesh.vertices = polytope.vertices;
  for (const ConvexPolytope::Face& face : polytope.faces) {
    for (std::size_t k = 2; k < face.vertices.size(); ++k) {
      mesh.triangles.emplace_back(face.vertices[0], face.vertices[k - 1], face.vertices[k]);
    }
  }
  return mesh;
}

// Linear in the mesh: closed, and most edges are not concave.
bool mayBeNearlyConvex(const MeshView& view, const std::vector<Eigen::Vector3d>& vertices) {
  const std::vector<int> welded = weldVertices(view);
  std::vector<DirectedEdge> edges;
  for (int t = 0; t < view.triangle_count; ++t) {
    addSides(weldedCorners(welded, view.triangles[t]), t, edges);
  }
  const EdgePairing pairing = pairEdges(std::move(edges));
  if (pairing.fault) return false;
  const auto corner = [&](int t, int k) { return vertices[view.triangles[t][k]]; };
  std::size_t concave = 0;
  for (const EdgeMatch& match : pairing.matches) {
    const int t = match.forward.polygon;
    const int s = match.backward.polygon;
    const Eigen::Vector3d n = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
    const Eigen::Vector3d& from = vertices[match.forward.from];
    double highest = 0.0;
    double length = 0.0;
    for (int k = 0; k < 3; ++k) {
      highest = std::max(highest, n.dot(corner(s, k) - from));
      length = std::max(length, (corner(s, k) - from).norm());
    }
    concave += highest > 1e-6 * n.norm() * length;
  }
  return static_cast<double>(concave) < kMostConcave * static_cast<double>(pairing.matches.size());
}

ConvexPolytope coreOf(const ConvexPolytope& hull, const std::vector<CoreCut>& cuts) {
  CutPolytope cut(toFaceSet(hull));
  for (const CoreCut& each : cuts) cut.cut(each.n, each.offset);
  FaceSet rest;
  cut.writeTo(rest);
  if (rest.vertices().empty()) return {};
  return convexHull(rest.vertices());
}

// All vertices are P's, so that its hull is that of the mesh whatever Qhull made of it.
void holdAll(const std::vector<Eigen::Vector3d>& vertices, ConvexFan& hull) {
  hull.vertices.clear();
  for (const Eigen::Vector3d& v : vertices) {
    hull.vertices.emplace_back(v - hull.centre);
    hull.radius = std::max(hull.radius, hull.vertices.back().norm());
  }
  const double rounding = 16 * kEpsilon * (hull.radius + hull.centre.norm());
  for (std::size_t f = 0; f < hull.normals.size(); ++f) {
    const double before = hull.offsets[f];
    for (const Eigen::Vector3d& v : hull.vertices) {
      hull.offsets[f] = std::max(hull.offsets[f], hull.normals[f].dot(v) + rounding);
    }
    hull.depths[f] += hull.offsets[f] - before;
  }
}

}  // namespace

std::shared_ptr<const NearlyConvex> nearlyConvexOf(const MeshView& view,
                                                   const std::vector<Eigen::Vector3d>& vertices,
                                                   const Eigen::Vector3d& moved_by) {
  if (isLeftOut("nearly convex") || view.triangle_count < 4 ||
      view.triangle_count > kMostCutTriangles)
    return nullptr;
  if (!mayBeNearlyConvex(view, vertices)) return nullptr;
  const ConvexPolytope hull = convexHull(vertices);
  if (hull.faces.empty()) return nullptr;
  const TriangleMesh around = surfaceOf(hull);
  TriangleMesh mesh = triangleMesh(view);
  mesh.vertices = vertices;
  const double whole = enclosedVolume(around);
  if (!(enclosedVolume(mesh) > kLeastCoreShare * whole)) return nullptr;
  const auto cuts = findCoreCuts(view, vertices, hull);
  if (!cuts) return nullptr;
  const ConvexPolytope inside = coreOf(hull, *cuts);
  if (inside.faces.empty()) return nullptr;
  const TriangleMesh core = surfaceOf(inside);
  const double share = enclosedVolume(core) / whole;
  if (!(share > kLeastCoreShare)) return nullptr;
  const auto hull_fan = convexFanOf(viewOf(around), around.vertices, Eigen::Vector3d::Zero());
  const auto core_fan = convexFanOf(viewOf(core), core.vertices, Eigen::Vector3d::Zero());
  if (!hull_fan || !core_fan) return nullptr;
  auto found = std::make_shared<NearlyConvex>(NearlyConvex{*hull_fan, *core_fan, share});
  holdAll(vertices, found->hull);
  std::vector<Eigen::Vector3d> normals;
  for (const ConvexPolytope::Face& face : hull.faces) normals.push_back(face.normal);
  for (const CoreCut& cut : *cuts) normals.push_back(cut.n);
  const SurroundingMesh surrounding(view, vertices, moved_by);
  if (!surrounding.surrounds(found->core, normals)) return nullptr;
  return found;
}

}  // namespace fcl_prob::detail
