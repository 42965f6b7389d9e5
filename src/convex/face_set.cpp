// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/face_set.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>

namespace fcl_prob::detail {
namespace {

/// A face is left out of a ConvexPolytope when its area is below this times its longest edge
/// squared: its normal would be noise.
constexpr double kSliver = 1e-13;

std::uint64_t mixed(std::uint64_t x) {  // SplitMix64's finalizer
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

std::uint64_t edgeKey(int low, int high) {
  return mixed((static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint32_t>(high));
}

double longestEdge(const FaceSet& faces, std::size_t face) {
  const int count = faces.cornerCount(face);
  double longest = 0.0;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d edge = faces.position(face, (i + 1) % count) - faces.position(face, i);
    longest = std::max(longest, edge.norm());
  }
  return longest;
}

}  // namespace

void FaceSet::clear() {
  vertices_.clear();
  edge_vectors_.clear();
  first_.clear();
  corners_.clear();
}

int FaceSet::addVertex(const Eigen::Vector3d& position) {
  vertices_.push_back(position);
  return static_cast<int>(vertices_.size()) - 1;
}

void FaceSet::addFace(std::initializer_list<int> corners) {
  beginFace();
  corners_.insert(corners_.end(), corners);
}

void FaceSet::transform(const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation) {
  for (Eigen::Vector3d& v : vertices_) v = linear * v + translation;
  for (Eigen::Vector3d& e : edge_vectors_) e = linear * e;
}

Eigen::Vector3d FaceSet::vectorArea(std::size_t face) const {
  const Eigen::Vector3d& origin = position(face, 0);
  const int count = cornerCount(face);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 1; i + 1 < count; ++i) {
    sum += (position(face, i) - origin).cross(position(face, i + 1) - origin);
  }
  return 0.5 * sum;
}

bool FaceSet::closed() const {
  std::uint64_t sum = 0;
  for (std::size_t face = 0; face < faceCount(); ++face) {
    int from = corners_[end(face) - 1];
    for (int at = first_[face]; at < end(face); ++at) {
      const int to = corners_[at];
      if (from < to) sum += edgeKey(from, to);
      if (from > to) sum -= edgeKey(to, from);
      from = to;
    }
  }
  return sum == 0;
}

namespace {

ConvexPolytope::Face faceOf(const FaceSet& faces, std::size_t f, const Eigen::Vector3d& normal) {
  ConvexPolytope::Face face;
  face.normal = normal;
  face.offset = normal.dot(faces.position(f, 0));
  for (int i = 0; i < faces.cornerCount(f); ++i) {
    face.vertices.push_back(faces.corner(f, i));
    face.offset = std::max(face.offset, normal.dot(faces.position(f, i)));
  }
  return face;
}

// Some unit vector across the longest edge of a face that has no other direction.
Eigen::Vector3d normalOfSliver(const FaceSet& faces, std::size_t f) {
  const int count = faces.cornerCount(f);
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d edge = faces.position(f, (i + 1) % count) - faces.position(f, i);
    if (edge.norm() > longest.norm()) longest = edge;
  }
  return longest.norm() > 0.0 ? longest.unitOrthogonal() : Eigen::Vector3d::UnitX();
}

ConvexPolytope polytopeOf(const FaceSet& faces, bool with_slivers) {
  ConvexPolytope polytope;
  polytope.vertices = faces.vertices();
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    const Eigen::Vector3d area = faces.vectorArea(f);
    const double longest = longestEdge(faces, f);
    if (area.norm() > kSliver * longest * longest) {
      polytope.faces.push_back(faceOf(faces, f, area.normalized()));
    } else if (with_slivers) {
      polytope.faces.push_back(faceOf(faces, f, normalOfSliver(faces, f)));
    }
  }
  return polytope;
}

}  // namespace

FaceSet toFaceSet(const ConvexPolytope& polytope) {
  FaceSet faces;
  for (const Eigen::Vector3d& v : polytope.vertices) faces.addVertex(v);
  for (const ConvexPolytope::Face& face : polytope.faces) {
    faces.beginFace();
    for (const int corner : face.vertices) faces.addCorner(corner);
  }
  return faces;
}

ConvexPolytope toPolytope(const FaceSet& faces) { return polytopeOf(faces, false); }

ConvexPolytope toClosedPolytope(const FaceSet& faces) { return polytopeOf(faces, true); }

void setToBox(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, FaceSet& faces) {
  faces.clear();
  for (int corner = 0; corner < 8; ++corner) {
    faces.addVertex({(corner & 1) ? upper.x() : lower.x(), (corner & 2) ? upper.y() : lower.y(),
                     (corner & 4) ? upper.z() : lower.z()});
  }
  faces.addFace({0, 4, 6, 2});
  faces.addFace({1, 3, 7, 5});
  faces.addFace({0, 1, 5, 4});
  faces.addFace({2, 6, 7, 3});
  faces.addFace({0, 2, 3, 1});
  faces.addFace({4, 5, 7, 6});
}

}  // namespace fcl_prob::detail
