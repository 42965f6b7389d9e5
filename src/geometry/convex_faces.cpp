// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/convex_faces.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fcl_prob/exceptions.h"
#include "geometry/directed_edges.h"
#include "geometry/length.h"

namespace fcl_prob::detail {
namespace {

/// Vertices off their face's plane, relative to the size of the body: what single precision leaves.
constexpr double kPlanarTolerance = 1e-6;

using Points = std::vector<Eigen::Vector3d>;

struct FacePlane {
  Eigen::Vector3d normal;  ///< unit, or zero for a face that is narrower than the tolerance
  Eigen::Vector3d point;

  double height(const Eigen::Vector3d& v) const { return normal.dot(v - point); }
};

/// Whether all its corners are as close to a line as they may be off a plane: then it has no
/// direction of its own that could be wrong.
bool isNarrow(const Points& points, const std::vector<int>& face, double tolerance) {
  const Eigen::Vector3d& origin = points[face[0]];
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (int vertex : face) {
    const Eigen::Vector3d way = points[vertex] - origin;
    if (way.squaredNorm() > along.squaredNorm()) along = way;
  }
  const double length = along.norm();
  if (!(length > 0.0)) return true;
  return std::all_of(face.begin(), face.end(), [&](int vertex) {
    return along.cross(points[vertex] - origin).norm() <= tolerance * length;
  });
}

/// Newell's normal: right for any planar polygon, and the mean for one that is not quite.
FacePlane planeOf(const Points& points, const std::vector<int>& face, double tolerance) {
  const Eigen::Vector3d& origin = points[face[0]];
  if (isNarrow(points, face, tolerance)) return {Eigen::Vector3d::Zero(), origin};
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < face.size(); ++i) {
    normal += (points[face[i]] - origin).cross(points[face[(i + 1) % face.size()]] - origin);
  }
  const double length = normal.norm();
  return {length > 0.0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero(), origin};
}

[[noreturn]] void refuse(const std::string& name, const std::string& fault) {
  throw InvalidGeometry(name + ": " + fault);
}

void requirePositions(const Points& points, const std::string& name) {
  if (points.empty()) refuse(name, "it has no vertices");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (isPosition(points[i])) continue;
    std::ostringstream out;
    out << "vertex " << i << " is (" << points[i].transpose() << ")";
    refuse(name, out.str());
  }
}

void requireAllUsed(std::size_t vertex_count, const std::vector<std::vector<int>>& faces,
                    const std::string& name) {
  std::vector<bool> used(vertex_count, false);
  for (const auto& face : faces) {
    for (int index : face) used[index] = true;
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end()) {
    refuse(name, "vertex " + std::to_string(unused - used.begin()) + " belongs to no face");
  }
}

std::vector<DirectedEdge> edgesOf(const std::vector<std::vector<int>>& faces) {
  std::vector<DirectedEdge> edges;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    addSides(faces[f], static_cast<int>(f), edges);
  }
  return edges;
}

void requirePlanar(const FacePlane& plane, const Points& points, const std::vector<int>& face,
                   std::size_t index, double tolerance, const std::string& name) {
  for (int vertex : face) {
    const double height = plane.height(points[vertex]);
    if (std::abs(height) <= tolerance) continue;
    std::ostringstream out;
    out << "vertex " << vertex << " lies " << height << " m off the plane of its face " << index;
    refuse(name, out.str());
  }
}

Eigen::Vector3d middleOf(const Points& points, const std::vector<int>& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int vertex : face) sum += points[vertex];
  return sum / static_cast<double>(face.size());
}

/// A planar face lies on one side of its edges, so its middle tells on which side of a neighbour it
/// is.
void requireBehind(const FacePlane& plane, const Eigen::Vector3d& middle_of_neighbour,
                   const EdgeMatch& edge, double tolerance, const std::string& name) {
  const double height = plane.height(middle_of_neighbour);
  if (height <= tolerance) return;
  std::ostringstream out;
  out << "faces " << edge.forward.polygon << " and " << edge.backward.polygon
      << " are not convex (by " << height << " m), or not counter-clockwise seen from outside";
  refuse(name, out.str());
}

/// Across a face without a normal its neighbours may be dented unnoticed: then all vertices have to
/// be behind all other faces.
void requireAllBehind(const std::vector<FacePlane>& planes, const Points& points, double tolerance,
                      const std::string& name) {
  for (std::size_t f = 0; f < planes.size(); ++f) {
    for (std::size_t v = 0; v < points.size(); ++v) {
      const double height = planes[f].height(points[v]);
      if (height <= tolerance) continue;
      std::ostringstream out;
      out << "vertex " << v << " lies " << height << " m before face " << f
          << ": it is not convex, or not counter-clockwise seen from outside";
      refuse(name, out.str());
    }
  }
}

void requireConvex(const Points& points, const std::vector<std::vector<int>>& faces,
                   const std::vector<EdgeMatch>& matches, const std::string& name) {
  double size = 0.0;
  for (const auto& p : points) size = std::max(size, (p - points[0]).cwiseAbs().maxCoeff());
  const double tolerance = kPlanarTolerance * size;
  std::vector<FacePlane> planes;
  Points middles;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    planes.push_back(planeOf(points, faces[f], tolerance));
    middles.push_back(middleOf(points, faces[f]));
    requirePlanar(planes[f], points, faces[f], f, tolerance, name);
  }
  for (const EdgeMatch& edge : matches) {
    requireBehind(planes[edge.forward.polygon], middles[edge.backward.polygon], edge, tolerance,
                  name);
    requireBehind(planes[edge.backward.polygon], middles[edge.forward.polygon], edge, tolerance,
                  name);
  }
  const bool all_known = std::none_of(planes.begin(), planes.end(), [](const FacePlane& plane) {
    return plane.normal.isZero(0.0);
  });
  if (!all_known) requireAllBehind(planes, points, tolerance, name);
}

}  // namespace

std::vector<std::vector<int>> decodeFaces(const fcl::Convexd& convex, const std::string& name) {
  const std::vector<int>& code = convex.getFaces();
  const auto vertex_count = static_cast<int>(convex.getVertices().size());
  std::vector<std::vector<int>> faces;
  std::size_t at = 0;
  for (int f = 0; f < convex.getFaceCount(); ++f) {
    const std::string where = "face " + std::to_string(f);
    if (at >= code.size()) refuse(name, where + " is missing from the face array");
    const int count = code[at++];
    if (count < 3) refuse(name, where + " has " + std::to_string(count) + " vertices");
    if (code.size() - at < static_cast<std::size_t>(count)) {
      refuse(name, where + " runs over the end of the face array");
    }
    faces.emplace_back(code.begin() + at, code.begin() + at + count);
    for (int index : faces.back()) {
      if (index < 0 || index >= vertex_count) {
        refuse(name, where + " refers to vertex " + std::to_string(index) +
                         ", but there are only " + std::to_string(vertex_count));
      }
    }
    at += count;
  }
  if (faces.empty()) refuse(name, "it has no faces");
  if (at != code.size()) refuse(name, "the face array goes on after the last face");
  return faces;
}

void validateConvex(const fcl::Convexd& convex, const std::string& name) {
  const Points& points = convex.getVertices();
  requirePositions(points, name);
  const auto faces = decodeFaces(convex, name);
  requireAllUsed(points.size(), faces, name);
  const EdgePairing pairing = pairEdges(edgesOf(faces));
  if (pairing.fault) refuse(name, "its faces do not close: " + *pairing.fault);
  requireConvex(points, faces, pairing.matches, name);
}

}  // namespace fcl_prob::detail
