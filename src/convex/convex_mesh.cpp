// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/convex_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/constants.h"
#include "convex/hull_slack.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// A triangle lower than this fraction of its longest side is a segment.
constexpr double kFlat = 1e-14;

void addFace(ConvexMesh& mesh, const Eigen::Vector3d& normal, const std::vector<int>& corners) {
  mesh.faces.push_back(
      {normal, static_cast<int>(mesh.corners.size()), static_cast<int>(corners.size())});
  mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
}

void addEdges(ConvexMesh& mesh) {
  std::map<std::pair<int, int>, int> unmatched;  // directed edge -> face
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const ConvexMesh::Face& face = mesh.faces[f];
    for (int c = 0; c < face.count; ++c) {
      const int from = mesh.corners[face.first + c];
      const int to = mesh.corners[face.first + (c + 1) % face.count];
      const auto other = unmatched.find({to, from});
      if (other == unmatched.end()) {
        unmatched[{from, to}] = static_cast<int>(f);
      } else {
        mesh.edges.push_back({to, from, other->second, static_cast<int>(f)});
        unmatched.erase(other);
      }
    }
  }
  if (!unmatched.empty()) {
    throw InvalidGeometry("the faces of a convex polytope do not close: edge " +
                          std::to_string(unmatched.begin()->first.first) + "-" +
                          std::to_string(unmatched.begin()->first.second) + " has one face only");
  }
}

/// A polygon with its corners in counter-clockwise order around `normal`: one face for each side.
ConvexMesh makePolygon(Points corners, const Eigen::Vector3d& normal) {
  ConvexMesh mesh;
  mesh.vertices = std::move(corners);
  std::vector<int> order(mesh.vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  addFace(mesh, normal, order);
  std::reverse(order.begin(), order.end());
  addFace(mesh, -normal, order);
  addEdges(mesh);
  return mesh;
}

/// A body without volume from its extreme points, in order around it if they are a polygon.
ConvexMesh makeFlat(const Points& extreme_points) {
  ConvexMesh mesh;
  if (extreme_points.size() < 3) {
    mesh.vertices = extreme_points;
    if (extreme_points.size() == 2) mesh.edges = {{0, 1, -1, -1}};
    return mesh;
  }
  double largest = 0.0;
  for (const Eigen::Vector3d& p : extreme_points) {
    largest = std::max(largest, (p - extreme_points[0]).cwiseAbs().maxCoeff());
  }
  const double unit = powerOfTwoAt(largest);
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < extreme_points.size(); ++i) {
    const Eigen::Vector3d p = (extreme_points[i] - extreme_points[0]) / unit;
    area += p.cross((extreme_points[i + 1] - extreme_points[0]) / unit);
  }
  return makePolygon(extreme_points, area.normalized());
}

/// How far the points reach out of the planes of the faces.
double slackOf(const ConvexMesh& mesh, const Points& points) {
  double slack = 0.0;
  for (const ConvexMesh::Face& face : mesh.faces) {
    double plane = face.normal.dot(mesh.vertices[mesh.corners[face.first]]);
    for (int c = 1; c < face.count; ++c) {
      plane = std::max(plane, face.normal.dot(mesh.vertices[mesh.corners[face.first + c]]));
    }
    for (const Eigen::Vector3d& p : points) slack = std::max(slack, face.normal.dot(p) - plane);
  }
  return slack;
}

}  // namespace

Eigen::Vector3d ConvexMesh::supportPoint(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d* best = &vertices.front();
  double highest = direction.dot(*best);
  for (const Eigen::Vector3d& v : vertices) {
    const double height = direction.dot(v);
    if (height > highest) {
      highest = height;
      best = &v;
    }
  }
  return *best;
}

ConvexMesh makeConvexMesh(const ConvexPolytope& polytope) {
  if (polytope.faces.empty()) return makeFlat(polytope.vertices);
  ConvexMesh mesh;
  mesh.vertices = polytope.vertices;
  for (const ConvexPolytope::Face& face : polytope.faces) addFace(mesh, face.normal, face.vertices);
  addEdges(mesh);
  return mesh;
}

ConvexMesh makeConvexMesh(const Points& points) {
  return makeConvexMesh(convexHull(points), points);
}

ConvexMesh makeConvexMesh(const ConvexPolytope& hull, const Points& points) {
  ConvexMesh mesh = makeConvexMesh(hull);
  mesh.slack = std::max(slackOf(mesh, points), hullSlack(mesh, points));
  return mesh;
}

ConvexMesh makeTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c) {
  // In a unit in which squares of areas neither overflow nor underflow.
  const double unit =
      powerOfTwoAt(std::max((b - a).cwiseAbs().maxCoeff(), (c - a).cwiseAbs().maxCoeff()));
  const Eigen::Vector3d ab = (b - a) / unit, ac = (c - a) / unit, bc = (c - b) / unit;
  const Eigen::Vector3d area = ab.cross(ac);
  const double longest = std::max({ab.norm(), ac.norm(), bc.norm()});
  if (area.norm() <= kFlat * longest * longest) return makeConvexMesh(Points{a, b, c});
  return makePolygon({a, b, c}, area.normalized());
}

void reflect(const ConvexMesh& mesh, const Eigen::Matrix3d& rotation, ConvexMesh& image) {
  image.vertices.resize(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    image.vertices[i] = -(rotation * mesh.vertices[i]);
  }
  image.faces = mesh.faces;
  for (ConvexMesh::Face& face : image.faces) face.normal = -(rotation * face.normal);
  // Seen from the other side, a face is walked the other way round.
  image.corners = mesh.corners;
  for (const ConvexMesh::Face& face : image.faces) {
    std::reverse(image.corners.begin() + face.first,
                 image.corners.begin() + face.first + face.count);
  }
  image.slack = mesh.slack;
  image.edges = mesh.edges;
  for (ConvexMesh::Edge& edge : image.edges) std::swap(edge.left, edge.right);
}

}  // namespace fcl_prob::detail
